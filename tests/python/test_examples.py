"""The examples of tools/python."""

import os
import pathlib
import re
import subprocess
import sys

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "tools" / "python" / "examples"


def run_example(name, *arguments):
    done = subprocess.run([sys.executable, EXAMPLES / name, *arguments], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_ellipsometry_finds_the_constants_of_a_metal():
    lines = run_example("ellipsometry.py", "silver").splitlines()
    assert len(lines) == 3
    for line in lines:
        eta, true_eta, k, true_k, spread = map(float, re.findall(r"\d+\.\d+(?:e[-+]\d+)?", line))
        assert abs(eta - true_eta) < 1e-3 and abs(k - true_k) < 1e-3, line
        assert spread < 1e-3, line


def test_shape_from_polarization_finds_the_normals_of_a_sphere(tmp_path):
    text = run_example("shape_from_polarization.py", str(tmp_path))
    dark, room = (float(value) for value in re.findall(r"median error ([\d.]+)", text))
    assert dark < 0.1, text  # exact
    assert 1 < room < 60, text
    assert (tmp_path / "dark.png").exists() and (tmp_path / "room.png").exists()
