#!/usr/bin/env python3
"""`malus view` as a person uses it, on a display without a screen: MALUS is the program, MALUS_SCENES the scenes."""

import json
import os
import pathlib
import random
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import viewer_display
from viewer_display import Display, Image, Viewer

MALUS = os.environ["MALUS"]
SCENES = pathlib.Path(os.environ["MALUS_SCENES"])
FAILING_DEVICE = os.environ.get("MALUS_FAILING_DEVICE", "")
COUNT_COPIES = os.environ.get("MALUS_COUNT_COPIES", "")
LEAK_SANITIZER = os.environ.get("MALUS_LEAK_SANITIZER", "")
SKIPPED = 77
WIDTH, HEIGHT = 480, 300
VALIDATION = {"MALUS_VALIDATION": "1"}
NOT_SHARED = {"MALUS_VULKAN_LIMITS": "VK_KHR_external_memory_fd=0"}
# Pixels whose colours are at an edge of the tone curve's rounding.
MOST_SHARE = 0.001


def read_png(path):
    """8-bit RGB without interlacing, as malus writes it."""
    data, at, packed, size = path.read_bytes(), 8, b"", (0, 0)
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            packed += body
        at += length + 12
    width, height = size
    raw, stride, rows, last = zlib.decompress(packed), 3 * width, [], bytearray(3 * width)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (row[i - 3] if i >= 3 else 0), last[i], (last[i - 3] if i >= 3 else 0)
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                p = left + up - corner
                nearest = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
                row[i] = (row[i] + nearest) & 255
        rows.append(bytes(row))
        last = row
    return Image(width, height, b"".join(rows))


class ViewerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.pack = cls.folder / "cornell-box.pack"
        subprocess.run([MALUS, "-q", "bake", SCENES / "cornell-box" / "scene.json", "-o", cls.pack], check=True,
                       stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_malus(self, *arguments, environment=None):
        return subprocess.run([MALUS, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              env=dict(os.environ, MALUS_DEVICE="llvmpipe", **(environment or {})))

    def headless(self, script, *arguments, frames=1, environment=None):
        (self.folder / "script.txt").write_text(script)
        return self.run_malus("view", self.pack, "--frames", frames, "--script", "script.txt", *arguments,
                              environment=environment)

    def rendered(self, *arguments, method="stokes"):
        file = self.folder / "rendered.png"
        done = self.run_malus("render", self.pack, "-o", file, "--width", WIDTH, "--height", HEIGHT, "--method", method,
                              *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return read_png(file)

    def assert_same(self, a, b):
        self.assertLess(a.share_that_differs(b), MOST_SHARE)

    def assert_differ(self, a, b):
        self.assertGreater(a.share_that_differs(b), 0.01)


class HeadlessTest(ViewerTest):
    def test_a_moved_view_is_what_its_command_renders(self):
        for extra in ("", "0 wave-plate 30 70\n", "0 method importance\n0 exposure 1\n", "0 method sp\n",
                      "0 backend vulkan\n0 depth 2\n0 samples 2\n", "0 effects metal,shadows\n0 analyser left\n",
                      "0 backend reference\n"):
            script = f"0 orbit 25 10\n0 pan 0.1 0\n0 zoom 1.3\n0 polarizer 35\n{extra}0 command out.png\n0 save view.png\n"
            done = self.headless(script, "--width", 160, "--height", 100, environment=VALIDATION)
            self.assertEqual((done.returncode, done.stderr), (0, ""), extra)
            command = done.stdout.splitlines()[0].replace("malus", MALUS, 1)
            subprocess.run(command, shell=True, check=True, cwd=self.folder, capture_output=True)
            self.assert_same(read_png(self.folder / "view.png"), read_png(self.folder / "out.png"))

    def test_json_has_times_of_both_kinds_of_frames(self):
        done = self.headless("0 wait\n1-3 turn 5\n4-6 orbit 1 0\n", "--json", "--width", 64, frames=7)
        result = json.loads(done.stdout)
        self.assertEqual(len(result["frames"]), 7)
        self.assertEqual(result["rendered"]["frames"], 3)
        self.assertEqual(result["displayOnly"]["frames"], 4)
        self.assertEqual(result["sides"][0]["method"], "stokes")
        # By the clock of the device, which is within the frame; and a device without a clock.
        for frame in result["frames"]:
            self.assertGreater(frame["displayPassMs"], 0)
            self.assertLess(frame["displayPassMs"], frame["ms"])
        self.assertGreater(result["displayPassMs"], 0)
        done = self.headless("0 wait\n", "--json", "--width", 64, environment={"MALUS_VULKAN_LIMITS": "timestampValidBits=0"})
        result = json.loads(done.stdout)
        self.assertIsNone(result["displayPassMs"])
        self.assertIsNone(result["frames"][0]["displayPassMs"])

    def test_errors_of_the_sides_are_those_of_compare(self):
        done = self.headless("0 split 0.5\n0 method b fresnel\n0 show flip\n0 wait-reference\n0 save flip.png\n", "--json",
                             "--width", 160, "--height", 100)
        a, b = json.loads(done.stdout)["sides"]
        self.assertLess(a["relRms"], 1e-5)
        self.assertGreater(b["relRms"], 1e-3)
        self.assertGreater(b["flip"], 100 * a["flip"])
        flip = read_png(self.folder / "flip.png")
        lowest = bytes((68, 1, 84))  # of viridis
        left, right = flip.columns(0, 80), flip.columns(80, 160)
        for image, exact in ((left, True), (right, False)):
            pixels = [image.rgb[i:i + 3] for i in range(0, len(image.rgb), 3)]
            self.assertEqual(sum(p == lowest for p in pixels) > 0.95 * len(pixels), exact)

    def count_copies(self, script, *arguments, frames, environment=None):
        """Sides of --json, and what was copied to mapped memory: bytes, and calls of vkMapMemory."""
        counts = self.folder / "copies.txt"
        done = self.headless(script, "--json", "--width", 320, "--height", 200, *arguments, frames=frames,
                             environment={"LD_PRELOAD": COUNT_COPIES, "MALUS_HOST_COPIES": str(counts),
                                          **(environment or {})})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)["sides"], *map(int, counts.read_text().split())

    def test_images_of_the_device_of_the_display_stay_there(self):
        for method in ("stokes", "sp"):
            arguments = ("--backend", "vulkan", "--method", method)
            moving = "0 wait\n1-9 orbit 1 0\n9 wait\n"
            sides, copied, mappings = self.count_copies(moving, *arguments, frames=10)
            self.assertEqual((sides[0]["image"], sides[0]["copiedBytes"], copied), ("shared", 0, 0))
            # More frames map no more memory.
            longer = self.count_copies("0 wait\n1-29 orbit 1 0\n29 wait\n", *arguments, frames=30)
            self.assertEqual(longer[1:], (0, mappings))
            # A saved image is read back.
            saved = self.count_copies(moving + "9 save shared.png\n9 save shared.exr\n", *arguments, frames=10)
            self.assertGreaterEqual(saved[1], 320 * 200 * (4 + 4 * (15 if method == "stokes" else 3)))
            # Without shared memory, every image is copied, and is the same.
            sides, copied, _ = self.count_copies(moving + "9 save copied.png\n", *arguments, frames=10,
                                                 environment=NOT_SHARED)
            self.assertEqual(sides[0]["image"], "copied")
            self.assertGreater(sides[0]["copiedBytes"], 320 * 200 * 12)
            self.assertGreaterEqual(copied, sides[0]["copiedBytes"])
            self.assertEqual((self.folder / "shared.png").read_bytes(), (self.folder / "copied.png").read_bytes())

    def test_sides_on_the_device_and_of_the_host(self):
        script = "0 split 0.5\n0 method b fresnel\n0 backend b embree\n0 wait-reference\n0 save both.png\n"
        images, errors = [], []
        for environment in ({}, NOT_SHARED):
            done = self.headless(script, "--json", "--backend", "vulkan", "--width", 160, "--height", 100,
                                 environment={**VALIDATION, **environment})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            sides = json.loads(done.stdout)["sides"]
            self.assertEqual([side["image"] for side in sides], ["copied" if environment else "shared", "copied"])
            errors.append([(side["relRms"], side["flip"]) for side in sides])
            images.append((self.folder / "both.png").read_bytes())
        self.assertEqual(images[0], images[1])
        self.assertEqual(errors[0], errors[1])

    def test_other_quantities_are_the_images_of_render(self):
        for shown, option in (("dolp", "--output-dolp"), ("aolp", "--output-aolp")):
            self.headless(f"0 show {shown}\n0 save shown.png\n", "--width", WIDTH, "--height", HEIGHT)
            self.rendered(option, self.folder / "expected.png")
            share = read_png(self.folder / "shown.png").share_that_differs(read_png(self.folder / "expected.png"), 3)
            self.assertLess(share, 0.01, shown)

    def test_an_image_above_the_limit_of_storage_buffers(self):
        # 2.4 million pixels of 60 bytes: more than 128 MiB, the limit of lavapipe.
        done = self.headless("0 orbit 1 0\n0 command out.png\n0 save large.png\n", "--width", 2400, "--height", 1000,
                             environment=VALIDATION)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        command = done.stdout.splitlines()[0].replace("malus", MALUS, 1)
        subprocess.run(command, shell=True, check=True, cwd=self.folder, capture_output=True)
        # 1/255 of a bright sRGB value is below 0.01 in linear light.
        compared = self.run_malus("compare-images", "large.png", "out.png", "--threshold", 0.01, "--max-outliers", 2400)
        self.assertEqual(compared.returncode, 0, compared.stdout)

    def test_wrong_use(self):
        for arguments, code, words in ((["--script", "x"], 2, "--frames"),
                                       (["--method", "x"], 2, "x"), (["--frames", "1", "--script", "none"], 1, "none"),
                                       (["--view", "{}{", "--frames", "1"], 1, "--view")):
            done = self.run_malus("view", self.pack, *arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertIn("script.txt:2: ", self.headless("0 wait\n0 orbit x 1\n").stderr)

    def test_no_display(self):
        done = self.run_malus("view", self.pack, environment={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("display", done.stderr)

    def test_a_lost_device_is_a_message(self):
        for arguments, submission in (([], 20), (["--backend", "vulkan"], 30), (["--backend", "vulkan"], 31)):
            done = self.headless("0-50 orbit 1 0\n", "--width", 64, *arguments, frames=50,
                                 environment={"LD_PRELOAD": FAILING_DEVICE, "MALUS_FAIL_AT": str(submission)})
            self.assertEqual(done.returncode, 1)
            self.assertIn("lost", done.stderr)


class WindowTest(ViewerTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.display = self.enterContext(Display(folder.name, WIDTH, HEIGHT))

    def open(self, *arguments, environment=VALIDATION):
        viewer = self.enterContext(Viewer(self.display, MALUS, self.pack, *arguments, environment=environment))
        self.assertIsNone(viewer.process.poll())
        return viewer

    def close(self, viewer):
        viewer.key("ctrl+q")
        code, messages, seconds = viewer.wait(10)
        self.assertEqual((code, messages), (0, ""))
        self.assertLess(seconds, 1)

    def test_image_polarizer_and_method_are_those_of_render(self):
        viewer = self.open("--method", "stokes")
        viewer.display.still_screenshot()
        viewer.key("h")  # the panel covers a part of the image
        self.display.xdotool("mousemove", WIDTH - 1, HEIGHT - 1)
        seen = self.display.still_screenshot()
        self.assert_same(seen.columns(0, WIDTH - 20), self.rendered().columns(0, WIDTH - 20))
        viewer.key("bracketright", "bracketright", "bracketright")
        turned = self.display.still_screenshot()
        self.assert_same(turned.columns(0, WIDTH - 20), self.rendered("--polarizer", 15).columns(0, WIDTH - 20))
        self.assert_differ(turned, seen)
        viewer.key("p", "shift+m")
        linear = self.display.still_screenshot()
        self.assert_same(linear.columns(0, WIDTH - 20),
                         self.rendered(method="stokes-linear").columns(0, WIDTH - 20))
        self.close(viewer)

    def test_images_of_the_vulkan_renderer(self):
        for environment in (VALIDATION, {**VALIDATION, **NOT_SHARED}):
            viewer = self.open("--backend", "vulkan", environment=environment)
            viewer.display.still_screenshot()
            viewer.key("h")
            self.display.xdotool("mousemove", WIDTH - 1, HEIGHT - 1)
            viewer.key("bracketright", "bracketright")
            seen = self.display.still_screenshot()
            expected = self.rendered("--backend", "vulkan", "--polarizer", 10)
            self.assert_same(seen.columns(0, WIDTH - 20), expected.columns(0, WIDTH - 20))
            viewer.key("h", "i")  # the probe reads a pixel back
            self.display.xdotool("mousemove", WIDTH - 60, HEIGHT - 40)
            self.display.still_screenshot()
            self.close(viewer)

    def test_the_divider_separates_two_methods(self):
        viewer = self.open("--compare-with", "schlick")
        viewer.display.still_screenshot()
        viewer.key("h")
        viewer.drag((WIDTH // 2, HEIGHT - 20), (WIDTH // 4, HEIGHT - 20))
        self.display.xdotool("mousemove", WIDTH - 1, HEIGHT - 1)
        seen = self.display.still_screenshot()
        margin, top = 12, 60  # of the divider, and of the labels
        stokes, schlick = self.rendered(), self.rendered(method="schlick")

        def below(image):
            return Image(image.width, image.height - top, image.rgb[3 * top * image.width:])

        right = (WIDTH // 4 + margin, WIDTH - 20)
        self.assert_same(below(seen.columns(0, WIDTH // 4 - margin)), below(stokes.columns(0, WIDTH // 4 - margin)))
        self.assert_same(below(seen.columns(*right)), below(schlick.columns(*right)))
        self.assert_differ(below(seen.columns(*right)), below(stokes.columns(*right)))
        self.close(viewer)

    def test_from_input_to_photon_are_at_most_two_frames(self):
        viewer = self.open("--json", environment={})
        viewer.display.still_screenshot()
        for _ in range(4):
            viewer.drag((WIDTH - 100, 200), (WIDTH - 60, 160))
        viewer.key(*["bracketright"] * 12)
        self.display.still_screenshot()
        viewer.key("ctrl+q")
        output, messages = viewer.process.communicate(timeout=10)
        self.assertEqual((viewer.process.returncode, messages), (0, ""))
        result = json.loads(output)
        for kind, least in (("rendered", 10), ("displayOnly", 12)):
            self.assertGreaterEqual(result["inputToPhoton"][kind]["events"], least)
            self.assertLessEqual(result["inputToPhoton"][kind]["p95Frames"], 2, result)
        for time_of in ("frameMs", "displayPassMs", "overlayMs"):
            self.assertGreater(result[time_of], 0)

    def test_home_restores_the_camera_and_the_pivot(self):
        viewer = self.open(environment={})
        viewer.key("h")

        def orbited():
            viewer.drag((240, 150), (300, 180))
            self.display.xdotool("mousemove", WIDTH - 1, HEIGHT - 1)
            return self.display.still_screenshot()

        first = orbited()
        viewer.drag((240, 150), (160, 190), button=3)
        moved = self.display.still_screenshot()
        self.assert_differ(moved, first)
        viewer.key("Home")
        self.assert_same(orbited(), first)

    def test_closing_while_rendering(self):
        # Without the driver's cache of shaders, the Vulkan renderer compiles for seconds.
        compiling = {"MESA_SHADER_CACHE_DISABLE": "1"}
        for arguments in (["--samples", 16], ["--backend", "vulkan", "--samples", 8]):
            for seconds in (0.1, 0.7, 1.5):
                viewer = self.open(*arguments, environment=compiling)
                time.sleep(seconds)
                self.close(viewer)

    def test_interrupt(self):
        viewer = self.open("--samples", 8, environment={})
        time.sleep(0.5)
        viewer.process.send_signal(signal.SIGINT)
        code, _, seconds = viewer.wait(10)
        self.assertEqual(code, 130)
        self.assertLess(seconds, 1)

    def test_sizes_of_the_window(self):
        viewer = self.open()
        for size in ((1, 1), (WIDTH, 1), (1, HEIGHT), (37, 91), (WIDTH, HEIGHT)):
            self.display.xdotool("windowsize", viewer.window, *size)
            time.sleep(0.3)
        self.display.xdotool("windowunmap", viewer.window)
        time.sleep(0.3)
        self.display.xdotool("windowmap", viewer.window)
        viewer.display.still_screenshot()
        viewer.key("h")
        self.display.xdotool("mousemove", WIDTH - 1, HEIGHT - 1)
        seen = self.display.still_screenshot()
        self.assert_same(seen.columns(0, WIDTH - 20), self.rendered().columns(0, WIDTH - 20))
        self.close(viewer)

    def test_a_lost_device_is_a_message(self):
        viewer = self.enterContext(Viewer(self.display, MALUS, self.pack,
                                          environment={"LD_PRELOAD": FAILING_DEVICE, "MALUS_FAIL_AT": "6"}))
        for i in range(20):
            if viewer.process.poll() is None:
                self.display.xdotool("mousemove", 100 + i, 100)
                time.sleep(0.05)
        code, messages, _ = viewer.wait(10)
        self.assertEqual(code, 1)
        self.assertIn("lost", messages)

    @unittest.skipUnless(LEAK_SANITIZER, "no LeakSanitizer")
    def test_no_leak_at_exit(self):
        viewer = self.open("--compare-with", "fresnel", environment={"LD_PRELOAD": LEAK_SANITIZER})
        self.display.xdotool("mousemove", WIDTH - 60, HEIGHT // 2)
        viewer.key("r", "i", "8")  # reference, probe and FLIP
        self.display.still_screenshot()
        viewer.key("ctrl+q")
        code, messages, _ = viewer.wait(30)
        if "LeakSanitizer has encountered a fatal error" in messages:
            self.skipTest("LeakSanitizer cannot stop the threads here")
        self.assertEqual((code, messages), (0, ""))

    def test_random_input(self):
        seconds = float(os.environ.get("MALUS_SOAK_SECONDS", "12"))
        seed = int(os.environ.get("MALUS_SOAK_SEED", "20"))
        viewer = self.open("--compare-with", "sp", environment={})
        generator = random.Random(seed)
        keys = ("f w s a d p bracketleft bracketright m shift+m b x 1 2 3 4 5 6 7 8 r minus equal Home h F1").split()
        start, resident = time.monotonic(), []
        while time.monotonic() - start < seconds:
            x, y = generator.randrange(WIDTH), generator.randrange(HEIGHT)
            kind = generator.randrange(4)
            if kind == 0:
                viewer.key(generator.choice(keys))
            elif kind == 1:
                viewer.drag((x, y), (generator.randrange(WIDTH), generator.randrange(HEIGHT)),
                            generator.choice((1, 3)))
            elif kind == 2:
                self.display.xdotool("mousemove", x, y, "click", generator.choice((1, 4, 5)))
            else:
                time.sleep(generator.random() * 0.2)
            self.assertIsNone(viewer.process.poll(), f"seed {seed}")
            resident.append(viewer.resident_bytes())
        # The first third visits the states, whose renderers, shaders and stores are kept. Pixels depend on the view at
        # hand: at most two sides with a coarse and a complete image, the image before, reference, FLIP and idle stores.
        private, pixels = zip(*resident)
        third = len(private) // 3
        growth = statistics.median(private[-third:]) - statistics.median(private[third:2 * third])
        print(f"soak: {seconds:.0f} s, {len(private)} events, private memory at most {max(private) / 2**20:.0f} MiB, growth of "
              f"the median {growth / 2**20:.1f} MiB, pixels at most {max(pixels) / 2**20:.0f} MiB", file=sys.stderr)
        self.assertLess(max(pixels), 20 * 60 * WIDTH * HEIGHT)
        if seconds >= 300:
            self.assertLess(growth, 4 * 2**20)
        viewer.key("ctrl+q")
        self.assertEqual(viewer.wait(10)[:2], (0, ""))


if __name__ == "__main__":
    if not viewer_display.is_available():
        print("viewer_test: Xvfb and xdotool are not installed (tools/install-deps)", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
