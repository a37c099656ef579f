"""Many runs, and gases."""

import json
import subprocess
import unittest
import warnings

import clca
import numpy
from clca import _figures
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest, needs


class SweepTest(ScratchTest):
    def test_a_sweep_is_that_of_the_command_line(self):
        with open("scene.yaml", "w") as file:
            json.dump(SCENE, file)
        subprocess.run([PROGRAM, "sweep", "scene.yaml", "--seeds", "1..2", "--vary", "rules.inertia=0,0.9", "--vary",
                        "box.width,rules.ties=40,particle; 44,direction", "--set", "output.series.every=2", "-o", "there",
                        "--quiet"], check=True)
        here = clca.sweep("scene.yaml", seeds=range(1, 3), output="here", set={"output.series.every": 2},
                          vary={"rules.inertia": [0, 0.9], ("box.width", "rules.ties"): [(40, "particle"), (44, "direction")]})
        for name in ("runs.csv", "measures.csv"):
            self.assertEqual((here.folder / name).read_bytes(), (self.folder / "there" / name).read_bytes())
        self.assertEqual(here.keys, ["rules.inertia", "box.width", "rules.ties"])
        self.assertEqual((len(here), len(here.runs)), (8, 8))
        # Each run of the sweep is that of a row.
        for run, row in zip(here, here.runs):
            self.assertEqual((run.seed, run.state_hash), (row["seed"], row["state_hash"]))
            numpy.testing.assert_equal(float(run.measures["flow"]["runout_99"]), row["flow.runout_99"])
        self.assertEqual(here.runs.units["flow.runout_99"], "spacings")
        self.assertEqual(here.runs["rules.ties"].tolist(), 2 * ["particle", "particle", "direction", "direction"])

    def test_measures_are_means_over_the_seeds(self):
        sweep = clca.sweep(SCENE, seeds=[3, 1, 2], vary={"rules.inertia": [0, 0.9]})
        self.assertEqual(sweep.folder, self.folder / "renders/scene-sweep")
        table = sweep.measures
        row = table[(table["stage"] == "flow") & (table["measure"] == "runout_99") & (table["rules.inertia"] == 0.9)]
        values = sweep.runs["flow.runout_99"][sweep.runs["rules.inertia"] == 0.9]
        self.assertEqual(row["runs"].tolist(), [3])
        self.assertAlmostEqual(row["mean"][0], values.mean())
        self.assertAlmostEqual(row["standard_error"][0], values.std(ddof=1) / 3**0.5)

    def test_series_are_averaged_over_the_seeds(self):
        sweep = clca.sweep(SCENE, seeds=range(1, 4), vary={"rules.inertia": [0, 0.9]}, output="sweep")
        series = sweep.series("flow", "mean_height")
        self.assertEqual(series.dtype.names, ("rules.inertia", "step", "mean", "standard_error", "runs"))
        self.assertEqual(series.units["mean"], "spacings")
        part = series[series["rules.inertia"] == 0.9]
        runs = [run.series for run, row in zip(sweep, sweep.runs) if row["rules.inertia"] == 0.9]
        heights = [run["mean_height"][run["stage"] == "flow"] for run in runs]
        shortest = min(map(len, heights))
        self.assertEqual(part["step"].tolist(), list(range(int(part["step"][0]), int(part["step"][0]) + shortest)))
        cells = numpy.array([height[:shortest] for height in heights])
        numpy.testing.assert_allclose(part["mean"], cells.mean(0))
        numpy.testing.assert_allclose(part["standard_error"], cells.std(0, ddof=1) / 3**0.5)
        self.assertEqual(set(part["runs"]), {3})
        table = sweep.table("mean-series")
        own = table[(table["stage"] == "flow") & (table["rules.inertia"] == 0.9)]
        self.assertEqual(own["mean_height_se"].tolist(), part["standard_error"].tolist())
        sparse = clca.sweep(SCENE, seeds=range(1, 4), set={"output.series.every": 4}, output="sparse").series("flow", "mean_height")
        self.assertEqual(sparse["step"].tolist()[:2], [4, 8])
        alone = clca.sweep(SCENE, seeds=[1], output="alone").series("flow", "mean_height")
        self.assertTrue(numpy.isnan(alone["standard_error"]).all())

    def test_measures_that_a_side_of_the_box_holds_are_noted(self):
        narrow = {"box": {"width": 22, "height": 40}}
        sweep = clca.sweep(SCENE | narrow, seeds=[1, 2, 3], vary={"rules.inertia": [0.9]}, output="narrow")
        value = sweep.runs["flow.runout_front"][0]
        self.assertEqual(set(sweep.runs["flow.runout_front"]), {value})
        note = f"flow.runout_front, rules.inertia=0.9: {value:.6g} spacings for all 3 seeds, since grains have come to the right side of the box"
        self.assertIn(note, sweep.notes)
        self.assertIn(note.partition("=")[2], sweep.report().read_text())
        self.assertIn(note, sweep._repr_html_())
        self.assertEqual(clca.sweep(SCENE, seeds=[1, 2, 3], output="wide").notes, [], "only the wall holds what is packed")

    def test_units_are_those_of_the_runs(self):
        sweep = clca.sweep(CONTACT, seeds=[1, 2], set={"output.fields": {"every": 20}}, output="sweep")
        self.assertEqual(sweep.runs.units["flow.fluctuation_energy"], "(m/s)²")

    def test_models_with_and_without_a_time_are_drawn_over_steps(self):
        scene = SCENE | {"species": {"grain": {"shape": {"hexagon": 1}}}}
        counts = {"stages.packing.fill.counts": {"grain": 40}}
        sweep = clca.sweep(scene, seeds=[1, 2], vary={"model": ["automaton", "contact"]}, set=counts, output="sweep")
        self.assertEqual(sweep.runs.units["flow.time"], "√(spacing/gravity)")
        charts = _figures.charts(sweep, _figures.FigureChoice(y=["mean_height"]))
        means = next(chart for chart in charts if chart.name == "mean-series-flow-mean_height")
        (panel,) = means.panels()
        self.assertEqual([curve.label for curve in panel.curves], ["model=automaton", "model=contact"])
        self.assertEqual(panel.x.label, "Step, since the stage began")
        with self.assertRaisesRegex(clca.Error, "figures of a sweep have no second axis"):
            _figures.charts(sweep, _figures.FigureChoice(y2="mean_height"))

    def test_columns_of_its_tables_are_described_as_such(self):
        sweep = clca.sweep(SCENE, seeds=[1, 2], output="sweep")
        self.assertEqual(sweep.measures.descriptions["low"], "Lower end: of the interval of one standard error")
        self.assertEqual(sweep.runs.descriptions["steps"], "Steps: of the whole run")
        self.assertEqual(sweep.table("mean-series").descriptions["step"], "Step: since the stage began")

    def test_mistakes_are_named(self):
        with self.assertRaisesRegex(clca.Error, "--vary rules.inertia=.*error: rules.inertia: expected a number"):
            clca.sweep(SCENE, vary={"rules.inertia": [0, 7]})
        with self.assertRaisesRegex(clca.Error, "seeds"):
            clca.sweep(SCENE, vary={"seed": [1, 2]})
        for wrong in ({"seeds": []}, {"seeds": [1, 1]}, {"vary": {"rules.inertia": []}},
                      {"vary": {"rules.inertia": [0.5, "=1/2"]}}, {"vary": {("box.width", "box.height"): [(40,)]}}):
            with self.assertRaises(clca.Error):
                clca.sweep(SCENE, **wrong)

    def test_names_under_let_may_be_those_of_columns(self):
        scene = SCENE | {"let": {"wall": 1, "steps": 1}}
        sweep = clca.sweep(scene, seeds=[1], vary={"wall": [1, 2, 10], "let.steps": [3, 40]}, output="sweep")
        self.assertEqual(sweep.runs["wall"].tolist(), [1, 1, 2, 2, 10, 10])
        self.assertEqual(sweep.measures["let.steps"].tolist()[0], 3)
        with self.assertRaisesRegex(clca.Error, "a column 'steps' of their own; .* as let.steps$"):
            clca.sweep(scene, seeds=[1], vary={"steps": [3, 40]}, output="refused")

    def test_a_folder_of_another_kind_is_named(self):
        clca.sweep(SCENE, seeds=[1], output="sweep")
        for read, said in ((lambda: clca.Sweep("sweep/runs/seed=1"), "sweep.json.* is the folder of a run$"),
                           (lambda: clca.Run("sweep"), "run.json.* is the folder of a sweep$"),
                           (lambda: clca.Sweep("."), "is not the folder of a sweep$")):
            with self.assertRaisesRegex(clca.Error, said):
                read()
        (self.folder / "sweep/sweep.json").unlink()
        with self.assertRaisesRegex(clca.Error, "not the folder of a run; clca sweep --collect makes tables of the runs in it$"):
            clca.open("sweep")

    def test_a_cell_that_is_no_number_is_told_with_its_line(self):
        needs("matplotlib")
        clca.sweep(SCENE, seeds=[1, 2, 3], output="sweep", vary={"rules.inertia": [0.1, 0.5]})
        for table, column in (("measures", "mean"), ("measures", "high"), ("mean-series", "step"), ("mean-series", "moving_se")):
            file = self.folder / "sweep" / f"{table}.csv"
            good = file.read_text()
            names, row, *others = good.splitlines()
            cells = row.split(",")
            cells[names.split(",").index(column)] = "x"
            file.write_text("\n".join([names, ",".join(cells), *others]))
            sweep = clca.open("sweep")
            for call in (sweep.plot, lambda: sweep.notes) if column == "mean" else (sweep.plot,):
                with self.assertRaisesRegex(clca.Error, f"{table}.csv: line 2: 'x' in column '{column}' is no number"):
                    call()
            with self.assertRaisesRegex(clca.Error, "is no number"):
                sweep.plot(y=["flow.runout_99"])
            file.write_text(good)

    def test_runs_that_fail_are_warnings(self):
        # Too many to fit.
        vary = {"stages.packing.fill.counts.grain": [20, 100]}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            sweep = clca.sweep(SCENE, seeds=[1], vary=vary, output="sweep")
        self.assertEqual(sweep.runs["status"].tolist(), ["done", "failed"])
        self.assertIn("does not fit", sweep.runs["error"][1])
        self.assertTrue(any("does not fit" in str(one.message) for one in caught))


class GasTest(ScratchTest):
    def test_a_gas_is_that_of_a_run(self):
        run = clca.run(GAS, set={"boltzmann.friction": 0.3}, output="run")
        gas = clca.Gas(GAS, set={"boltzmann.friction": 0.3})
        first = gas.moments["translational"]
        for row in run.series:
            gas.advance(row["time"])
            self.assertEqual((gas.time, gas.collisions), (row["time"], row["collisions"]))
            self.assertEqual(gas.moments["translational"] / first, row["t_tr"])
        self.assertGreater(len(run.series), 2)

    def test_its_motions_are_arrays_without_copies(self):
        gas = clca.Gas(GAS, threads=1)
        gas.advance(1)
        velocities, spins = gas.velocities, gas.spins
        self.assertEqual((velocities.shape, spins.shape), ((1000, 3), (1000, 3)))
        self.assertEqual(velocities.__array_interface__["data"], gas.velocities.__array_interface__["data"])
        self.assertFalse(velocities.flags.writeable)
        self.assertAlmostEqual((velocities**2).sum(1).mean() / 3, gas.moments["translational"])
        before = velocities.copy()
        hash_before = gas.state_hash
        gas.advance(2)
        self.assertNotEqual(gas.state_hash, hash_before)
        numpy.testing.assert_array_equal(velocities, before)
        self.assertFalse(numpy.array_equal(gas.velocities, before))
        # What is held changes no bits, nor do threads.
        other = clca.Gas(GAS, threads=2)
        other.advance(1)
        other.advance(2)
        self.assertEqual(other.state_hash, gas.state_hash)

    def test_grains_are_no_gas(self):
        with self.assertRaisesRegex(clca.Error, "expected a scene of a gas"):
            clca.Gas(SCENE)
        gas = clca.Gas(GAS)
        with self.assertRaises(clca.Error):
            gas.advance(numpy.inf)
        gas.advance(0.1)


if __name__ == "__main__":
    unittest.main()
