"""The site that mkdocs has built, in the folder of the first argument, opened as files in a browser."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SITE = pathlib.Path(sys.argv.pop(1)).resolve()
# A window has at least 500 px: the page is in a frame, and tells the page around it.
FRAME = """<!doctype html><script>
addEventListener("message", event => document.documentElement.setAttribute("broken", event.data));
</script><iframe src="words.html" width="420" height="900" style="border: 0"></iframe>"""
BROKEN_WORDS = r"""<script>
addEventListener("load", () => {
  const words = ["width " + document.documentElement.clientWidth];
  const texts = document.createTreeWalker(document.querySelector("article"), NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const text = texts.currentNode;
    for (const word of text.parentElement.closest("pre") ? [] : text.data.matchAll(/[\p{L}\p{N}_]+/gu)) {
      const range = document.createRange();
      range.setStart(text, word.index);
      range.setEnd(text, word.index + word[0].length);
      const lines = new Set([...range.getClientRects()].filter(box => box.width > 0).map(box => Math.round(box.top)));
      if (lines.size > 1) words.push(word[0]);
    }
  }
  parent.postMessage(words.join(" "), "*");
});
</script>"""


def dom(page):
    """The page as the browser has made it."""
    with tempfile.TemporaryDirectory() as user:
        return subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", f"--user-data-dir={user}",
             "--virtual-time-budget=20000", "--dump-dom", f"file://{page}"],
            check=True, capture_output=True, text=True).stdout


class TheSite(unittest.TestCase):
    def test_the_search_knows_pages_and_no_sources(self):
        index = json.loads((SITE / "search/search_index.json").read_text())
        found = {entry["location"].partition("#")[0] for entry in index["docs"]}
        self.assertIn("bench/peers/index.html", found)
        self.assertTrue((SITE / "bench/peers/dem.py.html").exists())
        self.assertEqual([name for name in found if re.search(r"\.\w+\.html", name)], [])


@unittest.skipIf(shutil.which("chromium") is None and "CLCA_CI" not in os.environ, "no chromium on the PATH")
class InABrowser(unittest.TestCase):
    def test_pages_opened_as_files_are_searched(self):
        for page in ("index.html", "bench/peers/index.html"):
            links = re.findall(r'href="([^"]*)" class="md-search-result__link"', dom(f"{SITE}/{page}?q=restitution"))
            self.assertIn(f"file://{SITE}/contact.html", links)

    def test_no_word_breaks_on_a_narrow_screen(self):
        page, frame = SITE / "words.html", SITE / "frame.html"
        for file, text in ((page, (SITE / "scene-format.html").read_text().replace("</head>", BROKEN_WORDS + "</head>", 1)),
                           (frame, FRAME)):
            self.addCleanup(file.unlink)
            file.write_text(text)
        broken = re.search(r'broken="([^"]*)"', dom(frame))[1].split()
        self.assertLessEqual(int(broken[1]), 420)
        self.assertEqual(broken[2:], [])


if __name__ == "__main__":
    unittest.main()
