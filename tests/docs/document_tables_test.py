"""Tables of the documents are those of bench/document-tables."""

import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TOOL = ROOT / "bench/document-tables"
sys.path.insert(0, str(ROOT / "bench"))
from document_tables import pages  # noqa: E402
from document_tables.table import Cell, Line, OutOfTime, Table, bare, robust, scattered, until_clog, with_range  # noqa: E402
from document_tables.tables import TABLES  # noqa: E402

PAGE = """Text.

<!-- table: outflow -->

| D/d | 8 | 10 | DEM |
|---|---|---|---|
| outflow | 15.0 ± 0.3 | 22.9 ± 0.5 | <!-- dem: x -->16.6<!-- / --> |
| clogged | 1 of 4 | 0 of 4 | |

More.
"""


class SomeRuns:
    """Two runs in place of a program: of each column what `numbers` say."""

    late = False

    def __init__(self, **numbers):
        self.numbers = numbers

    def taken(self, scene, seeds, arguments, source, begin):
        name = arguments[-1]
        if name not in self.numbers:
            raise OutOfTime
        return self.numbers[name]


def runs(*outflows):
    return [{"outflow": outflow, "clogged": False} for outflow in outflows]


TABLE = Table("page.md", "outflow", "silo", [Line("outflow", key="outflow", decimals=1), Line("clogged", key="clogged")],
              [Line("8", ["w=8"]), Line("10", ["w=10"])], source=len)


def script():
    loader = importlib.machinery.SourceFileLoader("document_tables_script", str(TOOL))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def faults(text, tables=(TABLE,)):
    return "\n".join(pages.faults_of_form(text, "page.md", tables))


class ThePages(unittest.TestCase):
    def test_each_mark_has_a_table_with_the_same_titles_and_numbers_that_can_be_read(self):
        found = [fault for page in sorted((ROOT / "docs").glob("*.md"))
                 for fault in pages.faults_of_form(page.read_text(encoding="utf-8"), page.name, TABLES)]
        self.assertEqual(found, [])

    def test_no_two_tables_of_a_page_and_no_two_lines_of_a_table_have_one_name(self):
        names = [(table.page, table.name) for table in TABLES]
        self.assertEqual(len(names), len(set(names)))
        for table in TABLES:
            for lines in (table.rows, table.columns):
                self.assertEqual(len(lines), len({line.title for line in lines}), table.name)

    def test_a_page_that_differs_in_form_is_told(self):
        self.assertEqual(faults(PAGE), "")
        self.assertIn("no mark", faults(PAGE.replace("table: outflow", "outflow")))
        self.assertIn("no such table", faults(PAGE, ()))
        self.assertIn("titles of rows", faults(PAGE.replace("| clogged |", "| jammed |")))
        self.assertIn("titles of columns", faults(PAGE.replace("| D/d | 8 |", "| D/d | 9 |")))
        self.assertIn("'about 15'", faults(PAGE.replace("15.0 ± 0.3", "about 15")))
        self.assertIn("cells", faults(PAGE.replace(" | 0 of 4 | |", " |")))


class Cells(unittest.TestCase):
    def test_what_a_page_says(self):
        self.assertEqual(scattered([1.0, 2.0, 3.0], 1).text, "2.0 ± 1.0")
        self.assertEqual(scattered([1234.0], 0).text, "1,234")
        self.assertEqual(bare([-0.001, 0.0], 2).text, "0.00")
        self.assertEqual(bare([True, False, True], 2).text, "2 of 3")
        self.assertEqual(with_range([1.0, 3.0], 0).text, "2 ± 1 (1 to 3)")
        self.assertEqual(robust([1.0, 2.0, 9.0], 0).text, "2 (1 to 9)")
        self.assertEqual(until_clog([(3, True), (5, True), (10, False)], 1).text, "9.0 ± 6.4")
        self.assertEqual(until_clog([(10, False)], 1).text, "")

    def test_the_readers_form_of_all_cells(self):
        for text in ("2.0 ± 1.0", "1,234", "-0.31 ± 0.01", "2 of 3", "157 ± 81 (13 to 259)", "0.82 (0.37 to 2.09)"):
            self.assertTrue(pages.CELL.fullmatch(text), text)
        for text in ("about 3", "3 d", "", "1 of", "±"):
            self.assertFalse(pages.CELL.fullmatch(text), text)

    def test_a_difference_of_four_standard_errors_and_a_last_digit_is_allowed(self):
        values = [9.0, 10.0, 11.0, 10.0]
        error = statistics.stdev(values) / 2 * 2**0.5  # of the difference, the page having the same scatter
        cell = scattered(values, 1)
        self.assertTrue(pages.agrees(f"{10 + 4 * error:.1f} ± 0.8", cell, 4))
        self.assertFalse(pages.agrees(f"{10 + 4 * error + 0.2:.1f} ± 0.8", cell, 4))
        self.assertFalse(pages.agrees(f"{10 + 4 * error + 0.2:.1f}", cell, 4))
        self.assertTrue(pages.agrees(f"{10 + 4 * error + 0.2:.1f} ± 2.0", cell, 4))
        self.assertTrue(pages.agrees("1,240 ± 10", Cell("1,239", 1239.0, 10.0, 4), 4))

    def test_of_a_sweep_cut_short_the_page_has_more_seeds(self):
        self.assertTrue(pages.agrees("10.0 ± 1.0", Cell("13.5", 13.5, 1.0, 2), 2))
        self.assertFalse(pages.agrees("10.0 ± 1.0", Cell("13.5", 13.5, 1.0, 2), 128))

    def test_shares_and_cells_without_a_number(self):
        all_of_four = bare([True] * 4, 0)
        self.assertTrue(pages.agrees("3 of 4", all_of_four, 4))
        self.assertFalse(pages.agrees("0 of 40", bare([True] * 40, 0), 40))
        self.assertTrue(pages.agrees("", Cell(), 4))
        self.assertFalse(pages.agrees("1.0", Cell(), 4))
        self.assertFalse(pages.agrees("", all_of_four, 4))


class TheTool(unittest.TestCase):
    def test_what_is_measured_is_written_and_the_rest_stays(self):
        measured = script().measured(TABLE, SomeRuns(**{"w=8": runs(1.0, 3.0), "w=10": runs(5.0, 7.0)}))
        text = pages.written(PAGE, TABLE, measured)
        self.assertIn("| outflow | 2.0 ± 1.4 | 6.0 ± 1.4 | <!-- dem: x -->16.6<!-- / --> |\n| clogged | 0 of 2 | 0 of 2 | |\n\nMore.", text)
        self.assertEqual(text.split("| outflow")[0], PAGE.split("| outflow")[0])
        self.assertEqual(faults(text), "")

    def check(self, numbers):
        tool = script()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
            tool.DOCS = pathlib.Path(folder)
            (tool.DOCS / "page.md").write_text(PAGE.replace("1 of 4", "0 of 4"), encoding="utf-8")
            failed = tool.check([TABLE], SomeRuns(**numbers), random.Random(1))
        return bool(failed), said.getvalue()

    def test_a_check_passes_where_all_cells_agree(self):
        self.assertEqual(self.check({"w=8": runs(14.8, 15.2), "w=10": runs(22.5, 23.2)}), (False, "4 cells compared, 0 differ\n"))

    def test_a_check_names_page_table_cell_and_both_numbers(self):
        failed, said = self.check({"w=8": runs(14.8, 15.2), "w=10": runs(32.5, 33.2)})
        self.assertTrue(failed)
        self.assertIn("page.md, outflow, 'outflow', '10': the page has '22.9 ± 0.5', measured '32.9 ± 0.5'", said)

    def test_a_check_that_has_compared_nothing_in_time_fails(self):
        self.assertEqual(self.check({}), (True, "0 cells compared, 0 differ\n"))

    def test_help_needs_no_package_and_what_is_missing_is_one_line(self):
        bare_python = [sys.executable, "-S", "-E", str(TOOL)]  # without numpy and clca
        shown = subprocess.run([*bare_python, "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        self.assertIn("--check", shown.stdout)
        failed = subprocess.run(bare_python, capture_output=True, text=True, check=False)
        self.assertEqual(failed.returncode, 1)
        self.assertRegex(failed.stderr, r"\A.*numpy.*\n\Z")


if __name__ == "__main__":
    unittest.main()
