"""`clca compare`: a run of grains beside a gas, and what is refused."""

import csv
import json
import math
import subprocess
import unittest
from pathlib import Path

import clca
import matplotlib
from support import PROGRAM, ScratchTest, clca_program

matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402

SHAKEN = {
    "clca": 1,
    "seed": 5,
    "box": {"width": 40, "height": 80},
    "species": {"grain": {"shape": {"hexagon": 1}}},
    "rules": {"scatter": 1},
    "walls": {"floor": {"box": [0, 0, 40, 1], "passive": "rigid", "motion": {"shake": {"amplitude": 6}}}},
    "stages": [
        {"name": "packing", "fill": {"region": [0, 1, 40, 80], "counts": {"grain": 80}}},
        {"name": "shaking", "move": ["floor"], "until": {"cycles": 5}},
    ],
    "output": {"frames": "none", "fields": {"cell": 13, "every": 20}},
}

# Of the folders below, as the C++ of earlier versions wrote them: name, distance, floor, samples.
DISTANCES = """\
automaton,0.0016750839516659344,0.0005625,4000
automaton_local,6.651984542527245e-05,0.0005625,4000
boltzmann_translational,1.6626239785821895e-05,0.000225,10000
boltzmann_rotational,0.006861146485074077,0.000225,10000
automaton:boltzmann_translational,0.0013581460123321953,0.0007875,4000
automaton:boltzmann_rotational,0.001761497744293239,0.0007875,4000
automaton_local:boltzmann_translational,1.6634179698438167e-05,0.0007875,4000
automaton_local:boltzmann_rotational,0.005579966099212852,0.0007875,4000
"""


def sloping(slope, bins=20):
    """Shares that grow or fall along a line."""
    return [1 / bins + slope * (2 * bin + 1 - bins) / bins for bin in range(bins)]


def lines(start, shares, end):
    """Of a histogram; edges count the bins."""
    last = len(shares) - 1
    return "".join(f"{start}{i},{i + 1 if i < last else ''},{share}{end}\n" for i, share in enumerate(shares))


def write_run(folder, kind, scene, particles=0, stages=(), samples=4000.0):
    Path(folder).mkdir(exist_ok=True)
    numbers = dict.fromkeys(("seed", "steps", "wall_seconds", "step_seconds"), 0)
    numbers |= {"particle_updates_per_second": 0, "collisions_per_second": 0}
    summary = numbers | {
        "clca": "0.1.0",
        "kind": kind,
        "scene": scene,
        "threads": 1,
        "status": "done",
        "particles": particles,
        "state_hash": f"{0:016x}",
        "build": {"compiler": "", "type": ""},
        "stages": [
            {"name": name, "steps": 1, "ended": "settled", "measures": {"fluctuation_samples": samples}}
            for name in stages
        ],
    }
    (Path(folder) / "run.json").write_text(json.dumps(summary))


def write_fluctuation(stage, shares, local):
    rows = [f"{i},{i + 1},{a},{b},{1 / len(shares)}\n" for i, (a, b) in enumerate(zip(shares, local))]
    Path(f"grains/fluctuation-{stage}.csv").write_text("lower,upper,share,share_local,reference\n" + "".join(rows))


def write_gas(time, translational, rotational, particles=10_000):
    write_run("gas", "boltzmann", "gas", particles)
    parts = [("translational,", translational), ("rotational,", rotational)]
    Path(f"gas/histogram-{time}.csv").write_text(
        "energy,lower,upper,share,reference\n" + "".join(lines(name, sloping(slope), ",0.05") for name, slope in parts)
    )


def distances(folder="out"):
    with open(f"{folder}/distances.csv") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


class FolderTest(ScratchTest):
    def setUp(self):
        super().setUp()
        write_run("grains", "automaton", "shaken", stages=("packing", "shaking"))
        write_fluctuation("shaking", sloping(0.01), sloping(0.002))
        write_gas("5", 0.001, 0.02)

    def compare(self, *options):
        return clca_program("compare", "grains", "gas", "-o", "out", *options)

    def refused(self, *options, one="grains", other="gas", code=2):
        result = subprocess.run(
            [PROGRAM, "compare", one, other, "-o", "out", *map(str, options)], capture_output=True, text=True
        )
        self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (code, "", 1), result)
        self.assertEqual(sorted(path.name for path in Path("out").glob("*.csv")), [])
        return result.stderr


class CompareTest(FolderTest):
    def test_the_numbers_are_those_of_earlier_versions(self):
        said = self.compare()
        for found, expected in zip(distances().values(), csv.reader(DISTANCES.splitlines())):
            name, distance, floor, samples = expected
            self.assertEqual((found["name"], int(found["samples"])), (name, int(samples)))
            self.assertAlmostEqual(float(found["distance"]), float(distance), delta=1e-15)
            self.assertEqual(float(found["floor"]), float(floor))
            self.assertIn(f"{name:40} D_H {float(distance):.3e}, floor {float(floor):.1e}\n", said)
        self.assertTrue(said.startswith("stage shaking beside time 5\n"))
        self.assertTrue(said.endswith("\nout\n"))

    def test_puts_both_runs_into_one_table_by_quantile(self):
        self.compare()
        with open("out/comparison.csv") as file:
            rows = list(csv.reader(file))
        names = ["automaton", "automaton_local", "boltzmann_translational", "boltzmann_rotational"]
        self.assertEqual(rows[0], ["quantile_lower", "quantile_upper", *names, "reference"])
        self.assertEqual(len(rows), 21)
        last = [0.95, 1, *(sloping(slope)[-1] for slope in (0.01, 0.002, 0.001, 0.02)), 0.05]
        self.assertEqual([float(cell) for cell in rows[-1]], last)
        self.assertTrue(Path("out/comparison.png").read_bytes().startswith(b"\x89PNG"))
        measures = json.loads(Path("out/run.json").read_text())["stages"][0]["measures"]
        self.assertEqual(list(measures), [f"hellinger_{name}" for name in names])

    def test_replaces_another_comparison_but_no_run_and_no_file_of_another(self):
        self.compare()
        self.compare()
        result = subprocess.run([PROGRAM, "compare", "grains", "gas", "-o", "grains"], capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(json.loads(Path("grains/run.json").read_text())["kind"], "automaton")
        Path("sweep").mkdir()
        Path("sweep/sweep.json").write_text("{}")
        with self.assertRaisesRegex(clca.Error, "sweep: it is the folder of a sweep; write elsewhere"):
            clca.compare("grains", "gas", "sweep")
        self.assertEqual([path.name for path in Path("sweep").iterdir()], ["sweep.json"])
        Path("mine").mkdir()
        Path("mine/comparison.png").write_text("mine")
        result = subprocess.run([PROGRAM, "compare", "grains", "gas", "-o", "mine"], capture_output=True, text=True)
        self.assertIn("clca did not make the folder", result.stderr)
        self.assertEqual([path.name for path in Path("mine").iterdir()], ["comparison.png"])

    def test_takes_the_last_stage_with_a_table_and_the_latest_time_unless_told_otherwise(self):
        write_run("grains", "contact", "shaken", stages=("packing", "shaking", "rest"))
        write_fluctuation("packing", sloping(0.03), sloping(0.03))
        write_gas("0.5", 0.03, 0.03)
        write_gas("15", 0.04, 0.04)
        self.assertIn("stage shaking beside time 15\n", self.compare())
        self.assertIn("stage packing beside time 0.5\n", self.compare("--stage", "packing", "--time", 0.5))
        self.assertAlmostEqual(float(distances()["automaton:boltzmann_rotational"]["distance"]), 0, delta=1e-15)

    def test_a_stage_or_a_time_that_is_not_there_is_refused_and_those_that_are_named(self):
        self.assertRegex(self.refused("--stage", "packing"), "'packing'; there are shaking")
        self.assertRegex(self.refused("--time", 7), "time 7; there are 5")
        Path("gas/histogram-5.csv").unlink()
        self.assertIn("output.histograms", self.refused())
        Path("grains/fluctuation-shaking.csv").unlink()
        self.assertIn("output.fields", self.refused())

    def test_what_is_no_run_or_one_of_the_wrong_kind_is_refused(self):
        self.assertIn("expected a run of grains, found one of kind boltzmann", self.refused(one="gas", other="grains"))
        self.assertIn("expected a run of a gas, found one of kind automaton", self.refused(other="grains"))
        self.assertIn("is not the folder of a run", self.refused(one="."))
        self.assertIn("nowhere", self.refused(other="nowhere"))
        write_gas("5", 0.001, 0.02, particles=0)
        self.assertIn("gas: there are no particles", self.refused())
        write_run("grains", "contact", "shaken", stages=("shaking",), samples=0.0)
        self.assertIn("grains: there are no particles", self.refused())
        Path("gas/run.json").write_text("{")
        self.assertIn("run.json", self.refused())

    def test_other_bins_than_equally_probable_ones_in_the_same_number_are_refused(self):
        head, file = "energy,lower,upper,share,reference\n", Path("gas/histogram-5.csv")
        file.write_text(
            head + lines("translational,", sloping(0, 10), ",0.1") + lines("rotational,", sloping(0, 10), ",0.1")
        )
        self.assertRegex(self.refused(), "10 bins.*20")
        file.write_text(head + "translational,0,1,0.5,0.4\ntranslational,1,,0.5,0.6\n")
        self.assertIn("not equally probable", self.refused())
        file.write_text(head)
        self.assertIn("0 bins", self.refused())

    def test_a_broken_table_is_refused(self):
        head, file = "energy,lower,upper,share,reference\n", Path("gas/histogram-5.csv")
        for text in ("", "energy,lower,upper\n", head + "translational,0\n"):
            file.write_text(text)
            self.assertIn("histogram-5.csv", self.refused(), text)
        for share in ("nan", "", "1e", "-0.1", "0.9"):
            file.write_text(head + f"translational,0,,{share},1\n")
            self.assertIn("histogram-5.csv", self.refused(), share)

    def test_the_restitution_is_chosen_where_there_are_several(self):
        text = "restitution,energy,lower,upper,share,share_se,reference\n"
        for slope, restitution in ((0.01, 0.5), (0.02, 0.9)):
            for energy in ("translational", "rotational"):
                text += lines(f"{restitution},{energy},", sloping(slope), ",0.001,0.05")
        Path("gas/histogram-5.csv").write_text(text)
        self.compare("--restitution", 0.5)
        self.assertAlmostEqual(float(distances()["automaton:boltzmann_rotational"]["distance"]), 0, delta=1e-15)
        for path in Path("out").iterdir():
            path.unlink()
        self.assertIn("0.5, 0.9", self.refused())
        self.assertIn("0.5, 0.9", self.refused("--restitution", 0.7))
        write_gas("5", 0, 0)
        self.assertIn("no column 'restitution'", self.refused("--restitution", 0.9))

    def test_the_rotation_of_spheres_that_do_not_spin_is_left_out(self):
        Path("gas/histogram-5.csv").write_text(
            "energy,lower,upper,share,reference\n"
            + lines("translational,", sloping(0), ",0.05")
            + lines("rotational,", 20 * [0], ",0.05")
        )
        self.compare()
        self.assertEqual(len(distances()), 5)

    def test_a_folder_that_cannot_be_written_is_a_failure(self):
        Path("out").write_text("")
        self.assertIn("out", self.refused(code=1))


class PythonTest(FolderTest):
    def test_it_gives_the_files_of_the_command_as_a_run(self):
        self.compare("--stage", "shaking", "--time", 5)
        found = clca.compare("grains", clca.Run("gas"), stage="shaking", time=5)
        self.assertEqual(found.folder, self.folder / "renders/comparison")
        for name in ("comparison.csv", "distances.csv", "run.json"):
            self.assertEqual((found.folder / name).read_bytes(), Path("out", name).read_bytes())
        self.assertEqual(found.table("distances").names, ("name", "distance", "floor", "samples"))
        self.assertAlmostEqual(found.measures["shaking"]["hellinger_automaton"], 0.0016750839516659344)
        ax = found.plot("comparison")
        self.assertEqual(len(ax.lines), 5)
        pyplot.close("all")

    def test_the_command_and_python_write_over_one_another_and_over_nothing_else(self):
        clca.compare("grains", "gas", "out")
        self.compare()
        clca.compare("grains", "gas", "out")
        Path("mine").mkdir()
        Path("mine/distances.csv").write_text("mine")
        with self.assertRaisesRegex(clca.Error, r"mine: clca did not make the folder, and there are files in it \(distances.csv\)"):
            clca.compare("grains", "gas", "mine")
        self.assertEqual(Path("mine/distances.csv").read_text(), "mine")
        with self.assertRaisesRegex(clca.Error, "found one of kind boltzmann"):
            clca.compare("gas", "grains")
        with self.assertRaisesRegex(clca.Error, "there is a run of kind boltzmann in it"):
            clca.compare("grains", "gas", "gas")
        Path("file").write_text("")
        with self.assertRaisesRegex(clca.Error, "cannot write .*/file: "):
            clca.compare("grains", "gas", "file")


class RunTest(ScratchTest):
    def test_a_run_on_several_threads_has_the_same_table_and_one_without_fields_none(self):
        table = "fluctuation-shaking.csv"
        one, three = (clca.run(SHAKEN, threads=count, output=f"of{count}") for count in (1, 3))
        self.assertEqual((one.folder / table).read_bytes(), (three.folder / table).read_bytes())
        write_gas("5", 0.001, 0.02)
        self.assertIn("stage shaking beside time 5\n", clca_program("compare", "of1", "gas"))
        self.assertTrue(Path("renders/comparison/comparison.csv").exists())
        clca.run(SHAKEN, set={"output.fields": None}, output="of1")
        self.assertFalse((one.folder / table).exists())


if __name__ == "__main__":
    unittest.main()
