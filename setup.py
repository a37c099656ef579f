"""Builds the Python package by CMake, for pip: pyproject.toml has the rest."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

tree = Path(__file__).parent


class BuildByCMake(build_ext):
    def run(self):
        build, target = Path(self.build_temp).resolve(), Path(self.build_lib).resolve()
        for arguments in (["--preset", "package", "-S", tree, "-B", build, "-DCLCA_PYTHON_DIR=.", "-DCLCA_MPI=OFF",
                           f"-DPython3_EXECUTABLE={sys.executable}"],
                          ["--build", build, "--target", "clca_python"],
                          ["--install", build, "--component", "python", "--strip", "--prefix", target]):
            subprocess.run(["cmake", *arguments], cwd=tree, check=True)
        shutil.copytree(tree / "scenes", target / "clca/share/clca/scenes", dirs_exist_ok=True)


version = re.search(r"VERSION ([\d.]+) LANGUAGES", (tree / "CMakeLists.txt").read_text())[1]
setup(version=version, packages=[], ext_modules=[Extension("clca._clca", [])], cmdclass={"build_ext": BuildByCMake})
