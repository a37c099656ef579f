"""Runs by Python: the bits and messages of the command line, and what the folder holds."""

import contextlib
import io
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import clca
import numpy
from clca._table import Quantity, read_table
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest, clca_program, needs


class RunTest(ScratchTest):
    def test_a_run_has_the_bits_of_the_command_line(self):
        for number, (scene, key) in enumerate([(SCENE, "rules.inertia"), (CONTACT, "contact.friction")]):
            with open(f"scene{number}.yaml", "w") as file:
                json.dump(scene, file)
            clca_program("run", f"scene{number}.yaml", "--seed", 5, "--set", f"{key}=0.25", "-o", f"there{number}")
            here = clca.run(f"scene{number}.yaml", seed=5, set={key: 0.25}, output=f"here{number}")
            there = clca.open(f"there{number}")
            self.assertEqual(here.state_hash, there.state_hash)
            self.assertEqual((here.seed, here.status), (5, "done"))
            for name in ("series.csv", "scene.yaml"):
                self.assertEqual((here.folder / name).read_text(), (there.folder / name).read_text())

    def test_a_scene_of_a_dictionary_is_that_of_the_file(self):
        with open("scene.yaml", "w") as file:
            json.dump(SCENE, file)
        self.assertEqual(clca.Scene(SCENE).to_yaml(), clca.Scene("scene.yaml").to_yaml())
        scene = clca.Scene(SCENE, seed=9, set={"rules.inertia": numpy.float64(0.5), "output.series": None})
        self.assertIn("seed: 9", scene.to_yaml())
        run = clca.run(scene, set={"rules.inertia": 0.75})
        self.assertEqual((run.seed, run.folder), (9, self.folder / "renders/scene"))
        self.assertIn("inertia: 0.75", (run.folder / "scene.yaml").read_text())
        with self.assertRaisesRegex(clca.Error, "scene.seed: expected what a scene can have"):
            clca.Scene(SCENE | {"seed": object()})

    def test_measures_may_be_derived_from_others(self):
        scene = SCENE | {"measure": {"ratio": {"value": "=runout_99 / 20", "unit": "m", "about": "Reach"}}}
        flow = clca.run(scene).measures["flow"]
        self.assertEqual(float(flow["ratio"]), float(flow["runout_99"]) / 20)
        self.assertEqual((flow["ratio"].unit, flow["ratio"].name), ("m", "Reach"))
        simulation = clca.Simulation(scene)
        while not simulation.over:
            simulation.step(100)
        self.assertEqual(simulation.measures["ratio"].name, "Reach")
        means = clca.sweep(scene, seeds=[1, 2]).measures
        self.assertEqual(means["mean"][(means["measure"] == "ratio") & (means["stage"] == "flow")].size, 1)

    def test_scenes_that_come_with_clca_go_by_name(self):
        self.assertEqual(clca.Scene("wall-removal").name, "wall-removal")
        with self.assertRaisesRegex(clca.Error, "did you mean 'wall-removal'"):
            clca.Scene("wall-removl")

    def test_errors_have_a_place(self):
        with open("bad.yaml", "w") as file:
            file.write("clca: 1\nbox: {width: 10,\n      height: -3}\n")
        with self.assertRaises(clca.Error) as caught:
            clca.run("bad.yaml")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), ("bad.yaml", 3, 15))
        self.assertTrue(error.message.startswith("box.height: expected"), error.message)
        self.assertEqual(str(error), f"bad.yaml:3:15: error: {error.message}")
        said = subprocess.run([PROGRAM, "check", "bad.yaml"], capture_output=True, text=True).stderr
        self.assertIn(str(error), said)
        with self.assertRaises(clca.Error) as caught:
            clca.Scene(SCENE, set={"rules.inertia": 7})
        self.assertIsNone(caught.exception.line)
        for wrong in (lambda: clca.open("nowhere"), lambda: clca.resume("nowhere")):
            self.assertRaises(clca.Error, wrong)

    def test_a_run_does_not_replace_its_scene(self):
        clca.run(SCENE, output="run")
        with self.assertRaisesRegex(clca.Error, "would replace this file"):
            clca.run("run/scene.yaml", output="run")
        self.assertEqual(clca.run("run/scene.yaml", output="run", keep=True).folder.name, "run-2")

    def test_a_run_that_is_done_needs_no_resuming(self):
        run = clca.run(SCENE, output="run")
        files = {file: file.read_bytes() for file in run.folder.rglob("*") if file.is_file()}
        again = clca.resume("run")
        self.assertEqual((again.folder, again.status, again.state_hash), (run.folder, "done", run.state_hash))
        self.assertEqual(files, {file: file.read_bytes() for file in run.folder.rglob("*") if file.is_file()})

    def test_measures_know_their_units(self):
        run = clca.run(SCENE, output="run")
        said = json.loads((run.folder / "run.json").read_text())
        self.assertEqual(list(run.measures), ["packing", "flow"])
        for stage, there in zip(run.measures.values(), said["stages"]):
            for name, value in stage.items():
                expected = there["measures"][name]
                numpy.testing.assert_equal(float(value), numpy.nan if expected is None else expected)
        slope = run.measures["flow"]["repose_angle_deg"]
        self.assertEqual((slope.name, slope.unit), ("Slope", "degrees"))
        self.assertRegex(repr(slope), r"^\d+\.?\d* degrees$")
        self.assertEqual(f"{slope:.3f}", f"{float(slope):.3f}")
        self.assertEqual(pickle.loads(pickle.dumps(slope)).unit, "degrees")
        self.assertEqual(run.stages["flow"].ended, "settled")

    def test_tables_are_structured_arrays(self):
        run = clca.run(SCENE, output="run")
        self.assertEqual(run.tables, ["profile-flow", "profile-packing", "series"])
        series = run.series
        with open(run.folder / "series.csv") as file:
            lines = [line.rstrip("\n").split(",") for line in file]
        self.assertEqual(list(series.dtype.names), lines[0])
        self.assertEqual(len(series), len(lines) - 1)
        self.assertEqual((series["step"].dtype, series["mean_height"].dtype), (numpy.int64, numpy.float64))
        self.assertEqual(series["step"].tolist(), [int(line[0]) for line in lines[1:]])
        self.assertEqual(series["stage"][-1], "flow")
        self.assertEqual((series.units["mean_height"], series.units["step"]), ("spacings", ""))
        self.assertEqual(series.descriptions["mean_height"], "Mean height of the particles: of their centres, weighted by sites")
        self.assertEqual(series[series["stage"] == "flow"].units["mean_height"], "spacings")
        self.assertIs(type(series["step"]), numpy.ndarray)
        with self.assertRaisesRegex(clca.Error, "no table 'no-such'; there are profile-flow"):
            run.table("no-such")

    def test_names_that_are_not_there_are_answered_with_those_that_are(self):
        run = clca.run(SCENE, output="run")
        with self.assertRaisesRegex(KeyError, "no stage 'flwo'; there are packing, flow"):
            run.measures["flwo"]
        with self.assertRaisesRegex(KeyError, "no measure 'runout'; there are .*runout_99"):
            run.measures["flow"]["runout"]
        with self.assertRaisesRegex(IndexError, "no frame 1000; there are"):
            run.frames[1000]

    def test_tables_are_data_frames_too(self):
        needs("pandas")
        series = clca.run(SCENE, output="run").series
        frame = series.to_pandas()
        self.assertEqual(list(frame.columns), list(series.dtype.names))
        self.assertEqual(frame["mean_height"].tolist(), series["mean_height"].tolist())

    def test_counts_are_whole_numbers(self):
        with open("run.csv", "w") as file:
            file.write("count,height,share,gap\n3,2,1,1\n4,3,0.5,\n")
        columns = {"height": Quantity("Height", "spacings"), "count": Quantity("Count", "particles")}
        table = read_table(self.folder / "run.csv", columns)
        self.assertEqual([table[name].dtype.kind for name in table.names], ["i", "f", "f", "f"])
        self.assertEqual(repr(table["count"].tolist()), "[3, 4]")
        self.assertEqual(repr(clca.Value(12_345_678, "Discharged", "particles")), "12345678 particles")

    def test_names_that_look_like_numbers_stay_names(self):
        scene = SCENE | {"stages": [SCENE["stages"][0] | {"name": "1"}]}
        self.assertEqual(set(clca.run(scene, output="run").series["stage"]), {"1"})

    def test_units_are_those_of_the_run(self):
        run = clca.run(CONTACT, output="run")
        self.assertEqual(run.series.units["time"], "s")
        self.assertEqual(run.frames[0].units, {"time": "s", "velocity": "m/s"})
        times = {row["step"]: row["time"] for row in run.series}
        self.assertAlmostEqual(run.frames[-1].time, times[run.frames[-1].step], delta=1e-12)

    def test_a_gas_runs_too(self):
        run = clca.run(GAS, output="gas")
        self.assertEqual(run.kind, "boltzmann")
        self.assertEqual(run.series["time"][-1], 2)
        with self.assertRaises(clca.Error):
            run.frames

    def test_warnings_are_those_of_python(self):
        scene = SCENE | {"stages": [SCENE["stages"][0] | {"max_steps": 2}]}  # is still moving then
        said = subprocess.run([PROGRAM, "run", "-", "-o", "there"], input=json.dumps(scene), capture_output=True,
                              text=True).stderr
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            clca.run(scene, output="here")
        self.assertEqual([f"warning: {one.message}" for one in caught],
                         [line for line in said.splitlines() if line.startswith("warning: ")])
        self.assertTrue(caught, "the scene gives no warning")


class NotebookTest(ScratchTest):
    def test_tables_show_themselves(self):
        series = clca.run(SCENE | {"title": "<b>"}, output="run").series
        html = series._repr_html_()
        self.assertIn("<th>Mean height of the particles (spacings)</th>", html)
        self.assertIn(f"<td>packing</td><td>{series['particles'][0]}</td>", html)
        self.assertIn(f"<p>{len(series)} rows</p>", html)
        self.assertEqual(html.count("<tr>"), 42, "head, 20 first rows, dots and 20 last ones")
        self.assertEqual(series[:3]._repr_html_().count("<tr>"), 4)

    def test_runs_and_sweeps_show_their_measures(self):
        run = clca.run(SCENE, output="run")
        self.assertIn('<td data-of="flow">{:.3f}</td>'.format(run.measures["flow"]["runout_99"]), run._repr_html_())
        sweep = clca.sweep(SCENE, seeds=[1, 2], vary={"rules.inertia": [0, 0.9]}, output="sweep")
        self.assertIn("<h4>flow</h4>", sweep._repr_html_())
        self.assertIn("inertia=<wbr>0.9", sweep._repr_html_())

    def test_a_movie_of_a_stage_is_a_path_that_shows_itself(self):
        run = clca.run(SCENE, output="run")
        movie = run.movie("a.png", stage="flow", every=1000, width=64)
        self.assertEqual(movie, self.folder / "a.png")
        self.assertEqual(movie.read_bytes().count(b"fcTL"), 2, "its beginning and its end")
        self.assertIn('<img src="data:image/png;base64,iVBOR', movie._repr_html_())
        with self.assertRaisesRegex(clca.Error, "no stage 'flwo'; did you mean 'flow'?"):
            run.movie("a.png", stage="flwo")
        said = subprocess.run([PROGRAM, "render", "run", "--stage", "flow", "--from", "0", "--to", "0"], capture_output=True, text=True)
        self.assertEqual(said.returncode, 2)
        self.assertIn("stage 'flow' has no picture in that range", said.stderr)

    def test_runs_and_sweeps_tell_how_far_they_are(self):
        endless, told = {"stages.packing.until": {"steps": 10**6}}, []

        def hear(progress):
            told.append(progress)
            if len(told) == 3:
                raise LookupError

        with self.assertRaises(LookupError):
            clca.run(CONTACT, set=endless, output="run", progress=hear)
        self.assertEqual(clca.open("run").status, "interrupted")
        self.assertEqual((told[0].stage, told[0].total), ("packing", None))
        self.assertEqual([one.done for one in told], sorted(one.done for one in told))
        told.clear()
        clca.sweep(SCENE, seeds=[1, 2, 3], output="sweep", progress=told.append)
        self.assertEqual((told[-1].done, told[-1].total), (3, 3))
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            clca.sweep(SCENE, seeds=[1, 2, 3], output="again", progress=True)
        self.assertTrue(shown.getvalue().startswith("\r["))
        self.assertRegex(shown.getvalue(), r"\] 3 of 3[^\r\n]*\n$")


class FramesTest(ScratchTest):
    def test_frames_have_each_step_once(self):
        run = clca.run(SCENE, output="run")
        self.assertTrue(numpy.all(numpy.diff(run.frames.steps.astype(int)) > 0))
        self.assertEqual(run.frames[-1].step, run.steps)
        self.assertEqual(len(run.frames), len(list(run.frames)))
        last = run.stages["packing"].steps
        self.assertEqual(run.frames.at(last).stage, "packing")
        self.assertRaises(KeyError, run.frames.at, last + 10**6)
        self.assertRaises(IndexError, run.frames.__getitem__, len(run.frames))
        self.assertEqual([frame.step for frame in run.frames[:3]], [0, 5, 10])

    def test_frames_are_what_the_file_has(self):
        import h5py

        turning = 0
        for scene in (SCENE, CONTACT):
            run = clca.run(scene, output=f"run-{scene.get('model')}")
            with h5py.File(run.folder / "trajectory.h5") as file:
                steps = file["frames/step"][:]
                for frame in run.frames:
                    place = int(numpy.flatnonzero(steps == frame.step)[0])
                    first = int(file["frames/first"][place])
                    rows = slice(first, first + int(file["frames/particles"][place]))
                    species = numpy.array([name.decode() for name in file["scene/species"]])
                    numpy.testing.assert_array_equal(frame.ids, file["particles/id"][rows])
                    numpy.testing.assert_array_equal(frame.positions, file["particles/position"][rows])
                    numpy.testing.assert_array_equal(frame.species, species[file["particles/species"][rows]])
                    there = {"gate"} if file["walls/present"][place][0] else set()
                    self.assertEqual(set(frame.walls), there)
                    if "velocity" in file["particles"]:
                        to_metres = 0.001 * frame.step / frame.time if frame.step else 0
                        numpy.testing.assert_allclose(
                            frame.velocities, to_metres * file["particles/velocity"][rows], rtol=1e-12)
                        seven = numpy.sqrt(7 * numpy.sqrt(3) / (2 * numpy.pi))  # radius of a disc of seven sites
                        turns = file["particles/spin"][rows] / seven * (frame.step / frame.time if frame.step else 0)
                        numpy.testing.assert_allclose(frame.angular_velocities, turns, rtol=1e-12)
                        turning += numpy.count_nonzero(frame.angular_velocities)
                    if "contacts" in file:
                        first = int(file["frames/first_contact"][place])
                        rows = slice(first, first + int(file["frames/contacts"][place]))
                        contacts = run.contacts(frame.step)
                        for name in ("upper", "other", "normal", "branch", "force"):
                            numpy.testing.assert_array_equal(contacts[name], file["contacts"][name][rows])
                        numpy.testing.assert_array_equal(contacts["place"], file["contacts/place"][rows])
            self.assertGreater(len(run.frames), 3)
        self.assertGreater(turning, 0)

    def test_shapes_have_names_and_outlines(self):
        run = clca.run(SCENE, output="run")
        self.assertEqual([kind.name for kind in run.kinds], ["grain", "rod@0", "rod@60", "rod@120"])
        frame = run.frames[-1]
        self.assertEqual(set(frame.orientation[frame.species == "rod"]), {0, 60, 120})
        for kind, outline, place in zip(frame.kinds, frame.outlines, frame.positions):
            x, y = outline.T
            area = 0.5 * numpy.sum(x * numpy.roll(y, -1) - numpy.roll(x, -1) * y)
            self.assertGreater(area, 0, "corners go anticlockwise")
            self.assertTrue(numpy.all(outline.min(0) < place) and numpy.all(outline.max(0) > place))
        self.assertEqual(run.walls["gate"].shape[1], 2)
        self.assertTrue(numpy.all((run.walls["gate"][:, 0] >= 19.5) & (run.walls["gate"][:, 0] <= 21.5)))

    def test_contacts_name_walls_and_sides(self):
        run = clca.run(CONTACT, output="run")
        frame = run.frames.at(run.stages["packing"].steps)
        names = frame.contact_names
        other = frame.contacts["other"]
        self.assertEqual(set(names[other >= 0]), {""})
        self.assertEqual(set(names[other == -2]), {"gate"})
        self.assertEqual(set(names[other == -2**31]), {"box.floor"})
        # The floor carries the grains, up to what still moves.
        weight = frame.contacts["force"][names == "box.floor", 0].sum()
        self.assertAlmostEqual(weight, len(frame.ids), delta=0.25 * len(frame.ids))

    def test_arrays_cannot_be_written_and_outlive_the_run(self):
        positions = clca.run(SCENE, output="run").frames[0].positions
        expected = positions.copy()
        with self.assertRaises(ValueError):
            positions[0, 0] = 1
        numpy.testing.assert_array_equal(positions, expected)

    def test_frames_are_read_when_they_are_asked_for(self):
        run = clca.run(SCENE, output="run")
        frames = run.frames
        for part in (run.folder / "trajectory").glob("part-*"):
            part.unlink()
        frame = frames[0]
        self.assertEqual(frame.step, 0)
        with self.assertRaises(clca.Error):
            frame.positions

    def test_several_threads_read_at_once(self):
        run = clca.run(SCENE, output="run")
        expected = [frame.positions.copy() for frame in run.frames]
        failures = []

        def read(order):
            for i in order:
                if not numpy.array_equal(run.frames[i].positions, expected[i]):
                    failures.append(i)

        orders = [range(len(expected)), range(len(expected) - 1, -1, -1)]
        threads = [threading.Thread(target=read, args=(order,)) for order in orders]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


# Goes on until it is stopped.
ENDLESS = SCENE | {
    "stages": [SCENE["stages"][0] | {"until": {"steps": 10**9}}],
    "output": {"frames": "none", "series": "none"},
}


class InterruptTest(ScratchTest):
    def test_ctrl_c_leaves_a_run_that_can_go_on(self):
        code = f"import clca\ntry: clca.run({ENDLESS!r}, output='run')\nexcept KeyboardInterrupt: print('stopped')"
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            while not (self.folder / "run" / "run.json").exists():
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate()
        self.assertEqual((out, process.returncode), ("stopped\n", 0))
        run = clca.open("run")
        self.assertEqual(run.status, "interrupted")
        with self.assertRaisesRegex(clca.Error, "unfinished run"):
            clca.run(ENDLESS, output="run")
        gone_on = clca.resume("run", until=run.steps + 100)
        self.assertEqual((gone_on.status, gone_on.steps), ("done", run.steps + 100))
        whole = clca.run(ENDLESS, set={"stages.packing.until.steps": gone_on.steps}, output="whole")
        self.assertEqual(gone_on.state_hash, whole.state_hash)

    def test_ctrl_c_ends_a_sweep_that_is_planned(self):
        # The signal comes while 90,000 values are on their way to C++, or while C++ plans their runs.
        for seconds in (0.003, 1):
            code = f"""import clca, signal
from clca import _scene
def sweep(*arguments):
    signal.setitimer(signal.ITIMER_REAL, {seconds})
    return clca._clca.sweep(*arguments)
_scene._clca = type("", (), dict(sweep=staticmethod(sweep)))
signal.signal(signal.SIGALRM, signal.default_int_handler)
try: clca.sweep({SCENE!r}, seeds=[1], vary={{'rules.inertia': [i / 1e5 for i in range(90_000)]}}, output='sweep')
except KeyboardInterrupt: print('stopped')"""
            result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
            self.assertEqual((result.stdout, result.returncode), ("stopped\n", 0), result.stderr[:200])
            self.assertFalse((self.folder / "sweep").exists())

    def test_other_threads_run_meanwhile(self):
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        before = signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(TimeoutError()))
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 1)
        thread.start()
        with self.assertRaises(TimeoutError):  # also what other handlers raise ends the run
            clca.run(ENDLESS, output="run")
        done.set()
        thread.join()
        self.assertGreater(len(ticks), 10)
        self.assertEqual(clca.open("run").status, "interrupted")


if __name__ == "__main__":
    unittest.main()
