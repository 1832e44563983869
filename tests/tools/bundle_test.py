#!/usr/bin/python3
"""tools/bundle: the folder runs without the environment and the libraries of this machine. The complete check, in a
minimal Debian, is tools/bundle --check. Environment: MALUS_BUILD the build folder."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

kRoot = pathlib.Path(__file__).resolve().parents[2]
kBuild = pathlib.Path(os.environ["MALUS_BUILD"]).resolve()


class Bundle(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.bundle = cls.folder / "bundle"
        made = subprocess.run([kRoot / "tools/bundle", "--from", kBuild, "-o", cls.bundle], capture_output=True, text=True)
        if made.returncode != 0:
            raise AssertionError(made.stdout + made.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def run_clean(self, *command, **environment):
        """Runs a command of the bundle without the environment of this machine."""
        return subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=self.folder,
                              env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder), "LD_LIBRARY_PATH": ""} | environment)

    def expect_done(self, *command, **environment):
        done = self.run_clean(*command, **environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def inspect(self, bundle):
        return subprocess.run([kRoot / "tools/bundle-files/inspect", bundle, kRoot], capture_output=True, text=True)

    def test_renders_without_vulkan(self):
        for scene in ("glass-wall", "cornell-box", "engine"):
            for backend in ("embree", "reference"):
                image = self.folder / f"{scene}-{backend}.exr"
                self.expect_done(self.bundle / "malus", "render", self.bundle / f"packs/{scene}.pack", "--backend", backend,
                                 "--method", "stokes", "--effects", "all", "--width", 128, "-o", image,
                                 "-o", image.with_suffix(".png"))
                self.expect_done(self.bundle / "malus", "compare-images", image,
                                 self.bundle / f"references/{scene}-reference.exr", "--threshold", 0.001,
                                 "--max-outliers", 100)

    def test_images_equal_those_of_the_build(self):
        for program, name in ((self.bundle / "malus", "a"), (kBuild / "bin/malus", "b")):
            self.expect_done(program, "render", self.bundle / "packs/cornell-box.pack", "--width", 64, "-o",
                             self.folder / f"{name}.exr", "-o", self.folder / f"{name}.png")
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        for suffix in ("exr", "png"):
            self.expect_done(kBuild / "bin/malus", "compare-images", self.folder / f"a.{suffix}",
                             self.folder / f"b.{suffix}", "--fail-over", 0)

    def test_no_library_comes_from_outside(self):
        maps = self.expect_done("/bin/sh", "-c", f"LD_DEBUG=files '{self.bundle}/malus' bake nothing.json -o x 2>&1 || true")
        paths = {line.split("calling init: ")[1].strip() for line in maps.split("\n") if "calling init: " in line}
        allowed = ("libc.so", "libm.so", "libstdc++.so", "libgcc_s.so", "libz.so", "libvulkan.so", "ld-linux", "libtinfo")
        outside = [p for p in paths if not p.startswith(str(self.bundle)) and not os.path.basename(p).startswith(allowed)]
        self.assertEqual(outside, [])
        self.assertTrue(any("libembree" in p for p in paths), paths)

    def test_other_formats_are_an_error_that_names_the_supported_ones(self):
        done = self.run_clean(self.bundle / "malus", "bake", kRoot / "scenes/glass-wall/scene.json", "-o", "wall.pack")
        self.assertEqual(done.returncode, 1)
        self.assertIn("skylight.hdr", done.stderr)
        self.assertIn("EXR and PNG", done.stderr)

    def test_the_viewer_renders_a_frame(self):
        out = self.expect_done(self.bundle / "malus", "view", self.bundle / "packs/cornell-box.pack", "--frames", 2,
                               "--width", 64, "--height", 64, "--json", MALUS_DEVICE="llvmpipe")
        self.assertEqual(json.loads(out)["scene"], "cornell-box")
        done = self.run_clean(self.bundle / "malus", "view", self.bundle / "packs/cornell-box.pack", DISPLAY="")
        self.assertEqual(done.returncode, 1)
        self.assertIn("display", done.stderr.lower())

    def test_without_a_driver(self):
        nothing = {"VK_DRIVER_FILES": "/nowhere", "VK_ICD_FILENAMES": "/nowhere"}
        done = self.run_clean(self.bundle / "malus", "--list-devices", **nothing)
        self.assertEqual(done.returncode, 1)
        self.assertIn("driver", done.stderr)
        self.assertEqual(self.run_clean(self.bundle / "gpu-check", "--minutes", 1, **nothing).returncode, 1)

    def small_bundle(self, name):
        """Returns a copy with one scene and one image to check, which any machine renders in a minute."""
        copy = self.folder / name
        shutil.copytree(self.bundle, copy)
        for scene in ("glass-wall", "engine"):
            (copy / f"packs/{scene}.pack").unlink()
        (copy / "references/checks").write_text("cornell-box stokes 128 cornell-box-reference.exr 0.001 98\n")
        return copy

    def test_gpu_check(self):
        done = self.run_clean(self.small_bundle("small") / "gpu-check", "--minutes", 2, "-o", "out",
                              MALUS_DEVICE="llvmpipe")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        results = json.loads((self.folder / "out/results.json").read_text())
        self.assertEqual(results["deviceInfo"]["rayTracingCores"], "no")
        self.assertEqual({row["status"] for row in results["rows"]}, {"ok"})
        checks = (self.folder / "out/checks.txt").read_text()
        self.assertIn("passed  optics", checks)
        self.assertIn("passed  cornell-box stokes", checks)
        for name in ("summary.txt", "table.txt"):
            self.assertIn("schlick", (self.folder / "out" / name).read_text())

    def test_gpu_check_reports_differences(self):
        copy = self.small_bundle("different")
        shutil.copy(copy / "references/engine-fresnel.exr", copy / "references/cornell-box-reference.exr")
        done = self.run_clean(copy / "gpu-check", "--minutes", 1, "-o", "differences", MALUS_DEVICE="llvmpipe")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("failed  cornell-box stokes", (self.folder / "differences/summary.txt").read_text())

    def test_gpu_check_keeps_what_is_finished_after_ctrl_c(self):
        copy = self.small_bundle("interrupted")
        out = self.folder / "stopped"
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder), "MALUS_DEVICE": "llvmpipe"}
        with open(self.folder / "stopped.log", "w") as log:
            process = subprocess.Popen([copy / "gpu-check", "--minutes", "30", "-o", out], stdout=log, stderr=log,
                                       cwd=self.folder, env=environment, start_new_session=True)
        try:
            deadline = time.monotonic() + 900
            while not (out / "results.json").exists() and process.poll() is None and time.monotonic() < deadline:
                time.sleep(0.2)
            os.killpg(process.pid, signal.SIGINT)  # as a terminal does
            self.assertEqual(process.wait(timeout=300), 130, (self.folder / "stopped.log").read_text())
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        rows = json.loads((out / "results.json").read_text())["rows"]
        self.assertTrue(any(row["status"] == "ok" for row in rows), rows)
        summary = (out / "summary.txt").read_text()
        self.assertIn("interrupted", summary)
        self.assertIn("cornell-box", summary)
        self.assertIn("passed  cornell-box stokes", (out / "checks.txt").read_text())

    def test_gpu_check_usage(self):
        for arguments in (("--minutes", "soon"), ("--minutes",), ("--fast", "1")):
            self.assertEqual(self.run_clean(self.bundle / "gpu-check", *arguments).returncode, 2, arguments)

    def test_inspect_finds_defects(self):
        self.assertEqual(self.inspect(self.bundle).returncode, 0)
        copy = self.folder / "broken"
        shutil.copytree(self.bundle, copy)
        library = next((copy / "lib").glob("libembree*"))
        library.rename(copy / "hidden")
        self.assertIn("libembree", self.inspect(copy).stderr)
        (copy / "hidden").rename(library)
        (copy / "note").write_text(f"built in {kRoot}\n")
        self.assertIn("path", self.inspect(copy).stderr)


if __name__ == "__main__":
    unittest.main()
