"""Each figure of the list, drawn from small runs: axes with units, data within the limits, letters inside the page."""

import re
import unittest

import clca
import numpy
from clca import _chart, _figures
from clca._chart import FileFormat
from clca._figures import FIGURES, charts
from matplotlib.figure import Figure
from support import ScratchTest

# All that a run of grains by contact dynamics has tables of.
SILO = {
    "clca": 1,
    "title": "A silo",
    "seed": 3,
    "model": "contact",
    "units": {"spacing": "1 mm", "density": 2},
    "box": {"width": 61, "height": 120},
    "species": {"small": {"shape": {"hexagon": 1}}, "large": {"shape": {"hexagon": 2}}, "nut": {"shape": {"hexagon": 3}}},
    "walls": {
        "floor": {"parts": [{"box": [0, 10, 16, 12]}, {"box": [45, 10, 61, 12]}]},
        "plug": {"box": [16, 10, 45, 12]},
        "plate": {"box": [25, 100, 36, 104], "motion": {"direction": "down", "period": 4, "distance": 60}},
    },
    "outlets": {"tray": {"region": [0, 0, 61, 8]}},
    "probes": {"neck": [16, 12, 45, 20]},
    "lines": {"level": {"from": [0, 25], "to": [61, 25], "parts": 6}},
    "stages": [
        {"name": "nut", "fill": {"region": [20, 12, 40, 40], "counts": {"nut": 1}}, "until": {"steps": 1}},
        {"name": "packing", "fill": {"region": [0, 12, 61, 120], "counts": {"small": 60, "large": 60}}, "until": {"steps": 600}},
        {"name": "shaking", "vessel": {"shake": {"gamma": 2, "amplitude": 6}}, "until": {"cycles": 3}},
        {"name": "pressing", "insert": ["plate"], "move": ["plate"], "until": {"steps": 200}},
        {"name": "discharge", "remove": ["plug", "plate"], "until": {"steps": 600}},
    ],
    "measure": ["profile", "repose", "packing", "outflow", "force", "segregation", "intruder", "convection", "mixing"],
    "output": {"frames": "none", "series": {"every": 10}, "fields": {"cell": 9, "every": 100}},
}

# What only the automaton has: an index of force at walls; and paths of weight, which a vessel does not have.
PILE = {
    "clca": 1,
    "title": "A pile that a piston pushes",
    "seed": 3,
    "box": {"width": 61, "height": 60},
    "species": {"grain": {"shape": {"hexagon": 1}}},
    "rules": {"inertia": 0, "scatter": 0.5},
    "walls": {
        "floor": {"box": [0, 0, 61, 1], "passive": "rigid", "motion": {"shake": {"amplitude": 2}}},
        "gate": {"box": [20, 1, 21, 60]},
    },
    "stages": [
        {"name": "packing", "fill": {"region": [0, 1, 20, 60], "counts": {"grain": 80}}},
        {"name": "flow", "remove": ["gate"]},
        {"name": "shaking", "move": ["floor"], "until": {"cycles": 4}},
    ],
    "measure": ["repose", "weight_paths"],
    "output": {"frames": "none"},
}
PISTON = PILE | {
    "walls": {
        "piston": {"box": [0, 50, 61, 54], "passive": "overlap", "motion": {"direction": "down", "period": 2, "distance": 48}},
    },
    "stages": [
        {"name": "packing", "fill": {"region": [0, 0, 61, 50], "counts": {"grain": 120}}},
        {"name": "pressing", "insert": ["piston"], "move": ["piston"], "until": {"steps": 120}},
    ],
    "measure": ["force"],
    "output": {"frames": "none", "series": {"every": 1}},
}
GAS = {
    "clca": 1,
    "seed": 3,
    "boltzmann": {"particles": 2000, "restitution": [0.5, 0.9], "friction": 0.3, "energy_ratio": 1, "until": 2, "ensemble": 2},
    "output": {"series": {"every": 0.5}, "histograms": [0, 2], "bins": "q20"},
}
SHEAR = GAS | {"boltzmann": {"particles": 2000, "restitution": 0.9, "friction": 0, "shear_rate": 1, "until": 2}}

# Labels without a unit: pure numbers that no table has, but a function of the figure.
PURE = "Step|X|X = .*|f / mean f|T_rot / T_tr, .*|Stress / mean pressure|Share / share .*|Probability density of .*|Quantile .*|" \
       "Base pressure over its mean"


class EachFigureTest(ScratchTest):
    def check(self, run, chart):
        pure = {table.label(name) for table in map(run.table, run.tables) for name in table.names if not table.units[name]}
        (panel,) = chart.panels()
        with _chart.plot_style(1):
            page = _chart.page_figure(chart, FileFormat(), 6, None, 8)
            page.canvas.draw()
        for axis in filter(None, (panel.x, panel.y, panel.y2)):
            self.assertTrue(axis.label in pure or re.fullmatch(PURE + r"|.*\(.+\)", axis.label), axis.label)
        for ax, curves in zip(page.axes, (panel.curves, panel.on_y2)):
            (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
            for curve in (curve for curve in curves if len(curve.x)):
                is_shown = numpy.isfinite(curve.y) & (left <= curve.x) & (curve.x <= right)
                shown = curve.y[is_shown & (curve.y >= low)] if ax.get_yscale() == "log" else curve.y[is_shown]
                self.assertGreater(len(shown), 0, curve.label)
                self.assertTrue(low <= shown.min() and shown.max() <= high, curve.label)
        self.assertTrue(any(len(curve.x) for curve in panel.curves) or panel.draw is not None)
        boxes = [artist.get_window_extent() for artist in (*page.legends, *page.texts)] + [ax.get_tightbbox() for ax in page.axes]
        for box in boxes:
            self.assertTrue(min(box.x0, box.y0) >= 0 and box.x1 <= page.bbox.x1 and box.y1 <= page.bbox.y1, (box, page.bbox))

    def test_it_can_be_read(self):
        runs = [clca.run(scene, output=f"run-{i}") for i, scene in enumerate((SILO, PILE, PISTON, GAS, SHEAR))]
        runs.append(clca.compare(runs[0], runs[3], output="beside", stage="shaking", restitution=0.9))
        drawn = set()
        for run in runs:
            for chart in charts(run):
                if chart.source not in drawn:
                    with self.subTest(figure=chart.name):
                        self.check(run, chart)
                    drawn.add(chart.source)
        self.assertEqual(drawn, {figure.name for figure in FIGURES}, "give a scene of this test what the new figure needs")

    def test_neighbours_need_enough_pairs(self):
        run = clca.run(SILO | {"stages": SILO["stages"][:2], "walls": {}}, output="run", set={"stages.packing.until.steps": 300})
        table = run.table("mixing-packing")
        self.assertTrue(table["kept"].any() and (table["pairs"] < _figures.ENOUGH_PAIRS).all(), table)
        self.assertNotIn("neighbours-packing", [chart.name for chart in charts(run)])

    def test_values_too_far_apart_for_an_axis_are_one_error(self):
        values = [numpy.array([-1.7e308, 1.7e308])]
        with self.assertRaisesRegex(ValueError, "Axis limits"):  # and no warning before it
            _chart.draw_axis(Figure().subplots(), "y", _chart.Axis("huge"), values)


if __name__ == "__main__":
    unittest.main()
