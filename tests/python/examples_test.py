"""The examples run, and print what they should."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

from support import ScratchTest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples/python"


class ExamplesTest(ScratchTest):
    def printed(self, name, *arguments):
        return subprocess.run([sys.executable, "-W", "error", EXAMPLES / name, *arguments], check=True,
                              capture_output=True, text=True).stdout

    def numbers(self, pattern, text):
        found = re.search(pattern, text)
        self.assertTrue(found, f"no {pattern} in\n{text}")
        return [float(number) for number in found.groups()]

    def test_the_flow_test_has_the_papers_slope_and_run_out(self):
        text = self.printed("wall_removal.py")
        # 43 to 50 degrees and 27 to 32 spacings: docs/phenomena.md, "What the tests check".
        slope, error = self.numbers(r"repose_right_deg: (\S+) \+- (\S+)", text)
        self.assertTrue(43 < slope < 50 and 0 < error < 2, text)
        runout, error = self.numbers(r"runout_99: (\S+) \+- (\S+)", text)
        self.assertTrue(27 < runout < 32 and 0 < error < 3, text)

    def test_inertia_lowers_the_slope(self):
        text = self.printed("parameter_study.py")
        (first,) = self.numbers(r"\n +0\.00 +(\S+) ", text)
        (last,) = self.numbers(r"\n +0\.98 +(\S+) ", text)
        self.assertGreater(first, last + 10, text)

    def test_the_gate_opens_when_the_bed_is_level(self):
        text = self.printed("open_when_level.py", "end.png")
        (before,) = self.numbers(r"at rest, the surface is even to (\S+) spacings", text)
        (level,) = self.numbers(r": even to (\S+) spacings, the gate opens", text)
        self.assertTrue(level <= 3 < before, text)
        (runout,) = self.numbers(r"settled, run-out (\S+) spacings", text)
        self.assertGreater(runout, 2, text)
        self.assertEqual(Path("end.png").read_bytes()[:4], b"\x89PNG")

    def test_the_distance_from_chi_square_is_largest_at_middle_restitutions(self):
        # Ogawa & Kato 1982, Fig. 3: about 0.02 at 0.5 and time 15, hardly any for elastic spheres.
        text = self.printed("ogawa_kato_fig3.py")
        ends = {}
        for restitution in ("0.2", "0.5", "1.0"):
            (ends[restitution],) = self.numbers(rf"\n +{re.escape(restitution)} .* (\S+)\n", text)
        self.assertAlmostEqual(ends["0.5"], 0.02, delta=0.005)
        self.assertLess(ends["1.0"], 0.003)
        self.assertTrue(ends["1.0"] < ends["0.2"] < ends["0.5"], text)


if __name__ == "__main__":
    unittest.main()
