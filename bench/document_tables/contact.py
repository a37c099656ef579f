"""Tables of the contact model: docs/contact.md and docs/phenomena.md."""

from . import sources
from .table import Line, Table

DEPOSIT = [Line("H0/L0", key="H0/L0"), Line("run-out of 99 % / L0", key="run-out"), Line("slope °", key="slope", decimals=1),
           Line("centre of mass, shift / L0", key="shift"), Line("share moved", key="moved"), Line("steps to rest", key="steps", decimals=0)]
TIMES = [Line("kinetic energy below 1 % after, √(2 H0/g)", key="slow after", decimals=1), Line("last move", key="last move", decimals=1)]
PROFILE = [Line(f"height / L0 at x/L0 = {at}", key=at) for at in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)]
ENDS = "{series: {every: 10}, trajectory: {every: 1000000}}"  # states at the ends of stages


def collapse(title, seeds, grains, width, rolling, *more, height=None):
    height = height or round(6.4 * width)
    return Line(title, [
        f"box={{width: {7 * width:.0f}, height: {height}}}",
        f"walls.right={{box: [{width}, 0, {width + 1}, {height}]}}",
        f"stages.packing.fill={{region: [0, 0, {width}, {height}], counts: {{small: {grains // 2}, large: {grains // 2}}}}}",
        f"contact.rolling={rolling}", *more], seeds, sources.deposit(width))


def orifice(diameters):
    """In the middle of a silo 40 d wide, d = 8.2."""
    left, right = 164 - 4.1 * diameters, 164 + 4.1 * diameters
    return Line(f"{diameters} d", [
        f"walls.floor_left={{box: [0, 60, {left}, 64]}}", f"walls.plug={{box: [{left}, 60, {right}, 64]}}",
        f"walls.floor_right={{box: [{right}, 60, 328, 64]}}"], source=sources.silo(diameters))


def janssen(rolling, height, grains):
    return Line(f"{rolling}, {2 * grains} grains", [
        "box.height=2400", f"contact.rolling={rolling}",
        f"stages.filling.fill={{region: [0, 0, 328, {height}], counts: {{small: {grains}, large: {grains}}}}}"])


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
    Table("phenomena.md: collapse", "collapse-contact", DEPOSIT + TIMES + PROFILE,
          [collapse(f"{grains}, {name}", seeds, grains, width, name)
           for name in ("resistance", "none")
           for grains, width, seeds in ((540, 72, "101..116"), (2000, 138.6, "101..104"), (5000, 219, "101..103"))], output=ENDS),
    Table("phenomena.md: friction", "collapse-contact", DEPOSIT[1:3],
          [collapse(f"{friction}", "101..108", 540, 72, "none", f"contact.friction={friction}", f"contact.wall_friction={friction}")
           for friction in (0.2, 0.6)], output=ENDS),
    Table("phenomena.md: height/width", "collapse-contact", DEPOSIT[:3],
          [collapse(f"{width} wide", "101..104", 2000, width, "resistance", height=1300) for width in (169, 119, 84)], output=ENDS),
    Table("phenomena.md: free rolling", "collapse-contact", [DEPOSIT[2], DEPOSIT[4]],
          [collapse("after 2,200 steps", "101..108", 540, 72, "free", "stages.flow.until={steps: 2200}")], output=ENDS),
    Table("phenomena.md: silo", "silo-beverloo",
          [Line("outflow", key="outflow", decimals=1), Line("v_c, m/s", key="speed", decimals=3), Line("v_c / √(g D)", key="by fall"),
           Line("filling in the middle", key="filling", decimals=3)], [orifice(diameters) for diameters in (8, 10, 12, 14)]),
    Table("phenomena.md: weight in a silo", "janssen",
          [Line("on the floor", key="floor", decimals=3), Line("friction at the sides over the most that it can be", key="friction"),
           Line("steps until settled", key="steps", decimals=0)],
          [janssen(name, height, grains) for name in ("resistance", "free")
           for height, grains in ((300, 395), (600, 790), (1200, 1580), (2400, 3160))], source=sources.weight),
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
    Table("phenomena.md: tilted box", "tilting-box",
          [Line("5 % have moved", key=0.05), Line("10 %", key=0.1), Line("20 %", key=0.2), Line("surface before", key="before"),
           Line("surface after", key="after"), Line("surface at rest", key="rest")], [Line("degrees")], "101..108", sources.tilted, 1, IN_TIME, True),
    Table("phenomena.md: slope", "chute",
          [Line("velocity at the surface", key="surface"), Line("mean velocity", key="mean"), Line("exponent n", key="n"),
           Line("share of sites covered, inside", key="filling", decimals=3), Line("depth", key="depth"), Line("at the bed / at the surface", key="slip")],
          [Line(f"{angle}°", [f"let.angle={angle}"], "1..4") for angle in range(22, 33, 2)]
          + [Line(f"28°, level {level}", [f"let.level={level}"], "1..2") for level in (27, 40, 53, 66)], source=sources.chute),
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
    Table("phenomena.md: rotation", "collapse-contact",
          [Line("share of kinetic energy in rotation", key="energy", decimals=4), Line(r"Σ\|s\| / Σ\|v\|", key="spin", decimals=3),
           Line("turning over the whole path °", key="turning", decimals=0), Line("rolled path over path", key="rolled", decimals=3),
           Line(r"Σs / Σ\|s\|", key="signs"), Line("pairs that turn opposite ways", key="opposite", decimals=3),
           Line("correlation of spins", key="correlation"), Line("net turn °", key="net turn", decimals=0),
           Line("net rolled path over path", key="net rolled", decimals=3), Line("sliding with spin over that without", key="slip"),
           Line("contacts that do not slide", key="holding"), Line("slope °", key="slope", decimals=1), Line("run-out of 99 % / L0", key="run-out")],
          [Line(name, [rolling(name), "stages.flow.until={steps: 2000}"]) for name in ("none", "resistance", "free")], source=sources.rotation,
          output="{series: {every: 20}, contacts: {window: 1}, trajectory: {every: 20, contacts: true}}"),
]
