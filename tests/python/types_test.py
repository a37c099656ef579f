"""The types of the package hold, and the stubs of the module say what it has."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import needs

TREE = Path(__file__).resolve().parents[2]


class TypesTest(unittest.TestCase):
    def setUp(self):
        needs("mypy")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def check(self, *arguments):
        environment = os.environ | {"MYPYPATH": str(TREE / "src/python"), "MYPY_CACHE_DIR": str(self.folder / "cache")}
        result = subprocess.run([sys.executable, "-m", *arguments], cwd=self.folder, env=environment,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_the_package_is_typed(self):
        self.check("mypy", "--strict", "-p", "clca")

    def test_examples_use_it_rightly(self):
        files = sorted(map(str, (TREE / "examples/python").glob("*.py")))
        self.assertTrue(files)
        self.check("mypy", "--check-untyped-defs", "--ignore-missing-imports", *files)

    def test_the_stubs_are_those_of_the_module(self):
        # pybind11's classes have a metaclass of their own.
        allowed = self.folder / "allowed"
        allowed.write_text("".join(f"clca._clca.{name}\n" for name in ("Gas", "Scene", "Simulation")))
        self.check("mypy.stubtest", "clca._clca", "--ignore-positional-only", "--allowlist", str(allowed))


if __name__ == "__main__":
    unittest.main()
