"""Tables of the contact model: docs/contact.md and docs/phenomena.md."""

from . import sources
from .table import Line, Table, bare, until_clog, with_range

HEIGHT = Line("H0/L0", key="H0/L0", style=bare)
RUNOUT = Line("run-out of 99 % / L0", key="run-out")
SLOPE = Line("slope °", key="slope", decimals=1)
SHIFT = Line("centre of mass, shift / L0", key="shift")
MOVED = Line("share moved", key="moved")
STEPS = Line("steps to rest", key="steps", decimals=0)
DEPOSIT = [HEIGHT, RUNOUT, SLOPE, SHIFT, MOVED, STEPS, Line("kinetic energy below 1 % after, √(2 H0/g)", key="slow after", decimals=1),
           Line("last move, √(2 H0/g)", key="last move", decimals=1), Line("`energy_growth` %, rain", key="growth of rain", style=with_range),
           Line("`energy_growth` %, collapse", key="growth", style=with_range)]
ROTATION = [
    Line("**Is it rare?** share of kinetic energy in rotation", key="energy", decimals=4),
    Line(r"mean spin over mean speed of moving grains, Σ\|s\| / Σ\|v\|", key="spin", decimals=3),
    Line("turning over the whole path, both ways added, median of grains °", key="turning", decimals=0),
    Line(r"rolled path over path, Σ R\|dφ\| / Σ \|dx\|", key="rolled", decimals=3),
    Line(r"**Does it cancel?** over grains: Σs / Σ\|s\|", key="signs"),
    Line("between neighbours: pairs that turn opposite ways", key="opposite", decimals=3),
    Line("between neighbours: correlation of spins, Σ s₁s₂ / Σ (s₁² + s₂²)/2", key="correlation"),
    Line("over time: net turn, median of grains °", key="net turn", decimals=0),
    Line("over time: net rolled path over path", key="net rolled", decimals=3),
    Line("**Against slip**: sliding at contacts with spin over that without", key="slip"),
    Line("contacts of pairs that do not slide", key="holding")]
ENDS = "{series: {every: 10}, trajectory: {every: 1000000}}"  # states at the ends of stages
IN_TIME = "{series: {every: 20}, trajectory: {every: 200}}"


def rolling(name):
    return f"contact.rolling={name}"


def collapse(title, seeds, grains, width, kind, *more, height=None):
    height = height or round(6.4 * width)
    return Line(title, [
        f"box={{width: {7 * width:.0f}, height: {height}}}",
        f"walls.right={{box: [{width}, 0, {width + 1}, {height}]}}",
        f"stages.packing.fill={{region: [0, 0, {width}, {height}], counts: {{small: {grains // 2}, large: {grains // 2}}}}}",
        rolling(kind), *more], seeds, sources.deposit(width))


def of_540(title, kind, *more, seeds="101..108"):
    return collapse(title, seeds, 540, 72, kind, *more)


def by_grains(kind):
    return [collapse(f"{grains:,}" if grains > 999 else str(grains), seeds, grains, width, kind)
            for grains, width, seeds in ((540, 72, "101..116"), (2000, 138.6, "101..104"), (5000, 219, "101..103"))]


def at_rest(title, grains, width, seeds):
    """Before and after the collapse 5,000 steps more."""
    stages = ("stages=[{name: packing, fill: {region: [0, 0, 1, 1], counts: {small: 1}}, until: settled}, {name: bed, until: {steps: 5000}}, "
              "{name: flow, remove: [right], until: settled}, {name: heap, until: {steps: 5000}}]")
    return Line(title, [stages, *collapse(title, seeds, grains, width, "resistance").arguments], seeds)


def as_the_automaton(kind, seeds, source, *more):
    """The scene and the column of docs/model.md, in a wider box."""
    return Line(f"540, `{kind}`", ["model=contact", "box.width=800", "walls.right.box=[70,0,71,460]", "stages.packing.fill.region=[0,0,70,460]",
                                   rolling(kind), *more], seeds, source)


def hexagons(small, large):
    return [f"species.small.shape.hexagon={small}", f"species.large.shape.hexagon={large}"]


def clogging(columns, *more, seeds="101..150"):
    return Line(str(columns), ["model=contact", *more, f"let.W={columns}"], seeds)


def orifice(diameters):
    """In the middle of a silo 40 d wide, d = 8.2."""
    left, right = 164 - 4.1 * diameters, 164 + 4.1 * diameters
    return Line(str(diameters), [
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


def janssen(title, kind, height, grains, *more, how=""):
    return Line(title, [
        "box.height=2400", rolling(kind),
        f"stages.filling.fill={{region: [0, 0, 328, {height}], counts: {{small: {grains}, large: {grains}}}{how}}}", *more])


def weights(kind):
    return Table(
        "phenomena.md", f"weight-{kind}", "janssen",
        [Line("H/d", key="height", decimals=0, style=bare), Line("on the floor", key="floor", decimals=3),
         Line("friction at the sides over the most that it can be", key="friction"), Line("K, stress across over stress down", key="K"),
         Line("steps until settled", key="steps", decimals=0)],
        [janssen(f"{2 * grains:,}", kind, height, grains) for height, grains in ((300, 395), (600, 790), (1200, 1580), (2400, 3160))],
        source=sources.weight)


def placed(title, kind, width, height, each, box, seeds):
    """At random up to a height, as the decks of bench/peers have it."""
    return Line(title, [f"box={{width: {width}, height: {box}}}", rolling(kind),
                        f"stages.filling.fill={{region: [0, 0, {width}, {height}], counts: {{small: {each}, large: {each}}}}}"], seeds)


def poured(title, *more, seeds="101..108", **source):
    """From a source, at rest."""
    text = ", ".join(f"{key}: {value}" for key, value in source.items())
    return Line(title, [f"sources={{pour: {{{text}}}}}",
                        "stages=[{name: filling, sources: [pour], until: settled, max_steps: 100000}, {name: rest, until: {steps: 3000}}]", *more], seeds)


def rain(title, *more, kind="none", rate=5, bottom=902, seeds="101..108"):
    """Of 700 grains into a silo 20 d wide."""
    return poured(title, f"box={{width: 164, height: {bottom + 98}}}", rolling(kind), *more, seeds=seeds,
                  region=f"[0, {bottom}, 164, {bottom + 98}]", rate=rate, count=700)


HARD_RAIN = {kind: rain(f"5 a step, `{kind}`", kind=kind, seeds="101..132") for kind in ("none", "resistance")}


def tilted_box(title, angle, height, bottom=0):
    return Line(title, [f"box.height={height}", f"stages.settle.fill.region=[0, {bottom}, 260, {height}]", f"stages.settle.vessel={{tilt: {angle}}}",
                        "stages.settle.max_steps=30000", f"stages.tilt.vessel={{tilt: {angle}}}", "stages.tilt.until={steps: 1}"])


RATE = "stages.turn.vessel.rotate.rate"
RATES = {0.001: 0.000563, 0.01: 0.00178, 0.1: 0.00563}  # by Froude number
IN_DRUM = {"resistance": "rolling resistance", "none": "no rotation", "free": "free rolling"}


def drum(name, **keys):
    return Table("phenomena.md", name, "rotating-drum",
                 [Line(f"{title}, {what}", [rolling(kind)], key=key) for kind, title in IN_DRUM.items() for key, what in keys.items()],
                 [Line(str(froude), [f"{RATE}={value}"]) for froude, value in RATES.items()], "101..103", sources.drum, 1, IN_TIME)


def nut(title, gamma, *more, seeds="101..104"):
    return Line(title, [f"stages.shaking.vessel.shake.gamma={gamma}", *more], seeds)


NUT = [*(Line(f"height after {cycle} shakes", key=cycle) for cycle in (100, 200, 300)), Line("on top within 300", key="top"),
       Line("shakes until then", key="until", decimals=0), Line("packing fraction at the end", key="packing", style=bare)]
TWO_D = "stages.shaking.vessel.shake.amplitude=16.4"

TABLES = [
    Table("contact.md", "stiffness", "collapse-contact",
          [Line(f"hard rain, `{kind}`: floor over weight", line.arguments, line.seeds, sources.load, "floor", 3, "janssen", output="{}")
           for kind, line in HARD_RAIN.items()]
          + [Line(f"collapse of 540, `{kind}`: {line.title}", of_540("", kind).arguments, "101..164", sources.deposit(72), line.key, line.decimals)
             for kind in ("resistance", "none") for line in (SLOPE, RUNOUT, MOVED)],
          [Line("2/7, 0.3, with the impacts below")], output=ENDS),
    Table("contact.md", "time-step", "collapse-contact",
          [collapse(f"{grains:,}, `{kind}`, {resolution}", seeds, grains, width, kind, *(() if resolution == 0.4 else (f"contact.resolution={resolution}",)))
           for grains, width, seeds in ((540, 72, "101..116"), (2000, 138.6, "101..104")) for kind in ("resistance", "none") for resolution in (0.4, 0.55)],
          [STEPS, RUNOUT, SLOPE, SHIFT, HEIGHT, *DEPOSIT[-2:]], output=ENDS),
    Table("contact.md", "forces", "janssen",
          [Line("force on the floor + friction at the sides, over the weight of all grains", key="carried", decimals=4, style=bare),
           Line("what forces and weight of a grain do not balance, over its weight, mean", key="residual", decimals=5, style=bare),
           Line("force on the floor over the weight of all grains", key="floor")],
          [Line("1,200 grains", ["box={width: 60, height: 600}", rolling("free"), *hexagons(1, 2),
                                 "stages.filling.fill={region: [0, 0, 60, 600], counts: {small: 600, large: 600}}", "stages.rest.until={steps: 1000}"])],
          source=sources.balance),
    Table("contact.md", "reproduced", "wall-removal",
          [*(as_the_automaton(kind, "1..128", sources.deposit(70)) for kind in ("none", "resistance")),
           as_the_automaton("free", "1..16", sources.not_stopped(70), "stages.flow.max_steps=10000"),
           *(collapse(f"5,000, `{kind}`", "1..4", 5000, 213, kind, "model=contact", height=1400) for kind in ("none", "resistance"))],
          [SLOPE, RUNOUT, MOVED, HEIGHT, Line("packing fraction", key="packing", style=bare), STEPS], output=ENDS),
    Table("contact.md", "rain", "janssen",
          [*HARD_RAIN.values(), rain("5 a step, `none`, half as high", bottom=451), rain("5 a step, `none`, no restitution", "contact.restitution=0"),
           rain("5 a step, `none`, 32 sweeps", "contact.sweeps=32", seeds="101..105"), rain("0.05 a step, `none`", rate=0.05),
           rain("0.01 a step, `none`", rate=0.01), placed("placed at random, `none`", "none", 164, 700, 350, 1010, "101..108"),
           placed("placed at random, `resistance`, 83 d high", "resistance", 164, 1300, 790, 1300, "101..106")],
          [Line("floor over weight", key="floor")], source=sources.load),
    Table("contact.md", "heap", "heap",
          [Line(f"a grain in {steps} steps", ["model=contact", "contact={friction: 0.4, rolling: resistance, rolling_friction: 0.5, fall_height: 56}",
                                              f"sources.spout={{region: [232, 54, 248, 60], species: {{small: 1, large: 1}}, rate: {rate}, count: 240}}"])
           for steps, rate in ((60, 0.0167), (240, 0.0042))],
          [Line(f"{side} °", key=key) for side, key in (("left flank", "left"), ("right flank", "right"), ("slope", "angle"))],
          "101..108", sources.heap, 1),
    Table("phenomena.md", "collapse-resistance", "collapse-contact", DEPOSIT, by_grains("resistance"), output=ENDS),
    Table("phenomena.md", "collapse-none", "collapse-contact", DEPOSIT, by_grains("none"), output=ENDS),
    Table("phenomena.md", "collapse-20000", "collapse-contact", DEPOSIT[:5],
          [collapse(title, "101..101", 20000, 438, kind, *more, height=2800)
           for title, kind, *more in (("rolling resistance", "resistance"), ("rolling resistance, four sweeps", "resistance", "contact.sweeps=4"),
                                      ("no rotation", "none"))], output=ENDS),
    Table("phenomena.md", "collapse-profile", "collapse-contact",
          [of_540(IN_DRUM[kind], kind, seeds="101..116") for kind in ("resistance", "none")],
          [Line(str(at), key=at) for at in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)], output=ENDS, style=bare),
    Table("phenomena.md", "collapse-friction", "collapse-contact", [RUNOUT, SLOPE],
          [of_540(title, "none", f"contact.friction={friction}", f"contact.wall_friction={floor}", *more)
           for title, friction, floor, *more in (("0.2", 0.2, 0.2), ("0.6", 0.6, 0.6), ("0.2, four sweeps", 0.2, 0.2, "contact.sweeps=4"),
                                                 ("0.2, floor 0.4", 0.2, 0.4))], output=ENDS),
    Table("phenomena.md", "collapse-height", "collapse-contact", [HEIGHT, RUNOUT, SLOPE],
          [collapse(f"{width} wide", "101..104", 2000, width, "resistance", height=1300) for width in (169, 119, 84)], output=ENDS),
    Table("phenomena.md", "collapse-rolling", "collapse-contact", [HEIGHT, RUNOUT, SLOPE, SHIFT, MOVED],
          [of_540(title, "resistance", *more, seeds="101..164")
           for title, *more in (("0.5",), ("0.5, restitution 0.8", "contact.restitution=0.8"), ("0.2", "contact.rolling_friction=0.2"))], output=ENDS),
    Table("phenomena.md", "collapse-free", "collapse-contact", [SLOPE, MOVED, RUNOUT],
          [of_540("after 2,200 steps", "free", "stages.flow.until={steps: 2200}"),
           *(of_540(f"{steps:,}, box 16 L0 wide", "free", "box.width=1152", f"stages.flow.until={{steps: {steps}}}") for steps in (3100, 6200))], output=ENDS),
    Table("phenomena.md", "rest", "collapse-contact",
          [at_rest("540", 540, 72, "301..308"), at_rest("2,000", 2000, 138.6, "301..308"), at_rest("5,000", 5000, 219, "301..304")],
          [Line("beds", key="bed"), Line("deposits", key="heap")], source=sources.later_moves, output="{series: {every: 1}}"),
    Table("phenomena.md", "clogging-contact", "clogging", [Line("clogged", key="clogged"), Line("⟨s⟩", key="left", decimals=1, style=until_clog)],
          [clogging(columns, rolling("free")) for columns in (17, 21, 25, 29, 33, 37)], source=sources.clogging),
    Table("phenomena.md", "clogging-resistance", "clogging", [Line("clogged", key="clogged"), Line("⟨s⟩", key="left", decimals=1, style=until_clog)],
          [clogging(41, seeds="101..160")], source=sources.clogging),
    Table("phenomena.md", "silo-orifice", "silo-beverloo",
          [Line("outflow", key="outflow", decimals=1), Line("v_c, m/s", key="speed", decimals=3), Line("v_c / √(g D)", key="by fall", style=bare),
           Line("filling in the middle", key="filling", decimals=3)], [orifice(diameters) for diameters in (8, 10, 12, 14)]),
    Table("phenomena.md", "silo-grains", "silo-beverloo",
          [silo_of("R1 and R2", (1, 2)), silo_of("R3 and R5", (3, 5)), silo_of("R5 and R8", (5, 8)),
           *(silo_of(f"R3 and R5, {what.replace('=', ' ')}", (3, 5), f"contact.{what}") for what in ("resolution=0.8", "resolution=0.2", "sweeps=4"))],
          [Line("outflow", key="outflow", decimals=1), Line("clogged", key="clogged")]),
    Table("phenomena.md", "silo-rolling", "silo-beverloo", [Line(IN_DRUM[kind], [rolling(kind)]) for kind in ("resistance", "none")],
          [Line("outflow", key="outflow", decimals=1), Line("clogged", key="clogged")], source=sources.outflow()),
    Table("phenomena.md", "silo-height", "silo-beverloo", [bed("bed of 33 d", 575, 33), bed("66 d", 1150, 66), bed("132 d", 2300, 132)],
          [Line(str(height), key=height) for height in (14, 25, 37, 43, 54, 62, 74, 98, 110)], source=sources.outflow_by_height, decimals=1,
          output=IN_TIME),
    weights("resistance"), weights("free"),
    Table("phenomena.md", "weight-history", "janssen",
          [janssen("rain", "resistance", 1200, 1580), janssen("rain from twice as high", "resistance", 2400, 1580),
           janssen("`method: deposition`", "resistance", 1200, 1580, how=", method: deposition"),
           janssen("rain, 8 sweeps", "resistance", 1200, 1580, "contact.sweeps=8"),
           janssen("rain, resolution 0.8, no restitution", "resistance", 1200, 1580, "contact.resolution=0.8", "contact.restitution=0"),
           Line("rain of R1 and R2", ["box={width: 147.1, height: 1076}", *hexagons(1, 2),
                                      "stages.filling.fill={region: [0, 0, 147.1, 538], counts: {small: 1580, large: 1580}}"]),
           *(poured(f"0.3 grains a step, `{kind}`", "contact.fall_height=334", rolling(kind), seeds="101..104", region="[0, 560, 328, 600]", rate=0.3,
                    count=1580) for kind in ("resistance", "free"))],
          [Line("on the floor", key="floor")], source=sources.load),
    Table("phenomena.md", "weight-later", "janssen",
          [janssen(title, "resistance", height, grains, "stages.rest.until={steps: 35000}")
           for title, height, grains in (("42 d", 600, 790), ("83 d", 1200, 1580))],
          [Line("on the floor after 5,000 steps", key=5), Line("after 35,000", key=35), Line("growth", key="growth")],
          source=sources.load_in_time, decimals=3, output="{series: {every: 1000, forces: true}}"),
    Table("phenomena.md", "plate", "plate-forces",
          [Line(str(number), key=stage) for stage, number in zip(("half", "one", "two", "three", "four", "five"), (0.5, 1.5, 2.5, 3.5, 4.5, 5.5))],
          [Line(title, [rolling(kind)]) for title, kind in (("rolling", "resistance"), ("free", "free"))],
          "101..108", sources.plate, 0, "{contacts: {window: 60}}", with_range),
    drum("drum", surface="surface", centre="centre"),
    drum("drum-avalanches", least="least", most="most", **{"in time": "deviation in time"}),
    Table("phenomena.md", "drum-core", "rotating-drum",
          [Line(f"{IN_DRUM[kind]}, {froude}", [f"{RATE}={RATES[froude]}", rolling(kind)])
           for kind, froude in (("resistance", 0.001), ("resistance", 0.01), ("resistance", 0.1), ("none", 0.01), ("free", 0.01))],
          [Line(str(turns), key=turns) for turns in (0.05, 0.5, 1, 1.5, 1.95)], "101..103", sources.drum, output=IN_TIME),
    Table("phenomena.md", "level-drum", "rotating-drum",
          [Line("surface against the level", key="surface"), Line("direction of the centre of mass", key="centre")],
          [Line(f"{angle}°", [rolling("free"), "stages.turn.until={steps: 1}", "stages.fill.max_steps=30000", "stages.refill.max_steps=30000",
                              "stages.refill.fill.region=[27, 27, 139, 139]",
                              *(f"stages.{stage}.vessel={{tilt: {angle}}}" for stage in ("fill", "refill", "turn"))])
           for angle in (0, 10, 20, 30, 40, 50)], source=sources.standing_drum, decimals=1, output=IN_TIME),
    Table("phenomena.md", "level-box", "tilting-box", [Line("surface against the level", key="surface")],
          [*(tilted_box(f"{angle}°", angle, 160) for angle in (10, 20, 30, 40, 50)), tilted_box("30°, up to 240", 30, 240),
           tilted_box("30°, 60 to 260", 30, 260, 60)],
          "101..108", sources.standing_box, 1, IN_TIME),
    Table("phenomena.md", "tilted-box", "tilting-box",
          [Line(title, key=key) for title, key in (("tilt when 5 % have moved", 0.05), ("10 %", 0.1), ("20 %", 0.2), ("surface before", "before"),
                                                   ("surface after", "after"), ("surface at rest in the box at 35°", "rest"))],
          [Line("`clca`")], "101..108", sources.tilted, 1, IN_TIME, with_range),
    Table("phenomena.md", "slope", "chute",
          [Line("velocity at the surface", key="surface"), Line("mean velocity", key="mean"), Line("exponent n", key="n"),
           Line("share of sites covered, inside", key="filling", decimals=3, style=bare), Line("depth", key="depth", decimals=1, style=bare),
           Line("velocity at the bed over that at the surface", key="slip", style=bare)],
          [Line(f"{angle}°", [f"let.angle={angle}"], "1..4") for angle in range(22, 33, 2)], source=sources.chute),
    Table("phenomena.md", "slope-depth", "chute",
          [Line("depth", key="depth", decimals=1, style=bare), Line("mean velocity", key="mean"), Line("exponent n", key="n")],
          [Line(f"`level={level}`", [f"let.level={level}"], "1..2") for level in (27, 40, 53, 66)], source=sources.chute),
    Table("phenomena.md", "slope-test", "chute",
          [Line("20,000 and 40,000 steps", ["let.angle=28"], "1..4"),
           Line("10,000 and 10,000, as the test", ["let.angle=28", *(f"stages.{stage}.until={{steps: 10000}}" for stage in ("start", "flow"))], "1..8")],
          [Line("velocity 60 spacings above the bed", key="surface"), Line("exponent n", key="n")], source=sources.chute_of_test),
    Table("phenomena.md", "shaken-nut", "shaken-nut", NUT,
          [nut(str(gamma), gamma, seeds="101..104" if gamma <= 1 else "101..108") for gamma in (0.5, 1, 1.5, 2, 2.5, 3)], source=sources.nut),
    Table("phenomena.md", "shaken-nut-otherwise", "shaken-nut",
          [*(nut(f"{gamma}, `amplitude: 12.8`", gamma, "stages.shaking.vessel.shake.amplitude=12.8") for gamma in (1, 1.5, 2)),
           nut("2.5, `contact.wall_friction=0`", 2.5, "contact.wall_friction=0"), nut("2.5, `box.periodic=true`", 2.5, "box.periodic=true")],
          NUT[:4], source=sources.nut),
    Table("phenomena.md", "convection-contact", "convection-contact",
          [Line("in the bed", key="bed"), Line("in the bed, first 15 cycles", ["stages.shaking.until.cycles=15"], key="bed"), Line("all", key="all"),
           Line("free rolling, in the bed", [rolling("free")], key="bed"), Line("2 d to either side, in the bed", [TWO_D], key="bed"),
           Line("2 d, free rolling, in the bed", [TWO_D, rolling("free")], key="bed")],
          [Line(str(friction), [f"walls.sides.friction={friction}"]) for friction in (0, 0.4, 0.8)], "101..106", sources.convection),
    Table("phenomena.md", "convection-profile", "convection-contact",
          [Line(title, ["walls.sides.friction=0.8"], key=key) for title, key in (("at the walls", "wall"), ("inside", "inside"))],
          [Line(str(height), source=sources.convection_at(height)) for height in range(24, 105, 16)], "101..106"),
    Table("phenomena.md", "rotation", "collapse-contact", [*ROTATION, Line("**What it does**: slope °", key="slope", decimals=1), RUNOUT],
          [Line(f"`{kind}`", [rolling(kind), "stages.flow.until={steps: 2000}"]) for kind in ("none", "resistance", "free")], source=sources.rotation,
          output="{series: {every: 20}, contacts: {window: 1}, trajectory: {every: 20, contacts: true}}"),
    Table("phenomena.md", "rotation-silo", "silo-beverloo", ROTATION,
          [Line(f"`{kind}`", [rolling(kind), "stages.discharge.until={steps: 5000}"]) for kind in ("none", "resistance", "free")],
          source=sources.rotation_in_silo, output="{series: {every: 20}, contacts: {window: 1}, trajectory: {every: 50, contacts: true}}"),
]
