"""What the tests of the Python package share."""

import importlib.util
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["CLCA_PROGRAM"]

# A bed behind a wall that is taken away, of two shapes, one of them turned.
SCENE = {
    "clca": 1,
    "title": "A small collapse",
    "seed": 7,
    "box": {"width": 40, "height": 40},
    "species": {
        "grain": {"shape": {"hexagon": 1}},
        "rod": {"shape": {"rod": {"radius": 0, "length": 3}}, "orientations": "any"},
    },
    "walls": {"gate": {"box": [20, 0, 21, 40]}},
    "stages": [
        {"name": "packing", "fill": {"region": [0, 0, 20, 40], "counts": {"grain": 20, "rod": 20}}},
        {"name": "flow", "remove": ["gate"]},
    ],
    "output": {"frames": "none", "series": {"every": 1}, "trajectory": {"every": 5}},
}

# The same without what the contact model cannot turn, with contacts.
CONTACT = SCENE | {
    "model": "contact",
    "units": {"spacing": "1 mm"},
    "species": {"grain": {"shape": {"hexagon": 1}}},
    "stages": [
        {"name": "packing", "fill": {"region": [0, 0, 20, 40], "counts": {"grain": 30}}, "until": {"steps": 200}},
        {"name": "flow", "remove": ["gate"], "until": {"steps": 100}},
    ],
    "output": {"frames": "none", "series": {"every": 10}, "trajectory": {"every": 50, "contacts": True}},
}

GAS = {
    "clca": 1,
    "seed": 3,
    "boltzmann": {"particles": 1000, "restitution": 0.9, "friction": 0, "until": 2},
}


class ScratchTest(unittest.TestCase):
    """A test in a folder of its own, which is the current one."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = Path(folder.name)


def clca_program(*arguments):
    """Runs the program; its output."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def needs(module):
    """Skips a test without this module, but not in CI, where it has to be there."""
    if os.environ.get("CLCA_CI") is None and importlib.util.find_spec(module) is None:
        raise unittest.SkipTest(f"no module {module}")
