"""Calibration: hidden truths, what is refused, the command and the function."""

import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

import numpy
from support import PROGRAM, SCENE, ScratchTest, needs

for module in ("scipy", "sklearn", "yaml"):
    needs(module)

import clca
from clca._rounds import Surrogate, posterior, sobol_points
from clca._study import read_study

NOISE = (1.0, 0.05)
STUDY = {
    "vary": {"rules.inertia": [0, 0.9]},
    "tests": [{"scene": "scene.yaml", "targets": {"flow.runout_99": [12, 0.5]}}],
    "seeds": 2,
    "points": 8,
    "rounds": 1,
    "check": 2,
}


def measures(points):
    """As slope and run-out depend on friction and rolling friction."""
    return 20 + 15 * numpy.tanh(3 * points[:, 0]) + 4 * points[:, 1], 2 + numpy.exp(-2 * points[:, 1]) + 0.3 * points[:, 0]


class StatisticsTest(unittest.TestCase):
    def test_intervals_hold_hidden_truths(self):
        held, random = numpy.zeros(2, int), numpy.random.default_rng(1)
        points, seeds = sobol_points(2, 64, 1), 4
        for truth in random.uniform(0.1, 0.9, (12, 2)):
            surrogates = []
            for values, noise in zip(measures(points), NOISE):
                means = (values[:, None] + noise * random.normal(size=(64, seeds))).mean(1)
                surrogates.append(Surrogate(points, means, numpy.full(64, noise**2 / seeds)))
            errors = [noise / 8**0.5 for noise in NOISE]
            targets = [(value[0] + error * random.normal(), error) for value, error in zip(measures(truth[None]), errors)]
            found = posterior(surrogates, targets, 2)
            self.assertAlmostEqual(found.weights.sum(), 1)
            held += (found.quantile(0.025) <= truth) & (truth <= found.quantile(0.975))
        self.assertGreaterEqual(held.min(), 10)  # of 12: 95 %

    def test_a_parameter_that_changes_nothing_stays_open(self):
        points = sobol_points(2, 32, 1)
        surrogate = Surrogate(points, points[:, 0], numpy.full(32, 1e-4))
        found = posterior([surrogate], [(0.4, 0.02)], 2)
        width = found.quantile(0.975) - found.quantile(0.025)
        self.assertLess(width[0], 0.15)
        self.assertGreater(width[1], 0.9)


class CalibrateTest(ScratchTest):
    def setUp(self):
        super().setUp()
        with open("scene.yaml", "w") as file:
            json.dump(SCENE, file)

    def study(self, **changes):
        with open("study.yaml", "w") as file:
            json.dump(STUDY | changes, file)
        return subprocess.run([PROGRAM, "calibrate", "study.yaml", "-o", "found", "--quiet"], capture_output=True, text=True)

    def test_the_command_gives_what_the_function_gives_and_goes_on(self):
        told = self.study()
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("rules.inertia: ", told.stdout)
        here = clca.calibrate("scene.yaml", {"flow.runout_99": (12, 0.5)}, {"rules.inertia": (0, 0.9)}, seeds=2, points=8, rounds=1,
                              check=2, output="here")
        files = ("calibration.json", "parameters.csv", "targets.csv", "likely.csv", "calibration.png", "report.html")
        for name in files:
            self.assertEqual((self.folder / "found" / name).read_bytes(), (here.folder / name).read_bytes(), name)
        self.assertEqual(here.summary["runs"], 12 * 2 + 2)
        runs = clca.Sweep(here.folder / "runs/scene").runs
        self.assertEqual((len(runs), set(runs["seed"])), (24, {1, 2}))
        check = clca.Sweep(here.folder / "check/scene")
        self.assertEqual(set(check.runs["seed"]), {3, 4})
        self.assertEqual(check.runs["rules.inertia"][0], here.best["rules.inertia"])
        row = here.targets[0]
        self.assertAlmostEqual(row["checked"], check.runs["flow.runout_99"].mean())
        self.assertEqual((row["unit"], row["value"], row["standard_deviation"]), ("spacings", 12, 0.5))
        parameter = here.parameters[0]
        self.assertLessEqual(parameter["low"], parameter["mean"])
        self.assertLessEqual(parameter["mean"], parameter["high"])
        self.assertEqual(clca.Calibration("found").best, here.best)
        self.assertIn("rules.inertia: ", repr(here))
        with self.assertRaisesRegex(clca.Error, "here: it is the folder of a calibration; write elsewhere"):
            clca.sweep("scene.yaml", seeds=[1], output="here")
        # The same command again runs nothing.
        before = {file: file.stat().st_mtime_ns for file in (self.folder / "found/runs").rglob("run.json")}
        self.assertEqual(self.study().returncode, 0)
        self.assertEqual(before, {file: file.stat().st_mtime_ns for file in (self.folder / "found/runs").rglob("run.json")})

    def test_several_ranks_give_the_same(self):
        if shutil.which("mpirun") is None or not Path(PROGRAM).with_name("clca-mpi").exists():
            self.skipTest("no mpirun, or no clca-mpi")
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        self.study()
        command = [PROGRAM, "calibrate", "study.yaml", "--quiet", "--launcher"]
        told = subprocess.run([*command, "mpirun --oversubscribe -n 3", "-o", "ranks"], capture_output=True, text=True, env=os.environ | allowed)
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        for name in ("calibration.json", "parameters.csv", "targets.csv", "likely.csv"):
            self.assertEqual((self.folder / "ranks" / name).read_bytes(), (self.folder / "found" / name).read_bytes(), name)
        told = subprocess.run([*command, "nosuch -n 3"], capture_output=True, text=True)
        self.assertEqual(told.returncode, 2)
        self.assertIn("--launcher: no program 'nosuch' on the PATH", told.stderr)
        for launcher, what in (("false", "ended with exit code 1"), ("true", "has not run the sweep")):
            told = subprocess.run([*command, launcher, "-o", launcher], capture_output=True, text=True)
            self.assertEqual((told.returncode, told.stderr), (1, f"clca: error: '{launcher}' {what}\n"))

    def test_what_cannot_be_had_is_said(self):
        self.study(tests=[{"scene": "scene.yaml", "targets": {"flow.runout_99": [90, 0.5]}}])
        notes = clca.Calibration("found").notes
        self.assertIn("No values in these ranges give all targets", notes[0])
        self.study(tests=[{"scene": "scene.yaml", "targets": {"packing.packing_fraction": [0.8, 1]}}])
        self.assertIn("rules.inertia is not determined", clca.Calibration("found").notes[0])

    def test_a_measure_that_depends_on_no_parameter_is_told(self):
        targets = {"packing.packing_fraction": (0.8, 0.01), "flow.runout_99": (12, 0.5)}
        how = {"seeds": 2, "points": 8, "rounds": 0, "check": 2}
        scene = SCENE | {"stages": [SCENE["stages"][0], SCENE["stages"][1] | {"rules": {"inertia": 0.5}}]}
        vary = {"stages.flow.rules.inertia": (0, 0.9)}
        found = clca.calibrate(scene, targets, vary, output="found", **how)
        said = "scene: packing.packing_fraction does not depend on stages.flow.rules.inertia: it is the same at all points."
        self.assertIn(said, found.notes)
        self.assertNotIn("runout", "".join(note for note in found.notes if "depend" in note))
        alone = clca.calibrate(scene, {"flow.runout_99": (12, 0.5)}, vary, output="alone", **how)
        self.assertEqual(found.best, alone.best)
        for targets in ({"packing.packing_fraction": (0.8, 0.01)}, {"packing.steps": (9, 1), "flow.runout_99": (12, 0.5)}):
            with self.assertRaisesRegex(clca.Error, "^no target depends on title: the same in all runs"):
                clca.calibrate(scene, targets, {"title": (0.1, 0.9)}, output="title", **how)

    def test_a_wrong_study_is_one_line_with_its_place(self):
        for text, line in (
            ("vary: {a.b: [1, 0]}\ntests: []", "study.yaml:1:8: error: the range is empty: 1 to 0"),
            ("tests: []", "study.yaml:1:1: error: 'vary' is missing"),
            ("vary: {a.b: [0, 1]}\ntests:\n  - scene: x\n    goals: 1", "study.yaml:4:5: error: unknown key 'goals'"),
            ("vary: {a.b: [0, 1]}\ntests:\n  - scene: x\n    targets: {flow.x: [1, 0]}", "study.yaml:4:15: error: the standard"),
            ("vary: {a.b: [0, 1]\ntests: 3", "study.yaml:2:1: error: expected"),
            ("vary: &a {b: [0, 1]}\ntests: *a", "it has aliases"),
            ("vary: {a.b: [0, 1]}\ntests:\n  - scene: 3\n    targets: {flow.x: [1, 1]}", "study.yaml:3:5: error: expected the name"),
            ("- 1", "study.yaml:1:1: error: expected a map"),
            ("vary: {a.b: [0, 1], a.b: [0, 2]}", "study.yaml:1:21: error: 'a.b' stands twice"),
            ("vary: {a.b: [0, .nan]}\ntests: []", "study.yaml:1:8: error: expected the range"),
            ("vary: {a.b: [0.1, 1_0]}\ntests: []", "study.yaml:1:8: error: expected the range [LOWEST, HIGHEST], found '[0.1, 1_0]'"),
            ("vary: {a.b: [12 mm, 15 mm]}\ntests: []",
             "study.yaml:1:8: error: expected the range [LOWEST, HIGHEST], found '[12 mm, 15 mm]'; numbers stand without a unit"),
            ("vary: {a.b: [0, 1]}\ntests: [{scene: x, set: [1], targets: {flow.x: [1, 1]}}]", "study.yaml:2:20: error: expected a map of keys"),
            ("vary: {a.b: [no, yes]}\ntests: []", "study.yaml:1:8: error: expected the range"),
            ("vary: {a.b: [false, true]}\ntests: []", "study.yaml:1:8: error: expected the range"),
            (f"vary: {{a.b: [0, 1{400 * '0'}]}}\ntests: []", "study.yaml:1:8: error: expected the range"),
            ("vary: {a.b: [1e-1, .5e0]}\ntests: []", "study.yaml:2:1: error: expected a list of tests"),
            ("vary: {a.b: !!binary [0, 1]}", "study.yaml:1:13: error: tags ('!') are not part of the format"),
            ("vary: {a.b: [0, 1]}\ntests: [{scene: x, targets: {a.b: [1, 1]}}]\nseeds: 1",
             "study.yaml:3:1: error: expected a whole number from 2 to 1000, found '1'"),
            ("\0", "it is no YAML"),
        ):
            with open("study.yaml", "w") as file:
                file.write(text)
            told = subprocess.run([PROGRAM, "calibrate", "study.yaml"], capture_output=True, text=True)
            self.assertEqual(told.returncode, 2, told.stderr)
            self.assertIn(line, told.stderr)
            self.assertEqual(told.stderr.startswith("study.yaml:"), line.startswith("study.yaml:"), told.stderr)
            self.assertEqual(told.stderr.count("\n"), 1)
        self.assertFalse((self.folder / "renders").exists())

    def test_a_study_is_read_as_a_scene_is(self):
        with open("study.yaml", "w") as file:
            file.write("vary: {rules.inertia: [1e-1, 9.e-1]}\ntests:\n- scene: scene.yaml\n  targets: {flow.x: [-1, .5]}\n"
                       "  set: {title: 2020-01-01, a: 1_0, b: yes, c: 0x10, d: '12', e: 12, f: true, g: ~, h: [1:30, 12.]}")
        study = read_study(Path("study.yaml"))
        self.assertEqual(study.vary, {"rules.inertia": (0.1, 0.9)})
        self.assertEqual(study.tests[0].targets, {"flow.x": (-1, 0.5)})
        expected = {"title": "2020-01-01", "a": "1_0", "b": "yes", "c": "0x10", "d": "12", "e": 12, "f": True, "g": None}
        self.assertEqual(study.tests[0].set, {"output": {}} | expected | {"h": ["1:30", 12]})

    def test_a_message_names_its_place_once(self):
        for changed, message in (
            ({"scene": None, "tests": 5}, "tests: expected a list of tests"),
            ({"seeds": 1}, "seeds: expected a whole number from 2 to 1000, found '1'"),
            ({"points": 9}, "points: expected a power of two, found 9"),
            ({"vary": {"rules.inertia": (1, 10**400)}}, "vary.rules.inertia: expected the range [LOWEST, HIGHEST], found '[1, 1"),
            ({"vary": numpy.array([1, 2])}, "vary: expected a map of keys and values, found '[1 2]'"),
            ({"targets": numpy.array([1, 2])}, "targets: expected a map of keys and values, found '[1 2]'"),
            ({"set": numpy.array([1, 2])}, "set: expected a map of keys and values, found '[1 2]'"),
            ({"tests": numpy.array([1, 2]), "scene": None}, "tests: expected a list of tests"),
        ):
            with self.assertRaises(clca.Error) as caught:
                clca.calibrate(**{"scene": "scene.yaml", "targets": {"flow.runout_99": (12, 1)}, "vary": {"rules.inertia": (0, 0.9)}}
                               | changed)
            self.assertTrue(str(caught.exception).startswith(message), caught.exception)

    def test_scenes_are_checked_before_anything_runs(self):
        told = self.study(vary={"rules.inertia": [0.1, 1.9]})
        self.assertRegex(told.stderr, "^study.yaml:1:[0-9]+: error: --vary rules.inertia=1.9: error: .* from 0 to 1.*\n$")
        with self.assertRaisesRegex(clca.Error, "rules.inertia=1.9: error: .* from 0 to 1"):
            clca.calibrate("scene.yaml", {"flow.runout_99": (12, 1)}, {"rules.inertia": (0.1, 1.9)}, output="found")
        self.assertFalse((self.folder / "found").exists())
        told = self.study(vary={"rules.nosuch": [0, 1]})
        self.assertEqual(told.returncode, 2)
        self.assertIn("unknown key 'nosuch'", told.stderr)
        told = self.study(tests=[{"scene": "scene.yaml", "targets": {"flow.nosuch": [1, 1]}}])
        self.assertEqual(told.returncode, 2)
        self.assertIn("no measure 'flow.nosuch'; there are packing.steps", told.stderr)
        self.assertEqual(len(list((self.folder / "found/runs/scene/runs").iterdir())), 1)
        told = self.study(tests=[STUDY["tests"][0], {"scene": "scene.yam", "targets": {"flow.runout_99": [1, 1]}}])
        self.assertIn("scene.yam:1:1: error: cannot read the file", told.stderr)
        self.assertEqual(len(list((self.folder / "found/runs/scene/runs").iterdir())), 1)
        told = self.study(tests=[{"scene": "scene.yaml", "targets": {"flow.runout_9": [1, 1]}}])
        self.assertIn("; did you mean 'flow.runout_99'?", told.stderr)
        with self.assertRaisesRegex(clca.Error, "vary: expected a map"):
            clca.calibrate("scene.yaml", {"flow.runout_99": (12, 1)})
        with self.assertRaisesRegex(clca.Error, "either a scene with targets, or tests"):
            clca.calibrate()

    def test_files_of_others_stay(self):
        (self.folder / "found").mkdir()
        (self.folder / "found/parameters.csv").write_text("mine")
        told = self.study()
        self.assertNotEqual(told.returncode, 0)
        with self.assertRaisesRegex(clca.Error, "clca did not make the folder"):
            clca.calibrate("scene.yaml", {"flow.runout_99": (12, 1)}, {"rules.inertia": (0, 0.9)}, output="found")
        self.assertEqual((self.folder / "found/parameters.csv").read_text(), "mine")
        clca.run("scene.yaml", output="run")
        with self.assertRaisesRegex(clca.Error, "run: it is the folder of a run; write elsewhere"):
            clca.calibrate("scene.yaml", {"flow.runout_99": (12, 1)}, {"rules.inertia": (0, 0.9)}, output="run")


if __name__ == "__main__":
    unittest.main()
