"""Tables of the automaton: docs/phenomena.md, and those of docs/model.md and docs/scene-format.md on wall removal."""

import math

import numpy as np

from . import sources
from .table import Line, Table, bare, until_clog

HEIGHTS = (9, 16, 22, 29, 35, 42, 48)
TAPPED = ["stages.tapping.until.cycles=1000", "box.width=500", "walls.floor.box=[0, 0, 500, 1]"]


def measures(stage):
    def numbers(run):
        return {"steps": run.stages[stage].steps,
                **{key: value for key, value in run.measures[stage].items() if value is not None and not math.isnan(value)}}
    return numbers


def unless_clogged(run):
    """Outflow and whether an orifice clogs. `share`: of the grains, that leaves."""
    flow = run.measures["discharge"]
    return {"clogged": bool(flow["clogged"]), "share": 100 * flow["discharged_share"],
            **({} if flow["clogged"] else {"outflow": flow["outflow_sites_per_step"]})}


def wall_removal(run):
    """`run-out`: over the width of 70 of docs/model.md."""
    flow, packing = (measures(stage)(run) for stage in ("flow", "packing"))
    return {**flow, "run-out": flow["runout_99"] / 70, "steps to settle": packing["steps"], "packing": packing["packing_fraction"]}


def outlet(side):
    def numbers(run):
        flow = run.measures["discharge"]
        return {"outflow": flow[f"outflow_sites_per_step.{side}"], "clogged": bool(flow[f"clogged.{side}"]),
                **{key: flow[f"discharged.{side}{species}"] for key, species in (("discharged", ""), ("small", ".small"), ("large", ".large"))}}
    return numbers


def column(run):
    """Of `collapse-aspect`."""
    return {**measures("collapse")(run), "height": run.measures["packing"]["height_mean"] / 40}


def by_cycle(stage, column):
    """Of `cycles`, from 0 on: what a column has after so many."""
    def numbers(run):
        cycles = run.table("cycles")
        cycles = cycles[cycles["stage"] == stage]
        return {int(cycle): value for cycle, value in zip(cycles["cycle"], cycles[column]) if not math.isnan(value)}
    return numbers


def slope_by_taps(run):
    return {0: run.measures["collapse"]["repose_angle_deg"], **by_cycle("tapping", "repose_angle_deg")(run)}


def segregation(run):
    return {0: run.measures["packing"]["segregation_index"], **by_cycle("tapping", "segregation_index")(run)}


def nut(run):
    heights = by_cycle("shaking", "intruder_height_rel")(run)
    up = [cycle for cycle, height in heights.items() if height >= 1]
    return {"up": bool(up), "end": heights[max(heights)], **({"cycles": float(up[0])} if up else {})}


def drift(height):
    """In spacings a cycle, mean of the cells of this height: of the outer cell on either side, and the inner four."""
    def numbers(run):
        cells = run.table("convection-shaking")
        row = cells[abs(cells["y"] - height) < 1]
        wall, centre = (np.average(part["dy"], weights=part["weight"]) for part in (row[[0, -1]], row[2:6]))
        return {"wall": wall, "centre": centre, "difference": centre - wall}
    return numbers


def drift_from_wall(run):
    """At height 35 by the distance from the left wall."""
    cells = run.table("convection-shaking")
    row = cells[abs(cells["y"] - 35) < 1.3]
    return {place: row["dy"][abs(row["x"] - place).argmin()] for place in (0.9, 3.5, 6.2, 8.8, 11.5, 16.7, 24.7)}


def load(wall, stage, home=0.0):
    """The load of a wall when it has gone so far: sites of overlap that began at it."""
    def numbers(run):
        series = run.series[run.series["stage"] == stage]
        reached = {place: series[series[f"travel.{wall}"] >= place + home] for place in (6, 14, 16, 18, 22, 26, 36)}
        return {place: rows[f"index.{wall}"][0] for place, rows in reached.items() if len(rows)} | {
            "end": series[f"index.{wall}"][-1], **measures(stage)(run)}
    return numbers


def piston(run):
    """`packing`: all sites of the grains over all below the piston, in 93 columns."""
    travel = run.series["travel.piston"][-1]
    return {**load("piston", "compression")(run), "travel": travel, "packing": 240 * (7 + 19) / (93 * (100 - travel))}


def tails(run):
    """β and the share above the mean of what overlaps, of the means over the stage and of its last state."""
    stage = "penetration" if "penetration" in run.stages else "compression"
    flow = run.measures[stage]
    return {"tail": flow["force_tail_beta"], "above": flow["force_share_above_mean"]}


def width_of_silo(columns):
    """In the middle of 121."""
    left = (121 - columns) / 2
    places = [math.sqrt(0.75) * (left + at - 0.5) for at in (0, columns)]
    return Line(str(columns), [f"walls.floor_left={{box: [0, 40, {places[0]:.3f}, 42]}}",
                               f"walls.plug={{box: [{places[0]:.3f}, 40, {places[1]:.3f}, 42]}}",
                               f"walls.floor_right={{box: [{places[1]:.3f}, 40, 104.7, 42]}}"])


def hopper(width):
    """Walls that slant alike and end so far apart."""
    half, thickness = width / 2, 3
    ends = 70 - half, 70 + half
    top = 24 + (ends[0]) * 66 / 59
    return Line(str(width), [f"walls.left={{line: {{from: [0, {top:.2f}], to: [{ends[0]:g}, 24], thickness: {thickness}}}}}",
                             f"walls.right={{line: {{from: [140, {top:.2f}], to: [{ends[1]:g}, 24], thickness: {thickness}}}}}"])


def inertia(value):
    return Line(str(value), [f"rules.inertia={value}"])


def scene(name, scene_name, rows, columns, source, seeds="1..16", decimals=2, output="{}", page="phenomena.md"):
    return Table(page, name, scene_name, rows, columns, seeds, source, decimals, output)


def of_model(name, inertias, columns, seeds):
    """The column of docs/model.md."""
    return scene(name, "wall-removal", [inertia(value) for value in inertias],
                 [Line(f"`{ties}`: {line.title}", ["walls.right.box=[70,0,71,460]", "stages.packing.fill.region=[0,0,70,460]", f"rules.ties={ties}"],
                       key=line.key, decimals=line.decimals, style=line.style) for ties in ("particle", "direction") for line in columns],
                 wall_removal, seeds, page="model.md")


OUTFLOW = Line("outflow", key="outflow", decimals=1)
CLOGGED = [Line("clogged", key="clogged"), Line("⟨s⟩", key="left", decimals=1, style=until_clog)]
NUT = [Line("cycles to the top", key="cycles", decimals=0), Line("on top", key="up"), Line("height at the end", key="end")]
TAILS = [Line("β", key="tail"), Line("share above the mean", key="above")]

SLOPE = Line("slope °", key="repose_right_deg", decimals=1)
RUNOUT = Line("run-out / L0", key="run-out")
REMOVED = [SLOPE, Line("run-out of 99 %", key="runout_99", decimals=1), Line("share moved (2 sites)", key="moved_share_2", decimals=3)]

TABLES = [
    of_model("ties", (0, 0.9, 0.98), [SLOPE, RUNOUT], "1..48"),
    of_model("inertia", (0, 0.5, 0.8, 0.9, 0.95, 0.98, 1), [SLOPE, RUNOUT, Line("moved", key="moved_share")], "1..16"),
    scene("fill-method", "wall-removal",
          [Line(f"{value}, `{method}`", [f"rules.inertia={value}", f"stages.packing.fill.method={method}"])
           for value in (0.9, 0) for method in ("random", "deposition")],
          [Line("steps to settle", key="steps to settle", decimals=0, style=bare), Line("packing fraction", key="packing", decimals=3), *REMOVED],
          wall_removal, page="scene-format.md"),
    scene("wall-removal", "wall-removal", [inertia(0), inertia(0.9)], [Line("steps to collapse", key="steps", decimals=0), *REMOVED], wall_removal),
    scene("heap", "heap", [inertia(0), inertia(0.9)], [Line("angle of repose °", key="repose_angle_deg", decimals=1)], measures("pouring")),
    scene("silo", "silo-discharge",
          [Line(f"{2 * each:,}", [f"stages.filling.fill.counts={{small: {each}, large: {each}}}"]) for each in (300, 600, 800)],
          [Line("outflow, sites/step", key="outflow", decimals=1), Line("left, %", key="share", decimals=0)], unless_clogged),
    scene("silo-width", "silo-discharge", [OUTFLOW, Line("clogged", key="clogged")],
          [width_of_silo(columns) for columns in (5, 7, 9, 11, 15, 21, 27, 31)], unless_clogged),
    scene("two-orifices", "two-orifices",
          [Line("outflow, sites/step", key="outflow", decimals=2), Line("grains that left", key="discharged", decimals=0),
           Line("of these R1", key="small", decimals=0), Line("of these R2", key="large", decimals=0), Line("clogged", key="clogged")],
          [Line(f"{side}, {columns} columns", source=outlet(side)) for side, columns in (("left", 15), ("right", 25))], None, "1..8"),
    scene("clogging-automaton", "clogging", CLOGGED, [Line(str(columns), [f"let.W={columns}"]) for columns in range(12, 21)], sources.clogging,
          "1..100"),
    scene("hopper", "hopper", [Line("outflow, sites/step", key="outflow", decimals=1)], [hopper(width) for width in (14, 18, 22, 26, 30)],
          unless_clogged),
    scene("nut-lift", "brazil-nut",
          [Line(str(lift), [f"walls.floor.motion={{shake: {{amplitude: {lift}}}}}", "stages.shaking.until.cycles=300"]) for lift in (2, 4, 10)],
          NUT[:2], nut),
    scene("nut-size", "brazil-nut",
          [Line(f"R{radius}", ["stages.intruder.fill.region=[16, 1, 36, 20]", f"species.intruder.shape={{hexagon: {radius}}}"]) for radius in (2, 3, 5, 7)],
          NUT, nut),
    scene("nut-otherwise", "brazil-nut", [Line(f"`{key}`", [key]) for key in ("rules.scatter=0", "box.periodic=true")], NUT, nut),
    scene("segregation", "segregation",
          [Line(f"{each} + {each}", [f"stages.packing.fill.counts={{small: {each}, large: {each}}}"]) for each in (300, 150)],
          [Line(str(cycle), key=cycle) for cycle in (0, 25, 50, 100, 200, 400)], segregation),
    scene("convection", "convection", [Line("wall", key="wall", style=bare), Line("centre", key="centre", style=bare), Line("difference", key="difference")],
          [Line(str(height), source=drift(height)) for height in HEIGHTS], None, output="{fields: {cell: 6.5, every: 2000}}"),
    scene("convection-from-wall", "convection", [Line("drift", style=bare)],
          [Line(str(place), key=place) for place in (0.9, 3.5, 6.2, 8.8, 11.5, 16.7, 24.7)], drift_from_wall,
          output="{fields: {cell: 2.6, every: 2000}}"),
    scene("convection-otherwise", "convection",
          [Line("as it is", []), *(Line(f"lift {lift}", [f"walls.floor.motion={{shake: {{amplitude: {lift}}}}}"]) for lift in (2, 4)),
           *(Line(f"scatter {value}", [f"rules.scatter={value}"]) for value in (0.25, 0.5)), Line("periodic", ["box.periodic=true"])],
          [Line("centre minus wall", key="convection_centre_minus_wall")], measures("shaking"), output="{fields: {cell: 6.5, every: 2000}}"),
    scene("plate-penetration", "plate-penetration",
          [Line("depth at which it stalls", key="plate_depth", decimals=1), Line("share of overlap in the 45° cone", key="overlap_cone_share"),
           Line("deepest overlap", key="overlap_depth_max", decimals=0, style=bare), Line("pairs that overlap", key="overlap_contacts", decimals=0),
           Line("jammed grains", key="jammed", decimals=0)],
          [Line("measured")], load("plate", "penetration", 13.7), output="{series: {every: 1}, contacts: {every: 4}}"),
    scene("plate-load", "plate-penetration", [Line("load, sites", decimals=0)],
          [*(Line(str(place), key=place) for place in (6, 16, 26, 36)), Line("at the stall", key="end")],
          load("plate", "penetration", 13.7), output="{series: {every: 1}, contacts: {every: 4}}"),
    scene("overlap-forces", "plate-penetration", TAILS,
          [Line(f"{name}, {what}", [], scene=scene_name, output=output)
           for name, scene_name in (("plate", "plate-penetration"), ("piston", "piston"))
           for what, output in (("means over the stage", "{series: {every: 1}, contacts: {every: 4}}"), ("last state", "{series: {every: 1}}"))],
          tails),
    scene("piston", "piston",
          [Line("travel at which it stalls", key="travel", decimals=0), Line("depth below the mean surface", key="plate_depth", decimals=1),
           Line("nominal packing", key="packing"), *(Line(f"load after {place}", key=place, decimals=0) for place in (14, 18, 22, 26))],
          [Line("measured")], piston, output="{series: {every: 1}, contacts: {every: 4}}"),
    scene("taps", "avalanche-taps", [Line("slope °", decimals=1)],
          [Line(str(taps), TAPPED, key=taps) for taps in (0, 1, 3, 10, 30, 100, 300, 1000)], slope_by_taps, output="{series: {every: 1000}}"),
    scene("collapse-aspect", "collapse-aspect",
          [Line("H0/L0", key="height", style=bare), Line("run-out of 99 % / L0", key="runout_ratio"), Line("slope °", key="repose_right_deg", decimals=0),
           Line("run-out / L0, inertia 0.98", ["rules.inertia=0.98", "box.width=800"], key="runout_ratio")],
          [Line(str(a), [f"let.a={a}"]) for a in (0.5, 1, 2, 4, 8)], column),
]
