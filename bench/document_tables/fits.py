"""Numbers of docs/phenomena.md that need several runs together, from those of its tables."""

import csv

import numpy as np

from . import contact, sources


def runs_of(name, column, program, folder):
    """What a table takes from the runs of columns whose titles begin so."""
    table = next(table for table in contact.TABLES if table.name == name)
    return [run for line in table.columns if line.title.startswith(column)
            for run in table.measured(table.rows[0], line, program, folder)]


def janssen(program, folder):
    print("| | begins below the surface, d | λ/d | difference, root mean square |\n" + "|---" * 4 + "|")
    lengths = np.arange(40, 600)[:, None]
    for name in ("resistance", "free"):
        runs = runs_of("phenomena.md: weight in a silo", name, program, folder)
        height, floor = (np.array([run[key] for run in runs]) for key in ("height", "floor"))
        for top in (0, 5, 10, 15):
            share = (top + lengths * (1 - np.exp(-(height - top) / lengths))) / height
            difference = np.sqrt(((share - floor) ** 2).mean(axis=1))
            best = difference.argmin()
            print(f"| {name} | {top} | {lengths[best, 0]} | {difference[best]:.3f} |", flush=True)


def profiles(program, folder):
    """Root of the mean square difference of the mean profile and that of discrete elements on a smooth floor, x/L0 from 0.1 to 2.5."""
    print("| | difference / L0 |\n|---|---|")
    for name, column, kind in (("phenomena.md: collapse", "540, resistance", "rr"), ("phenomena.md: collapse", "540, none", "norot"),
                               ("contact.md: what is reproduced", "resistance", "rr"), ("contact.md: what is reproduced", "none", "norot")):
        with open(f"tests/data/dem_profile_smooth_{kind}.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        discrete = np.interp(sources.PROFILE, *([float(row[key]) for row in rows] for key in ("x_over_L0", "hfinal_over_L0_mean")))
        profile = np.mean([run["profile"] for run in runs_of(name, column, program, folder)], axis=0)
        print(f"| {name}, {column} | {np.sqrt(((profile - discrete) ** 2).mean()):.3f} |", flush=True)


PARTS = {"phenomena.md: law of Janssen": janssen, "phenomena.md: collapse, profiles beside discrete elements": profiles}
