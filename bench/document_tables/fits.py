"""Tables of docs/phenomena.md that need several runs together, from those of other tables. Errors of what is fitted to runs: by leaving out one after the
other (jackknife); of what is fitted to means: from their errors."""

import csv
import math

import numpy as np

from . import automaton, contact, sources
from .table import Cell, Fit, Line, estimate, number


def table_of(name, tables=contact.TABLES):
    return next(table for table in tables if table.name == name)


def runs_of(name, title, runs):
    """What a table takes from the runs of a row or a column."""
    table = table_of(name)
    line = next(line for line in (*table.rows, *table.columns) if line.title == title)
    return table.measured(*((line, table.columns[0]) if line in table.rows else (table.rows[0], line)), runs)


def jackknife(function, values):
    """Of an array of runs: the function and its error."""
    without = [function(np.delete(values, index, axis=0)) for index in range(len(values))]
    return function(values), math.sqrt((len(values) - 1) * np.var(without))


def profiles(runs):
    """Root of the mean square difference of the mean profile and that of discrete elements on a smooth floor, x/L0 from 0.1 to 2.5."""
    for name, title, kind in PROFILES.values():
        with open(f"tests/data/dem_profile_smooth_{kind}.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        discrete = np.interp(sources.PROFILE, *([float(row[key]) for row in rows] for key in ("x_over_L0", "hfinal_over_L0_mean")))

        def difference(profiles):
            return np.sqrt(((profiles.mean(axis=0) - discrete) ** 2).mean())
        yield [estimate(*jackknife(difference, np.array([run["profile"] for run in runs_of(name, title, runs)])), 3)]


PROFILES = {"72 wide, rolling resistance": ("collapse-profile", "rolling resistance", "rr"),
            "72 wide, no rotation": ("collapse-profile", "no rotation", "norot"),
            "70 wide, rolling resistance": ("reproduced", "540, `resistance`", "rr"), "70 wide, no rotation": ("reproduced", "540, `none`", "norot")}


def straight(x, means, errors):
    """Intercept and slope of the weighted line through means, the error of the slope, and chi-square."""
    weights = 1 / np.asarray(errors)
    (slope, intercept), covariance = np.polyfit(x, means, 1, w=weights, cov="unscaled")
    return intercept, slope, math.sqrt(covariance[0, 0]), (((means - intercept - slope * x) * weights) ** 2).sum()


def clogging(runs):
    """ln⟨s⟩ = a + b x; the error of ln⟨s⟩ is that of ⟨s⟩ over ⟨s⟩. 0.119 d in a column."""
    for tables, name, first, last in CLOGGING.values():
        table = table_of(name, tables)
        lines = [column for column in table.columns if first <= int(column.title) <= last]
        cells = [table.cell(table.rows[1], line, runs) for line in lines]
        widths = np.array([int(line.title) for line in lines]) * math.sqrt(0.75) / sources.mean_diameter((3, 4))
        logarithms, errors = np.log([cell.mean for cell in cells]), [cell.deviation / cell.mean for cell in cells]
        intercept, slope, error, squares = straight(widths**2, logarithms, errors)
        yield [number_of(intercept, 2), estimate(slope, error, 3), number_of(squares, 1), number_of(straight(widths, logarithms, errors)[3], 1),
               number_of(len(lines) - 2, 0)]


CLOGGING = {"contact, 17 to 33 columns": (contact.TABLES, "clogging-contact", 17, 33),
            "contact, 17 to 37": (contact.TABLES, "clogging-contact", 17, 37),
            "automaton, 15 to 20": (automaton.TABLES, "clogging-automaton", 15, 20)}


def number_of(value, decimals):
    """Without an error of its own; in a check it may differ by a quarter."""
    return Cell(number(value, decimals), value, abs(value) / 4 / 4 / math.sqrt(2))


def beverloo(runs):
    """Outflow = a (D/d - b) to a power, fitted to the power of its means over the range of D."""
    table = table_of("silo-orifice")
    widths, outflow = [int(column.title) for column in table.columns], [table.cell(table.rows[0], column, runs).mean for column in table.columns]
    for power in (1.5, 1):
        straightened = np.power(outflow, 1 / power)
        slope, intercept = np.polyfit(widths, straightened, 1)
        off = max(abs((slope * np.array(widths) + intercept) / straightened - 1))
        yield [number_of(slope**power, 2), number_of(-intercept / slope, 1), number_of(100 * off, 1)]


def janssen(runs):
    """Share on the floor = (top + λ (1 - exp(-(H - top)/λ))) / H, by least squares over all runs, λ in whole d."""
    lengths = np.arange(40, 600)[:, None]
    for kind in ("resistance", "free"):
        table = table_of(f"weight-{kind}")
        measured = [run for column in table.columns for run in table.measured(table.rows[0], column, runs)]
        pairs = np.array([(run["height"], run["floor"]) for run in measured])
        for top in (0, 10):
            def differences(pairs):
                height, floor = pairs.T
                return np.sqrt((((top + lengths * (1 - np.exp(-(height - top) / lengths))) / height - floor) ** 2).mean(axis=1))

            def length(pairs):
                return lengths[differences(pairs).argmin(), 0]
            yield [estimate(*jackknife(length, pairs), 0), number_of(differences(pairs).min(), 3)]


def lines(titles):
    return [Line(title) for title in titles]


TABLES = [
    Fit("phenomena.md", "collapse-profile-difference", lines(PROFILES), lines(["difference / L0"]), profiles),
    Fit("phenomena.md", "clogging-law", lines(CLOGGING), lines(["a", "b", "chi-square", "chi-square, straight in D", "degrees of freedom"]),
        clogging),
    Fit("phenomena.md", "silo-law", lines(["a (D/d - b)^(3/2)", "a (D/d - b)"]), lines(["a", "b", "largest difference, %"]),
        beverloo),
    Fit("phenomena.md", "weight-law", lines([f"`{kind}`, from {top} d below the surface on" for kind in ("resistance", "free") for top in (0, 10)]),
        lines(["λ/d", "difference, root mean square"]), janssen),
]
