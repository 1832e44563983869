#!/usr/bin/env python3
"""Tests of tools/mitsuba on small scenes whose Stokes vectors have closed forms.

Needs the environment that tools/mitsuba/install makes, and fails without it.
"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

kRoot = pathlib.Path(__file__).resolve().parents[2]
kTools = kRoot / "tools" / "mitsuba"
kPython = kRoot / "build" / "mitsuba" / "bin" / "python"
if pathlib.Path(sys.prefix).resolve() != kPython.parents[1].resolve():
    if not kPython.exists():
        sys.exit("mitsuba_test: Mitsuba is not installed: run tools/mitsuba/install")
    os.environ["DRJIT_LIBLLVM_PATH"] = subprocess.run([kTools / "install", "--llvm"], check=True, capture_output=True,
                                                      text=True).stdout.strip()
    os.execv(kPython, [str(kPython), *sys.argv])

sys.dont_write_bytecode = True
sys.path.insert(0, str(kTools))
import export  # noqa: E402
import drjit as dr  # noqa: E402
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402

import difference  # noqa: E402
import environment  # noqa: E402
import integrator  # noqa: E402
import malus_rules  # noqa: E402
import simplify  # noqa: E402
import stock  # noqa: E402
import tables  # noqa: E402


def material(name: str, kind: str, **changes) -> dict:
    zero = [0.0, 0.0, 0.0]
    return {"name": name, "type": kind, "eta": [1.5] * 3, "k": zero, "outsideEta": 1.0, "albedo": zero,
            "radiance": zero, "highlight": None} | changes


def quad(middle, u, v) -> np.ndarray:
    """Returns the corners of a parallelogram, counter-clockwise about cross(u, v)."""
    m, u, v = (np.array(x, float) for x in (middle, u, v))
    return np.array([m - u - v, m + u - v, m + u + v, m - u + v])


def write_ply(path: pathlib.Path, corners: np.ndarray) -> None:
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(corners) // 2}\nproperty list uchar int vertex_indices\nend_header\n")
    data = corners.astype("<f4").tobytes()
    for i in range(0, len(corners), 4):
        for face in ((i, i + 1, i + 2), (i, i + 2, i + 3)):
            data += b"\x03" + np.array(face, "<i4").tobytes()
    path.write_bytes(header.encode() + data)


class Scene:
    """An unpacked folder with quads; the camera at the origin looks along -z by default."""

    def __init__(self, test: unittest.TestCase, materials: list, quads: list, camera=None, **changes):
        holder = tempfile.TemporaryDirectory()
        test.addCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        view = {"position": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0], "forward": [0, 0, -1],
                "verticalFovDegrees": 1.0, "mediumEta": 1.0} | (camera or {})
        meshes = []
        for i, (name, corners) in enumerate(quads):
            write_ply(folder / f"{i}.ply", corners)
            meshes.append({"name": str(i), "file": f"{i}.ply", "material": name, "openSurface": False})
        scene = {"name": "test", "resolution": [1, 1], "depth": 8, "camera": view, "lights": [],
                 "environment": {"radiance": [1.0] * 3, "ambientIrradiance": 0}, "materials": materials, "meshes": meshes}
        (folder / "scene.json").write_text(json.dumps(scene | changes))
        self.unpacked = export.Unpacked(folder)

    def centre(self, colour: int = 1) -> np.ndarray:
        """Returns the Stokes vector of the one pixel, by the rules of malus."""
        scene = export.mitsuba_scene(self.unpacked, colour, 1, 1, environment=False)
        rules = malus_rules.Rules(scene, self.unpacked, colour)
        return integrator.render(scene, self.unpacked.up(), self.unpacked.depth, rules).stokes[0]


def reflectance(degrees: float, n: complex) -> tuple[float, float]:
    c = math.cos(math.radians(degrees))
    t = np.sqrt(n * n - math.sin(math.radians(degrees)) ** 2 + 0j)
    return abs((c - t) / (c + t)) ** 2, abs((n * n * c - t) / (n * n * c + t)) ** 2


def mirror(degrees: float, flipped: bool = False) -> np.ndarray:
    """Returns a large mirror at (0, 0, -2) with this angle of incidence; the plane of incidence is vertical."""
    a = math.radians(degrees)
    u, v = (50, 0, 0), (0, 50 * math.cos(a), -50 * math.sin(a))
    return quad((0, 0, -2), v, u) if flipped else quad((0, 0, -2), u, v)


class ClosedForms(unittest.TestCase):
    def test_metal_reflects_with_rs_along_x(self):
        gold = material("gold", "metal", eta=[0.19, 0.54, 1.33], k=[3.4, 2.23, 1.87])
        for colour in range(3):
            rs, rp = reflectance(60, complex(gold["eta"][colour], -gold["k"][colour]))
            s = Scene(self, [gold], [("gold", mirror(60))]).centre(colour)
            np.testing.assert_allclose(s, [(rs + rp) / 2, (rs - rp) / 2, 0, 0], atol=2e-6)

    def test_mirror_glass_reflects_as_glass(self):
        for degrees in (0, 30, 56.31, 85):
            rs, rp = reflectance(degrees, 1.5)
            s = Scene(self, [material("g", "mirror-glass")], [("g", mirror(degrees))]).centre()
            np.testing.assert_allclose(s, [(rs + rp) / 2, (rs - rp) / 2, 0, 0], atol=2e-6)

    def test_outside_index_divides(self):
        rs, rp = reflectance(60, 1.5 / 1.33)
        s = Scene(self, [material("g", "mirror-glass", outsideEta=1.33)], [("g", mirror(60))]).centre()
        np.testing.assert_allclose(s, [(rs + rp) / 2, (rs - rp) / 2, 0, 0], atol=2e-6)

    def test_both_sides_of_a_mirror_are_alike(self):
        gold = material("gold", "metal", eta=[0.5] * 3, k=[2.2] * 3)
        lamp = material("lamp", "mirror-glass")
        tilted = quad((0, 3, -2), (40, 10, 0), (0, 10, 40))  # polarizes the light that the gold reflects
        images = [Scene(self, [gold, lamp], [("gold", mirror(50, flipped)), ("lamp", tilted)]).centre()
                    for flipped in (False, True)]
        self.assertGreater(abs(images[0][3]), 1e-3)
        np.testing.assert_allclose(images[0], images[1], atol=1e-6)

    def test_slab_sums_all_reflections(self):
        a = math.radians(60)
        u, v = np.array([50, 0, 0]), np.array([0, 50 * math.cos(a), -50 * math.sin(a)])
        normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        front, back = quad((0, 0, -2), u, v), quad(np.array([0, 0, -2]) - 0.01 * normal, v, u)
        lamp = quad((0, 0, -60), (9, 0, 0), (0, 9, 0))  # the front face reflects only black
        s = Scene(self, [material("g", "glass"), material("lamp", "emitter", radiance=[1.0] * 3)],
                  [("g", front), ("g", back), ("lamp", lamp)], depth=24, environment={"radiance": [0.0] * 3}).centre()
        ts, tp = ((1 - r) / (1 + r) for r in reflectance(60, 1.5))
        np.testing.assert_allclose(s, [(ts + tp) / 2, (ts - tp) / 2, 0, 0], atol=1e-5)

    def test_white_sky_from_inside_glass(self):
        surface = quad((0, 0, -1), (0, 50, 0), (50, 0, 0))  # its normal points away from the camera
        black = quad((0, 0, 1), (50, 0, 0), (0, 50, 0))
        s = Scene(self, [material("g", "glass"), material("b", "lambert")], [("g", surface), ("b", black)],
                  camera={"mediumEta": 1.5}).centre()
        r = reflectance(0, 1.5)[0]
        np.testing.assert_allclose(s, [2.25 * (1 - r), 0, 0, 0], atol=1e-5)

    def test_lambert_under_a_point_light(self):
        lights = [{"type": "point", "position": [0, 3, 0], "intensity": [5.0] * 3}]
        s = Scene(self, [material("w", "lambert", albedo=[0.8] * 3)], [("w", mirror(0))], lights=lights,
                  environment={"radiance": [0.0] * 3}).centre()
        distance = math.hypot(3, 2)
        np.testing.assert_allclose(s, [0.8 / math.pi * 5 / distance**2 * 2 / distance, 0, 0, 0], rtol=1e-5, atol=0)

    def test_emitter_emits_on_the_side_of_its_normal(self):
        lamp = material("lamp", "emitter", radiance=[3.0] * 3, outsideEta=1.33)
        for flipped, expected in ((False, 3.0), (True, 0.0)):
            s = Scene(self, [lamp], [("lamp", mirror(0, flipped))], camera={"mediumEta": 1.33}).centre()
            self.assertAlmostEqual(s[0], expected, places=5)

    def test_two_sided_emitter_emits_on_both_sides(self):
        lamp = material("lamp", "emitter", radiance=[3.0, 2.0, 1.0], outsideEta=1.33, twoSided=True)
        for flipped in (False, True):
            scene = Scene(self, [lamp], [("lamp", mirror(0, flipped))], camera={"mediumEta": 1.33})
            for colour, expected in enumerate((3.0, 2.0, 1.0)):
                self.assertAlmostEqual(scene.centre(colour)[0], expected, places=5)

    def test_two_sided_emitter_lights_diffuse_surfaces_in_path(self):
        """A floor of albedo 0.8 under the back of a wide lamp: `path` samples the lamp directly."""
        floor = material("floor", "lambert", albedo=[0.8] * 3)
        lamp = material("lamp", "emitter", radiance=[3.0] * 3, twoSided=True)
        below = quad((0, -0.5, -2), (0, 0, 500), (500, 0, 0))  # its normal points up, toward the lamp's back
        above = quad((0, 0.5, -2), (0, 0, 500), (500, 0, 0))
        scene = Scene(self, [floor, lamp], [("floor", below), ("lamp", above)],
                      camera={"forward": [0, -0.6, -0.8], "up": [0, 0.8, -0.6]}).unpacked
        described = export.mitsuba_scene(scene, 1, 1, 1, environment=False)
        s = stock.sampled(described, scene.up(), 2, 4000)[0]
        self.assertAlmostEqual(s[0], 0.8 * 3, delta=0.1)


class Materials(unittest.TestCase):
    def kinds(self) -> list[str]:
        """Returns every kind of material that malus has."""
        rows = (kRoot / "bake" / "pack" / "material_kinds.def").read_text()
        found = re.findall(r'^MALUS_MATERIAL_KIND\(\w+, *\d+, *"([a-z-]+)"', rows, re.MULTILINE)
        self.assertIn("thin-glass", found)
        return found

    def test_every_kind_is_exported_or_refused_by_name(self):
        for kind in self.kinds():
            scene = Scene(self, [material("odd one", kind)], [("odd one", mirror(0))])
            if kind in export.BSDFS:
                export.mitsuba_scene(scene.unpacked, 1, 1, 1)
                continue
            with self.assertRaises(ValueError) as caught:
                export.mitsuba_scene(scene.unpacked, 1, 1, 1)
            for part in ("odd one", kind, "expected", "metal"):
                self.assertIn(part, str(caught.exception))

    def test_all_materials_without_an_equivalent_are_listed(self):
        materials = [material("window", "thin-glass"), material("gold", "metal"), material("film", "polarizer")]
        scene = Scene(self, materials, [(m["name"], mirror(0)) for m in materials])
        with self.assertRaises(ValueError) as caught:
            export.mitsuba_scene(scene.unpacked, 1, 1, 1)
        for part in ("'window' (thin-glass)", "'film' (polarizer)"):
            self.assertIn(part, str(caught.exception))
        self.assertNotIn("gold", str(caught.exception))

    def test_mitsubas_thin_dielectric_is_not_a_polarized_pane(self):
        """The reason why thin-glass is refused. If this fails, Mitsuba has changed and thin-glass may be exported."""
        pane = mi.load_dict({"type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0})
        si = dr.zeros(mi.SurfaceInteraction3f, 1)
        si.n, si.sh_frame = mi.Normal3f(0, 0, 1), mi.Frame3f(mi.Normal3f(0, 0, 1))
        si.wi = mi.Vector3f(math.sin(math.radians(60)), 0, math.cos(math.radians(60)))
        out, weight = pane.sample(mi.BSDFContext(), si, 0.999, mi.Point2f(0.5))
        self.assertLess(out.wo.z[0], 0)  # transmitted
        through = integrator.matrices(weight, 1)[0] * out.pdf[0]
        ts, tp = ((1 - r) / (1 + r) for r in reflectance(60, 1.5))
        self.assertGreater(tp - ts, 0.2)  # a pane polarizes what it transmits
        self.assertLess(abs(through[0, 1]), 1e-6)
        self.assertGreater(abs(through[0, 0] - (ts + tp) / 2), 0.01)


class Twosided(unittest.TestCase):
    def test_mitsubas_twosided_mirrors_the_frame_on_the_back(self):
        """The reason why malus_rules rotates the frame. If this fails, Mitsuba is repaired and the README is out of date."""
        bsdf = mi.load_dict({"type": "twosided", "b": {"type": "conductor", "eta": 0.5, "k": 2.2}})
        wi, normal = mi.Vector3f(-0.3, 0.5, 0.8) / 0.99, dr.normalize(mi.Vector3f(0.1, 0.2, 0.97))
        found = []
        for n in (normal, -normal):
            si = dr.zeros(mi.SurfaceInteraction3f, 1)
            si.n, si.sh_frame = mi.Normal3f(n), mi.Frame3f(n)
            si.wi = si.to_local(wi)
            out, weight = bsdf.sample(mi.BSDFContext(), si, 0.5, mi.Point2f(0.5))
            found.append(integrator.matrices(si.to_world_mueller(weight, -out.wo, si.wi), 1)[0])
        np.testing.assert_allclose(found[0][0, 0], found[1][0, 0], rtol=1e-5)
        self.assertGreater(np.abs(found[0] - found[1]).max(), 0.1)


class Environment(unittest.TestCase):
    def test_lookup_of_a_smooth_map(self):
        size = 32
        at = (np.arange(size + 2) - 0.5) / size
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        u, v = np.meshgrid(np.clip(at, 0, 1), np.clip(at, 0, 1))
        d = np.stack([2 * u - 1, 2 * v - 1], -1)
        z = 1 - np.abs(d).sum(-1)
        fold = (1 - np.abs(d[..., ::-1])) * np.where(d >= 0, 1, -1)
        d = np.concatenate([np.where(z[..., None] < 0, fold, d), z[..., None]], -1)
        d /= np.linalg.norm(d, axis=-1, keepdims=True)
        mi.Bitmap((2 + d).astype(np.float32)).write(str(folder / "e.exr"))
        directions = np.random.default_rng(1).normal(size=(1000, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        for axis in range(3):
            look = environment.Environment({"image": "e.exr", "size": size}, folder, axis)
            np.testing.assert_allclose(look(directions), 2 + directions[:, axis], atol=0.05)
            emitter = mi.load_dict(look.emitter())
            si = dr.zeros(mi.SurfaceInteraction3f, len(directions))
            si.wi = mi.Vector3f(-directions.T)
            np.testing.assert_allclose(np.array(emitter.eval(si)[0, 0].x), 2 + directions[:, axis], atol=0.05)


class Stock(unittest.TestCase):
    def setUp(self):
        a = quad((0, 0, -2), (1, 0, 0), (0, 0.5, -0.8))
        lamp = material("lamp", "emitter", radiance=[1.0] * 3)
        self.unpacked = Scene(self, [material("g", "glass"), lamp],
                              [("g", a), ("g", a[::-1] - [0, 0, 0.1]), ("lamp", quad((0, 0, -9), (9, 0, 0), (0, 9, 0)))],
                              camera={"verticalFovDegrees": 20.0}, environment={"radiance": [0.0] * 3}).unpacked
        self.scene = export.mitsuba_scene(self.unpacked, 1, 8, 8)
        self.image = integrator.render(self.scene, self.unpacked.up(), 8)
        self.mean = stock.sampled(self.scene, self.unpacked.up(), 9, 4096)

    def test_path_agrees(self):
        found = stock.check_bounds(self.image, self.mean, 4096)
        self.assertEqual(found["violations"], 0)
        self.assertGreater(found["random"], 100, found)
        self.assertTrue(0.7 < found["rmsZ"] < 1.3, found)

    def test_an_error_of_a_few_per_cent_is_found(self):
        self.image.stokes[:, 0] *= 1.05
        self.assertGreater(stock.check_bounds(self.image, self.mean, 4096)["violations"], 0)


class AreaLights(unittest.TestCase):
    """Diffuse surfaces under area lamps: malus's reference with its fixed samples and Mitsuba's `direct` integrator."""
    WIDTH = 32
    QUADS = {"floor": quad((0, 0, -6), (4, 0, 0), (0, 4, 0)), "block": quad((0.4, 0.2, -5.5), (0.5, 0, 0.1), (0, 0.4, 0.2)),
             "lamp": quad((-0.8, 0.5, -4), (0, 0.5, 0), (0.4, 0, -0.2)), "panel": quad((2.2, -0.5, -5), (0, 0.6, 0), (0, 0, 0.5))}

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        materials = {"white": {"type": "lambert", "albedo": 0.8}, "grey": {"type": "lambert", "albedo": 0.3},
                     "lamp": {"type": "emitter", "radiance": [4, 4, 4], "illuminates": True},
                     "panel": {"type": "emitter", "radiance": [2, 2, 2], "illuminates": True, "twoSided": True}}
        of = {"floor": "white", "block": "grey"}
        meshes = []
        for name, corners in self.QUADS.items():
            write_ply(self.folder / f"{name}.ply", corners)
            meshes.append({"name": name, "file": f"{name}.ply", "material": of.get(name, name), "flat": True})
        scene = {"malus": 1, "name": "lamps", "resolution": [self.WIDTH] * 2, "depth": 1, "materials": materials,
                 "meshes": meshes, "camera": {"position": [0, 0, 0], "target": [0, 0, -1], "verticalFovDegrees": 55}}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.malus("bake", "scene.json", "-o", "lamps.pack")

    def malus(self, *arguments):
        done = subprocess.run([kRoot / "build/release/bin/malus", *arguments], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def image(self, *options) -> np.ndarray:
        self.malus("render", "lamps.pack", "-o", "out.exr", "--backend", "reference", "--compression", "zip", *options)
        bitmap = mi.Bitmap(str(self.folder / "out.exr"))
        return np.array(bitmap, np.float64)[..., [field.name for field in bitmap.struct_()].index("G")]

    def test_diffuse_surfaces_under_lamps_agree_within_the_noise(self):
        self.malus("unpack", "lamps.pack", "-o", "unpacked")
        unpacked = export.Unpacked(self.folder / "unpacked")
        scene = export.mitsuba_scene(unpacked, 1, self.WIDTH, self.WIDTH)
        direct = mi.load_dict({"type": "direct", "emitter_samples": 4, "bsdf_samples": 0})
        runs = np.array([np.array(mi.render(scene, integrator=direct, spp=1024, seed=seed)).reshape(
            self.WIDTH, self.WIDTH, -1)[..., 0] for seed in range(8)])
        mean, error = runs.mean(0), runs.std(0, ddof=1) / math.sqrt(len(runs))
        fine = self.image("--samples", "16", "--light-samples", "16")
        other = self.image("--samples", "15", "--light-samples", "15")
        # Grids of camera rays alias at the outlines of the lamps, which are parallel to them, mostly to different values.
        z = (fine - mean) / np.sqrt(error**2 + (fine - other)**2 + (3e-4 * mean.mean())**2)
        self.assertLess(np.mean(np.abs(z) > 5), 0.02, np.sort(np.abs(z).ravel())[-20:])
        near = [np.roll(fine, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        inside = (np.max(near, 0) < 1) & (np.min(near, 0) > 0.3 * fine) & (np.abs(fine - other) < 5e-3 * fine)
        self.assertGreater(inside.mean(), 0.5)
        self.assertLess(abs(fine[inside].mean() / mean[inside].mean() - 1), 1e-3)
        # 4 samples per hit are as right on average.
        few = self.image("--samples", "16", "--light-samples", "4")
        self.assertLess(abs(few[inside].mean() / mean[inside].mean() - 1), 1e-3)


class Speed(unittest.TestCase):
    def test_both_trace_the_same_rays_without_glass(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "speed.json"
            done = subprocess.run([kTools / "compare", "--speed", "--scenes", "engine", "--width", "128", "--rounds", "1",
                                   "--json", file], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("| engine |", done.stdout)
            result = json.loads(file.read_text())["scenes"]["engine"]
        self.assertAlmostEqual(result["mitsubaRays"] / result["rays"], 1, delta=0.05)
        self.assertAlmostEqual(result["ratio"], result["millionRaysPerSecond"] / result["mitsubaMillionRaysPerSecond"])


class Numbers(unittest.TestCase):
    def test_statistics_count_outliers(self):
        a = np.full((4, 4, 3, 4), 0.5)
        b = a.copy()
        b[1, 2, 0, 3] += 0.1
        found = difference.statistics(b, a)
        self.assertEqual(found["outliers"], 1)
        self.assertAlmostEqual(found["max"][3], 0.2)
        self.assertEqual(found["rmsOrdinary"], [0.0] * 4)

    def test_failures_name_scene_and_number(self):
        r = {"rmsOrdinary": [0, 0, 1e-3, 0], "outlierShare": 0, "unexplained": 0}
        results = {"x": {"reference": r, "embree": r | {"rmsOrdinary": [0] * 4}, "width": 2, "height": 2, "stock": {}}}
        most = {"default": {"rms": 1e-5, "outlierShare": 0, "unexplainedShare": 0, "pathShare": 0, "stokes": 1},
                "scenes": {}}
        failures = tables.failures(results, most)
        self.assertEqual(len(failures), 1)
        for part in ("x", "reference", "S2", "0.001", "1e-05"):
            self.assertIn(part, failures[0])

    def test_simplified_scenes_list_replacements(self):
        scene = {"environment": {"radiance": [1, 1, 1], "ambientIrradiance": 0.5}, "meshes": [], "materials": {
            "a": {"type": "paint", "eta": 1.6, "albedo": 0.2, "highlight": {"exponent": 2}},
            "b": {"type": "metal", "preset": "gold", "albedo": 0.1}, "c": {"type": "glass", "eta": 1.5}}}
        new, replaced = simplify.simplified(scene)
        self.assertEqual(new["materials"], {"a": {"type": "lambert", "albedo": 0.2},
                                            "b": {"type": "metal", "preset": "gold"},
                                            "c": {"type": "glass", "eta": 1.5}})
        self.assertEqual(len(replaced), 4)
        self.assertIn("highlight", scene["materials"]["a"])


if __name__ == "__main__":
    unittest.main()
