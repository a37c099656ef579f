"""Hooks of mkdocs.yml: the site also has what its pages link to outside of docs/, sources as pages of their own; all
its links lead somewhere, and its search works in files, too, and leaves sources out.
"""

import json
import logging
import posixpath
import re
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r'(?P<before>\]\(|src=")(?!\w+:)(?P<target>[^)"#:\s]+)(?P<after>[^)"\s]*[)"])')
TEXT_LINK = re.compile(r"\[(?P<text>[^\[\]]*)\]\((?P<target>[^)#:\s]+)\)")
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".yaml": "yaml", ".csv": "text",
             ".txt": "text", "": "text"}  # of sources, by the end of their names
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)

pages_of_sources = tempfile.TemporaryDirectory()
log = logging.getLogger("mkdocs.plugins.site")


def source_of(site_path):
    """The path in the source tree of a file of the site."""
    return f"docs/{site_path}" if (ROOT / "docs" / site_path).exists() else site_path


def place_of(source):
    """The reverse. The start page stands for README.md, and a source is a page."""
    if Path(source).suffix in LANGUAGES:
        return f"{source}.md"
    return "index.md" if source == "README.md" else source.removeprefix("docs/")


def is_source(location):
    """Whether this address in the site is of the page of a source."""
    return Path(pages_of_sources.name, location.partition("#")[0].removesuffix(".html") + ".md").exists()


def page_of_source(source, config):
    page = Path(pages_of_sources.name, place_of(source))
    page.parent.mkdir(parents=True, exist_ok=True)
    text = (ROOT / source).read_text()
    page.write_text(f"# `{source}`\n\n~~~~~~ {LANGUAGES[Path(source).suffix]}\n{text}\n~~~~~~\n")
    return File(place_of(source), pages_of_sources.name, config["site_dir"], config["use_directory_urls"])


def target_of(source, link):
    """The path in the source tree that a link of a page leads to; of a folder, its README.md or None."""
    target = posixpath.normpath(posixpath.join(posixpath.dirname(source), unquote(link)))
    if (ROOT / target).is_dir():
        return f"{target}/README.md" if (ROOT / target / "README.md").exists() else None
    return target


def linked_files(source):
    text = CODE.sub("", (ROOT / source).read_text())
    targets = {target_of(source, link["target"]) for link in LINK.finditer(text)}
    return {target for target in targets if target and (ROOT / target).is_file()}


def on_files(files, config):
    """Adds the files that pages link to, and those that these link to if they are pages, too."""
    waiting = [source_of(file.src_path) for file in files.documentation_pages()]
    waiting += ["CHANGELOG.md", "CONTRIBUTING.md"]
    seen = set()
    while waiting:
        source = waiting.pop()
        if source in seen or source == "README.md":
            continue
        seen.add(source)
        if Path(source).suffix in LANGUAGES:
            files.append(page_of_source(source, config))
        elif not source.startswith("docs/"):
            files.append(File(source, str(ROOT), config["site_dir"], config["use_directory_urls"]))
        if source.endswith(".md"):
            waiting += linked_files(source)
    return files


def on_page_markdown(markdown, page, config, files):
    """Makes links in the source tree links in the site. A link to a folder becomes its text."""
    source = source_of(page.file.src_path)
    if not (ROOT / source).exists():  # made here
        return markdown
    here = posixpath.dirname(place_of(source))

    def without_folder(link):
        return link[0] if target_of(source, link["target"]) else link["text"]

    def replaced(link):
        target = place_of(target_of(source, link["target"]))
        return link["before"] + posixpath.relpath(target, here or ".") + link["after"]

    parts = re.split(f"({CODE.pattern})", markdown, flags=CODE.flags)
    return "".join(part if part.startswith("```") else LINK.sub(replaced, TEXT_LINK.sub(without_folder, part))
                   for part in parts)


class Links(HTMLParser):
    """The anchors and the links of a page, and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads = set(), set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.add(values.get("id"))
        if tag == "a" and values.get("href"):
            self.links.add(values["href"])
        elif values.get("src") or (tag == "link" and values.get("rel") != "canonical"):
            self.loads.add(values.get("src") or values.get("href"))


def on_post_page(output, page, config):
    script = posixpath.relpath("search.js", posixpath.dirname(page.file.url) or ".")
    return output.replace("</head>", f'<script src="{script}"></script></head>', 1)


def write_search_index(site):
    """Leaves sources out of the index, and writes it as a script, too, for docs/search.js."""
    path = site / "search/search_index.json"
    index = json.loads(path.read_text())
    index["docs"] = [entry for entry in index["docs"] if not is_source(entry["location"])]
    text = json.dumps(index, separators=(",", ":"))
    path.write_text(text)
    path.with_suffix(".js").write_text(f"var __index = {text};\nvar __search = {{index: Promise.resolve(__index)}};\n")


def on_post_build(config):
    """Warns of links without a target, and of anything that a page would load from elsewhere."""
    site = Path(config["site_dir"])
    write_search_index(site)
    for name in ("sitemap.xml", "sitemap.xml.gz"):  # without addresses
        (site / name).unlink()
    pages = {path: Links(path.read_text()) for path in site.rglob("*.html")}
    for path, page in pages.items():
        name = path.relative_to(site)
        for link in page.links:
            if re.match(r"\w+:", link) or name.name == "404.html":
                continue
            file, _, anchor = unquote(link).partition("#")
            target = (path.parent / file).resolve() if file else path
            if not target.exists():
                log.warning(f"{name}: no {link}")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                log.warning(f"{name}: no anchor {link}")
        for address in page.loads:
            if address.startswith(("http:", "https:", "//")):
                log.warning(f"{name}: loads {address}")
