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

    def test_what_the_command_line_refuses_is_refused(self):
        run = clca.run(SCENE, output="run")
        for mean in (0, -1, 10**9, float("nan"), 1.5):
            message = message_of_command("plot", "run", "--running-mean", mean)
            self.refused(lambda: run.plot("motion", mean=mean), "mean: expected " + message)
        self.refused(lambda: run.plot("motion", mean="3"), "mean: expected a whole number")
        for first in ("3", float("nan"), True):
            self.refused(lambda: run.plot("motion", first=first), "first, last: expected a number, found")
        self.refused(lambda: run.plot("motion", ax=5), "ax: expected Axes of matplotlib, found '5'")
        self.refused(lambda: run.plot("motion", log="z"), "log: expected x, y or xy, found 'z'")
        self.refused(lambda: run.movie("a.mp4", duration="3"), "duration: expected 0.1 to 86400 seconds, found '3'")
        for values in (b"12", "12", 5, None, numpy.array(5)):
            self.refused(lambda: clca.sweep(SCENE, seeds=values), "seeds: expected a list of values, found")
            self.refused(lambda: clca.sweep(SCENE, vary={"seed": values}), "seed: expected a list of values, found")
            self.refused(lambda: clca.sweep(SCENE, vary={("seed", "title"): [values]}), "seed,title: expected a list of values")
        self.refused(lambda: clca.sweep(SCENE, vary={(): [()]}), "vary: expected keys, found none")
        self.refused(lambda: clca.sweep(SCENE, vary="seed"), "vary: expected a map of keys and values, found 'seed'")
        study = {"targets": {"flow.runout_99": (12, 1)}, "vary": {"rules.inertia": (0, 0.9)}}
        for progress in ("x", object(), 1, None):
            for call in (clca.run, clca.sweep, lambda scene, **how: clca.calibrate(scene, **study, **how)):
                self.refused(lambda: call(SCENE, progress=progress, output="new"), "progress: expected True, False or a function, found")
            self.refused(lambda: clca.resume("run", progress=progress), "progress: expected")
        self.refused(lambda: clca.calibrate(SCENE, **study, jobs=0, output="new"), "jobs: expected a whole number from 1 to 1024")
        self.assertFalse(os.path.exists("new"))
        for name in ("keep", "overwrite"):
            self.refused(lambda: clca.run(SCENE, **{name: "x"}), f"{name}: expected True or False, found 'x'")
        for call in (run.movie, run.picture(0, width=64).save, run.report, clca.open, clca.resume, clca.Scene,
                     lambda name: run.export("xyz", name), lambda name: clca.run(SCENE, output=name),
                     lambda name: clca.Scene(SCENE, name=name)):
            self.refused(lambda: call(""), "the name of a file or folder is empty")
            self.refused(lambda: call(5), "'5' cannot be the name of a file")
        for name in (".", "/"):
            self.refused(lambda: run.picture(0, width=64).save(name), "cannot write ")

    def test_places_in_lists_are_whole_numbers(self):
        run, sweep = clca.run(SCENE, output="run"), clca.sweep(SCENE, seeds=[1, 2], output="sweep")
        self.refused(lambda: run.frames.at("x"), "step: expected a number, found 'x'")
        self.refused(lambda: run.frames["x"], "frame: expected a whole number, found 'x'")
        self.refused(lambda: sweep["x"], "run: expected a whole number, found 'x'")
        self.assertEqual(sweep[-1].seed, 2)
        with self.assertRaisesRegex(IndexError, "no run 2; there are 2"):
            sweep[2]

    def test_names_in_tables_are_texts_that_are_there(self):
        run, sweep = clca.run(SCENE, output="run"), clca.sweep(SCENE, seeds=[1, 2], output="sweep")
        for wrong in (1, None, b"step", ["step"], slice(0, 2), numpy.array(["step", "stage"])):
            self.refused(lambda: run.series.label(wrong), "column: expected a text, found '")
            self.refused(lambda: run.table(wrong), "name: expected a text, found '")
            self.refused(lambda: sweep.series(wrong, "moving"), "stage: expected a text, found '")
            self.refused(lambda: sweep.series("flow", wrong), "column: expected a text, found '")
        self.refused(lambda: run.series[["step", "nosuch"]], "no column 'nosuch'; there are step, stage")
        self.assertEqual(run.series[["step", "moving"]].names, ("step", "moving"))
        self.refused(lambda: sweep.series("nosuch", "moving"), "no stage 'nosuch'; there are packing, flow")
        with self.assertRaisesRegex(KeyError, "no stage 'nosuch'; there are packing, flow"):
            run.stages["nosuch"]

    def test_a_name_of_a_file_has_at_most_255_bytes(self):
        run = clca.run(SCENE, output="run")
        for name in (256 * "x", 128 * "ä", "run/" + 256 * "x", 256 * "x" + "/run"):
            for call in (clca.open, clca.resume, clca.Scene, run.movie, run.report, run.picture(0, width=64).save,
                         lambda name: run.export("xyz", name), lambda name: clca.run(SCENE, output=name),
                         lambda name: clca.sweep(SCENE, output=name), lambda name: clca.Scene(SCENE, name=name),
                         lambda name: clca.compare("run", "run", name),
                         lambda name: clca.calibrate(SCENE, {"flow.x": (1, 1)}, {"rules.inertia": (0, 1)}, output=name)):
                self.refused(lambda: call(name), "cannot be the name of a file")
        self.assertEqual(os.listdir(), ["run"])
        longest = 127 * "ä" + "x"
        self.assertEqual(clca.run(SCENE, output=longest).folder.name, longest)
        for call in (run.report, run.picture(0, width=64).save, run.movie):
            call(longest[6:] + ".png")

    def test_a_gas_does_not_go_back(self):
        gas = clca.Gas(GAS)
        self.refused(lambda: gas.advance(-1), "time: expected 0 or later, found '-1'")
        gas.advance(0.5)
        before = gas.state_hash
        self.refused(lambda: gas.advance(0.25), "time: expected 0.5 or later, found '0.25'")
        gas.advance(0.5)
        self.assertEqual(gas.state_hash, before)

    def test_what_is_no_text_is_told_by_its_name(self):
        run, simulation, gas = clca.run(SCENE, output="run"), clca.Simulation(SCENE), clca.Gas(GAS)
        for wrong in ("x\udcff", "x\ud800", "a\0b", b"x", object(), {1: 2}, [{3}]):
            for name, call in {
                "color_by": lambda: run.picture(1, color_by=wrong),
                "width": lambda: simulation.picture(width=wrong),
                "until": lambda: clca.resume("run", until=wrong),
                "title": lambda: clca.Scene(SCENE, set={"title": wrong}),
                "scene.title": lambda: clca.Scene(SCENE | {"title": wrong}),
                "rules.inertia": lambda: clca.sweep(SCENE, vary={"rules.inertia": [wrong]}),
            }.items():
                with self.subTest(name, wrong=wrong):
                    self.refused(call, f"{name}")
                    self.refused(call, ": expected ")
        for wrong in ("x\udcff", "x\ud800", "a\0b", b"x", 5):
            for name, call in {
                "name": lambda: simulation.measure(wrong),
                "stage": lambda: run.movie("a.mp4", stage=wrong),
                "format": lambda: run.export(wrong),
                "y": lambda: run.plot(y=[wrong]),
                "set": lambda: clca.Scene(SCENE, set={wrong: 1}),
                "vary": lambda: clca.sweep(SCENE, vary={(wrong,): [(1,)]}),
                "time": lambda: gas.advance(str(wrong)),
            }.items():
                with self.subTest(name, wrong=wrong):
                    self.refused(call, f"{name}: expected a {'number' if name == 'time' else 'text'}, found '")
        vary = {"a\udcff": (0, 1)}
        self.refused(lambda: clca.calibrate(SCENE, {"flow.runout_99": (12, 1)}, vary), "vary: expected a text, found 'a\\xff'")
        endless = {}
        endless["box"] = endless
        self.refused(lambda: clca.Scene(endless), "scene: expected what a scene can have")
        self.refused(lambda: clca.Scene(SCENE, seed=10**5000), "seed: expected what a scene can have, found '<int>'")
        self.refused(lambda: clca.Simulation(SCENE).step("a\nb"), "found 'a\\nb'")

    def test_seeds_are_whole_numbers(self):
        for seed in (-1, 1.7, "x", 2**64):
            self.refused(lambda: clca.Scene(SCENE, seed=seed), "expected a whole number from 0 to 18446744073709551615")
            self.refused(lambda: clca.sweep(SCENE, seeds=[seed]), "expected a whole number from 0 to 18446744073709551615")
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
                with self.assertRaises(ValueError):
                    array.setflags(write=True)

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



if __name__ == "__main__":
    unittest.main()
