"""Figures: which the tables allow, what is in them, letters that are not cut off, and the command."""

import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import clca
import numpy
from clca import _chart, _figures
from clca._chart import Axis, Chart, Curve, FileFormat, Panel, figure_bytes
from clca._figures import FigureChoice, charts, chosen_charts
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest, clca_program

import matplotlib
matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402

# What gnuplot's templates drew of these scenes.
OF_RUN = {"profile", "motion", "mean-height"}
OF_CONTACT = OF_RUN | {"kinetic-energy"}
OF_GAS = {"temperature-translational", "cumulant-translational", "distance-translational", "energy-translational", "collisions"}


def names(folder, **choice):
    return [chart.name for chart in charts(folder, FigureChoice(**choice))]


def panel_of(folder, name, **choice):
    return chosen_charts(folder, [name], FigureChoice(**choice))[0].panels()[0]


class FiguresTest(ScratchTest):
    def test_a_run_and_a_gas_have_all_figures_that_their_tables_allow(self):
        self.assertLessEqual(OF_RUN, set(names(clca.run(SCENE, output="run"))))
        self.assertLessEqual(OF_CONTACT, set(names(clca.run(CONTACT, output="contact"))))
        self.assertLessEqual(OF_GAS, set(names(clca.run(GAS, output="gas"))))

    def test_a_figure_is_left_out_where_a_column_is_zero_throughout(self):
        run = clca.run(SCENE, output="run")
        table = run.folder / "series.csv"
        lines = [line.split(",") for line in table.read_text().splitlines()]
        place = lines[0].index("mean_height")
        for line in lines[1:]:
            line[place] = "0"
        table.write_text("\n".join(map(",".join, lines)) + "\n")
        self.assertNotIn("mean-height", names(run))

    def test_curves_are_those_of_the_stages_and_axes_say_what_they_show(self):
        run = clca.run(CONTACT, output="run")
        panel = panel_of(run, "mean-height")
        self.assertEqual([curve.label for curve in panel.curves], ["packing", "flow"])
        self.assertEqual((panel.x.label, panel.y.label), ("Time (s)", "Mean height of the particles (spacings)"))
        self.assertEqual(sum(len(curve.x) for curve in panel.curves), len(run.series))

    def test_stages_times_and_means_may_be_chosen(self):
        run = clca.run(SCENE, output="run")
        self.assertEqual([curve.label for curve in panel_of(run, "motion", stages=("flow",)).curves], ["flow"])
        self.assertEqual([curve.label for curve in panel_of(run, "profile", filling=False).curves], ["end of flow"])
        steps = numpy.concatenate([curve.x for curve in panel_of(run, "motion", first=3, last=9).curves])
        self.assertEqual((steps.min(), steps.max()), (3, 9))
        smooth = panel_of(run, "motion", mean=5).curves[0].y
        rough = run.series["moving_share"][run.series["stage"] == "packing"]
        self.assertAlmostEqual(smooth[4], rough[2:7].mean())
        with self.assertRaisesRegex(clca.Error, "no stage 'flw'; did you mean 'flow'"):
            names(run, stages=("flw",))

    def test_the_outflow_is_a_running_mean_of_what_leaves(self):
        run = clca.run(SCENE, output="run")
        steps, stages = numpy.arange(101), numpy.where(numpy.arange(101) < 20, "packing", "flow")
        left = 3 * numpy.clip(steps - 20, 0, 60)  # 3 sites a step, from step 20 to 80
        cells = [f"{step},{stage},{sites}" for step, stage, sites in zip(steps, stages, left)]
        (run.folder / "series.csv").write_text("\n".join(["step,stage,discharged_sites", *cells, ""]))
        panel = panel_of(run, "outflow-rate")
        self.assertEqual(panel.y.label, "Outflow, mean over 3 steps (sites/step)")
        self.assertEqual([curve.label for curve in panel.curves], ["flow"])
        rate = dict(zip(panel.curves[0].x, panel.curves[0].y))
        self.assertAlmostEqual(rate[50], 3)
        self.assertAlmostEqual(rate[20], 1.5)
        self.assertAlmostEqual(rate[90], 0)
        self.assertAlmostEqual(dict(zip(*panel_of(run, "outflow-rate", mean=10).curves[0][1:3]))[23], 2.4)
        self.assertEqual(panel_of(run, "outflow-rate", first=50, last=50).curves, [])
        run.summary["units"] = {"site_mass": 0.5}
        self.assertIn("(kg/step)", panel_of(run, "outflow-rate").y.label)

    def test_columns_may_be_chosen_two_on_two_axes(self):
        run = clca.run(SCENE, output="run")
        panel = panel_of(run, "mean_height", y=("mean_height",), y2="moving_share")
        self.assertEqual(panel.y2.label, run.series.label("moving_share"))
        self.assertEqual(len(panel.on_y2), 2)
        with self.assertRaisesRegex(clca.Error, "no table with a column 'mean_heigt'; did you mean 'mean_height'"):
            names(run, y=("mean_heigt",))
        with self.assertRaisesRegex(clca.Error, "say which columns are y"):
            names(run, x="step")

    def test_a_figure_over_time_may_have_a_column_on_a_second_axis(self):
        run = clca.run(SCENE, output="run")
        self.assertEqual(names(run, y2="moving"), ["motion", "mean-height"])
        panel = panel_of(run, "mean-height", y2="moving")
        self.assertEqual([len(curve.x) for curve in panel.on_y2], [len(curve.x) for curve in panel.curves[:2]])
        self.assertEqual([curve.label for curve in panel.curves[2:]],
                         ["Mean height of the particles (spacings) (left)", "Moving (particles) (right, dashed)"])
        with _chart.plot_style(1):
            first, second = _chart.draw_panel(pyplot.figure().add_subplot(), panel)
        pyplot.close()
        self.assertEqual([any(line.get_visible() for line in ax.get_ygridlines()) for ax in (first, second)], [True, False])
        with self.assertRaisesRegex(clca.Error, "no figure over time of a table with a column 'movin'"):
            names(run, y2="movin")
        with self.assertRaisesRegex(clca.Error, "'profile' has no second axis; figures over time have one: motion, mean-height"):
            panel_of(run, "profile", y2="moving")

    def test_two_curves_on_two_axes_have_colours_and_names_of_their_own(self):
        panel = panel_of(clca.run(SCENE, output="run"), "mean-height", y2="moving", stages=("flow",))
        self.assertEqual([(curve.label, curve.color) for curve in [*panel.curves, *panel.on_y2]],
                         [("Mean height of the particles (spacings) (left)", 0), ("Moving (particles) (right, dashed)", 1)])
        self.assertEqual(panel.title, "flow")

    def test_what_cannot_be_drawn_is_said(self):
        run = clca.run(SCENE, output="run")
        with self.assertRaisesRegex(clca.Error, "do not allow the figure 'outflow', which needs series.csv"):
            chosen_charts(run, ["outflow"], FigureChoice())
        with self.assertRaisesRegex(clca.Error, "no figure 'x' .there are: .*profile"):
            chosen_charts(run, ["x"], FigureChoice())
        for choice, said in (
            ({"y": ["time"]}, "no table with a column 'time'; series.csv has step, stage, "),
            ({"first": 1e9}, "the figure 'motion' has no rows in the stages and times that are chosen"),
            ({"stages": ["packing"], "first": 9000}, "the figure 'motion' has no rows in the stages"),
            ({"first": 1e9, "y": ["moving_share"]}, "'moving_share' has no rows in the stages and times that are chosen"),
            ({"y2": "stage"}, "series.csv: column 'stage' is text, no numbers"),
            ({"y2": "mean_height", "first": 1e9}, "run: nothing to draw of what is chosen"),
            ({"first": 9, "last": 3}, "the last time 3 is before the first, 9"),
            ({"y2": "movin", "first": 1e9}, "no figure over time of a table with a column 'movin'"),
        ):
            with self.assertRaisesRegex(clca.Error, said):
                chosen_charts(run, ["motion"], FigureChoice(**choice))[0].panels()

    def test_names_of_the_list_are_all_different_and_say_what_they_show(self):
        self.assertEqual(len({figure.name for figure in _figures.FIGURES}), len(_figures.FIGURES))
        self.assertTrue(all(figure.about.endswith(".") for figure in _figures.FIGURES))


class SweepTest(ScratchTest):
    VARY = {"rules.inertia": [0, 0.3, 0.6, 0.9], "rules.scatter": [0, 0.1, 0.2, 0.3], "box.width": [40, 44, 48]}

    def test_three_keys_give_panels_that_can_be_read(self):
        sweep = clca.sweep(SCENE, seeds=[1], vary=self.VARY, output="sweep")
        chart = next(chart for chart in charts(sweep) if chart.name == "sweep-flow-runout_99")
        panels = chart.panels()
        self.assertEqual([panel.title for panel in panels], ["flow, box.width=40", "box.width=44", "box.width=48"])
        self.assertEqual([curve.label for curve in panels[0].curves], [f"rules.scatter={x}" for x in ("0", "0.1", "0.2", "0.3")])
        # No letter is over the axes, which are larger than the legend.
        for width in (89, 180):
            with _chart.plot_style(1):
                page = _chart.page_figure(chart, FileFormat(in_mm=True), width / 25.4, None, 8)
                page.canvas.draw()
                legend = page.legends[0].get_window_extent()
                for ax in page.axes:
                    self.assertFalse(ax.get_window_extent().overlaps(legend))
                    self.assertGreater(ax.get_window_extent().height, 2 * legend.height)

    def test_titles_of_panels_break_between_keys_and_each_column_has_labels(self):
        title = "rules.scatter=0.1, L0=60, stages.flow.rules.inertia=0.0625"
        self.assertEqual(_chart.lines_of_length(title, 20), ["rules.scatter=0.1,", "L0=60,", "stages.flow.rules.", "inertia=0.0625"])
        self.assertEqual(_chart.lines_of_length("x" * 30, 20), ["x" * 20, "x" * 10])
        x = numpy.arange(5.0)
        panels = [Panel([Curve("a", x, x)], Axis("Time (s)"), Axis("Height"), title) for _ in range(7)]
        with _chart.plot_style(1):
            page = _chart.page_figure(Chart("a", "b", 0, lambda: panels), FileFormat(), 960 / 96, None, 8)
            page.canvas.draw()
            has_label = [ax.get_xlabel() == "Time (s)" and ax.xaxis.get_ticklabels()[0].get_visible() for ax in page.axes]
            self.assertEqual(has_label, [False, False, False, False, True, True, True])
            shown = [ax.get_tightbbox() for ax in page.axes]
            self.assertFalse(any(one.overlaps(other) for i, one in enumerate(shown) for other in shown[:i]))

    def test_many_numbers_have_a_colour_bar(self):
        vary = {"rules.inertia": [0, 0.9], "rules.scatter": [x / 10 for x in range(9)]}
        sweep = clca.sweep(SCENE, seeds=[1], vary=vary, output="sweep")
        panel = panel_of(sweep, "sweep-flow-runout_99")
        self.assertEqual(panel.scale, ("rules.scatter", [x / 10 for x in range(9)]))
        figure_bytes(chosen_charts(sweep, ["sweep-flow-runout_99"], FigureChoice())[0], FileFormat())

    def test_axis_measures_and_curves_may_be_chosen(self):
        sweep = clca.sweep(SCENE, seeds=[1, 2], vary={"rules.inertia": [0, 0.9], "rules.ties": ["particle", "direction"]},
                           output="sweep")
        self.assertIn("mean-series-flow-mean_height", names(sweep))
        panel = panel_of(sweep, "sweep", x="rules.ties", y=("runout_99",), over=("rules.inertia",), stages=("flow",))
        self.assertEqual(panel.x.words, ("particle", "direction"))
        against = panel_of(sweep, "sweep", x="height_mean", y=("runout_99",), stages=("flow",))
        self.assertIsNotNone(against.curves[0].left)
        for wrong, said in (({"x": "rules.inerta"}, "varied key or measure"), ({"y": ("runut",)}, "no measure"),
                            ({"over": ("x",)}, "no varied key")):
            with self.assertRaisesRegex(clca.Error, said):
                names(sweep, **wrong)

    def test_notebooks_get_axes(self):
        sweep = clca.sweep(SCENE, seeds=[1, 2], vary={"rules.inertia": [0, 0.9]}, output="sweep")
        run = sweep[0]
        with matplotlib.rc_context({"axes.prop_cycle": matplotlib.cycler(color=["#123456", "#654321"])}):
            _, ax = pyplot.subplots()
            self.assertIs(run.plot("profile", ax=ax), ax)
            self.assertEqual([line.get_color() for line in ax.lines], ["#123456", "#654321"])
        other = sweep.plot(x="rules.inertia", y="flow.runout_99")
        self.assertEqual((other.get_xlabel(), other.get_ylabel()), ("rules.inertia", "Run-out of 99 % (spacings)"))
        several = sweep.plot(y=["flow.runout_99", "packing.height_mean"]), sweep.plot(y="height_mean"), run.plot(y=["moving", "step"])
        found = [[(ax.get_title(loc="left"), ax.get_ylabel().partition(" (")[0]) for ax in axes] for axes in several]
        self.assertEqual(found, [[("packing", "Mean height"), ("flow", "Run-out of 99 %")],
                                 [("packing", "Mean height"), ("flow", "Mean height")], [("", "Moving"), ("", "Step")]])
        with self.assertRaisesRegex(clca.Error, "2 figures, more than the one that ax takes: .*; there are moving, step"):
            run.plot(y=["moving", "step"], ax=ax)
        pyplot.close("all")


    def test_a_figure_too_small_for_its_panels_is_a_warning(self):
        x = numpy.arange(5.0)
        axis = Axis("Energy of the fluctuations ((√(spacing·gravity))²)")
        chart = Chart("many", "b", 0, lambda: [Panel([Curve("a", x, x)], Axis("Time (s)"), axis, "p") for _ in range(2)])
        for width, height, what in ((60, 40, "height"), (89, 45, "height"), (20, None, "width")):
            with self.assertWarnsRegex(UserWarning, f"^many: the {what} is too small for the panels and their labels$"):
                figure_bytes(chart, FileFormat(in_mm=True, width=width, height=height))
        figure_bytes(chart, FileFormat(in_mm=True, width=89, height=70))
        self.assertEqual(_chart.wrapped(axis.label, 0.2, 8).split("\n"), ["Energy of the", "fluctuations", "((√(spacing·", "gravity))²)"])

    def test_points_that_a_logarithmic_axis_leaves_out_are_a_warning(self):
        run = clca.run(SCENE, output="run")
        with self.assertWarnsRegex(UserWarning, "^Moving .particles.: points at 0 or below are not on the logarithmic axis y$"):
            panel = panel_of(run, "moving", y=["moving"], log="y")
        self.assertTrue((panel.curves[0].y == 0).any())
        ax = pyplot.figure().add_subplot()
        _chart.draw_panel(ax, panel)
        transformed = ax.transData.transform(ax.lines[0].get_xydata())
        pyplot.close()
        self.assertFalse(numpy.isfinite(transformed[panel.curves[0].y == 0, 1]).any())  # no stroke from the edge
        panel_of(run, "mean_height", y=["mean_height"], log="y")


class LegendTest(unittest.TestCase):
    def page(self, count, width, height=None, name="rules.ties={}"):
        x = numpy.array([0.0, 1.0])
        curves = [Curve(name.format(i), x, x + i) for i in range(count)]
        chart = Chart("many", "", 0, lambda: [Panel(curves, Axis("x"), Axis("y"))], "A title")
        with _chart.plot_style(1):
            page = _chart.page_figure(chart, FileFormat(in_mm=True), width / 25.4, height and height / 25.4, 8)
            page.canvas.draw()
        return page

    def check(self, page):
        """The names; the legend is whole and leaves the larger part to the axes, with the labels of these."""
        box, whole, (ax,) = page.legends[0].get_window_extent(), page.bbox, page.axes
        self.assertTrue(0 <= box.x0 and box.x1 <= whole.x1 and box.y0 >= 0 and box.y1 <= whole.y1, (box, whole))
        self.assertFalse(box.overlaps(ax.get_tightbbox()))
        self.assertGreater(ax.get_window_extent().height, 0.25 * whole.height)
        return [text.get_text() for text in page.legends[0].texts]

    def test_a_legend_too_long_for_the_height_says_how_many_names_are_left_out(self):
        self.assertEqual(self.check(self.page(4, 89, 60)), [f"rules.ties={i}" for i in range(4)])
        for width, height in ((89, 60), (60, 50), (180, 40)):
            names = self.check(self.page(60, width, height))
            self.assertEqual(names[:-1], [f"rules.ties={i}" for i in range(len(names) - 1)])
            self.assertEqual(names[-1], f"… and {61 - len(names)} more")
            self.assertGreater(len(names), 4)

    def test_a_legend_is_hardly_higher_than_the_plot(self):
        self.assertEqual(len(self.check(self.page(12, 60))), 12)
        self.assertRegex(self.check(self.page(100, 60))[-1], "^… and .. more$")

    def test_a_name_too_long_for_the_width_is_broken_or_cut(self):
        names = self.check(self.page(2, 60, name="{}, a name that takes two lines: 1e-3"))
        self.assertEqual([name.replace("\n", " ") for name in names], [f"{i}, a name that takes two lines: 1e-3" for i in range(2)])
        self.assertIn("\n", names[0])
        names = self.check(self.page(2, 60, name="{} " + "very " * 30))
        self.assertTrue(all(name.startswith(f"{i} very") and name.endswith("…") for i, name in enumerate(names)), names)


class LettersTest(ScratchTest):
    def test_any_title_stays_text_and_the_file_well_formed(self):
        run = clca.run(SCENE | {"title": "silo ]]> <b>&amp; $x_1$ \u1234 \U0001f600 end"}, output="run")
        for chart in charts(run):
            picture = xml.fromstring(figure_bytes(chart, FileFormat("svg")))
            file = self.folder / f"{chart.name}.pdf"
            file.write_bytes(figure_bytes(chart, FileFormat("pdf")))
            said = subprocess.run(["pdftotext", "-raw", file, "-"], check=True, capture_output=True, text=True).stdout
            for text in ("".join(picture.itertext()), said):
                for word in ("silo ]]> <b>&amp; $x_1$", "end"):
                    self.assertIn(word, " ".join(text.split()))

    def test_letters_have_eight_points_and_are_not_cut_off(self):
        run = clca.run(SCENE | {"title": "A collapse with a title so long that it takes several lines on paper, $5 of it"},
                       output="run")
        for width in (60, 89, 180):
            for chart in charts(run):
                file = self.folder / f"{width}-{chart.name}.pdf"
                file.write_bytes(figure_bytes(chart, FileFormat("pdf", True, width)))
                text = subprocess.run(["pdftotext", "-bbox", file, "-"], check=True, capture_output=True, text=True).stdout
                wide, high = map(float, re.search(r'page width="([\d.]+)" height="([\d.]+)"', text).groups())
                self.assertAlmostEqual(wide, width / 25.4 * 72, delta=0.1)
                boxes = re.findall(r'xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)<', text)
                self.assertGreater(len(boxes), 15)
                for left, top, right, bottom, word in boxes:
                    place = f"{word} in {file.name}"
                    self.assertTrue(float(left) >= 0 and float(right) <= wide, place)
                    self.assertTrue(float(top) >= -1.5 and float(bottom) <= high + 1.5, place)  # of the font, not of its letters
                    # DejaVu has 1.164 of the size from the top to the bottom.
                    height = min(float(bottom) - float(top), float(right) - float(left))
                    self.assertLess(height, 8 * 1.2, place)
                self.assertIn("$5", text)

    def test_letters_have_the_same_size_in_every_format(self):
        run = clca.run(SCENE, output="run")
        chart = next(chart for chart in charts(run) if chart.name == "mean-height")
        sizes = set(re.findall(r"font: ([\d.]+)px", figure_bytes(chart, FileFormat("svg", True, 89)).decode()))
        self.assertEqual(sizes, {"8"})  # 72 of its pixels are an inch
        png = figure_bytes(chart, FileFormat("png", True, 89))
        self.assertEqual(int.from_bytes(png[16:20], "big"), int(89 / 25.4 * 300))  # letters scale with the width

    def test_letters_that_no_font_has_are_told_by_their_number(self):
        self.assertEqual(_chart.plain_for_matplotlib("a\U0010ffffb"), "a[U+10FFFF]b" if "\U0010ffff".isprintable() else "a b")
        self.assertEqual(_chart.plain_for_matplotlib("cost $5"), r"cost \$5")

    def test_the_same_tables_give_the_same_bytes(self):
        chart = charts(clca.run(SCENE, output="run"))[0]
        for kind in ("png", "svg", "pdf"):
            self.assertEqual(figure_bytes(chart, FileFormat(kind)), figure_bytes(chart, FileFormat(kind)))


class CommandTest(ScratchTest):
    def refused(self, code, message, *arguments, environment=None):
        result = subprocess.run([PROGRAM, "plot", *arguments], capture_output=True, text=True, env=os.environ | (environment or {}))
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertRegex(result.stderr, message)
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_it_writes_what_the_options_say(self):
        clca.run(SCENE, output="run")
        said = clca_program("plot", "run", "--y", "mean_height", "--y2", "moving_share", "--no-filling", "--x-range", "0:50",
                            "--y-range", ":60", "--running-mean", 3, "--width", "89mm", "--format", "PDF", "-o", "out")
        self.assertEqual(said, "out/mean_height.pdf\n")
        self.assertTrue(Path("out/mean_height.pdf").read_bytes().startswith(b"%PDF"))
        said = clca_program("plot", "run", "--only", "profile,motion").splitlines()
        self.assertEqual(said, ["run/plots/profile.png", "run/plots/motion.png"])
        self.assertIn("profile.png", Path("run/.clca.manifest").read_text())
        said = clca_program("plot", "run", "--from", 99999).splitlines()
        self.assertEqual(said[0], "run/plots/profile.png")
        self.assertRegex(said[1], "no rows in the stages and times that are chosen: .*motion")

    def test_mistakes_are_one_line(self):
        clca.run(SCENE, output="run")
        self.refused(2, "none/run.json: No such file", "none")
        clca.run(SCENE, output="renders/mine")
        self.refused(2, "mine/run.json: No such file or directory; did you mean .*/renders/mine.", "mine")
        self.refused(2, "no figure 'x'", "run", "--only", "x")
        self.refused(2, "--x-range.*two numbers", "run", "--x-range", "5")
        log = ["run", "--y", "mean_height", "--log", "y", "--y-range"]
        self.refused(2, "the limits of the logarithmic axis y are above 0", *log, "0:1")
        self.refused(2, "the limits of the logarithmic axis y are above 0", *log, ":-1")
        self.refused(1, "nowhere", "run", environment={"CLCA_PYTHON": str(self.folder / "nowhere")})
        fake = self.folder / "python3"
        fake.write_text("#!/bin/sh\nexec /usr/bin/python3 -S \"$@\"\n")  # without the packages of the system
        fake.chmod(0o755)
        self.refused(1, "no Python module numpy; install python3-numpy", "run", environment={"CLCA_PYTHON": str(fake)})
        fake.write_text("#!/bin/sh\nkill -9 $$\n")
        self.refused(1, "fails with exit code 137", "run", environment={"CLCA_PYTHON": str(fake)})
        (self.folder / "mine").mkdir()
        (self.folder / "mine/profile.png").write_text("mine")
        self.refused(1, "clca did not make the folder", "run", "--only", "profile", "-o", "mine")
        self.assertEqual((self.folder / "mine/profile.png").read_text(), "mine")

    def test_a_signal_ends_both(self):
        clca.run(SCENE, output="run")
        fake = self.folder / "python3"
        fake.write_text("#!/bin/sh\necho $$ > pid.new; mv pid.new " + str(self.folder / "pid") + "\nexec sleep 100\n")
        fake.chmod(0o755)
        with subprocess.Popen([PROGRAM, "plot", "run"], env=os.environ | {"CLCA_PYTHON": str(fake)}) as program:
            while not (self.folder / "pid").exists():
                time.sleep(0.01)
            program.send_signal(signal.SIGINT)
            self.assertEqual(program.wait(), 130)
        self.assertFalse(Path("/proc", (self.folder / "pid").read_text().strip(), "cmdline").exists())


class PlainTest(ScratchTest):
    def test_folders_are_read_without_the_compiled_module(self):
        run = clca.run(SCENE, output="run")
        clca.sweep(SCENE, seeds=[1], output="sweep")
        code = f"""
import sys
sys.modules["clca._clca"] = None
import clca
run = clca.open("run")
assert run.frames[-1].positions.shape == ({len(run.frames[-1].ids)}, 2)
assert run.measures["flow"]["repose_angle_deg"].unit == "degrees"
assert run.series.label("mean_height") == "Mean height of the particles (spacings)"
assert len(clca.open("sweep").runs) == 1
try:
    clca.run("heap")
except clca.Error as error:
    print(error)
"""
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertIn("clca.run needs the compiled part of clca", result.stdout, result.stderr)

    def test_frames_are_those_of_a_simulation(self):
        for scene, step in ((SCENE, 20), (CONTACT, 50)):
            run, simulation = clca.run(scene, output=f"run-{scene.get('model')}"), clca.Simulation(scene)
            for name in ("name", "species", "degrees"):
                self.assertEqual([getattr(kind, name) for kind in run.kinds], [getattr(kind, name) for kind in simulation.kinds])
            for mine, compiled in zip(run.kinds, simulation.kinds):
                self.assertEqual(sorted(map(tuple, mine.outline.round(9))), sorted(map(tuple, compiled.outline.round(9))))
            simulation.step(step)
            for name in ("positions", "velocities", "displacements", "ids", "kinds", "angular_velocities"):
                numpy.testing.assert_allclose(getattr(run.frames.at(step), name), getattr(simulation.frame, name), atol=1e-12)
            numpy.testing.assert_allclose(run.frames.at(step).particles["image"], simulation.frame.particles["image"])

    def test_folders_say_what_each_column_is(self):
        run = clca.run(CONTACT, output="run")
        for name in run.tables:
            table = run.table(name)
            self.assertEqual(set(table.units), set(table.dtype.names))
            said = json.loads((run.folder / "run.json").read_text())["tables"]
            self.assertTrue(any(name == kind or name.startswith(f"{kind}-") for kind in said), name)
            self.assertTrue(all(table.descriptions.values()), name)
        self.assertTrue(str(run.series).startswith("step, time, stage, particles, "))


if __name__ == "__main__":
    unittest.main()
