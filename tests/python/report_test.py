"""The page of a run, a gas or a sweep: what is on it, what is left out, and that text of files stays text."""

import json
import math
import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import unittest
import warnings
import xml.etree.ElementTree as xml
import zlib
from html.parser import HTMLParser
from pathlib import Path

import clca
import numpy
from clca import _report
from clca._chart import Chart, Curve, FileFormat, Panel, figure_bytes
from support import CONTACT, GAS, PROGRAM, SCENE, ScratchTest, clca_program

EVIL = "</pre></script><script>alert(1)</script>]]>\"'&\x1b[2J\x00"
VOID = {"meta", "img", "input", "br", "wbr"}


class Markup(HTMLParser):
    """A page as a browser reads it. Elements are closed in order, and no id comes twice outside of figures."""

    def __init__(self, page):
        super().__init__()
        self.elements, self.ids, self.open, self.texts = [], [], [], {}
        self.feed(page)
        self.close()
        assert not self.open, self.open
        assert len(set(self.ids)) == len(self.ids), self.ids

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if "svg" not in self.open and tag != "svg":
            self.ids += [value for name, value in attributes if name == "id"]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, (tag, self.open)

    def handle_data(self, data):
        for tag in self.open:
            self.texts[tag] = self.texts.get(tag, "") + data

    def all(self, tag, **attributes):
        return [found for name, found in self.elements if name == tag and attributes.items() <= found.items()]


def png(width=40, height=30, size=0):
    """White; with as many bytes as asked for."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = zlib.compress(b"".join(b"\0" + b"\xff" * (3 * width) for _ in range(height)))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    whole = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")
    return whole + b"\0" * (size - len(whole))


class PageTest(ScratchTest):
    """With a run as it could be, in `run`."""

    def setUp(self):
        super().setUp()
        stages = [
            {"name": "packing", "steps": 20, "ended": "settled",
             "measures": {"packing_fraction": 0.8125, "repose_angle_deg": None, "clogged": True, "mean": 1.25, "mean_se": 0.01}},
            {"name": "flow", "steps": 10, "ended": "steps", "measures": {"packing_fraction": 0.5, "unheard_of": 3}},
        ]
        measures = [
            {"key": "packing_fraction", "name": "Packing fraction", "meaning": "of the bed"},
            {"key": "repose_angle_deg", "name": "Slope", "unit": "degrees", "of_floor": True},
            {"key": "runout_99", "name": "Run-out", "unit": "spacings", "of_floor": True},
            {"key": "repose_gravity_deg", "name": "Slope against gravity", "unit": "degrees"},
            {"key": "vessel_angle_deg", "name": "Angle of the vessel", "unit": "degrees"},
        ]
        self.run = {
            "clca": "0.1.0", "kind": "automaton", "scene": "small", "title": "A small run", "seed": 7, "threads": 1, "status": "done",
            "particles": 30, "steps": 30, "wall_seconds": 0.25, "particle_updates_per_second": 5e6, "state_hash": "00000000000000ab",
            "build": {"compiler": "GNU 12.2.0", "type": "Release"}, "stages": stages, "measures": measures, "tables": {},
        }
        self.write("scene.yaml", "clca: 1\ntitle: A small run\n")

    def write(self, name, content):
        file = self.folder / "run" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode(errors="surrogatepass"))

    def page(self, name="run", max_frames=None):
        """The page, and its text; warnings are in `warned`."""
        if name == "run":
            self.write("run.json", json.dumps(self.run))
        page, self.warned = _report.report_page(clca.open(name), max_frames)
        self.html = page.decode()
        for svg in re.findall(r"<svg.*?</svg>", self.html, re.DOTALL):
            xml.fromstring(svg)
        for warning in self.warned:
            self.assertIn("<li>" + str(_report.escape(warning)), self.html)
        return Markup(self.html)

    def assertHas(self, *texts):
        for text in texts:
            self.assertIn(text, self.html)

    def assertWarned(self, *patterns):
        self.assertEqual(len(self.warned), len(patterns), self.warned)
        for pattern in patterns:
            self.assertTrue(any(re.search(pattern, warning) for warning in self.warned), (pattern, self.warned))


class ReportTest(PageTest):
    """Of folders made for the test."""

    def test_a_run_without_pictures_and_tables_has_what_there_is(self):
        page = self.page()
        self.assertWarned()
        self.assertEqual(page.texts["h1"], "A small run")
        self.assertHas("Packing fraction", "<small>of the bed</small>", "0.8125", "unheard_of", '<td data-of="packing">yes</td>',
                       "1.250<small> ± 0.010</small>", "clca run small.yaml --seed 7 -o small", "5\u202f000\u202f000")
        self.assertEqual([link["href"] for link in page.all("a") if link["href"].startswith("#")], ["#measures", "#repeat"])

    def test_the_same_folder_gives_the_same_bytes(self):
        self.write("series.csv", "step,stage,moving_share\n0,packing,0.5\n1,packing,0.2\n")
        self.write("frames/small-000020.png", png())
        self.page()
        first = self.html
        self.page()
        self.assertEqual(self.html, first)

    def test_it_needs_nothing_from_elsewhere(self):
        self.write("frames/small-000030.png", png())
        self.write("series.csv", "step,stage,moving_share\n0,packing,0.5\n1,packing,0.2\n")
        page = self.page()
        self.assertHas("<svg", "default-src 'none'")
        self.assertNotRegex(re.sub(r"<svg.*?</svg>", "", self.html, flags=re.DOTALL), "https?://|@import")
        sources = [value for _, found in page.elements for key, value in found.items() if key in ("src", "href") and value]
        self.assertTrue(all(source.startswith(("data:", "#")) for source in sources))

    def test_text_of_files_stays_text(self):
        stage, name = self.run["stages"][0], "<script>alert(1)<script>]]>\"'&"
        self.run |= {"scene": name, "title": EVIL, "status": EVIL, "clca": EVIL}
        stage |= {"name": name, "ended": EVIL}
        stage["measures"][EVIL] = 1.0
        self.run["measures"].append({"key": EVIL, "name": EVIL, "unit": EVIL, "meaning": EVIL, "of": EVIL})
        self.run["tables"] = {"series": [{"key": "moving_share", "name": EVIL, "unit": EVIL}]}
        self.write("scene.yaml", EVIL.encode() + b"\xff")
        self.write("series.csv", f'step,stage,moving_share\n0,"{name.replace(chr(34), chr(39))}",0.5\n1,b,1\n')
        self.write("walls-flow.csv", "wall,\"<script>alert(1)\"\n</td><script>alert(1),2\n")
        self.write("profile-<script>.csv", "x,height_end\n0,1\n1,2\n")
        self.write("frames/small-000020.png", png())
        page = self.page()
        self.assertEqual((len(page.all("script")), len(page.all("pre")), len(page.all("title"))), (1, 2, 1))
        self.assertNotIn("<script>alert", self.html)
        self.assertNotRegex(self.html, "[\0\x1b]")
        self.assertEqual(page.texts["h1"], EVIL.replace("\x1b", "\ufffd").replace("\0", "\ufffd"))
        self.assertEqual(len(page.all("svg")), 1)
        self.run["title"] = "\ud800"  # JSON can say it, UTF-8 cannot
        self.assertEqual(self.page().texts["h1"], "\ufffd")

    def test_titles_of_figures_stay_text_in_svg(self):
        chart = Chart("name", "about", 0, lambda: [Panel([Curve(EVIL, [0, 1], [0, 1])], title=EVIL)], EVIL)
        svg = xml.fromstring(figure_bytes(chart, FileFormat("svg")))
        said = "".join(svg.itertext())
        self.assertIn("</script>", said)
        self.assertIn("]]>", said)
        self.assertFalse(list(svg.iter("{http://www.w3.org/2000/svg}script")))

    def test_what_cannot_be_read_is_left_out_with_a_warning(self):
        self.write("series.csv", "step,stage,moving_share,mean_height\n0,packing,0.5,1\n1,packing,x,2\n")
        self.write("profile-flow.csv", "x,height_end\n0,1,2\n")
        self.write("cycles.csv", "")
        self.write("walls-flow.csv", b"wall,force\n\xff,1\n")
        os.symlink("missing", self.folder / "run/fields.csv")
        self.write("frames/small-000020.png", b"\1\2\3")
        page = self.page()
        self.assertEqual([found["id"] for found in page.all("figure")], ["figure-mean-height"])
        self.assertWarned(
            "^series.csv: line 3: 'x' in column 'moving_share' is no number", "^cannot read profile-flow.csv: line 2: cut off",
            "^cannot read cycles.csv: line 1: cut off", "small-000020.png is left out: it is no PNG", "^cannot read fields.csv: No such",
            "^cannot read walls-flow.csv: .*UTF-8")

    def test_a_figure_that_fails_does_not_take_the_page_with_it(self):
        self.write("series.csv", "step,stage,moving_share,mean_height\n0,packing,0.5,1\n1,packing,0.2,2\n")
        self.addCleanup(setattr, _report, "figure_bytes", _report.figure_bytes)

        def failing(chart, look):
            if chart.name == "motion":
                raise ValueError("<no>")
            return figure_bytes(chart, look)

        _report.figure_bytes = failing
        self.page()
        self.assertHas("figure-mean-height")
        self.assertWarned("figure motion is left out: <no>")

    def test_a_folder_that_is_no_run_is_refused(self):
        for content, message in (("{", "cut off or no JSON"), (json.dumps(self.run | {"kind": "comparison"}), "kind 'comparison'")):
            self.write("run.json", content)
            with self.assertRaisesRegex(clca.Error, f"run.json: .*{message}"):
                clca.open("run").report()
            self.assertFalse(Path("run/report.html").exists())

    def test_a_damaged_run_is_refused_with_what_is_wrong(self):
        for changed, place in (
            ({"scene": 5}, "scene"), ({"steps": "x"}, "steps"), ({"steps": True}, "steps"), ({"seed": 10**400}, "seed"),
            ({"state_hash": "x"}, "state_hash"), ({"stages": [1]}, "stages.0"), ({"stages": {}}, "stages"),
            ({"stages": [self.run["stages"][0] | {"measures": {"a.b": "c"}}]}, "stages.0.measures.a.b"),
            ({"measures": [{"key": "a"}]}, "measures.0.name"), ({"tables": {"series": 3}}, "tables.series"),
            ({"units": {"time": "s"}}, "units.velocity"), ({"build": []}, "build"), ({"wall_seconds": None}, "wall_seconds"),
        ):
            self.write("run.json", json.dumps(self.run | changed))
            with self.assertRaisesRegex(clca.Error, f"^cannot read .*/run.json: '{place}' is missing or not what it should be$"):
                clca.open("run")
        for missing in ("build", "threads", "wall_seconds"):
            self.write("run.json", json.dumps({key: value for key, value in self.run.items() if key != missing}))
            with self.assertRaisesRegex(clca.Error, f"^cannot read .*{missing}"):
                clca.open("run").report()
        self.write("run.json", json.dumps(self.run))
        self.write("series.csv", "step,\n0,1\n")
        with self.assertRaisesRegex(clca.Error, "^cannot read .*series.csv: line 1: cut off or no row of the table$"):
            clca.open("run").series._repr_html_()

    def test_a_page_does_not_replace_what_runs_have_left(self):
        self.write("run.json", json.dumps(self.run))
        self.write("trajectory/part-000000.h5", "")
        (self.folder / "link").symlink_to("run")
        for name in ("run.json", "scene.yaml", "sweep.json", "log.txt", "series.csv", ".clca.manifest", "checkpoint.clca",
                     "trajectory.h5", "trajectory/part-000000.h5", "../link/run.json", "frames/../run.json"):
            (self.folder / "run/frames").mkdir(exist_ok=True)
            before = {file: file.read_bytes() for file in Path("run").rglob("*") if file.is_file()}
            message = "cannot write .*: a file of that name belongs to what clca has left in "
            with self.assertRaisesRegex(clca.Error, message):
                clca.open("run").report(f"run/{name}")
            if name in ("run.json", "trajectory/part-000000.h5"):
                told = subprocess.run([PROGRAM, "report", "run", "-o", f"run/{name}"], capture_output=True, text=True)
                self.assertEqual(told.returncode, 2, name)
                self.assertRegex(told.stderr, message)
            self.assertEqual(before, {file: file.read_bytes() for file in Path("run").rglob("*") if file.is_file()})
        shutil.rmtree("run/trajectory")
        for name in ("report.html", "my.html", "frames/a.html", "../run.json"):
            self.assertTrue(clca.open("run").report(f"run/{name}").exists())
        with self.assertRaisesRegex(clca.Error, message):
            numpy.zeros((2, 2, 3), numpy.uint8).view(clca.Picture).save("run/run.json")

    def test_a_run_without_title_or_scene_says_so(self):
        self.run["title"] = ""
        (self.folder / "run/scene.yaml").unlink()
        self.assertEqual(self.page().texts["h1"], "small")
        self.assertWarned("cannot read scene.yaml: No such file")

    def test_pictures_are_chosen_evenly_and_at_the_ends_of_stages(self):
        for step in range(31):
            self.write(f"frames/small-{step:06}.png", png())
        page = self.page()
        self.assertHas("All 31 pictures", "End of <b>packing</b>, step 20")
        self.assertEqual([(end["width"], end["height"]) for end in page.all("img") if "end-" in end.get("id", "")], 2 * [("40", "30")])
        frames = page.all("data")
        self.assertEqual((len(frames), frames[-1]["data-same"], frames[-1]["data-words"]), (31, "end-2", "Step 30, stage flow"))
        self.assertIn("data-image", frames[19])
        self.assertEqual([frame["data-step"] for frame in self.page(max_frames=4).all("data")], ["0", "10", "20", "30"])
        self.assertHas("4 of 31 pictures, evenly chosen;")
        self.assertEqual(self.page(max_frames=0).all("data"), [])
        self.assertHas("End of <b>flow</b>")

    def test_the_page_stays_below_20_megabytes_however_many_pictures_there_are(self):
        for step in range(2000):  # 80 MB
            self.write(f"frames/small-{step:06}.png", png(size=40_000))
        self.page()
        self.assertHas(" of 2000 pictures, evenly chosen to keep this page below some 20 MB")
        self.assertTrue(18 << 20 < len(self.html) < 20 << 20, len(self.html))

    def test_movies_and_pictures_drawn_again_are_on_it(self):
        self.write("flow.mp4", "a movie")
        self.write("small.gif", "another one")
        for step in range(0, 300, 10):
            self.write(f"render/small-{step:06}.png", png())
        self.page()
        self.assertHas("media-src data:", 'src="data:video/mp4;base64,YSBtb3ZpZQ=="', 'src="data:image/gif;base64,', "<code>flow.mp4</code>",
                       "12 of 30 pictures of <code>render/</code>, evenly chosen.", "<figcaption>step 290</figcaption>")
        self.assertWarned()
        self.write("flow.mp4", b"a" * (8 << 20))
        self.page()
        self.assertNotIn("<video", self.html)
        self.assertWarned("flow.mp4 is left out")

    def test_what_is_measured_along_the_floor_of_a_turned_vessel_is_left_out(self):
        level, turned = (stage["measures"] for stage in self.run["stages"])
        level |= {"repose_angle_deg": 11.5, "vessel_angle_deg": 0, "repose_gravity_deg": 12.5}
        turned |= {"repose_angle_deg": 21.5, "vessel_angle_deg": 30, "repose_gravity_deg": 22.5, "runout_99": 23.5}
        self.page()
        self.assertHas("11.50", "12.50", "22.50", "is left out")
        for gone in ("21.5", "23.5", "runout_99"):
            self.assertNotIn(gone, self.html)
        turned["vessel_angle_deg"] = 0
        self.page()
        self.assertHas("21.50", "runout_99")
        self.assertNotIn("is left out", self.html)

    def test_walls_have_names_and_units(self):
        self.run["tables"] = {"walls": [{"key": "force_y", "name": "Force on the wall", "of": "y", "unit": "grain weights"}]}
        self.write("walls-flow.csv", "wall,contacts,force_y\nbox.floor,3,-2\nplate,,0.125\n")
        self.page()
        self.assertHas('<td data-of="Force on the wall, y (grain weights)">−2.000</td>', '<td data-of="contacts">–</td>', ">0.125<")

    def test_a_run_with_units_is_in_these(self):
        self.run["units"] = {"length": "m", "time": "s", "velocity": "m/s", "spacing": 0.001, "time_step": 0.0005}
        self.write("frames/small-000020.png", png())
        self.page()
        self.assertHas("<dt>Time</dt><dd>0.0150 s</dd>", '<td data-of="packing">20 (0.0100 s) ', "End of <b>packing</b>, step 20, t = 0.0100 s",
                       'data-words="Step 20, t = 0.0100 s, stage packing"')

    def test_numbers_are_readable_however_large_or_small(self):
        infinity = math.inf
        for number, error, text in (
            (0.8125, None, "0.8125"), (12345.678, None, "12\u202f346"), (-0.25, 0.013, "−0.250 ± 0.013"), (0.029754, 0.000192, "0.02975 ± 0.00019"), (3, None, "3"), (0, 0.01, "0 ± 0.010"),
            (1e308, infinity, "1.00 × 10³⁰⁸"), (-1e308, None, "−1.00 × 10³⁰⁸"), (1e-320, None, "1.00 × 10⁻³²⁰"), (infinity, None, "∞"),
            (0.75, 1e300, "1 ± 1.00 × 10³⁰⁰"), (math.nan, 1.0, "–"), (None, None, "–"), (True, None, "yes"), (9.9999e9, 1e7, "1.00 × 10¹⁰ ± 1.00 × 10⁷"),
        ):
            rows, _ = _report.measured_rows([{"x": (number, error)}], lambda key: clca._table.Quantity(key))
            self.assertEqual(" ± ".join(filter(None, rows[0][2][0])), text, number)

    def test_names_between_backticks_are_code(self):
        self.assertEqual(_report.with_code_markup("as `a_b`, <x>"), "as <code>a_b</code>, &lt;x&gt;")
        self.assertEqual(_report.rendered_html("notebook.html", said="", columns=["a"], notes=[], parts=[("", [(
            "x", clca._table.Quantity("X", description="as `y`"), [("1", "")])], False)]).count(b"as <code>y</code>"), 1)

    def test_a_page_needs_no_compiled_part(self):
        self.page()
        first = self.html
        code = """
import sys
sys.modules["clca._clca"] = None
import clca
print(clca.open("run").report("page.html"))
"""
        said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.strip(), str(self.folder / "page.html"))
        self.assertEqual((self.folder / "page.html").read_text(), first)


class OfRunsTest(PageTest):
    """Of folders as runs leave them."""

    def test_pictures_come_from_the_trajectory_where_the_run_has_none(self):
        run = clca.run(SCENE, output="drawn")
        page = self.page("drawn")
        self.assertWarned()
        frames = page.all("data")
        self.assertTrue(8 <= len(frames) <= 12, len(frames))
        self.assertHas(f"{len(frames)} of {len(run.frames)} frames of the trajectory, drawn for this page", "End of <b>packing</b>")
        self.addCleanup(sys.modules.__setitem__, "clca._clca", sys.modules["clca._clca"])
        compiled = clca.__dict__.pop("_clca")
        self.addCleanup(setattr, clca, "_clca", compiled)
        sys.modules["clca._clca"] = None
        self.assertEqual(self.page("drawn").all("data"), [])
        self.assertWarned()
        self.assertHas("The run has no pictures. <code>clca render</code>")

    def test_a_gas_and_a_run_of_contacts_have_their_figures(self):
        clca.run(GAS, output="gas")
        clca.run(CONTACT, output="contact")
        figures = {figure.get("id") for figure in self.page("gas").all("figure")}
        self.assertWarned()
        self.assertLessEqual({"figure-temperature-translational", "figure-distance-translational"}, figures)
        self.assertHas("Collisions per second", "Gas of rough spheres")
        self.page("contact")
        self.assertWarned()
        self.assertHas("figure-kinetic-energy", "Particle updates per second", "<dt>Time</dt>")

    def test_a_sweep_has_its_combinations_and_runs(self):
        scene = SCENE | {"output": {"frames": "none", "series": {}}, "measure": ["runout"], "let": {"n": 1}}
        sweep = clca.sweep(scene, seeds=range(2), vary={"n": [1, 2], "rules.inertia": [0, 0.5]}, output="sweep")
        page = self.page("sweep")
        self.assertWarned()
        self.assertEqual(page.texts["h1"], "A small collapse")
        self.assertHas("<h3>packing</h3>", "<h3>flow</h3>", 'data-of="n=\u200b1\nrules.\u200binertia=\u200b0.5"', "rules.<wbr>inertia=<wbr>0.5</th>",
                       "--vary n=1,2 --vary rules.inertia=0,0.5 --seeds 0..1</pre>", "<small> ± ", "<dt>Done</dt><dd>8</dd>")
        self.assertEqual(self.html.count('<td data-of="Status">done</td>'), 8)
        self.assertGreater(len(page.all("figure")), 3)
        table = sweep.folder / "measures.csv"
        wrong = table.read_text().splitlines()
        cells = wrong[1].split(",")
        cells[wrong[0].split(",").index("mean")] = "n/a"
        table.write_text("\n".join([wrong[0], ",".join(cells), *wrong[2:], ""]))
        self.page("sweep")
        self.assertWarned("measures.csv: line 2: 'n/a' in column 'mean' is no number")
        table.unlink()
        self.page("sweep")
        self.assertWarned("no table 'measures'")
        runs = sweep.folder / "runs.csv"
        runs.write_text(runs.read_text().replace("status", "state", 1))
        with self.assertRaisesRegex(clca.Error, "runs.csv: no column 'status'"):
            self.page("sweep")
        runs.unlink()
        with self.assertRaisesRegex(clca.Error, "no table 'runs'"):
            self.page("sweep")

    def test_what_is_measured_along_turned_floors_is_left_out_of_a_sweep_too(self):
        of_runs = [{"key": "flow.runout_99", "name": "Run-out", "of_floor": True}, {"key": "flow.time", "name": "Time", "meaning": "of the stage"}]
        Path("sweep").mkdir()
        Path("sweep/sweep.json").write_text(json.dumps({
            "scene": "small.yaml", "runs": 2, "set": ["a.b='x y'"], "seeds": "1", "tables": {"runs": of_runs},
            "vary": [{"keys": ["a.tilt"], "rows": [["0"], ["0.5"]]}]}))
        Path("sweep/runs.csv").write_text(
            "a.tilt,seed,status,steps,state_hash,folder,error\n0,1,done,1,a,x,\n0.5,1,failed,1,b,y,<b>\n")

        def measures(angle):
            rows = [f"{tilt},flow,{name},{mean},,1,{mean},{mean},," for tilt in ("0", "0.5") for name, mean in (
                ("runout_99", f"1{tilt}25"), ("vessel_angle_deg", angle if tilt == "0" else 30), ("time", 7))]
            Path("sweep/measures.csv").write_text("\n".join(["a.tilt,stage,measure,mean,standard_error,runs,min,max,low,high", *rows, ""]))

        measures(0)
        self.page("sweep")
        self.assertHas('<td data-of="a.\u200btilt=\u200b0">1025</td>', '<td data-of="a.\u200btilt=\u200b0.5">–</td>', "Time<small>of the stage</small>",
                       "is left out", "--set", "<dt>Failed</dt><dd>1</dd>", "&lt;b&gt;", "incomplete")
        measures(20)
        self.page("sweep")
        self.assertNotIn("runout_99", self.html)

    def test_derived_measures_of_any_size_are_readable(self):
        derived = {"big": "=packing_fraction*1e308", "big2": "=-packing_fraction*1e308", "tiny": "=packing_fraction*1e-308",
                   "den": "=packing_fraction*1e-320"}
        stages = [{"name": "pack", "fill": {"region": [0, 0, 40, 60], "counts": {"a": 40}}, "until": {"steps": 40}}]
        scene = {"clca": 1, "box": {"width": 40, "height": 60}, "species": {"a": {"shape": {"hexagon": 1}}}, "stages": stages,
                 "measure": ["packing", derived], "output": {"series": {}}}
        clca.sweep(scene, seeds=range(1, 6), output="sweep")
        self.page("sweep")
        self.assertNotIn("inf ", self.html)
        self.assertRegex(self.html, r">−?\d\.\d\d × 10³⁰⁷")
        self.assertRegex(self.html, r">\d\.\d\d × 10⁻³⁰⁹")

    def test_in_python_it_returns_its_path_and_warns(self):
        scene = SCENE | {"output": {"frames": {"every": 10}}}
        run = clca.run(scene, output="once")
        self.assertEqual(run.report(), run.folder / "report.html")
        self.assertEqual(run.report(), run.folder / "report.html")
        self.assertEqual(clca_program("report", "once"), "once/report.html\n")
        clca.run(scene, output="once")
        self.assertFalse(Path("once/report.html").exists())
        self.assertEqual(run.report("page.html", max_frames=3), self.folder / "page.html")
        self.assertEqual(len(Markup(Path("page.html").read_text()).all("data")), 3)
        with self.assertRaisesRegex(clca.Error, "cannot write .*nowhere/page.html: No such file"):
            run.report("nowhere/page.html")
        with self.assertRaisesRegex(clca.Error, "max_frames"):
            run.report(max_frames=-1)
        (run.folder / "scene.yaml").unlink()
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            run.report("page.html")
        self.assertIn("cannot read scene.yaml", str(said[0].message))

    def test_the_program_shows_progress_on_a_terminal_alone(self):
        clca.run(SCENE, output="seen")
        terminal, side = pty.openpty()
        subprocess.run([PROGRAM, "report", "seen"], stdout=subprocess.PIPE, stderr=side, check=True)
        os.close(side)
        self.assertRegex(os.read(terminal, 9999), rb"^\r\x1b\[Kpicture 1 of \d+\r.*\r\x1b\[Kfigure 3 of 3\r\x1b\[K$")
        os.close(terminal)
        result = subprocess.run([PROGRAM, "report", "seen"], capture_output=True, text=True, check=True)
        self.assertEqual((result.stdout, result.stderr), ("seen/report.html\n", ""))


if __name__ == "__main__":
    unittest.main()
