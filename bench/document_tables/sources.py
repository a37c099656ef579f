"""What is taken from a run of the contact model for a table, by name. A function of a scene returns these numbers; one that needs more than the run
returns such a function. Angles are in degrees."""

import math

import numpy as np

DIAMETER = 8.2  # mean of hexagons of radius 3 and 5
MASS = {1: {"small": 7, "large": 19}, 3: {"small": 37, "large": 91}}  # of the species in sites, by the radius of small hexagons


def masses(frame, small):
    return np.where(frame.species == "small", MASS[small]["small"], MASS[small]["large"])


def turned(places, degrees):
    """Anticlockwise."""
    x, y = places.T
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)


def of_stage(run, name):
    return [frame for frame in run.frames if frame.stage == name]


def angles(run, frames):
    """Of the vessel in frames."""
    return np.interp([frame.step for frame in frames], run.series["step"], np.unwrap(run.series["vessel_angle_deg"], period=360))


def slope(places, width, half):
    """Of a straight line through the highest of places in strips from -half to half."""
    places = places[abs(places[:, 0]) < half]
    strips = np.floor((places[:, 0] + half) / width)
    highest = np.array([max(places[strips == strip], key=lambda place: place[1]) for strip in np.unique(strips)])
    return math.degrees(math.atan(np.polyfit(*highest.T, 1)[0]))


def deposit(width):
    """Of a column so wide that has collapsed."""
    def numbers(run):
        packing, flow = run.measures["packing"], run.measures["flow"]
        end, profile, series = run.frames[-1], run.table("profile-flow"), run.series[run.series["stage"] == "flow"]
        height = packing["height_mean"]
        times = (series["time"] - series["time"][0]) / math.sqrt(2 * height)
        energy = series["kinetic_energy"]
        return {"H0/L0": height / width, "run-out": flow["runout_99"] / width, "slope": flow["repose_right_deg"], "moved": flow["moved_share"],
                "steps": run.stages["flow"].steps, "shift": np.average(end.displacements[:, 0], weights=masses(end, 1)) / width,
                "slow after": times[energy > max(energy) / 100][-1], "last move": times[series["moving"] > 0][-1],
                **{at: np.interp(at * width, profile["x"], profile["height_end"]) / width for at in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)}}
    return numbers


def silo(diameters):
    """With an orifice of so many d."""
    def numbers(run):
        table = run.table("lines-discharge")
        line = table[(table["line"] == "orifice") & (abs(table["x"] - 164) < diameters * DIAMETER / 8)]
        speed = np.average(line["v_across"], weights=line["particles"])
        return {"outflow": run.measures["discharge"]["outflow_sites_per_step"] / 0.2868,  # m sqrt(g / d) in sites a step
                "speed": abs(speed), "by fall": abs(speed) / math.sqrt(9.81 * diameters * DIAMETER * 0.25e-3), "filling": np.mean(line["filling"])}
    return numbers


def weight(run):
    """On floor and sides, of the weight of all grains."""
    walls = {row["wall"]: row for row in run.table("walls-rest")}
    sides = [walls["box.left"], walls["box.right"]]
    return {"floor": run.measures["rest"]["load_floor"], "steps": run.stages["filling"].steps,
            "friction": abs(sum(side["force_y"] for side in sides)) / (0.4 * sum(abs(side["force_x"]) for side in sides))}


def plate(run):
    return {stage: next(row["force_y"] for row in run.table(f"walls-{stage}") if row["wall"] == "plate")
            for stage in ("half", "one", "two", "three", "four", "five")}


def in_drum(frame, angle):
    """Places from the middle of the drum, masses, centre of mass, its direction, and the slope of the surface between half the radius to either side."""
    places, mass = turned(frame.positions - 83, angle), masses(frame, 1)
    middle = np.average(places, axis=0, weights=mass)
    surface = direction = math.degrees(math.atan2(middle[0], -middle[1]))
    for _ in range(5):
        surface += slope(turned(places, -surface), 5, 40)
    return places, mass, middle, direction, surface


def drum(run):
    """After half a turn; and by turns the share of small grains within a quarter of the radius from the centre of mass."""
    frames, shots = of_stage(run, "turn"), []
    for frame, angle in zip(frames, angles(run, frames)):
        places, mass, middle, direction, surface = in_drum(frame, angle)
        core = mass[np.hypot(*(places - middle).T) < 20]
        shots.append((angle / 360, surface, direction, core[core == MASS[1]["small"]].sum() / core.sum()))
    turns, surface, direction, core = np.array(shots).T
    late = turns > 0.5
    return {"surface": surface[late].mean(), "centre": direction[late].mean(), "least": direction[late].min(), "most": direction[late].max(),
            "in time": direction[late].std(), **{at: core[abs(turns - at) <= 0.05].mean() for at in (0.05, 0.5, 1, 1.5, 1.95)}}


def standing_drum(run):
    frame = run.frames[-1]
    *_, direction, surface = in_drum(frame, *angles(run, [frame]))
    return {"surface": surface, "centre": direction}


def tilted(run):
    """Tilt when a share of the grains has moved by a diameter, and slopes of the surface before and after."""
    frames, shots = of_stage(run, "tilt"), []
    tilt = angles(run, frames)
    for frame in frames:
        tops = np.array([max(outline, key=lambda corner: corner[1]) for outline in frame.outlines]) - (130, 0)
        shots.append((np.mean(np.hypot(*frame.displacements.T) > DIAMETER), slope(tops, 10, 0.3 * 260)))
    moved, surface = np.array(shots).T
    surface = abs(surface + tilt)
    failure = {share: tilt[np.argmax(moved >= share)] for share in (0.05, 0.1, 0.2)}
    return {**failure, "before": surface[tilt <= failure[0.1]].max(),
            "after": surface[(tilt >= failure[0.1]) & (tilt <= failure[0.1] + 3)].min(), "rest": surface[-1]}


def chute(run):
    """The layer ends at the highest part of the line that is filled half as much as the middle."""
    line = run.table("lines-flow")
    last = np.flatnonzero(line["filling"] > np.median(line["filling"][5:15]) / 2)[-1]
    line = line[:last + 1]
    y, speed = line["position"], line["v_across"]
    inner = slice(4, -4)
    if abs(speed[-1]) < 0.05:
        return {"surface": 0.0}
    power = np.polyfit(np.log(1 - y[inner] / (y[-1] + 1)), np.log(1 - speed[inner] / speed[-1]), 1)[0]
    return {"surface": speed[-1], "mean": np.average(speed, weights=line["filling"]), "n": power, "filling": line["filling"][inner].mean(),
            "depth": y[-1] + 1, "slip": speed[3] / speed[-1]}


def nut(run):
    table = run.table("cycles")
    table = table[table["stage"] == "shaking"]
    height = dict(zip(table["cycle"].astype(int), table["intruder_height_rel"]))
    up = [cycle for cycle, at in height.items() if at >= 1]
    return {**{cycle: height[cycle] for cycle in (100, 200, 300)}, "top": bool(up), "packing": run.measures["shaking"]["packing_fraction"],
            **({"until": float(up[0])} if up else {})}


def convection(run):
    """Rise inside less that at the walls in d a cycle: in the bed below the surface, and of all cells."""
    cells = run.table("convection-shaking")
    cells = cells[cells["y"] <= 112]
    from_middle = abs(cells["x"] - 101)
    inside, wall = from_middle < 202 / 6, from_middle > 101 - 2 * DIAMETER
    rise = [np.average(cells["dy"][part], weights=cells["weight"][part]) for part in (inside, wall)]
    return {"bed": (rise[0] - rise[1]) / DIAMETER, "all": run.measures["shaking"]["convection_centre_minus_wall"] / DIAMETER}


def rotation(run):
    """Of the collapse of 540 grains, by sums over its states 20 steps apart, while kinetic energy is above 1 % of its most."""
    frames = of_stage(run, "flow")
    mass = masses(frames[0], 1)
    radius = np.sqrt(mass * math.sqrt(0.75) / math.pi)  # of discs of the same area
    spins = [frame.angular_velocities * radius for frame in frames]
    energies = [(mass @ (frame.velocities ** 2).sum(axis=1), mass @ spin ** 2 / 2) for frame, spin in zip(frames, spins)]
    fast = 0.0075 * frames[0].step / frames[0].time  # 0.0075 spacings a step
    sums = dict.fromkeys(("rotation", "kinetic", "spin", "signed", "speed", "pairs", "opposite", "product", "squares", "slip", "bare", "holding"),
                         0.0)
    path, turn, net = np.zeros((3, len(mass)))
    strongest = max(sum(energy) for energy in energies)
    for frame, spin, energy in zip(frames, spins, energies):
        if sum(energy) < strongest / 100:
            continue
        sums["rotation"] += energy[1]
        sums["kinetic"] += sum(energy)
        speed = np.hypot(*frame.velocities.T)
        moving = speed > fast
        sums["spin"] += abs(spin[moving]).sum()
        sums["signed"] += spin[moving].sum()
        sums["speed"] += speed[moving].sum()
        contacts = frame.contacts
        contacts = contacts[(contacts["other"] >= 0) & (contacts["force"][:, 0] > 0)]
        upper, other = contacts["upper"].astype(int), contacts["other"].astype(int)
        both = moving[upper] & moving[other]
        contacts, upper, other = contacts[both], upper[both], other[both]
        tangent = np.stack([-contacts["normal"][:, 1], contacts["normal"][:, 0]], axis=1)
        bare = ((frame.velocities[upper] - frame.velocities[other]) * tangent).sum(axis=1)
        sums["pairs"] += len(contacts)
        sums["opposite"] += (spin[upper] * spin[other] < 0).sum()
        sums["product"] += (spin[upper] * spin[other]).sum()
        sums["squares"] += (spin[upper] ** 2 + spin[other] ** 2).sum() / 2
        sums["bare"] += abs(bare).sum()
        sums["slip"] += abs(bare - spin[upper] - spin[other]).sum()
        sums["holding"] += (abs(contacts["force"][:, 1]) < 0.99 * 0.4 * contacts["force"][:, 0]).sum()
    for before, frame, spin in zip(frames, frames[1:], spins):
        rolled = spin * (frame.time - before.time)
        path += np.hypot(*(frame.displacements - before.displacements).T)
        turn += abs(rolled)
        net += rolled
    far = path > 3
    degrees = np.degrees(1 / radius[far])
    rolls = sums["spin"] > 0
    return {"energy": sums["rotation"] / sums["kinetic"], "spin": sums["spin"] / sums["speed"], "turning": np.median(turn[far] * degrees),
            "rolled": turn[far].sum() / path[far].sum(), "net turn": np.median(abs(net[far]) * degrees),
            "net rolled": abs(net[far]).sum() / path[far].sum(), "slip": sums["slip"] / sums["bare"], "holding": sums["holding"] / sums["pairs"],
            "slope": run.measures["flow"]["repose_right_deg"], "run-out": run.measures["flow"]["runout_99"] / 72,
            **({"signs": sums["signed"] / sums["spin"], "opposite": sums["opposite"] / sums["pairs"],
                "correlation": sums["product"] / sums["squares"]} if rolls else {})}
