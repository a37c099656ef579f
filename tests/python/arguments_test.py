"""Arguments and files that are wrong: refused as by the command line, by clca.Error of one line."""

import itertools
import os
import resource
import subprocess
import unittest

import clca
import numpy
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest


def message_of_command(*arguments):
    """Without what names the option."""
    result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert result.returncode == 2, result
    return result.stderr.split("expected", 1)[-1].split(" (see")[0].strip()


class ArgumentsTest(ScratchTest):
    def refused(self, call, message=""):
        with self.assertRaises(clca.Error) as caught:
            call()
        self.assertNotIn("\n", str(caught.exception))
        self.assertIn(message, str(caught.exception))

    def test_numbers_out_of_range_are_those_of_the_command_line(self):
        run = clca.run(SCENE, output="run")
        for threads in (100_000, 0, -1):
            message = message_of_command("run", "wall-removal", "--threads", threads)
            for call in (lambda: clca.Simulation(SCENE, threads=threads), lambda: clca.run(SCENE, threads=threads),
                         lambda: clca.Gas(GAS, threads=threads), lambda: clca.resume("run", threads=threads)):
                self.refused(call, message)
        for jobs in (0, -1, 1025):
            self.refused(lambda: clca.sweep(SCENE, jobs=jobs), message_of_command("sweep", "wall-removal", "--jobs", jobs))
        for fps in (0, -1, 241):
            self.refused(lambda: run.movie("a.mp4", fps=fps), message_of_command("render", "run", "--movie", "a.mp4", "--fps", fps))
        for duration in (0, 1e-300, float("nan"), float("inf"), -1):
            self.refused(lambda: run.movie("a.mp4", duration=duration), "expected 0.1 to 86400 seconds, found")
        self.refused(lambda: run.picture(-1), "expected a whole number")
        self.refused(lambda: clca.Simulation(SCENE).step(-1), "expected a whole number")
        self.refused(lambda: clca.Simulation(SCENE).step(1.5), "expected a whole number")
        self.refused(lambda: clca.run(SCENE, keep=True, overwrite=True))
        self.assertEqual(clca.Simulation(SCENE, threads=numpy.int64(2)).step(numpy.uint8(3)), 3)

    def test_seeds_are_whole_numbers(self):
        for seed in (-1, 1.7, "x", 2**64):
            self.refused(lambda: clca.Scene(SCENE, seed=seed), "expected a whole number from 0 to 18446744073709551615")
            self.refused(lambda: clca.sweep(SCENE, seeds=[seed]), "expected a whole number from 0 to 18446744073709551615")
        self.refused(lambda: clca.sweep(SCENE, seeds="12"), "expected a whole number")
        for seeds in (range(10**6), itertools.count()):
            self.refused(lambda: clca.sweep(SCENE, seeds=seeds), "more than 100000 runs")
        self.refused(lambda: clca.sweep(SCENE, seeds=range(10**4), vary={"rules.inertia": [i / 100 for i in range(100)]}),
                     "a sweep has at most 100000")
        self.refused(lambda: clca.sweep(SCENE, vary={"rules.inertia": itertools.count()}), "more than 100000 runs")
        self.assertFalse(os.path.exists("renders"))
        for seed in ("=1e18", 10**18, 2**63, numpy.uint64(2**64 - 1)):
            self.assertIn("seed", clca.Scene(SCENE, seed=seed).to_yaml())
        self.assertIn("seed: 1000000000000000000\n", clca.Scene(SCENE, seed="=1e18").to_yaml())

    def test_arrays_cannot_be_written(self):
        run = clca.run(CONTACT, output="run")
        frame, simulation, gas = run.frames[-1], clca.Simulation(CONTACT), clca.Gas(GAS)
        arrays = {
            "steps": run.frames.steps, "series": run.series, "column": run.series["step"], "profile": run.table("profile-flow"),
            "walls": run.walls["gate"], "outline": run.kinds[0].outline, "particles": simulation.particles,
            "velocities": gas.velocities, "spins": gas.spins, "live frame": simulation.frame.positions,
            "outlines": frame.outlines[0],
        } | {name: getattr(frame, name) for name in ("particles", "ids", "positions", "velocities", "angular_velocities", "kinds",
                                                     "displacements", "species", "orientation", "contacts", "contact_names")}
        for name, array in arrays.items():
            with self.subTest(name):
                self.assertFalse(array.flags.writeable)
                with self.assertRaises(ValueError):
                    array[0] = array[-1]

    def test_a_picture_without_pixels_is_no_png(self):
        for shape in ((0, 0, 3), (0, 5, 3), (5, 0, 3)):
            self.refused(lambda: numpy.empty(shape, dtype=numpy.uint8).view(clca.Picture).save("a.png"))


class HostileTextTest(ScratchTest):
    refused = ArgumentsTest.refused

    def test_names_that_are_no_utf8_are_told_escaped(self):
        name = os.fsdecode(b"x\xff")
        shown = "x\\xff"
        self.refused(lambda: clca.open(name), shown)
        self.refused(lambda: clca.Scene(name + ".yaml"), shown + ".yaml:1:1: error: cannot read the file")
        self.refused(lambda: clca.run(name + ".yaml"), shown)
        self.refused(lambda: clca.resume(name), shown)
        for call in (clca.open, clca.Scene, clca.resume, clca.Simulation, lambda name: clca.run(SCENE, output=name),
                     lambda name: clca.sweep(SCENE, seeds=[1], output=name)):
            self.refused(lambda: call("a\0b"), "cannot be the name of a file")
        self.refused(lambda: clca.Scene(SCENE | {"title": name}))
        self.refused(lambda: clca.Scene(SCENE, set={name: 1}))
        self.refused(lambda: clca.Scene(SCENE, set={"title": "\ud800"}))

    def test_they_may_be_names_all_the_same(self):
        name = os.fsdecode(b"x\xff")
        with open(name + ".yaml", "w") as file:
            file.write(clca.Scene(SCENE).to_yaml())
        scene = clca.Scene(name + ".yaml")
        self.assertEqual(scene.name, "x\\xff")
        run = clca.run(SCENE, output=name)
        self.assertEqual(run.folder, self.folder / name)
        self.assertEqual(clca.open(name).frames[-1].ids.size, 40)
        run.picture(0, width=64).save(name + ".png")
        run.movie(name + "-movie.png", width=64, every=10)
        sweep = clca.sweep(scene, seeds=[1], output=name + "-sweep")
        self.assertEqual(sweep.runs["status"].tolist(), ["done"])

    def test_files_of_any_bytes_are_read_or_refused(self):
        run = clca.run(SCENE, output="run")
        good = {name: (run.folder / name).read_bytes() for name in ("series.csv", "run.json", "scene.yaml", ".clca.manifest")}
        for name, content in good.items():
            for damaged in (content.replace(b"packing", b"pack\xff"), content.replace(b"packing", b"pack\0"), b"\xff\xfe",
                            b"", content[: len(content) // 2]):
                (run.folder / name).write_bytes(damaged)
                for look in (lambda: clca.open("run"), lambda: clca.open("run").series.shape,
                             lambda: clca.open("run").frames[-1].ids, lambda: clca.open("run").picture(0, width=64)):
                    try:
                        look()
                    except clca.Error as error:
                        self.assertNotIn("\n", str(error))
                (run.folder / name).write_bytes(content)
        (run.folder / "series.csv").write_bytes(b"stage,step\np\xff,1\n")
        self.refused(lambda: clca.open("run").series, "no UTF-8")
        (run.folder / "series.csv").write_bytes(b"st\xffge,step\np,1\n")
        self.refused(lambda: clca.open("run").series, "no UTF-8")

    def test_a_long_cell_does_not_take_its_length_in_each_row(self):
        run = clca.run(SCENE, output="run")
        (run.folder / "series.csv").write_bytes(b"stage\n" + b"x" * 100_000 + b"\n" + b"y\n" * 3000)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        table = clca.open("run").series
        self.assertEqual((table.shape, table["stage"][1], len(table["stage"][0])), ((3001,), "y", 100_000))
        self.assertEqual((table["stage"] == "y").sum(), 3000)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 100 << 10)


if __name__ == "__main__":
    unittest.main()
