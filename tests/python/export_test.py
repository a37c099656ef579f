"""Exports as a user meets them, read back by the programs' own readers."""

import json
import os
import re
import shutil
import signal
import subprocess
import time
import tracemalloc
import unittest
from pathlib import Path

import clca
import h5py
import numpy
from clca._export import chosen_frames
from clca._frames import body_trapezoids
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest, clca_program, needs

FORMATS = {"vtp": "pvd", "gsd": "gsd", "xyz": "xyz", "h5md": "h5"}

# A plate pushes into a bed behind a gate that is taken away.
PLATE = {
    "clca": 1,
    "seed": 3,
    "box": {"width": 40, "height": 50},
    "species": {"small": {"shape": {"hexagon": 1}}, "large": {"shape": {"hexagon": 2}}},
    "walls": {
        "plate": {
            "box": [12, 26, 19, 50],
            "passive": "overlap",
            "motion": {"direction": "down", "period": 2, "distance": 20},
        },
        "gate": {"parts": [{"box": [34, 0, 35, 30]}, {"line": {"from": [36, 4], "to": [39, 10]}}]},
    },
    "stages": [
        {"name": "packing", "fill": {"region": [0, 0, 33, 50], "counts": {"small": 30, "large": 25}}},
        {"name": "pushing", "insert": ["plate"], "move": ["plate"], "remove": ["gate"], "until": {"steps": 60}},
    ],
    "output": {"frames": "none", "trajectory": {"every": 6}},
}

# Bent and straight particles enter an empty periodic box, drift across its seam and leave.
PERIODIC = {
    "clca": 1,
    "seed": 4,
    "box": {"width": 24, "height": 40, "periodic": True},
    "rules": {"inertia": 0.9, "scatter": 0.7},
    "species": {
        "rod": {"shape": {"rod": {"radius": 0, "length": 4}}, "orientations": "any"},
        "hook": {"shape": {"sites": [[0, 0], [1, 0], [1, 1], [2, 1]]}, "orientations": [0, 60, 120]},
    },
    "sources": {"top": {"region": [0, 34, 24, 38], "species": {"rod": 1, "hook": 1}, "rate": 0.7}},
    "outlets": {"drain": {"region": [0, 0, 6, 6]}},
    "stages": [{"name": "raining", "sources": ["top"], "until": {"steps": 100}}],
    "output": {"frames": "none", "trajectory": {"every": 6}},
}

# Grains with spins, behind a gate that is taken away, and some that leave.
TURNING = {
    "clca": 1,
    "model": "contact",
    "seed": 5,
    "box": {"width": 30, "height": 40},
    "species": {"small": {"shape": {"hexagon": 1}}, "large": {"shape": {"hexagon": 2}}},
    "walls": {"gate": {"box": [18, 0, 19, 40]}},
    "outlets": {"drain": {"region": [26, 0, 30, 6]}},
    "stages": [
        {
            "name": "packing",
            "fill": {"region": [0, 0, 18, 40], "counts": {"small": 15, "large": 10}},
            "until": {"steps": 300},
        },
        {"name": "flow", "remove": ["gate"], "until": {"steps": 300}},
    ],
    "output": {"frames": "none", "trajectory": {"every": 30}},
}
IN_METRES = TURNING | {
    "units": {"spacing": "2 mm", "density": 100},
    "output": {"frames": "none", "trajectory": {"every": 30, "contacts": True}},
}


def enlarge(run, count, frames):
    """Puts frames of so many grains with two contacts each in place of the trajectory of a run of the contact model."""
    file = run.folder / "trajectory/part-000000.h5"
    with h5py.File(file) as old, h5py.File("enlarged.h5", "w", userblock_size=512) as new:
        old.copy("scene", new)
        side, many, ones = int(numpy.sqrt(count)) + 1, 2 * count, numpy.ones(frames, "u8")
        new["scene/lattice"][:] = [3 * side, 3 * side, 0]
        number, nothing = numpy.arange(frames, dtype="u8"), numpy.zeros(frames, "u8")
        rows = {"step": run.steps * number, "stage": nothing, "entered": count * ones, "particles": count * ones, "contacts": many * ones}
        rows |= {"first": count * number, "first_contact": many * number, "first_push": nothing, "pushes": nothing}
        rows |= {"origins": count * (number == 0), "first_origin": count * (number > 0)}
        for name, values in rows.items():
            new[f"frames/{name}"] = values.astype(old[f"frames/{name}"].dtype)
        ids = numpy.arange(count)
        site = 3 * numpy.stack([ids % side, ids // side], 1)
        grains = {"id": ids, "site": site, "kind": 0 * ids, "species": 0 * ids, "move": 0 * ids + 6, "spin": 1.0 * ids}
        grains |= {"position": site * (0.75**0.5, 1), "velocity": 1.0 * site}
        upper = numpy.repeat(ids, 2)
        contacts = {"upper": upper, "other": (upper + 1) % count}
        contacts |= {name: numpy.ones((many, 2)) for name in ("place", "normal", "branch", "force")}
        for group, columns, times in (("particles", grains, frames), ("contacts", contacts, frames), ("origins", grains, 1)):
            for name in old[group]:
                values = numpy.concatenate(times * [columns[name]]).astype(old[f"{group}/{name}"].dtype)
                new.create_dataset(f"{group}/{name}", data=values, chunks=(4096, *values.shape[1:]), compression=1)
        for name, walls in old["walls"].items():
            new[f"walls/{name}"] = numpy.concatenate(frames * [walls[:1]])
    with open("enlarged.h5", "r+b") as part:
        part.write(b"clca trajectory version 1\nbytes %d\n" % (os.path.getsize("enlarged.h5") - 512))
    os.replace("enlarged.h5", file)


def refused(*arguments):
    """The one line of wrong input."""
    result = subprocess.run([PROGRAM, "export", *map(str, arguments)], capture_output=True, text=True)
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (2, "", 1), result
    return result.stderr


class ReadBackTest(ScratchTest):
    def check(self, scene):
        for module in ("gsd", "vtk"):
            needs(module)
        from read_exports import CHECKS, Run

        run = clca.run(scene, output="run")
        expected = Run(run.folder)
        for form, ending in FORMATS.items():
            with self.subTest(form):
                said = clca_program("export", "run", "--format", form)
                file = f"run/export/{run.scene}.{ending}"
                self.assertEqual(said, f"{len(expected.frames)} frames\n{file}\n")
                CHECKS[form](expected, file)
                # The same by Python.
                self.assertEqual(run.export(form, f"{form}.{ending}"), self.folder / f"{form}.{ending}")
                CHECKS[form](expected, f"{form}.{ending}")
        self.assertEqual(list(self.folder.glob("**/.clca-*")), [])
        return expected.frames

    def some(self, frames, name):
        return sum(int(numpy.any(frame[name])) for frame in frames)

    def test_a_run_with_a_plate_is_what_it_was(self):
        frames = self.check(PLATE)
        self.assertTrue(self.some(frames, "force") and self.some(frames, "velocity"))
        self.assertGreater(len(list(Path("run/export").glob("*-walls-*"))), 2)

    def test_an_empty_periodic_box_that_fills_and_runs_out_is_what_it_was(self):
        frames = self.check(PERIODIC)
        self.assertTrue(self.some(frames, "image") and self.some(frames, "velocity"))
        self.assertEqual(len(frames[0]["id"]), 0)

    def test_a_run_of_the_contact_model_is_what_it_was(self):
        frames = self.check(TURNING)
        self.assertTrue(self.some(frames, "spin") and self.some(frames, "velocity"))

    def test_contacts_and_their_forces_are_there_and_all_is_in_si_units(self):
        frames = self.check(IN_METRES)
        self.assertTrue(any(contact["other"] >= 0 for frame in frames for contact in frame["contacts"]))
        self.assertTrue(any(contact["other"] < 0 for frame in frames for contact in frame["contacts"]))
        # The floor carries the weight of the grains, once they are at rest.
        rest = next(frame for frame in frames if frame["step"] == 300)
        weight = 9.81 * rest["mass"].sum()
        held = sum(contact["force"][1] for contact in rest["contacts"] if contact["other"] < 0)
        self.assertAlmostEqual(held / weight, 1, delta=0.05)


class ExportTest(ScratchTest):
    def test_one_frame_for_each_step_by_the_beat_of_each_stage(self):
        frames = [(0, "a"), (4, "a"), (8, "a"), (12, "b"), (16, "b")]
        self.assertEqual(chosen_frames(frames, None, None, 1), [0, 1, 2, 3, 4])
        self.assertEqual(chosen_frames(frames, None, None, 6), [0, 2, 4])
        self.assertEqual(chosen_frames(frames, 5, 12, 1), [2, 3])
        self.assertEqual(chosen_frames([(0, "a"), (4, "a"), (10, "a"), (14, "b"), (18, "b")], None, None, 8), [0, 2, 4])
        with self.assertRaisesRegex(clca.Error, "from step 0 to 16"):
            chosen_frames(frames, 17, None, 1)
        with self.assertRaisesRegex(clca.Error, "no frames yet"):
            chosen_frames([], None, None, 1)
        with self.assertRaisesRegex(clca.Error, "the last step 5 is before the first, 12"):
            chosen_frames(frames, 12, 5, 1)

    def test_walls_may_have_holes_and_parts(self):
        def area(sites):
            points, counts = body_trapezoids(numpy.array(sites))
            x, y = points.T
            ends = numpy.cumsum(counts)
            after = numpy.arange(len(points)) + 1
            after[ends - 1] = ends - counts
            return float((x * y[after] - x[after] * y).sum() / 2 / (numpy.sqrt(3) / 16))  # in small triangles

        ring = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]
        self.assertAlmostEqual(area(ring), 48)
        self.assertAlmostEqual(area([*ring, (0, 0)]), 54)
        self.assertAlmostEqual(area([(0, 0), (5, 5)]), 12)

    def test_takes_the_steps_that_are_asked_for(self):
        clca.run(PERIODIC | {"output": {"frames": "none", "trajectory": {"every": 5}}}, output="run")
        said = clca_program(
            "export", "run", "--format", "xyz", "-o", "some.xyz", "--from", 5, "--to", 30, "--every", 10
        )
        self.assertEqual(said, "3 frames\nsome.xyz\n")
        self.assertEqual(re.findall(r"Step=(\d+)", Path("some.xyz").read_text()), ["5", "15", "25"])
        self.assertEqual(sorted(os.listdir()), ["run", "some.xyz"])
        file = clca.open("run").export("xyz", first=5, last=30, every=10)
        self.assertEqual(file, self.folder / "scene.xyz")
        self.assertEqual(file.read_bytes(), Path("some.xyz").read_bytes())

    def test_steps_rise_where_stages_meet(self):
        run = clca.run(SCENE, output="run")
        steps = re.findall(r"Step=(\d+)", run.export("xyz").read_text())
        self.assertEqual(steps, [str(step) for step in run.frames.steps])
        self.assertEqual(len(set(steps)), len(steps))

    def test_memory_is_that_of_one_frame_without_its_contacts(self):
        needs("gsd")
        run, count = clca.run(CONTACT, output="run"), 200_000
        enlarge(run, count, 3)
        for form in ("vtp", "gsd"):
            tracemalloc.start()
            run.export(form, f"x.{form}")
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            self.assertLess(peak, 240 * count)  # 300 MB at 10^6 grains, of which 60 are those of Python

    def test_walls_that_stand_are_written_once(self):
        clca.run(PLATE, output="run")
        clca_program("export", "run", "--format", "vtp", "--to", 6)
        self.assertEqual(len(list(Path("run/export").glob("*-walls-*"))), 1)

    def test_a_name_may_have_any_letters(self):
        clca.run(TURNING, output="run")
        clca_program("export", "run", "--format", "vtp", "-o", 'a<b&"c.pvd', "--to", 0)
        self.assertIn("file='a&lt;b&amp;\"c-000000.vtp'", Path('a<b&"c.pvd').read_text())

    def test_wrong_input_is_one_line_and_no_file(self):
        clca.run(PERIODIC, output="run")
        clca.run(GAS, output="gas")
        Path("untracked").mkdir()
        shutil.copy("run/run.json", "untracked")
        before = sorted(os.listdir())
        for arguments, reason in [
            (["run"], "--format"),
            (["run", "--format", "png"], "png"),
            (["nowhere", "--format", "gsd"], "run.json"),
            (["gas", "--format", "gsd"], "Boltzmann"),
            (["untracked", "--format", "gsd"], "output.trajectory"),
            (["run", "--format", "gsd", "--every", "0"], "--every"),
            (["run", "--format", "gsd", "--from", "101"], "from step 0 to 100"),
            (["run", "--format", "xyz", "-o", "run/run.json"], "a file of that name belongs to what clca has left in "),
            (["run", "--format", "h5md", "-o", "run/trajectory.h5"], "a file of that name belongs to what clca has left in "),
            (["run", "--format", "gsd", "--from", "9", "--to", "8", "-o", "new/a.gsd"], "the last step 8 is before the first, 9"),
        ]:
            self.assertIn(reason, refused(*arguments))
        self.assertFalse(Path("run/export").exists())
        self.assertEqual(sorted(os.listdir()), before)
        run = clca.open("run")
        with self.assertRaisesRegex(clca.Error, "expected vtp, gsd, xyz, h5md, found 'png'"):
            run.export("png")
        with self.assertRaisesRegex(clca.Error, "cannot write .*nowhere/a.xyz: No such file"):
            run.export("xyz", "nowhere/a.xyz")
        with self.assertRaisesRegex(clca.Error, "every: expected"):
            run.export("xyz", every=0)
        with self.assertRaisesRegex(clca.Error, "scene.yaml: a file of that name belongs to what clca has left in "):
            run.export("xyz", "run/scene.yaml")
        self.assertEqual(clca.open("run").frames[0].step, 0)

    def test_a_damaged_trajectory_is_wrong_input(self):
        clca.run(PERIODIC, output="run")
        part = Path("run/trajectory/part-000000.h5")
        content = bytearray(part.read_bytes())
        content[len(content) // 2] ^= 1
        part.write_bytes(content)
        self.assertIn("part-000000.h5", refused("run", "--format", "gsd"))
        part.write_bytes(content[:-1])
        self.assertIn("part-000000.h5: it is cut off", refused("run", "--format", "vtp"))
        clca.run(PERIODIC, output="parts", set={"output.checkpoint": {"every": 5}})
        *_, last = sorted(Path("parts/trajectory").iterdir())
        last.unlink()
        self.assertIn(f"{last.name}: missing, though the run had written it", refused("parts", "--format", "gsd"))
        self.assertFalse(Path("run/export").exists())

    def test_a_full_disk_is_a_failure_that_leaves_nothing(self):
        clca.run(PLATE, output="run")
        for form in FORMATS:
            limited = f"ulimit -f 6; exec {PROGRAM} export run --format {form} -o out/x.{form}"
            result = subprocess.run(["sh", "-c", limited], capture_output=True, text=True)
            self.assertEqual(
                (result.returncode, result.stderr), (1, f"clca: error: cannot write out/x.{form}: File too large\n")
            )
            self.assertFalse(Path("out").exists())

    def test_a_signal_and_the_death_of_python_leave_nothing(self):
        clca.run(PLATE, output="run")
        for fake, code in (("kill -9 $$", 1), ("sleep 60", 128 + signal.SIGTERM)):
            Path("begun").unlink(missing_ok=True)
            Path("python").write_text(f'#!/bin/sh\necho \'{{"file": "x.vtp", "bytes": 1}}\'\ntouch {self.folder}/begun\n{fake}\n')
            os.chmod("python", 0o755)
            program = subprocess.Popen(
                [PROGRAM, "export", "run", "--format", "vtp", "-o", "out/x.pvd"],
                env=os.environ | {"CLCA_PYTHON": str(self.folder / "python")},
                stderr=subprocess.PIPE,
                text=True,
            )
            if code > 128:
                while not Path("begun").exists():
                    time.sleep(0.01)
                program.send_signal(signal.SIGTERM)
            self.assertEqual(program.communicate()[1].count("\n"), 1)
            self.assertEqual(program.returncode, code)
            self.assertFalse(Path("out").exists())


if __name__ == "__main__":
    unittest.main()
