"""Holds scripts/check-layers, the first argument, to what it finds in small trees."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = sys.argv.pop(1)
TABLE = "| layer | module |\n|---|---|\n| 1 | `high` |\n| 0 | `low` |\n| 0 | `beside` |\n"


def found(files, table=TABLE):
    """The messages about a tree of these files, line by line."""
    with tempfile.TemporaryDirectory() as folder:
        tree = {"CONTRIBUTING.md": table, "src/high/a.cpp": "", "src/low/a.cpp": "", "src/beside/a.cpp": ""} | files
        for name, text in tree.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        run = subprocess.run([CHECK, folder], capture_output=True, text=True, check=False)
        lines = run.stderr.splitlines()
        assert run.returncode == (1 if lines else 0)
        return lines


class CheckLayers(unittest.TestCase):
    def test_includes_downwards_and_of_the_module_itself_are_right(self):
        text = '#include "clca/low/a.hpp"\n#include "clca/high/a.hpp"\n#include "high/b/c.hpp"\n#include <vector>\n'
        self.assertEqual(found({"src/high/b/c.cpp": text}), [])

    def test_includes_upwards_and_sideways_are_wrong(self):
        self.assertEqual(
            found({"include/clca/low/a.hpp": '\n#include "clca/high/a.hpp"\n#include "clca/beside/a.hpp"\n'}),
            [
                "include/clca/low/a.hpp:2: error: module 'low' (layer 0) includes 'high' (layer 1)",
                "include/clca/low/a.hpp:3: error: module 'low' (layer 0) includes 'beside' (layer 0)",
            ],
        )

    def test_private_headers_of_others_are_wrong(self):
        self.assertEqual(
            found({"src/high/a.cpp": '#include "low/a.hpp"\n'}),
            ["src/high/a.cpp:1: error: module 'high' includes a private header of 'low'"],
        )

    def test_internal_headers_are_for_the_sources_above(self):
        text = '#include "low/internal/a.hpp"\n'
        self.assertEqual(found({"src/high/a.cpp": text}), [])
        self.assertEqual(
            found({"src/beside/b.cpp": text}),
            ["src/beside/b.cpp:1: error: module 'beside' (layer 0) includes 'low' (layer 0)"],
        )

    def test_private_headers_in_public_ones_are_wrong(self):
        for text in ('#include "low/a.hpp"\n', '#include "low/internal/a.hpp"\n'):
            self.assertEqual(
                found({"include/clca/low/a.hpp": "#include <sys/types.h>\n" + text}),
                ["include/clca/low/a.hpp:2: error: module 'low' includes a private header in a public one"],
            )

    def test_modules_and_table_agree(self):
        self.assertEqual(
            found({"src/new/a.cpp": ""}, TABLE + "| 0 | `gone` |\n"),
            [
                "CONTRIBUTING.md: error: module 'new' is not in the table of layers",
                "CONTRIBUTING.md: error: there is no module 'gone'",
            ],
        )

    def test_a_table_is_needed(self):
        self.assertIn("CONTRIBUTING.md: error: there is no table of layers", found({}, "no table\n"))


unittest.main()
