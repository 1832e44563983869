"""Finds the package of the build tree and the command that the tests compare it with."""

import os
import pathlib
import subprocess

import pytest

MALUS = pathlib.Path(os.environ["MALUS_COMMAND"])
SCENES = pathlib.Path(os.environ["MALUS_SCENES"])


def run(*arguments):
    """Returns the result of the command."""
    return subprocess.run([MALUS, *map(str, arguments)], capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def packs(tmp_path_factory):
    """The packs of two scenes, by name."""
    folder = tmp_path_factory.mktemp("packs")
    result = {}
    for name in ("glass-wall", "cornell-box"):
        result[name] = folder / f"{name}.pack"
        done = run("bake", SCENES / name / "scene.json", "-o", result[name])
        assert done.returncode == 0, done.stderr
    return result
