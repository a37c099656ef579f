"""Tables of the contact model: docs/contact.md and docs/phenomena.md."""

from . import sources
from .table import Line, Table

DEPOSIT = [Line("H0/L0", key="H0/L0"), Line("run-out of 99 % / L0", key="run-out"), Line("slope °", key="slope", decimals=1),
           Line("centre of mass, shift / L0", key="shift"), Line("share moved", key="moved"), Line("steps to rest", key="steps", decimals=0)]
TIMES = [Line("kinetic energy below 1 % after, √(2 H0/g)", key="slow after", decimals=1), Line("last move", key="last move", decimals=1)]
PROFILE = [Line(f"height / L0 at x/L0 = {at}", key=at) for at in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)]
ROTATION = [Line("share of kinetic energy in rotation", key="energy", decimals=4), Line(r"Σ\|s\| / Σ\|v\|", key="spin", decimals=3),
            Line("turning over the whole path °", key="turning", decimals=0), Line("rolled path over path", key="rolled", decimals=3),
            Line(r"Σs / Σ\|s\|", key="signs"), Line("pairs that turn opposite ways", key="opposite", decimals=3),
            Line("correlation of spins", key="correlation"), Line("net turn °", key="net turn", decimals=0),
            Line("net rolled path over path", key="net rolled", decimals=3), Line("sliding with spin over that without", key="slip"),
            Line("contacts that do not slide", key="holding")]
ENDS = "{series: {every: 10}, trajectory: {every: 1000000}}"  # states at the ends of stages


def collapse(title, seeds, grains, width, rolling, *more, height=None):
    height = height or round(6.4 * width)
    return Line(title, [
        f"box={{width: {7 * width:.0f}, height: {height}}}",
        f"walls.right={{box: [{width}, 0, {width + 1}, {height}]}}",
        f"stages.packing.fill={{region: [0, 0, {width}, {height}], counts: {{small: {grains // 2}, large: {grains // 2}}}}}",
        f"contact.rolling={rolling}", *more], seeds, sources.deposit(width))


def hexagons(small, large):
    return [f"species.small.shape.hexagon={small}", f"species.large.shape.hexagon={large}"]


def orifice(diameters):
    """In the middle of a silo 40 d wide, d = 8.2."""
    left, right = 164 - 4.1 * diameters, 164 + 4.1 * diameters
    return Line(f"{diameters} d", [
        f"walls.floor_left={{box: [0, 60, {left}, 64]}}", f"walls.plug={{box: [{left}, 60, {right}, 64]}}",
        f"walls.floor_right={{box: [{right}, 60, 328, 64]}}"], source=sources.silo(diameters))


def silo_of(title, radii, *more):
    """As high and wide in d as that of the scene, with an orifice of 10 d."""
    factor = sources.mean_diameter(radii) / sources.DIAMETER
    left, right, width, top = (f"{place * factor:.2f}" for place in (123, 205, 328, 1300))
    return Line(title, [
        *hexagons(*radii), f"box={{width: {width}, height: {top}}}", "lines={}",
        f"walls.floor_left.box=[0, 60, {left}, 64]", f"walls.plug.box=[{left}, 60, {right}, 64]", f"walls.floor_right.box=[{right}, 60, {width}, 64]",
        f"outlets.tray.region=[0, 0, {width}, 40]", f"stages.filling.fill.region=[0, 64, {width}, {top}]",
        f"stages.filling.until={{steps: {8000 * max(1, factor):.0f}}}", *more], source=sources.outflow(radii))


def bed(title, grains, height):
    """So high in a silo 40 d wide."""
    top = 64 + 18.7 * height
    return Line(title, [f"box.height={top:.0f}", "lines={}", "stages.discharge.until={discharged: 0.65}",
                        f"stages.filling.fill={{region: [0, 64, 328, {top:.0f}], counts: {{small: {grains}, large: {grains}}}}}",
                        f"stages.filling.until={{steps: {max(8000, 121 * height)}}}"])


def janssen(rolling, height, grains, *more, title=None, how=""):
    return Line(title or f"{rolling}, {2 * grains} grains", [
        "box.height=2400", f"contact.rolling={rolling}",
        f"stages.filling.fill={{region: [0, 0, 328, {height}], counts: {{small: {grains}, large: {grains}}}{how}}}", *more])


def poured(title, *more, seeds="101..108", **source):
    """From a source, at rest."""
    text = ", ".join(f"{key}: {value}" for key, value in source.items())
    return Line(title, [f"sources={{pour: {{{text}}}}}",
                        "stages=[{name: filling, sources: [pour], until: settled, max_steps: 100000}, {name: rest, until: {steps: 3000}}]", *more], seeds)


def rain(title, *more, rate=5, bottom=902, seeds="101..108"):
    """Of 700 grains without rotation into a silo 20 d wide."""
    return poured(title, f"box={{width: 164, height: {bottom + 98}}}", "contact.rolling=none", *more, seeds=seeds,
                  region=f"[0, {bottom}, 164, {bottom + 98}]", rate=rate, count=700)


def tilted_box(title, angle, height, bottom=0):
    return Line(title, [f"box.height={height}", f"stages.settle.fill.region=[0, {bottom}, 260, {height}]", f"stages.settle.vessel={{tilt: {angle}}}",
                        "stages.settle.max_steps=30000", f"stages.tilt.vessel={{tilt: {angle}}}", "stages.tilt.until={steps: 1}"])


def rolling(name):
    return f"contact.rolling={name}"


RATE = "stages.turn.vessel.rotate.rate"
RATES = {0.001: 0.000563, 0.01: 0.00178, 0.1: 0.00563}  # by Froude number
IN_TIME = "{series: {every: 20}, trajectory: {every: 200}}"

TABLES = [
    Table("contact.md: what is reproduced", "wall-removal", DEPOSIT,
          [Line(name, ["model=contact", "box.width=800", "walls.right.box=[70,0,71,460]", "stages.packing.fill.region=[0,0,70,460]", rolling(name)],
                seeds) for name, seeds in (("none", "1..128"), ("resistance", "1..128"), ("free", "1..16"))],
          source=sources.deposit(70), output=ENDS),
    Table("contact.md: what is reproduced, 5,000 grains", "wall-removal", DEPOSIT,
          [collapse(name, "1..4", 5000, 213, name, "model=contact", height=1400) for name in ("none", "resistance")], output=ENDS),
    Table("contact.md: time step", "collapse-contact", DEPOSIT,
          [collapse(f"{grains}, {name}, {resolution}", seeds, grains, width, name, *(() if resolution == 0.4 else (f"contact.resolution={resolution}",)))
           for grains, width, seeds in ((540, 72, "101..116"), (2000, 138.6, "101..104")) for name in ("resistance", "none") for resolution in (0.4, 0.55)],
          output=ENDS),
    Table("contact.md: forces", "janssen",
          [Line("floor + sides", key="carried", decimals=4), Line("not balanced", key="residual", decimals=5), Line("floor", key="floor")],
          [Line("1,200 grains", ["box={width: 60, height: 600}", rolling("free"), *hexagons(1, 2),
                                 "stages.filling.fill={region: [0, 0, 60, 600], counts: {small: 600, large: 600}}", "stages.rest.until={steps: 1000}"])],
          source=sources.balance),
    Table("contact.md: rain", "janssen", [Line("on the floor", key="floor")],
          [rain("5 a step"), rain("0.05", rate=0.05), rain("0.01", rate=0.01), rain("5, half as high", bottom=451),
           rain("5, no restitution", "contact.restitution=0"), rain("5, 32 sweeps", "contact.sweeps=32", seeds="101..105")], source=sources.load),
    Table("contact.md: heap", "heap", [Line(f"{side} °", key=side) for side in ("left", "right", "angle")],
          [Line(f"{rate} grains a step", ["model=contact", "contact={friction: 0.4, rolling: resistance, rolling_friction: 0.5, fall_height: 56}",
                                          f"sources.spout={{region: [232, 54, 248, 60], species: {{small: 1, large: 1}}, rate: {rate}, count: 240}}"])
           for rate in (0.0167, 0.0042)], "101..108", sources.heap, 1),
    Table("phenomena.md: collapse", "collapse-contact", DEPOSIT + TIMES + PROFILE,
          [collapse(f"{grains}, {name}", seeds, grains, width, name)
           for name in ("resistance", "none")
           for grains, width, seeds in ((540, 72, "101..116"), (2000, 138.6, "101..104"), (5000, 219, "101..103"))], output=ENDS),
    Table("phenomena.md: friction", "collapse-contact", DEPOSIT[1:3],
          [collapse(title, "101..108", 540, 72, "none", f"contact.friction={friction}", f"contact.wall_friction={floor}", *more)
           for title, friction, floor, *more in (("0.2", 0.2, 0.2), ("0.6", 0.6, 0.6), ("0.2, four sweeps", 0.2, 0.2, "contact.sweeps=4"),
                                                 ("0.2, floor 0.4", 0.2, 0.4))], output=ENDS),
    Table("phenomena.md: height/width", "collapse-contact", DEPOSIT[:3],
          [collapse(f"{width} wide", "101..104", 2000, width, "resistance", height=1300) for width in (169, 119, 84)], output=ENDS),
    Table("phenomena.md: free rolling", "collapse-contact", [DEPOSIT[2], DEPOSIT[4]],
          [collapse("after 2,200 steps", "101..108", 540, 72, "free", "stages.flow.until={steps: 2200}")], output=ENDS),
    Table("phenomena.md: silo", "silo-beverloo",
          [Line("outflow", key="outflow", decimals=1), Line("v_c, m/s", key="speed", decimals=3), Line("v_c / √(g D)", key="by fall"),
           Line("filling in the middle", key="filling", decimals=3)], [orifice(diameters) for diameters in (8, 10, 12, 14)]),
    Table("phenomena.md: silo, grains and time step", "silo-beverloo", [Line("outflow", key="outflow", decimals=1), Line("clogged", key="clogged")],
          [silo_of("R1 and R2", (1, 2)), silo_of("R3 and R5", (3, 5)), silo_of("R5 and R8", (5, 8)),
           *(silo_of(f"R3 and R5, {what}", (3, 5), f"contact.{what}") for what in ("resolution=0.8", "resolution=0.2", "sweeps=4"))]),
    Table("phenomena.md: silo, rolling", "silo-beverloo", [Line("outflow", key="outflow", decimals=1), Line("clogged", key="clogged")],
          [Line(name, [rolling(name)]) for name in ("resistance", "none")], source=sources.outflow()),
    Table("phenomena.md: silo, height", "silo-beverloo", [Line(f"h/d = {height}", key=height) for height in (14, 25, 37, 43, 54, 62, 74, 98, 110)],
          [bed("33 d", 575, 33), bed("66 d", 1150, 66), bed("132 d", 2300, 132)], source=sources.outflow_by_height, decimals=1,
          output="{series: {every: 20}, trajectory: {every: 200}}"),
    Table("phenomena.md: weight in a silo", "janssen",
          [Line("on the floor", key="floor", decimals=3), Line("friction at the sides over the most that it can be", key="friction"),
           Line("stress across over stress down", key="K"), Line("H/d", key="height", decimals=0), Line("steps until settled", key="steps", decimals=0)],
          [janssen(name, height, grains) for name in ("resistance", "free")
           for height, grains in ((300, 395), (600, 790), (1200, 1580), (2400, 3160))], source=sources.weight),
    Table("phenomena.md: weight in a silo, history", "janssen", [Line("on the floor", key="floor")],
          [janssen("resistance", 1200, 1580), janssen("resistance", 2400, 1580, title="rain from twice as high"),
           janssen("resistance", 1200, 1580, title="deposition", how=", method: deposition"),
           janssen("resistance", 1200, 1580, "contact.sweeps=8", title="8 sweeps"),
           janssen("resistance", 1200, 1580, "contact.resolution=0.8", "contact.restitution=0", title="resolution 0.8, no restitution"),
           Line("R1 and R2", ["box={width: 147.1, height: 1076}", *hexagons(1, 2),
                              "stages.filling.fill={region: [0, 0, 147.1, 538], counts: {small: 1580, large: 1580}}"])], source=sources.load),
    Table("phenomena.md: weight in a silo, later", "janssen",
          [Line("on the floor after 5,000 steps", key=5), Line("35,000", key=35), Line("growth", key="growth")],
          [janssen("resistance", height, grains, "stages.rest.until={steps: 35000}") for height, grains in ((600, 790), (1200, 1580))],
          source=sources.load_in_time, decimals=3, output="{series: {every: 1000, forces: true}}"),
    Table("phenomena.md: weight in a silo, poured", "janssen", [Line("on the floor", key="floor")],
          [poured(name, "contact.fall_height=334", rolling(name), seeds="101..104", region="[0, 560, 328, 600]", rate=0.3, count=1580)
           for name in ("resistance", "free")], source=sources.load),
    Table("phenomena.md: plate", "plate-forces",
          [Line(f"{number} d", key=stage) for stage, number in zip(("half", "one", "two", "three", "four", "five"), (0.5, 1.5, 2.5, 3.5, 4.5, 5.5))],
          [Line(name, [rolling(name)]) for name in ("resistance", "free")], "101..108", sources.plate, 0, "{contacts: {window: 60}}", True),
    Table("phenomena.md: drum", "rotating-drum",
          [Line(f"{name}, {key}", [rolling(name)], key=key) for name in ("resistance", "none", "free")
           for key in ("surface", "centre", "least", "most", "in time")],
          [Line(f"Froude number {froude}", [f"{RATE}={value}"]) for froude, value in RATES.items()], "101..103", sources.drum, 1, IN_TIME),
    Table("phenomena.md: core of small grains", "rotating-drum",
          [Line(f"{name}, {froude}", [f"{RATE}={RATES[froude]}", rolling(name)])
           for name, froude in (("resistance", 0.001), ("resistance", 0.01), ("resistance", 0.1), ("none", 0.01), ("free", 0.01))],
          [Line(f"{turns} turns", key=turns) for turns in (0.05, 0.5, 1, 1.5, 1.95)], "101..103", sources.drum, output=IN_TIME),
    Table("phenomena.md: level surface", "rotating-drum", [Line("surface against the level", key="surface"), Line("direction of the centre", key="centre")],
          [Line(f"{angle}°", [rolling("free"), "stages.turn.until={steps: 1}", "stages.fill.max_steps=30000", "stages.refill.max_steps=30000",
                              "stages.refill.fill.region=[27, 27, 139, 139]",
                              *(f"stages.{stage}.vessel={{tilt: {angle}}}" for stage in ("fill", "refill", "turn"))])
           for angle in (0, 10, 20, 30, 40, 50)], source=sources.standing_drum, decimals=1, output=IN_TIME),
    Table("phenomena.md: level surface of a box", "tilting-box", [Line("surface against the level", key="surface")],
          [*(tilted_box(f"{angle}°", angle, 160) for angle in (10, 20, 30, 40, 50)), tilted_box("30°, from 0 to 240", 30, 240),
           tilted_box("30°, from 60 to 260", 30, 260, 60)],
          "101..108", sources.standing_box, 1, IN_TIME),
    Table("phenomena.md: tilted box", "tilting-box",
          [Line("5 % have moved", key=0.05), Line("10 %", key=0.1), Line("20 %", key=0.2), Line("surface before", key="before"),
           Line("surface after", key="after"), Line("surface at rest", key="rest")], [Line("degrees")], "101..108", sources.tilted, 1, IN_TIME, True),
    Table("phenomena.md: slope", "chute",
          [Line("velocity at the surface", key="surface"), Line("mean velocity", key="mean"), Line("exponent n", key="n"),
           Line("share of sites covered, inside", key="filling", decimals=3), Line("depth", key="depth"), Line("at the bed / at the surface", key="slip")],
          [Line(f"{angle}°", [f"let.angle={angle}"], "1..4") for angle in range(22, 33, 2)]
          + [Line(f"28°, level {level}", [f"let.level={level}"], "1..2") for level in (27, 40, 53, 66)], source=sources.chute),
    Table("phenomena.md: slope, as its test", "chute", [Line("velocity", key="surface"), Line("exponent n", key="n")],
          [Line("20,000 and 40,000 steps", ["let.angle=28"], "1..4"),
           Line("10,000 and 10,000, as the test", ["let.angle=28", *(f"stages.{stage}.until={{steps: 10000}}" for stage in ("start", "flow"))], "1..8")],
          source=sources.chute_of_test),
    Table("phenomena.md: large grain, shaken", "shaken-nut",
          [*(Line(f"height after {cycle} shakes", key=cycle) for cycle in (100, 200, 300)), Line("on top within 300", key="top"),
           Line("shakes until then", key="until", decimals=0), Line("packing fraction at the end", key="packing")],
          [Line(f"gamma {gamma}{title}", [f"stages.shaking.vessel.shake.gamma={gamma}", *more], seeds)
           for gamma, title, seeds, *more in (
               (0.5, "", "101..104"), (1, "", "101..104"), *((gamma, "", "101..108") for gamma in (1.5, 2, 2.5, 3)),
               *((gamma, ", 2 d to either side", "101..104", "stages.shaking.vessel.shake.amplitude=12.8") for gamma in (1, 1.5, 2)),
               (2.5, ", smooth walls", "101..104", "contact.wall_friction=0"), (2.5, ", periodic", "101..104", "box.periodic=true"))],
          source=sources.nut),
    Table("phenomena.md: convection", "convection-contact",
          [Line("in the bed", key="bed"), Line("all", key="all"), Line("first 15 cycles, in the bed", ["stages.shaking.until.cycles=15"], key="bed"),
           Line("free rolling, in the bed", [rolling("free")], key="bed"),
           Line("2 d to either side, in the bed", ["stages.shaking.vessel.shake.amplitude=16.4"], key="bed"),
           Line("2 d, free rolling, in the bed", ["stages.shaking.vessel.shake.amplitude=16.4", rolling("free")], key="bed")],
          [Line(f"friction {friction}", [f"walls.sides.friction={friction}"]) for friction in (0, 0.4, 0.8)], "101..106", sources.convection),
    Table("phenomena.md: rotation", "collapse-contact", ROTATION + [DEPOSIT[2], DEPOSIT[1]],
          [Line(name, [rolling(name), "stages.flow.until={steps: 2000}"]) for name in ("none", "resistance", "free")], source=sources.rotation,
          output="{series: {every: 20}, contacts: {window: 1}, trajectory: {every: 20, contacts: true}}"),
    Table("phenomena.md: rotation in a silo", "silo-beverloo", ROTATION,
          [Line(name, [rolling(name), "stages.discharge.until={steps: 5000}"]) for name in ("none", "resistance", "free")],
          source=sources.rotation_in_silo, output="{series: {every: 20}, contacts: {window: 1}, trajectory: {every: 50, contacts: true}}"),
]
