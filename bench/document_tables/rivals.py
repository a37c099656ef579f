"""Tables and figures of docs/rivals.md."""

import csv
import itertools
import statistics
import subprocess
from dataclasses import dataclass

from .table import stated, sweep


@dataclass
class Rival:
    """A model of docs/rivals.md: its row, the mean diameter, the radii of its hexagons, what else is set, and whether B scatters so much from seed
    to seed that a mean says nothing."""

    title: str
    diameter: float
    radii: tuple[int, int]
    arguments: list[str]
    scatters: bool = False

    def set(self):
        return [f"let.d={self.diameter}", f"species.small.shape.hexagon={self.radii[0]}",
                f"species.large.shape.hexagon={self.radii[1]}", *self.arguments]


def one_site(title, *arguments, scatters=False):
    return Rival(title, 1.05, (0, 0), list(arguments), scatters)


VOIDS = one_site("voids, s = 1/3", "model=voids")
ONE_SITE = one_site("automaton, 1 site, 0", "rules.inertia=0")
RIVALS = [
    VOIDS, one_site("voids, s = 0.678", "model=voids", "voids.straight=0.678"),
    *(one_site(f"baxter, like_axes {s}", "model=baxter", f"baxter.like_axes={s}", scatters=True) for s in (0.01, 1)),
    ONE_SITE, one_site("1 site, 0.9", "rules.inertia=0.9"),
    *(Rival(f"{title}, {inertia}", diameter, radii, [f"rules.inertia={inertia}"])
      for title, diameter, radii in (("7 + 19 sites", 3.68, (1, 2)), ("19 + 37", 5.49, (2, 3)), ("37 + 91", 8.2, (3, 5)),
                                     ("7, one size", 2.78, (1, 1)))
      for inertia in (0, 0.9))]
ORDERS = [
    ONE_SITE, *(one_site(title, "rules.inertia=0", argument) for title, argument in (
        ("gravity, rest, inertia", "rules.update_priority=[gravity, rest, inertia]"),
        ("inertia, rest, gravity", "rules.update_priority=[inertia, rest, gravity]"),
        ("ties: direction", "rules.ties=direction"), ("scatter: 1", "rules.scatter=1"))),
    VOIDS]
SEEDS = "1..16"
COLUMN = 0.75 ** 0.5  # from one column of the lattice to the next, spacings


def rival_runs(program, folder, scene, rival, *more):
    """The folder of the sweep. Runs that are there are kept."""
    runs = folder / " ".join(["rivals", scene, rival.title, *more]).replace("/", "-").replace(" ", "-").replace(":", "")
    sweep(program, scene, SEEDS, ["output={}", *rival.set(), *more], runs)
    return runs


def outlet_runs(program, folder, rival, width=8, *more):
    """With an orifice of so many d."""
    return rival_runs(program, folder, "outlet", rival, f"let.W={width:.5g}", *more)


def width_of(columns):
    """Of an orifice of so many columns, in diameters of grains of one site."""
    return columns * COLUMN / ONE_SITE.diameter


def flux_by_line(table):
    """Of lines of `outlet`: x and flux of their parts by height."""
    lines = {}
    with open(table, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            lines.setdefault(float(row["y"]), []).append((float(row["x"]), float(row["flux"])))
    return lines


def variance(parts):
    total = sum(flux for _, flux in parts)
    mean = sum(x * flux for x, flux in parts) / total
    return sum((x - mean) ** 2 * flux for x, flux in parts) / total


def spreads(runs, diameter=1.0):
    """B/d of each run of `outlet`: half the growth with height of the variance of the flux across x."""
    tables = [flux_by_line(run / "lines-flow.csv") for run in sorted((runs / "runs").iterdir())]
    return [statistics.linear_regression(list(lines), [variance(parts) for parts in lines.values()]).slope / 2 / diameter for lines in tables]


def kept(runs):
    """The share of neighbours kept after a drop of so many d, in each run of `mixing`."""
    shares = {}
    for run in sorted((runs / "runs").iterdir()):
        with open(run / "mixing-flow.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                shares.setdefault(float(row["fallen_d"]), []).append(float(row["kept"]))
    return shares


def measured(runs, measure):
    """A measure of `flow` in each run."""
    with open(runs / "runs.csv", encoding="utf-8") as file:
        return [float(row[f"flow.{measure}"]) for row in csv.DictReader(file)]


def outflow(runs):
    return stated(measured(runs, "outflow_sites_per_step"), 2)


def rivals(program, folder):
    print("| | B/d | outflow | kept at 1 d | 5 d | 10 d | 20 d | b_p/d at 5 d |\n" + "|---" * 8 + "|", flush=True)
    for rival in RIVALS:
        outlets, mixings = outlet_runs(program, folder, rival), rival_runs(program, folder, "mixing", rival)
        spread, shares = spreads(outlets, rival.diameter), kept(mixings)
        cells = [median_and_range(spread) if rival.scatters else stated(spread, 2), outflow(outlets),
                 *(stated(shares[drop], 2) for drop in (1, 5, 10, 20)),
                 stated([diffusion / rival.diameter for diffusion in measured(mixings, "pair_diffusion_5")], 3)]
        print(f"| {rival.title} | " + " | ".join(cells) + " |", flush=True)


def rivals_by_columns(program, folder):
    print("| columns | " + " | ".join(f"{rival.title}: B | outflow" for rival in (VOIDS, ONE_SITE)) + " |\n" + "|---" * 5 + "|", flush=True)
    for title, columns, more in (*((str(columns), columns, []) for columns in (1, 2, 4, 8, 10, 16)),
                                 *((f"{columns}, outlet lower", columns, ["outlets.tray.region=[0, 0, 63, 1]"]) for columns in (1, 10))):
        cells = []
        for rival in (VOIDS, ONE_SITE):
            runs = outlet_runs(program, folder, rival, width_of(columns), *more)
            cells += [stated(spreads(runs), 2), outflow(runs)]
        print(f"| {title} | " + " | ".join(cells) + " |", flush=True)


def rivals_by_diameters(program, folder):
    widths = (4, 6, 8, 12)
    print("| outflow | " + " | ".join(f"{width} d" for width in widths) + " |\n" + "|---" * 5 + "|", flush=True)
    for rival in RIVALS:
        if "rules.inertia=0" in rival.arguments:
            cells = [outflow(outlet_runs(program, folder, rival, width)) for width in widths]
            print(f"| {rival.title} | " + " | ".join(cells) + " |", flush=True)


def rivals_of_one_site(program, folder):
    print("| one site, inertia 0 | B, one column | B, 8 d | outflow, 8 d |\n" + "|---" * 4 + "|", flush=True)
    for rival in ORDERS:
        column, wide = (outlet_runs(program, folder, rival, width) for width in (width_of(1), 8))
        print(f"| {rival.title} | {stated(spreads(column), 2)} | {stated(spreads(wide), 2)} | {outflow(wide)} |", flush=True)


def recursion(columns, height):
    """Litwiniszyn's: where voids that rise by equal chances come to that height, from any of so many columns: distances of columns from the
    middle and their shares."""
    target = 2 * height
    at = {(0, 2 * i - columns + 1): 1 / columns for i in range(columns)}  # by twice the height and twice the column
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


def rivals_figures(program, folder):
    """Figures of docs/rivals.md, from tables in d."""
    shown = [rival for rival in RIVALS if rival is VOIDS or "rules.inertia=0" in rival.arguments and rival.radii != (1, 1)]
    shares = [kept(rival_runs(program, folder, "mixing", rival)) for rival in shown]
    write_table(folder / "kept.csv", ["fallen", *(rival.title.removesuffix(", 0").replace(",", ":") for rival in shown)],
                [[drop, *(statistics.mean(each[drop]) for each in shares)] for drop in range(1, 21)])
    outlets = [(rival, spreads(outlet_runs(program, folder, rival), rival.diameter)) for rival in shown]
    write_table(folder / "spread.csv", ["diameter", "B", "deviation"],
                [[rival.diameter, statistics.mean(spread), statistics.stdev(spread)] for rival, spread in outlets])

    d = VOIDS.diameter
    # The box has 73 columns. In parts of two, as every second one is half a spacing lower and has another share.
    wide = [f"lines.at_{height}.parts=36" for height in (5, 20)]
    measured = flux_by_line(outlet_runs(program, folder, VOIDS, 8, *wide) / "mean-lines-flow.csv")
    for height in (5, 20):
        parts = min((abs(y - (2 + height) * d - 2), parts) for y, parts in measured.items())[1]
        chances = recursion(10, height * d)
        print(f"variance of the flux at {height} d: voids {variance(parts) / d**2:.1f} d², recursion {variance(chances) / d**2:.1f} d²")
        total = sum(flux for _, flux in parts) * 60 / len(parts)
        write_table(folder / f"voids-{height}.csv", ["x", "share"], [[x / d - 30, flux / total] for x, flux in parts])
        write_table(folder / f"recursion-{height}.csv", ["x", "share"],
                    [[(x + COLUMN / 2) / d, (chance + following) / 2 * d / COLUMN] for (x, chance), (_, following) in itertools.pairwise(chances)])
    for figure in ("neighbours-kept", "voids-flux"):
        subprocess.run(["gnuplot", "-c", f"bench/rivals/{figure}.gp", folder, f"renders/gallery/{figure}.png"], check=True)


PARTS = {"rivals.md: results": rivals, "rivals.md: by columns": rivals_by_columns, "rivals.md: by diameters": rivals_by_diameters,
               "rivals.md: one site": rivals_of_one_site, "rivals.md: figures": rivals_figures}


def write_table(file, header, rows):
    with open(file, "w", encoding="utf-8", newline="") as opened:
        csv.writer(opened).writerows([header, *rows])


def median_and_range(values):
    return f"{statistics.median(values):.2f} ({min(values):.2f} to {max(values):.2f})"
