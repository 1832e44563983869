#!/usr/bin/python3
"""Tests of tools/scaling with images of a few pixels. Environment: MALUS, the command."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

kRoot = pathlib.Path(__file__).resolve().parents[2]
kSeries = {"triangles": "0,1", "depth": "1,3", "resolution": "8,16", "lights": "1,5", "layers": "1,3"}


def run(*arguments):
    return subprocess.run([sys.executable, str(kRoot / "tools/scaling"), *map(str, arguments)], capture_output=True,
                          text=True, check=False)


class Scaling(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        done = run("--malus", os.environ["MALUS"], *(f"--series={name}={sizes}" for name, sizes in kSeries.items()),
                   "--width", 12, "--rounds", 2, "--packs", cls.folder / "packs", cls.folder / "out")
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.results = json.loads((cls.folder / "out/scaling.json").read_text(encoding="utf-8"))
        cls.series = {s["name"]: s["points"] for s in cls.results["series"]}

    def assert_error(self, done, code, *words):
        self.assertEqual((done.returncode, done.stdout), (code, ""))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_sizes_grow(self):
        self.assertEqual(list(self.series), list(kSeries))
        for name, points in self.series.items():
            with self.subTest(series=name):
                self.assertEqual([a["size"] < b["size"] for a, b in zip(points, points[1:])], [True])
        self.assertEqual([p["size"] for p in self.series["triangles"]], [28, 12510])
        self.assertEqual([p["size"] for p in self.series["resolution"]], [64, 256])
        self.assertEqual([p["depth"] for p in self.series["depth"]], [1, 3])
        self.assertEqual([p["depth"] for p in self.series["layers"]], [3, 5])
        self.assertEqual([p["triangles"] for p in self.series["layers"]], [4, 8])
        for name in ("depth", "resolution", "lights", "layers"):
            first, last = self.series[name]
            self.assertLess(first["rays"], last["rays"], name)

    def test_vulkan(self):
        with tempfile.TemporaryDirectory() as temporary:
            done = run("--malus", os.environ["MALUS"], "--backend", "vulkan", "--series", "resolution=8,16", "--methods",
                       "schlick", "--rounds", 1, "--packs", self.folder / "packs", temporary)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = json.loads((pathlib.Path(temporary) / "scaling.json").read_text(encoding="utf-8"))
        self.assertNotIn("Embree", found["device"])
        self.assertEqual([len(p["rows"]) for p in found["series"][0]["points"]], [1, 1])

    def test_rows_have_times_and_memory(self):
        self.assertRegex(self.results["date"], r"^\d{4}-\d\d-\d\d \d\d:\d\d UTC$")
        self.assertIn("Embree", self.results["device"])
        for points in self.series.values():
            for point in points:
                self.assertEqual([row["method"] for row in point["rows"]], ["schlick", "stokes"])
                for row in point["rows"]:
                    for name in ("traceMs", "buildMs", "processMs", "peakMiB"):
                        self.assertTrue(0 < row[name]["low"] <= row[name]["median"] <= row[name]["high"], row)
                    self.assertGreater(row["processMs"]["low"], row["traceMs"]["low"])

    def test_figure_has_every_curve(self):
        svg = (self.folder / "out/scaling.svg").read_text(encoding="utf-8")
        for label in ("triangles", "depth", "pixels", "point lights", "panes of thin glass", "trace, schlick",
                      "trace, stokes", "process, stokes", "build", "peak memory", "proportional", "Embree",
                      self.results["date"]):
            self.assertIn(f"{label}", svg)
        # Two quartile bars per point: a curve and its hollow point each have a group of caps.
        self.assertGreaterEqual(len(re.findall(r'<g id="LineCollection_', svg)), 4 + 4 * 3 + 5)
        (self.folder / "out/scaling.svg").unlink()
        self.assertEqual(run("--draw", self.folder / "out").returncode, 0)
        self.assertEqual((self.folder / "out/scaling.svg").read_text(encoding="utf-8"), svg)

    def test_packs_are_reused(self):
        packs = self.folder / "packs"
        before = {p.name: p.stat().st_mtime_ns for p in packs.glob("*.pack")}
        self.assertEqual(len(before), 6)
        done = run("--malus", os.environ["MALUS"], "--series", "lights=1,5", "--methods", "fresnel", "--width", 8,
                   "--rounds", 1, "--packs", packs, self.folder / "again")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({p.name: p.stat().st_mtime_ns for p in packs.glob("*.pack")}, before)

    def test_finer_engines(self):
        sys.path.insert(0, str(kRoot / "tools/scenes"))
        sys.dont_write_bytecode = True
        from malus_scenes.shapes import finer, lathe
        from malus_scenes.mesh import prepare
        profile = [(0.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0)]
        coarse = prepare(lathe(profile, 8))
        with finer(3):
            fine = prepare(lathe(profile, 8))
        self.assertEqual((len(coarse.triangles), coarse.open_edges), (32, 0))
        # 24 sides; the two bands at the poles have 24 triangles fewer, the other seven 48.
        self.assertEqual((len(fine.triangles), fine.open_edges), (24 * 2 * 9 - 2 * 24, 0))

    def test_wrong_arguments(self):
        out = self.folder / "none"
        self.assert_error(run("--series", "colours", out), 2, "colours", "triangles")
        self.assert_error(run("--series", "depth=0", out), 2, "depth=0", "255")
        self.assert_error(run("--series", "lights=many", out), 2, "lights=many")
        self.assert_error(run("--rounds", "0", out), 2, "--rounds", "1000")
        self.assert_error(run("--width", "1e3", out), 2, "--width")
        self.assert_error(run(), 2, "FOLDER")
        self.assert_error(run("--draw", out), 1, "scaling.json")
        self.assert_error(run("--malus", out / "malus", out), 1, "--malus")
        done = run("--malus", os.environ["MALUS"], "--series", "lights=1", "--methods", "newton", "--rounds", 1, "--packs",
                   self.folder / "packs", out)
        self.assertEqual(done.returncode, 1)
        self.assertIn("newton", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
