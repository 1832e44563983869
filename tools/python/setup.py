"""Builds the extension module by the project's CMake: see README.md in this folder."""

import os
import pathlib
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]


class CMakeBuild(build_ext):
    """Builds the target malus_python and installs the package into the build folder of setuptools."""

    def run(self):
        # An existing build folder saves the ten minutes of a new one.
        existing = os.environ.get("MALUS_BUILD")
        build = pathlib.Path(existing or self.build_temp).resolve()
        if not existing:
            subprocess.run(["cmake", "-S", PROJECT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_CXX_FLAGS_RELEASE=-O2", "-DMALUS_TESTS=OFF", "-DMALUS_PYTHON=ON",
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "malus_python_package"], check=True)
        folder = pathlib.Path(self.build_lib).resolve() if not self.inplace else HERE
        subprocess.run(["cmake", f"-DPACKAGE={build / 'python' / 'malus'}", f"-DTO={folder / 'malus'}", "-P",
                        HERE / "copy_package.cmake"], check=True)

    def get_outputs(self):
        return []


setup(ext_modules=[Extension("malus._malus", sources=[])], cmdclass={"build_ext": CMakeBuild})
