"""What else the process does: other libraries, other folders, children, signals, its end."""

import itertools
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import unittest

import clca
import numpy
from support import CONTACT, GAS, SCENE, ScratchTest, needs

ENDLESS = SCENE | {"stages": [SCENE["stages"][0] | {"until": {"steps": 10**9}}]}
LARGE_GAS = GAS | {"boltzmann": GAS["boltzmann"] | {"particles": 100_000}}


def python(code, **options):
    """Runs a program of its own; what it prints."""
    return subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, timeout=300, **options)


def in_child(work):
    """The answer of a function that a child by fork calls, by pickle; None: it hangs."""
    with multiprocessing.get_context("fork").Pool(1) as pool:
        try:
            return pool.apply_async(work).get(timeout=60)
        except multiprocessing.TimeoutError:
            return None


def hash_of_gas():
    gas = clca.Gas(LARGE_GAS, threads=2)
    gas.advance(0.2)
    return gas.state_hash


class OtherLibrariesTest(ScratchTest):
    def test_hdf5_may_be_in_use_already(self):
        needs("h5py")
        scene = SCENE | {"output": {"trajectory": {}}}
        program = f"import h5py, clca; print(clca.run({scene!r}, output='run').frames[-1].positions.shape)"
        result = python(program)
        self.assertEqual((result.returncode, result.stdout), (0, "(40, 2)\n"), result.stderr)

    def test_hdf5_is_left_as_it_is(self):
        # Plugins, and files that are open when the process ends, which the library then writes.
        needs("h5py")
        code = f"""
import clca, ctypes, h5py
run = clca.run({SCENE!r}, output="run")
run.frames[-1].positions
library = next(line.split()[-1] for line in open("/proc/self/maps") if "libhdf5" in line and "_hl" not in line)
state = ctypes.c_uint()
ctypes.CDLL(library).H5PLget_loading_state(ctypes.byref(state))
print(hex(state.value))
file = h5py.File("open.h5", "w")
file["x"] = [1, 2, 3]
clca.keep = file
"""
        result = python(code)
        self.assertEqual((result.returncode, result.stdout), (0, "0xffff\n"), result.stderr)
        self.assertEqual(python("import h5py; print(h5py.File('open.h5')['x'][2])").stdout, "3\n")

    def test_a_disk_that_is_full_is_an_error_and_python_ends(self):
        # The limit of a file stands for the end of the disk.
        scene = SCENE | {
            "stages": [SCENE["stages"][0] | {"until": {"steps": 2000}}],
            "output": {"trajectory": {"every": 1}},
        }
        code = f"""
import clca, resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
try:
    clca.run({scene!r}, output="run")
except clca.Error as error:
    print(error)
"""
        result = python(code)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, "^cannot write .*run/trajectory/part-.*: File too large\n$")


class FolderTest(ScratchTest):
    def test_a_run_stays_that_of_its_folder(self):
        run = clca.run(SCENE, output="run")
        sweep = clca.sweep(SCENE, seeds=[1], output="sweep")
        tables, positions = run.tables, run.frames[-1].positions
        os.mkdir("elsewhere")
        os.chdir("elsewhere")
        clca.run(SCENE, output="run", set={"stages.packing.fill.counts.rod": 1, "output.series": None})
        self.assertEqual(run.folder, self.folder / "run")
        self.assertEqual(run.tables, tables)
        self.assertEqual(clca.open(run.folder).frames[-1].positions.shape, positions.shape)
        self.assertEqual(len(sweep[0].series), len(sweep[0].table("series")))
        self.assertEqual(sweep.runs["status"].tolist(), ["done"])

    def test_the_process_may_go_elsewhere_while_it_works(self):
        os.mkdir("elsewhere")

        class Left(Exception):
            pass

        def leave(progress):
            os.chdir(self.folder / "elsewhere")
            raise Left  # ends the run, which then writes its files

        endless_gas = LARGE_GAS | {"boltzmann": LARGE_GAS["boltzmann"] | {"until": 100_000}}
        no_files = {"output": {}}
        for name, call in {
            "run": lambda: clca.run(ENDLESS, output="run", set=no_files, progress=leave),
            "renders/scene": lambda: clca.run(ENDLESS, set=no_files, progress=leave),
            "gas": lambda: clca.run(endless_gas, output="gas", progress=leave),
            "run again": lambda: clca.resume("run", progress=leave),
        }.items():
            with self.subTest(name):
                os.chdir(self.folder)
                self.assertRaises(Left, call)
                self.assertEqual(clca.open(self.folder / name.removesuffix(" again")).status, "interrupted")
        self.assertEqual(os.listdir(self.folder / "elsewhere"), [])

    def test_a_sweep_stays_that_of_its_folder_wherever_the_process_goes(self):
        os.mkdir("elsewhere")
        told = []

        def leave(progress):
            told.append(progress)
            os.chdir(self.folder / "elsewhere")

        for folder, chosen in {"sweep": {"output": "sweep"}, "renders/scene-sweep": {}}.items():
            with self.subTest(folder):
                os.chdir(self.folder)
                self.assertEqual(clca.sweep(SCENE, seeds=[1, 2], progress=leave, **chosen).folder, self.folder / folder)
        self.assertTrue(told)
        self.assertEqual(os.listdir(self.folder / "elsewhere"), [])

    def test_absolute_paths_need_no_current_folder(self):
        scene = clca.run(SCENE, output="run").folder / "scene.yaml"
        os.mkdir("gone")
        os.chdir("gone")
        os.rmdir(self.folder / "gone")
        self.assertEqual(clca.sweep(scene, seeds=[1], output=self.folder / "sweep").folder, self.folder / "sweep")
        for call in (lambda: clca.open("run"), lambda: clca.resume("run"), lambda: clca.run(scene, output="run")):
            with self.assertRaises(clca.Error):
                call()
        os.chdir(self.folder)

    def test_a_folder_that_is_gone_is_an_error(self):
        run = clca.run(SCENE, output="run")
        os.rename("run", "moved")
        for look in (lambda: run.tables, lambda: run.table("series"), lambda: run.frames, lambda: run.picture(0)):
            with self.assertRaises(clca.Error):
                look()


class SceneTest(ScratchTest):
    def counts(self, scene, where):
        """Particles of a run of the scene itself, one with another seed, and a sweep."""
        return (clca.run(scene, output=f"{where}-a").particles, clca.run(scene, seed=1, output=f"{where}-b").particles,
                clca.sweep(scene, seeds=[1], output=f"{where}-c")[0].particles,
                len(clca.Simulation(scene, set={"rules.inertia": 0.5}).particles))

    def test_a_scene_is_what_was_checked(self):
        file = pathlib.Path("scene.yaml")
        file.write_text(clca.Scene(SCENE).to_yaml())
        source = pickle.loads(pickle.dumps(SCENE))
        override = {"a": [1, 2]}
        scenes = {"file": clca.Scene(file), "dictionary": clca.Scene(source)}
        file.write_text(file.read_text().replace("rod: 20", "rod: 7"))
        source["stages"][0]["fill"]["counts"]["rod"] = 7
        os.mkdir("elsewhere")
        os.chdir("elsewhere")
        for name, scene in scenes.items():
            with self.subTest(name):
                self.assertEqual(self.counts(scene, name), 4 * (40,))
                self.assertEqual(clca.Scene.of(scene, seed=1).name, "scene")
        self.assertEqual(clca.Scene(self.folder / file).to_yaml().count("rod: 7"), 1)
        self.assertEqual(override, {"a": [1, 2]})

    def test_what_it_replaces_is_kept_as_it_was(self):
        region = [0, 0, 20, 40]
        scene = clca.Scene(SCENE, set={"stages.packing.fill.region": region})
        region[2] = 1
        self.assertEqual(clca.Simulation(scene, seed=2).state_hash, clca.Simulation(SCENE, seed=2).state_hash)

    def test_files_that_a_scene_names_are_beside_it_wherever_the_process_is(self):
        clca.run(SCENE, output="run")
        scene = clca.Scene(SCENE | {"begin": {"run": "run"}})
        os.mkdir("elsewhere")
        os.chdir("elsewhere")
        self.assertEqual(clca.Scene.of(scene, seed=3).name, "scene")

    def test_a_run_does_not_replace_the_file_of_its_scene(self):
        os.mkdir("run")
        pathlib.Path("run/scene.yaml").write_text(clca.Scene(SCENE).to_yaml())
        scene = clca.Scene("run/scene.yaml")
        os.mkdir("elsewhere")
        os.chdir("elsewhere")
        with self.assertRaisesRegex(clca.Error, "would replace this file"):
            clca.run(scene, output=self.folder / "run")


class PickleTest(ScratchTest):
    def test_what_comes_from_another_process_is_whole(self):
        run = clca.run(SCENE, output="run")
        run.frames, run.series
        copy = pickle.loads(pickle.dumps(run))
        self.assertEqual((copy.folder, copy.state_hash, repr(copy.measures)), (run.folder, run.state_hash, repr(run.measures)))
        numpy.testing.assert_array_equal(copy.frames[-1].positions, run.frames[-1].positions)
        for table in (run.series, run.series[2:5], clca.Simulation(SCENE | {"measure": ["profile"]}).measure("profile")):
            copy = pickle.loads(pickle.dumps(table))
            numpy.testing.assert_array_equal(copy, table)
            self.assertEqual((copy.units, copy.descriptions), (table.units, table.descriptions))
            self.assertTrue(copy.units)
        simulation = clca.Simulation(CONTACT)
        simulation.step(150)
        for frame in (run.frames[-1], clca.run(CONTACT, output="contact").frames.at(100), simulation.frame):
            copy = pickle.loads(pickle.dumps(frame))
            self.assertEqual((copy.step, copy.time, copy.stage, copy.walls), (frame.step, frame.time, frame.stage, frame.walls))
            for name in ("particles", "contacts", "contact_names", "species"):
                numpy.testing.assert_array_equal(getattr(copy, name), getattr(frame, name))
        scene = clca.Scene(SCENE, seed=4)
        self.assertEqual(pickle.loads(pickle.dumps(scene)).to_yaml(), scene.to_yaml())

    def test_errors_keep_their_place(self):
        with self.assertRaises(clca.Error) as caught:
            clca.Scene(SCENE | {"nothing": 1})
        copy = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(copy), copy.line), (str(caught.exception), caught.exception.line))

    def test_errors_of_every_kind_come_from_another_process(self):
        for kind in (clca.Error, clca.CompiledPartError, clca._error.ArgumentError, clca._error.WriteError):
            for error in (kind("a: b"), kind.__new__(kind)):
                self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))


class ForkTest(ScratchTest):
    def test_children_go_on_after_threads_of_their_parent(self):
        simulation = clca.Simulation(SCENE, threads=2)
        simulation.step(3)
        gas = clca.Gas(LARGE_GAS, threads=2)
        gas.advance(0.1)
        here = hash_of_gas()
        picture = simulation.picture(width=100).sum()

        def inherited():
            gas.advance(0.2)
            return gas.state_hash

        global forked_work  # a pool finds functions by name
        for what, work, expected in (
            ("a gas of its own", hash_of_gas, here),
            ("an inherited gas", inherited, None),
            ("a picture", lambda: int(simulation.picture(width=100).sum()), int(picture)),
            ("a simulation", lambda: simulation.step(5), 5),
            ("a run", lambda: clca.run(SCENE, output="child").status, "done"),
            ("a run of a gas", lambda: clca.run(GAS, output="gas").status, "done"),
        ):
            with self.subTest(what):
                forked_work = work
                answer = in_child(call_forked_work)
                self.assertIsNotNone(answer, "it hangs")
                if expected is not None:
                    self.assertEqual(answer, expected)
        gas.advance(0.2)
        forked_work = inherited
        self.assertEqual(in_child(call_forked_work), gas.state_hash)
        self.assertEqual(hash_of_gas(), here)


def call_forked_work():
    return forked_work()


class EndTest(ScratchTest):
    def test_threads_that_work_when_python_ends_do_not_abort(self):
        works = {
            "steps": f"while True: clca.Simulation({ENDLESS!r}).step(2000)",
            "gas": f"while True: clca.Gas({GAS!r}, threads=1).advance(0.3)",
            "runs": f"while True: clca.run({SCENE!r}, output='run', overwrite=True).frames[-1].ids",
            "long": f"clca.Simulation({ENDLESS!r}).step(10**9)",
        }
        for name, work in works.items():
            code = f"""
import clca, threading, time
clca.run  # the compiled part is loaded here: of threads that load one while Python ends, no library knows
def work():
    {work}
for i in range(3 if {name!r} != 'runs' else 1):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.6)
"""
            for attempt in range(3):
                result = python(code)
                self.assertEqual((name, result.returncode, result.stderr), (name, 0, ""))


class SignalTest(ScratchTest):
    def test_an_object_at_work_takes_no_other_call(self):
        gas = clca.Gas(LARGE_GAS | {"boltzmann": LARGE_GAS["boltzmann"] | {"until": 1000}}, threads=1)
        simulation = clca.Simulation(ENDLESS)
        calls = {"gas": (lambda: gas.advance(500), lambda: gas.advance(1)),
                 "steps": (lambda: simulation.step(10**9), lambda: simulation.step(1))}
        for name, (outer, inner) in calls.items():
            with self.subTest(name):
                old = signal.signal(signal.SIGALRM, lambda *_: inner())
                signal.setitimer(signal.ITIMER_REAL, 0.3)
                try:
                    with self.assertRaisesRegex(clca.Error, "another call is at work"):
                        outer()
                finally:
                    signal.signal(signal.SIGALRM, old)
        self.assertEqual(simulation.step(1), 1)
        gas.advance(gas.time)

    def test_a_movie_without_sigchld_has_its_reason(self):
        code = f"""
import clca, signal
run = clca.run({SCENE!r}, output="run")
signal.signal(signal.SIGCHLD, signal.SIG_IGN)
try:
    run.movie("a.gif", width=64)
except clca.Error as error:
    print(error)
print(run.frames[-1].ids.size)
"""
        result = python(code)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, "SIGCHLD is ignored|^40")
        self.assertTrue(result.stdout.endswith("40\n"))


class UnmadeTest(unittest.TestCase):
    def test_objects_without_init_are_an_error(self):
        scene = clca.Scene(SCENE)
        classes = {
            clca.Simulation: ("steps", "stage", "state_hash", "particles", "frame", "measures", "kinds", "over"),
            clca.Gas: ("time", "velocities", "state_hash", "moments"),
            clca.Scene: ("name", "to_yaml"),
            type(scene).__mro__[1]: ("name",),
        }
        for kind, names in classes.items():
            for name in names:
                with self.subTest(f"{kind.__name__}.{name}"), self.assertRaises(TypeError):
                    found = getattr(kind.__new__(kind), name)
                    found()
        objects = [clca.Simulation(scene), *(kind.__new__(kind) for kind in classes)]
        for unmade, protocol in itertools.product(objects, range(pickle.HIGHEST_PROTOCOL + 1)):
            with self.subTest(f"{type(unmade).__name__}, protocol {protocol}"), self.assertRaises((TypeError, AttributeError)):
                pickle.dumps(unmade, protocol)
        for call in (lambda: clca.run(clca.Scene.__new__(clca.Scene)), lambda: clca.Gas(clca.Scene.__new__(clca.Scene)),
                     lambda: clca.Simulation.__new__(clca.Simulation).step(1)):
            with self.assertRaises((TypeError, AttributeError)):
                call()


if __name__ == "__main__":
    unittest.main()
