"""Scenes step by step: the bits of runs, arrays without copies, stages at will, Ctrl-C."""

import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import clca
import numpy
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest

VOIDS = SCENE | {
    "model": "voids",
    "species": {"grain": {"shape": {"hexagon": 0}}},
    "stages": [
        {"name": "packing", "fill": {"region": [0, 0, 20, 40], "counts": {"grain": 100}}},
        {"name": "flow", "remove": ["gate"]},
    ],
}

BAXTER = VOIDS | {"model": "baxter"}

# A heap that grows from a source and runs out through an outlet, into a second stage without the source.
SOURCE = {
    "clca": 1,
    "seed": 3,
    "box": {"width": 40, "height": 60},
    "species": {"grain": {"shape": {"hexagon": 1}}},
    "sources": {"tap": {"at": [20, 55], "species": {"grain": 1}, "rate": 0.2}},
    "outlets": {"hole": {"region": [14, 0, 26, 6]}},
    "stages": [
        {"name": "pouring", "sources": ["tap"], "until": {"steps": 300}},
        {"name": "rest", "until": "settled"},
    ],
    "output": {"frames": "none"},
}


def numbers(measures):
    return {name: float(value) for name, value in measures.items()}


class SimulationTest(ScratchTest):
    def test_it_has_the_bits_and_the_measures_of_a_run(self):
        for number, scene in enumerate([SCENE, CONTACT, VOIDS, BAXTER, SOURCE]):
            run = clca.run(scene, output=f"run{number}")
            simulation = clca.Simulation(scene)
            while simulation.step():
                if simulation.ended:
                    stage = run.stages[simulation.stage]
                    self.assertEqual(simulation.ended, stage.ended)
                    numpy.testing.assert_equal(numbers(simulation.measures), numbers(stage.measures))
            self.assertTrue(simulation.over)
            self.assertEqual((simulation.steps, simulation.state_hash), (run.steps, run.state_hash))

    def test_many_steps_are_many_times_one(self):
        one, many = clca.Simulation(SCENE), clca.Simulation(SCENE)
        while one.step():
            pass
        self.assertEqual(many.step(10**6), one.steps)
        self.assertEqual(many.step(), 0)
        self.assertEqual(many.state_hash, one.state_hash)

    def test_held_arrays_change_no_bits(self):
        for scene in (SCENE, CONTACT, SOURCE):
            free, held = clca.Simulation(scene), clca.Simulation(scene)
            arrays = []
            while held.step():
                arrays.append(held.particles)
            free.step(10**6)
            self.assertEqual(free.state_hash, held.state_hash)

    def test_its_frame_is_that_of_the_trajectory(self):
        for number, scene in enumerate([SCENE, CONTACT]):
            frames = clca.run(scene, output=f"run{number}").frames
            simulation = clca.Simulation(scene)
            simulation.step(int(frames.steps[2]))
            for name in ("step", "stage", "time", "units", "walls"):
                self.assertEqual(getattr(simulation.frame, name), getattr(frames[2], name))
            for name in ("ids", "positions", "velocities", "angular_velocities", "displacements", "species", "orientation"):
                numpy.testing.assert_array_equal(getattr(simulation.frame, name), getattr(frames[2], name))
            self.assertEqual([kind.name for kind in simulation.kinds], [kind.name for kind in frames._facts.kinds])
            self.assertEqual(list(simulation.walls), ["gate"])

    def test_particles_are_views_that_follow_the_steps(self):
        simulation = clca.Simulation(SCENE)
        particles = simulation.particles
        self.assertEqual(particles.dtype.names, ("column", "row", "kind", "move", "present"))
        before = particles["row"].copy()
        simulation.step()
        self.assertLess(particles["row"].sum(), before.sum(), "they fall")
        address = simulation.particles.__array_interface__["data"][0]
        self.assertEqual(particles.__array_interface__["data"][0], address)
        with self.assertRaises(ValueError):
            particles["row"] = 0
        # The next stage works on a copy, and the old array stays as the stage has left it.
        while not simulation.ended:
            simulation.step()
        end = particles.copy()
        simulation.step(5)
        self.assertEqual(simulation.stage, "flow")
        numpy.testing.assert_array_equal(particles, end)
        self.assertFalse(numpy.array_equal(simulation.particles, end))
        # They outlive the simulation.
        del simulation
        numpy.testing.assert_array_equal(particles, end)

    def test_particles_are_copies_while_a_source_is_open(self):
        simulation = clca.Simulation(SOURCE)
        simulation.step(100)
        particles = simulation.particles
        before = particles.copy()
        simulation.step(100)
        numpy.testing.assert_array_equal(particles, before)
        self.assertGreater(len(simulation.particles), len(before))
        self.assertLess(len(simulation.frame.ids), len(simulation.particles), "some have left")

    def test_measures_are_taken_at_any_time(self):
        simulation = clca.Simulation(SCENE)
        simulation.step(10)
        profile = simulation.measure("profile")
        self.assertEqual(profile.dtype.names, ("x", "height"))
        self.assertEqual(profile.units, {"x": "spacings", "height": "spacings"})
        highest = simulation.frame.positions[:, 1].max()
        self.assertAlmostEqual(profile["height"].max(), highest, delta=2)
        self.assertIn("packing_fraction", simulation.measure("packing"))
        self.assertLess(set(simulation.measure("packing")), set(simulation.measures))
        self.assertEqual(simulation.measure("packing")["height_mean"].unit, "spacings")
        self.assertEqual(
            numbers(simulation.measure("packing")).items() - numbers(simulation.measures).items(), set())
        with self.assertRaisesRegex(clca.Error, "does not measure 'mixing'"):
            simulation.measure("mixing")

    def test_the_next_stage_begins_at_will(self):
        simulation = clca.Simulation(SCENE)
        simulation.step(3)
        simulation.next_stage()
        self.assertEqual((simulation.stage, simulation.steps, simulation.ended), ("flow", 3, None))
        self.assertEqual(simulation.frame.walls, {})
        # As a scene whose first stage has as many steps.
        first, second = SCENE["stages"]
        scene = SCENE | {"stages": [first | {"until": {"steps": 3}}, second]}
        simulation.step(10**6)
        self.assertEqual(simulation.state_hash, clca.run(scene, output="run").state_hash)
        with self.assertRaisesRegex(clca.Error, "flow is the last stage"):
            simulation.next_stage()

    def test_one_that_has_failed_says_so_again(self):
        # 208 of the 280 grains have room.
        for model in ("automaton", "contact"):
            fill = {"region": [0, 0, 40, 60]}
            stages = [{"name": "pack", "fill": fill | {"counts": {"a": 60}}, "until": {"steps": 5}},
                      {"name": "two", "fill": fill | {"counts": {"a": 280}}, "until": {"steps": 20}}]
            scene = {"clca": 1, "model": model, "box": {"width": 40, "height": 60}, "species": {"a": {"shape": {"hexagon": 1}}},
                     "stages": stages, "output": {"frames": None}}
            for begin in (lambda simulation: simulation.step(30), lambda simulation: simulation.next_stage()):
                simulation = clca.Simulation(scene)
                before = simulation.particles
                with self.assertRaisesRegex(clca.Error, "fill of stage two does not fit"):
                    begin(simulation)
                self.assertIn("that has failed", repr(simulation))
                for call in (lambda: simulation.step(1), lambda: simulation.step(30), lambda: simulation.next_stage(),
                             lambda: simulation.particles, lambda: simulation.frame, lambda: simulation.measures,
                             lambda: simulation.state_hash, lambda: simulation.stage, lambda: simulation.picture()):
                    with self.assertRaisesRegex(clca.Error, "fill of stage two does not fit"):
                        call()
                self.assertGreaterEqual(len(before), 60)

    def test_pictures_are_those_of_a_run(self):
        frames = {"every": 10, "width": 200, "color_by": "stage_layer"}
        run = clca.run(SCENE, set={"output.frames": frames}, output="run")
        simulation = clca.Simulation(SCENE)
        simulation.step(20)
        picture = simulation.picture(**frames)
        self.assertEqual((picture.dtype, picture.ndim, picture.shape[1:]), (numpy.uint8, 3, (200, 3)))
        numpy.testing.assert_array_equal(picture, run.picture(20))
        self.assertFalse(numpy.array_equal(picture, run.picture(20, color_by="species")))
        picture.save("here.png")
        self.assertEqual(picture._repr_png_(), Path("here.png").read_bytes())
        self.assertIsNone(picture[:, :, 0]._repr_png_())
        clca_diff = subprocess.run([PROGRAM, "diff", "here.png", run.folder / "frames/scene-000020.png"],
                                   capture_output=True, text=True)
        self.assertEqual(clca_diff.returncode, 0, clca_diff.stderr + clca_diff.stdout)
        with self.assertRaisesRegex(clca.Error, "output.frames.color_by"):
            simulation.picture(color_by="taste")
        with self.assertRaises(clca.Error):
            run.picture(21)

    def test_movies_are_drawn_from_the_trajectory(self):
        run = clca.run(SCENE, output="run")
        run.movie("a.png", every=10, width=100)
        self.assertEqual(Path("a.png").read_bytes()[:4], b"\x89PNG")

    def test_gases_have_no_steps(self):
        with self.assertRaisesRegex(clca.Error, "expected a scene of grains"):
            clca.Simulation(GAS)

    def test_ctrl_c_stops_between_two_steps(self):
        scene = SCENE | {"stages": [SCENE["stages"][0] | {"until": {"steps": 10**9}}]}
        code = (f"import clca\nsimulation = clca.Simulation({scene!r})\nprint('ready', flush=True)\n"
                "try: simulation.step(10**9)\nexcept KeyboardInterrupt: print(simulation.steps, simulation.step(5))")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            process.stdout.readline()
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=60)
        steps, more = map(int, out.split())
        self.assertGreater(steps, 0)
        self.assertEqual(more, 5)

    def test_ctrl_c_stops_a_fill(self):
        size = {"width": 1000, "height": 1000}
        fill = {"region": [0, 0, 1000, 1000], "counts": {"grain": 100_000}}
        grain = {"grain": SCENE["species"]["grain"]}
        scene = SCENE | {"box": size, "species": grain, "walls": {}, "stages": [{"name": "fill", "fill": fill, "until": {"steps": 1}}]}

        def seconds():
            begin = time.process_time()
            try:
                clca.Simulation(scene)
            except KeyboardInterrupt:
                pass
            return time.process_time() - begin

        whole = seconds()
        old = signal.signal(signal.SIGVTALRM, signal.default_int_handler)
        try:
            signal.setitimer(signal.ITIMER_VIRTUAL, whole / 4)
            self.assertLess(seconds(), 0.75 * whole)
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            signal.signal(signal.SIGVTALRM, old)


if __name__ == "__main__":
    unittest.main()
