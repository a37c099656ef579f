"""The cases of bench/peers/references: which scene, which deck, and what is taken from the run. Seeds begin at 101."""
import math
import sys
import types

import numpy as np

import beds
from beds import COLUMN, FLOOR, LEFT
from dem import HERE, Case

sys.path.insert(0, str(HERE.parent))
from document_tables import sources  # what the documents take from runs of clca is taken from these likewise

FEW = "stages.{}.until={{steps: 1}}".format  # grains of a fill are there from the start
POUR = "{{region: {}, species: {{small: 1, large: 1}}, rate: {}, count: {}}}".format


def face(x):
    """Left face of a wall from x on."""
    return math.ceil(x / COLUMN) * COLUMN - COLUMN / 2


def floor_share(run):
    """Force on the floor over the weight of all grains, mean of the frames at rest."""
    shares = []
    for frame in run.frames("rest"):
        overlap = np.maximum(0, frame.radii - (frame.positions[:, 1] - FLOOR))
        shares.append(run.variables["stiffness"] * overlap.sum() / (math.pi * frame.radii**2).sum())
    return {"floor": np.mean(shares)}


def deposit(width):
    """Of a column so wide that has collapsed."""
    def numbers(run):
        column, end = run.frame("column"), run.frame("deposit")
        heights = beds.profile(column.discs, width)
        profile = beds.profile(end.discs, run.variables["space_right"])
        shift = end.positions - column.positions
        values = {"height": np.mean([height for height in heights if height > 0]) / width, "slope": beds.slope(profile),
                  "runout": beds.runout_99(column.discs, end.discs) / width,
                  "moved": np.mean(np.hypot(*shift.T) > 2 * run.grains.radii[1]), "shift": np.average(shift[:, 0], weights=end.radii**2) / width}
        at = COLUMN * np.arange(len(profile))
        return values | {f"profile_{place}": np.interp(place * width, at, profile) / width for place in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)}
    return numbers


def collapse(name, grains, width, rolling, seeds, height=None, most_flow=2000.0, **more):
    height = height or round(6.4 * width)
    return Case(name, "collapse-contact", "collapse", (
        f"box={{width: {7 * width:.0f}, height: {height}}}", f"walls.right={{box: [{width}, 0, {width + 1}, {height}]}}",
        f"stages.packing.fill={{region: [0, 0, {width}, {height}], counts: {{small: {grains // 2}, large: {grains // 2}}}}}",
        FEW("packing"), FEW("flow")), deposit(width), rolling, seeds=seeds,
        variables={"right": face(width), "space_right": 20.0 * width, "most_flow": most_flow}, **more)


def rolling_540(what, seeds, **parameters):
    return collapse(f"collapse-540-resistance-{what}", 540, 72, "resistance", seeds, **parameters)


def filled(name, rolling, seeds, width, fill_height, each, height=None):
    """A bed of so many grains of each species, placed at random up to a height."""
    return Case(name, "janssen", "bed", (
        f"box={{width: {width}, height: {height or fill_height}}}",
        f"stages.filling.fill={{region: [0, 0, {width}, {fill_height}], counts: {{small: {each}, large: {each}}}}}", FEW("filling"), FEW("rest")),
        floor_share, rolling, seeds=seeds)


def poured(name, rolling, seeds, rate):
    """700 grains into a silo 20 d wide."""
    source = (0, 900, 164, 1000)
    return Case(name, "janssen", "bed", (
        "box={width: 164, height: 1010}", f"sources={{rain: {POUR(list(source), rate, 700)}}}",
        "stages=[{name: filling, sources: [rain], until: settled, max_steps: 40000}]", "output={trajectory: {every: 50}}"),
        floor_share, rolling, seeds=seeds, fall_height=1010, source=source)


def outflow(run):
    """As `outflow_sites_per_time`, and while the surface is so high (in d above the orifice), in m sqrt(g/d)."""
    dt, unit = run.variables["dt"], math.sqrt(sources.DIAMETER)
    steps, gone = np.loadtxt(run.folder / "counts", skiprows=1).T
    first, last = (np.argmax(gone >= share * gone[-1]) for share in (0.2, 0.7))
    second = math.sqrt(sources.SPACING / 9.81)
    frames = [types.SimpleNamespace(stage="discharge", time=frame.time * second, positions=frame.positions[frame.positions[:, 1] > 40])
              for frame in run.frames("frames")]
    by_height = sources.outflow_by_height(types.SimpleNamespace(
        frames=frames, series={"time": steps * dt * second, "discharged_sites": gone * 64}))
    return {"outflow": (gone[last] - gone[first]) / ((steps[last] - steps[first]) * dt) * unit,
            **{f"outflow_{height}": value for height, value in by_height.items()}}


def silo(name, orifice, seeds, each=1150, height=66, discharged=0.6):
    top, fall_height = 64 + 18.7 * height, each * 2 * 64 * COLUMN / (0.8 * 328)
    filling = max(8000, 121 * height) * 0.4 / math.sqrt(2 * fall_height)
    return Case(name, "silo-beverloo", "silo", (
        f"box.height={top:.0f}", "lines={}", f"stages.filling.fill={{region: [0, 64, 328, {top:.0f}], counts: {{small: {each}, large: {each}}}}}",
        FEW("filling"), FEW("discharge")), outflow, "free", seeds=seeds,
        variables={"floor": 64.0, "orifice_left": 164 - 4.1 * orifice, "orifice_right": 164 + 4.1 * orifice, "filling": filling,
                   "discharged": discharged})


def flanks(run):
    """Slopes of a heap, of its flanks that have one."""
    *_, frame = run.frames("rest")
    profile = beds.profile(frame.discs, run.variables["right"])
    slopes = [slope for slope in (beds.slope(profile), beds.slope(profile[::-1])) if slope is not None]
    return {"slope": np.mean(slopes), "grains": len(frame.ids)} if slopes else {"grains": len(frame.ids)}


def heap(name, rate, seeds):
    source = (232, 54, 248, 60)
    return Case(name, "heap", "bed", (
        "model=contact", "contact={friction: 0.4, rolling: resistance, rolling_friction: 0.5, fall_height: 56}",
        f"sources.spout={POUR(list(source), rate, 240)}"), flanks, "resistance", seeds=seeds, fall_height=56, source=source)


def of_vessel(run, stage, degrees_per_time, most=math.inf):
    """Frames as clca has them, in the vessel, with the series of its angle."""
    frames = list(run.frames("frames"))
    start, begin = frames[0], frames[0].time
    for frame in frames:
        frame.stage, frame.step = stage, frame.time
        frame.displacements = frame.positions - start.positions
        frame.outlines = [[top] for top in frame.positions + np.stack([0 * frame.radii, frame.radii], axis=1)]
    times = np.array([frame.time for frame in frames])
    angles = np.minimum(most, (times - begin) * degrees_per_time)
    return types.SimpleNamespace(frames=frames, series={"step": times, "vessel_angle_deg": angles})


def failure(run):
    values = sources.tilted(of_vessel(run, "tilt", run.variables["rate"], run.variables["tilt"]))
    return {{0.05: "5_percent", 0.1: "10_percent", 0.2: "20_percent"}.get(key, key): value for key, value in values.items()}


def tilted(name, rolling, seeds):
    return Case(name, "tilting-box", "tilt", (FEW("settle"), FEW("tilt")), failure, rolling, seeds=seeds, frame=7.0,
                variables={"tilt": 35.0, "rate": 0.02})


def turning(rate):
    def numbers(run):
        seen = of_vessel(run, "turn", 360 * rate)
        for frame, angle in zip(seen.frames, seen.series["vessel_angle_deg"]):
            frame.positions = sources.turned(frame.positions, -angle) + 83
        values = sources.drum(seen)
        return {"surface": values["surface"], "centre": values["centre"], "core": values[1.95]}
    return numbers


def drum(name, rate, rolling, seeds):
    return Case(name, "rotating-drum", "drum", (FEW("refill"), FEW("turn")), turning(rate), rolling, seeds=seeds, frame=5.66, centre=(83, 83),
                variables={"radius": 80.0, "rate": rate, "turning": 2 / rate})


CASES = [
    collapse("collapse-540-resistance", 540, 72, "resistance", 64),
    collapse("collapse-540-none", 540, 72, "none", 64),
    *(poured(f"hard-rain-{rolling}", rolling, seeds, 5) for rolling, seeds in (("none", 16), ("resistance", 8), ("free", 8))),
    filled("random-fill-none", "none", 8, 164, 700, 350, 1010),
    poured("slow-pour-none", "none", 4, 0.05),
    filled("janssen-42d", "resistance", 4, 328, 600, 790),
    filled("janssen-83d", "resistance", 4, 164, 1300, 790),
    collapse("collapse-540-free", 540, 72, "free", 4, most_flow=60.6),
    collapse("collapse-540-none-friction-0.2", 540, 72, "none", 4, friction=0.2),
    rolling_540("restitution-0.8", 16, restitution=0.8),
    rolling_540("rolling-0.2", 16, rolling_friction=0.2),
    rolling_540("rolling-0.2-stiffness-160000", 8, rolling_friction=0.2, stiffness=1.6e5),
    rolling_540("stiffness-2500", 16, stiffness=2.5e3),
    rolling_540("stiffness-160000", 16, stiffness=1.6e5),
    collapse("collapse-2000-resistance-stiffness-160000", 2000, 138.6, "resistance", 4, stiffness=1.6e5),
    collapse("collapse-5000-resistance-stiffness-160000", 5000, 219, "resistance", 1, stiffness=1.6e5),
    heap("heap-60-steps", 0.0167, 8),
    heap("heap-240-steps", 0.0042, 8),
    tilted("tilted-box-free", "free", 8),
    silo("silo-8d", 8, 3),
    silo("silo-10d", 10, 3),
    silo("silo-14d", 14, 3),
    collapse("collapse-2000-resistance", 2000, 138.6, "resistance", 4),
    collapse("collapse-2000-none", 2000, 138.6, "none", 4),
    drum("drum-resistance-0.1", 0.00563, "resistance", 3),
    drum("drum-resistance-0.01", 0.00178, "resistance", 3),
    drum("drum-none-0.01", 0.00178, "none", 3),
    drum("drum-free-0.01", 0.00178, "free", 3),
    collapse("collapse-5000-resistance", 5000, 219, "resistance", 3),
    collapse("collapse-5000-none", 5000, 219, "none", 3),
    *(collapse(f"collapse-2000-resistance-{width}-wide", 2000, width, "resistance", 4, height=1300) for width in (169, 119, 84)),
    silo("silo-10d-33d-high", 10, 3, 575, 33, 0.65),
    silo("silo-10d-132d-high", 10, 3, 2300, 132, 0.65),
    drum("drum-resistance-0.001", 0.000563, "resistance", 3),
]
