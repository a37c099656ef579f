"""Tables and figures of docs/rivals.md."""

import csv
import itertools
import math
import statistics
import subprocess

import numpy as np

from .table import Line, Table, bare, robust, standard_error

COLUMN = math.sqrt(0.75)  # from one column of the lattice to the next, spacings


def flow_of(diameter):
    """Of a run of `outlet`: B, half the growth with height of the variance of the flux across x, in spacings and in d, and the outflow. Of one of
    `mixing`: the share of neighbours kept after a drop of so many d, and their diffusion in d."""
    def numbers(run):
        if "mixing-flow" in run.tables:
            table = run.table("mixing-flow")
            return {**dict(zip(table["fallen_d"], table["kept"])), "diffusion": run.measures["flow"]["pair_diffusion_5"] / diameter,
                    "d": diameter}
        lines = flux_by_line(run)
        spread = statistics.linear_regression(list(lines), [variance(*line) for line in lines.values()]).slope / 2
        return {"B": spread, "B/d": spread / diameter, "outflow": run.measures["flow"]["outflow_sites_per_step"],
                "d": diameter}
    return numbers


def flux_by_line(run):
    """Of lines of `outlet` by height: x and flux of their parts."""
    table = run.table("lines-flow")
    return {height: (table["x"][table["y"] == height], table["flux"][table["y"] == height]) for height in sorted(set(table["y"]))}


def variance(x, flux):
    return float(np.cov(x, aweights=flux, ddof=0))


def model(title, diameter, radii, *arguments):
    """The mean diameter, the radii of its hexagons, and what else is set."""
    return Line(title, [f"let.d={diameter}", f"species.small.shape.hexagon={radii[0]}", f"species.large.shape.hexagon={radii[1]}", *arguments],
                source=flow_of(diameter))


def one_site(title, *arguments):
    return model(title, 1.05, (0, 0), *arguments)


def orifice(diameters):
    return [f"let.W={diameters:.5g}"]


def columns(number):
    """An orifice of so many, of grains of one site."""
    return orifice(number * COLUMN / 1.05)


MIXTURES = [("7 + 19 sites", 3.68, (1, 2)), ("19 + 37", 5.49, (2, 3)), ("37 + 91", 8.2, (3, 5)), ("7, one size", 2.78, (1, 1))]
VOIDS = one_site("voids, s = 1/3", "model=voids")
ONE_SITE = one_site("automaton, 1 site, 0", "rules.inertia=0")
GRAINS = {inertia: [model(f"{title}, {inertia}", diameter, radii, f"rules.inertia={inertia}") for title, diameter, radii in MIXTURES]
          for inertia in (0, 0.9)}
RIVALS = [VOIDS, one_site("voids, s = 0.678", "model=voids", "voids.straight=0.678"),
          one_site("`baxter`, `like_axes` 0.01", "model=baxter", "baxter.like_axes=0.01"),
          one_site("`baxter`, 1 (no energy of axes)", "model=baxter", "baxter.like_axes=1"), ONE_SITE, one_site("1 site, 0.9", "rules.inertia=0.9"),
          *itertools.chain(*zip(GRAINS[0], GRAINS[0.9]))]
ORDERS = [one_site(title, "rules.inertia=0", *more) for title, *more in (
    ("as it is: `update_priority` rest, inertia, gravity",), ("gravity, rest, inertia", "rules.update_priority=[gravity, rest, inertia]"),
    ("inertia, rest, gravity", "rules.update_priority=[inertia, rest, gravity]"), ("`ties: direction`", "rules.ties=direction"),
    ("`scatter: 1`", "rules.scatter=1"))]


def rivals(name, rows, cells, **more):
    return Table("rivals.md", name, "outlet", rows, cells, "1..16", **more)


def poured(run):
    return run.measures["pouring"]


def resting(run):
    numbers = run.measures["resting"]
    return {**numbers, "still": numbers["moved_share"] == 0}


def resting_still(run):
    numbers = resting(run)
    return numbers if numbers["still"] else {}


POURED = ["output.frames=none", "measure=[weight_paths]"]
LARGE = ["box.height=400", "sources.spout.count=1500", "sources.spout.at=[240, 390]"]
RESTING = ["model=contact", "sources={}", "stages=[{name: resting, until: settled}]", "measure=[weight_paths, moved]"]
RULES = ["inner", "outer", "pair", "q"]


def heaps(name, rows, cells, style, **more):
    return Table("rivals.md", name, "heap", rows, cells, "1..64", style=style, **more)


def at_rest(title, large, seeds="1..64", source=resting):
    return Line(title, [*RESTING, *(LARGE[:1] if large else [])], seeds, source, begin=[*POURED, *(LARGE if large else [])])


def of_rules(measure, rules=RULES):
    return [Line(rule, key=f"{measure}_{rule}") for rule in rules]


def both(title, rival, key):
    return Line(title, rival.arguments, source=rival.source, key=key)


TABLES = [
    rivals("rivals", RIVALS,
           [Line("B/d", orifice(8), key="B/d", style=robust), Line("outflow, sites/step", orifice(8), key="outflow"),
            *(Line(f"kept at {drop} d", scene="mixing", key=drop, style=bare) for drop in (1, 5, 10, 20)),
            Line("b_p/d at 5 d", scene="mixing", key="diffusion", decimals=3)]),
    rivals("diameters", [ONE_SITE, *GRAINS[0]], [Line(f"{width} d", orifice(width), key="outflow") for width in (4, 6, 8, 12)]),
    rivals("columns", [*(Line(str(number), columns(number)) for number in (1, 2, 4, 8, 10, 16)),
                       *(Line(f"{number}, outlet lower", [*columns(number), "outlets.tray.region=[0, 0, 63, 1]"]) for number in (1, 10))],
           [both(f"{name}: {title}", rival, key) for name, rival in (("voids", VOIDS), ("automaton", ONE_SITE))
            for title, key in (("B", "B"), ("outflow", "outflow"))]),
    rivals("one-site", [*ORDERS, one_site("voids", "model=voids")],
           [Line("B, one column", columns(1), key="B"), Line("B, 8 d", orifice(8), key="B"), Line("outflow, 8 d", orifice(8), key="outflow")]),
    heaps("heap-pressure",
          [at_rest("400 grains, seeds 1 to 64", False), at_rest("400 grains, 65 to 320", False, "65..320"), at_rest("1,500 grains, 1 to 64", True),
           at_rest("1,500 grains, 65 to 320", True, "65..320"),
           at_rest("1,500 grains, 65 to 320, where no grain moved", True, "65..320", resting_still)],
          [Line("contact model", key="centre_minus_ring_contact"), *of_rules("centre_minus_ring"), Line("no grain moved", key="still")], standard_error),
    heaps("heap-deviation", [at_rest("400 grains", False), at_rest("1,500 grains", True)], of_rules("base_deviation"), standard_error),
    heaps("heap-outside", [at_rest("400 grains", False), at_rest("1,500 grains", True)], of_rules("outside", RULES[:3]), bare),
    heaps("heap-poured",
          [Line(f"{title} grains, `inertia` {inertia}", [f"rules.inertia={inertia}", "measure=[weight_paths]", *more])
           for title, more in (("400", []), ("1,500", LARGE)) for inertia in (0.9, 0)],
          of_rules("centre_minus_ring"), standard_error, source=poured),
]


def recursion(number, height):
    """Litwiniszyn's: where voids that rise by equal chances come to that height, from any of so many columns: distances of columns from the
    middle and their shares."""
    target = 2 * height
    at = {(0, 2 * i - number + 1): 1 / number for i in range(number)}  # by twice the height and twice the column
    arrived = {}
    while at:
        (level, column) = place = min(at)
        chance = at.pop(place) / 3
        for up, sideways in ((2, 0), (1, -2), (1, 2)):
            to = (level + up, column + sideways)
            if to[0] >= target:
                arrived[to[1]] = arrived.get(to[1], 0) + chance
            else:
                at[to] = at.get(to, 0) + chance
    return [(column / 2 * COLUMN, chance) for column, chance in sorted(arrived.items())]


def write_table(file, header, rows):
    with open(file, "w", encoding="utf-8", newline="") as opened:
        csv.writer(opened).writerows([header, *rows])


def figures(runs):
    """Of docs/rivals.md, from tables in d."""
    table, shown = TABLES[0], [VOIDS, ONE_SITE, *GRAINS[0][:3]]
    kept = [[drop, *(table.cell(rival, Line("", scene="mixing", key=drop), runs).mean for rival in shown)] for drop in range(1, 21)]
    write_table(runs.folder / "kept.csv", ["fallen", *(rival.title.removesuffix(", 0").replace(",", ":") for rival in shown)], kept)
    spreads = [table.measured(rival, table.columns[0], runs) for rival in shown]
    write_table(runs.folder / "spread.csv", ["diameter", "B", "deviation"],
                [[of_runs[0]["d"], *(statistic([run["B/d"] for run in of_runs]) for statistic in (statistics.mean, statistics.stdev))]
                 for of_runs in spreads])

    d = 1.05
    # The box has 73 columns. In parts of two, as every second one is half a spacing lower and has another share.
    wide = [f"lines.at_{height}.parts=36" for height in (5, 20)]
    lines = runs.taken("outlet", "1..16", ("output={}", *VOIDS.arguments, *orifice(8), *wide), flux_by_line)
    for height in (5, 20):
        y = min(lines[0], key=lambda y: abs(y - (2 + height) * d - 2))
        x, flux = lines[0][y][0], np.mean([run[y][1] for run in lines], axis=0)
        chances = recursion(10, height * d)
        print(f"variance of the flux at {height} d: voids {variance(x, flux) / d**2:.1f} d², recursion {variance(*zip(*chances)) / d**2:.1f} d²")
        write_table(runs.folder / f"voids-{height}.csv", ["x", "share"], np.stack([x / d - 30, flux / flux.sum() * len(x) / 60], axis=1))
        write_table(runs.folder / f"recursion-{height}.csv", ["x", "share"],
                    [[(x + COLUMN / 2) / d, (chance + following) / 2 * d / COLUMN] for (x, chance), (_, following) in itertools.pairwise(chances)])
    for figure in ("neighbours-kept", "voids-flux"):
        subprocess.run(["gnuplot", "-c", f"bench/rivals/{figure}.gp", runs.folder, f"renders/gallery/{figure}.png"], check=True)
