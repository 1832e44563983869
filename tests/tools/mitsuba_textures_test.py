#!/usr/bin/env python3
"""Tests of the textures and lamps of tools/mitsuba against closed forms and a bilinear lookup in numpy.

Needs the environment that tools/mitsuba/install makes, and fails without it.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mitsuba_test import Scene, kRoot, material, mirror, quad, reflectance  # noqa: E402  (starts Mitsuba's interpreter)

import export  # noqa: E402
import drjit as dr  # noqa: E402
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402

import compare  # noqa: E402
import integrator  # noqa: E402
import lamps  # noqa: E402
import malus_rules  # noqa: E402
import stock  # noqa: E402
import textured  # noqa: E402
import textures  # noqa: E402

GOLD = {"eta": [0.5] * 3, "k": [2.2] * 3}


def mapping(texture: int, **changes) -> dict:
    plain = {"texture": texture, "set": 0, "wrapU": "repeat", "wrapV": "repeat", "u": [1, 0, 0], "v": [0, 1, 0]}
    return plain | changes


def add_coordinates(path: pathlib.Path, corners: np.ndarray, coordinates, tangents=None) -> None:
    """Writes a quad as `malus unpack` does, with texture coordinates and perhaps tangents."""
    names = ["x", "y", "z", "s", "t"] + (["tx", "ty", "tz", "tw"] if tangents is not None else [])
    rows = np.concatenate([corners, coordinates] + ([tangents] if tangents is not None else []), axis=1)
    header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\n"
    header += "".join(f"property float {n}\n" for n in names)
    header += "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    faces = b"".join(b"\x03" + np.array(face, "<i4").tobytes() for face in ((0, 1, 2), (0, 2, 3)))
    path.write_bytes(header.encode() + rows.astype("<f4").tobytes() + faces)


def textured_scene(test, m: dict, texels, corners, coordinates, tangents=None, others=(), **changes) -> Scene:
    """A quad of material m, the first mesh, whose maps read the one texture; others: (material, quad)."""
    scene = Scene(test, [m] + [o for o, _ in others], [(m["name"], corners)] + [(o["name"], q) for o, q in others],
                  textures=[{"file": "t.exr"}], **changes)
    folder = scene.unpacked.folder
    mi.Bitmap(np.ascontiguousarray(texels, dtype=np.float32)).write(str(folder / "t.exr"))
    add_coordinates(folder / "0.ply", corners, coordinates, tangents)
    return scene


def wrapped(i: int, size: int, wrap: str) -> int:
    if wrap == "clamp":
        return min(max(i, 0), size - 1)
    period = i % (2 * size)
    return min(period, 2 * size - 1 - period) if wrap == "mirror" else i % size


def bilinear(texels: np.ndarray, u: float, v: float, wrap: str) -> np.ndarray:
    """Returns the texture at (u, v), (0, 0) being its upper left corner (bake/FORMAT.md, MAPS)."""
    height, width = texels.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    i, j = math.floor(x), math.floor(y)
    total = 0
    for column, row, share in ((i, j, (i + 1 - x) * (j + 1 - y)), (i + 1, j, (x - i) * (j + 1 - y)),
                               (i, j + 1, (i + 1 - x) * (y - j)), (i + 1, j + 1, (x - i) * (y - j))):
        total = total + share * texels[wrapped(row, height, wrap), wrapped(column, width, wrap)]
    return total


class Lookup(unittest.TestCase):
    TEXELS = np.random.default_rng(3).random((3, 5, 3))
    COORDINATES = np.random.default_rng(4).uniform(-2.5, 3.5, (500, 2))

    def check(self, channels, **changes):
        described = mapping(0, **changes)
        m = material("m", "lambert") | {"meshMaps": {"albedo": described}}
        scene = textured_scene(self, m, self.TEXELS, mirror(0), np.zeros((4, 2)))
        texture = mi.load_dict(textures.Maps(scene.unpacked, m).bitmap("albedo", channels))
        si = dr.zeros(mi.SurfaceInteraction3f, len(self.COORDINATES))
        si.uv = mi.Point2f(self.COORDINATES.T)
        found = np.array(texture.eval_3(si) if isinstance(channels, list) else texture.eval_1(si)).T
        expected = []
        for s, t in self.COORDINATES:
            u, v = (np.dot(described[k], [s, t, 1]) for k in "uv")
            expected.append(bilinear(self.TEXELS, u, v, described["wrapU"])[channels])
        np.testing.assert_allclose(found, expected, atol=2e-5)

    def test_every_way_to_continue(self):
        for wrap in ("repeat", "clamp", "mirror"):
            self.check(1, wrapU=wrap, wrapV=wrap)

    def test_all_channels_under_a_transform(self):
        self.check([0, 1, 2], u=[0.8, 0.3, 0.2], v=[-0.4, 1.1, 0.7])
        self.check(2, u=[0.8, 0.3, 0.2], v=[-0.4, 1.1, 0.7], wrapU="mirror", wrapV="mirror")

    def test_other_maps_are_refused_by_name(self):
        for changes in ({"set": 1}, {"wrapV": "clamp"}):
            m = material("plate", "lambert") | {"meshMaps": {"albedo": mapping(0, **changes)}}
            scene = textured_scene(self, m, self.TEXELS, mirror(0), np.zeros((4, 2)))
            with self.assertRaises(ValueError) as caught:
                export.mitsuba_scene(scene.unpacked, 1, 1, 1)
            for part in ("plate", "albedo", "expected"):
                self.assertIn(part, str(caught.exception))

    def test_maps_that_are_left_out_are_listed(self):
        maps = {"roughness": mapping(0), "coverage": mapping(0), "albedo": mapping(0), "cutoff": 0.5}
        scene = textured_scene(self, material("plate", "lambert") | {"meshMaps": maps}, self.TEXELS, mirror(0),
                               np.zeros((4, 2)), camera={"mediumEta": 1.0})
        listed = " ".join(export.omissions(scene.unpacked))
        for part in ("plate", "'roughness'", "'coverage'"):
            self.assertIn(part, listed)
        for part in ("'albedo'", "'cutoff'"):
            self.assertNotIn(part, listed)


class Metal(unittest.TestCase):
    def test_a_texel_is_the_reflectance_at_normal_incidence(self):
        texels = np.array([[[0.2, 0.5, 0.8], [0.3, 0.6, 0.9]]] * 2)
        m = material("m", "metal", **GOLD) | {"meshMaps": {"reflectance": mapping(0)}}
        for s in (0.25, 0.75, 0.6):
            scene = textured_scene(self, m, texels, mirror(0), [[s, 0.5]] * 4)
            for colour in range(3):
                expected = bilinear(texels, s, 0.5, "repeat")[colour]
                self.assertAlmostEqual(scene.centre(colour)[0], expected, places=5)

    def test_edge_tint_and_obliqueness(self):
        """Tint 0 is a dielectric; the index follows from the interpolated reflectance."""
        texels = np.full((2, 2, 3), 0.04)
        texels[..., 0] = 0  # red: the tint
        maps = {"reflectance": mapping(0), "metallic": mapping(0)}
        m = material("m", "metal", **GOLD) | {"meshMaps": maps}
        scene = textured_scene(self, m, texels, mirror(60), [[0.5, 0.5]] * 4)
        rs, rp = reflectance(60, 1.5)
        np.testing.assert_allclose(scene.centre(1), [(rs + rp) / 2, (rs - rp) / 2, 0, 0], atol=2e-5)


class NormalMap(unittest.TestCase):
    SQUARE = [[0, 1], [1, 1], [1, 0], [0, 0]]  # of quad(): the image upright

    def scene(self, tilt, coordinates=SQUARE, tangents=None, scale=1.0, flipped=False) -> Scene:
        """A mirror that faces the camera, with a uniform map, under a lamp above."""
        n = np.array(tilt) / np.linalg.norm(tilt)
        m = material("m", "metal", **GOLD) | {"meshMaps": {"normal": mapping(0), "normalScale": scale}}
        corners = mirror(0)
        if flipped:
            corners, coordinates = corners[::-1], coordinates[::-1]
        lamp = material("lamp", "emitter", radiance=[1.0] * 3, twoSided=True)
        above = quad((0, 40, -2), (500, 0, 0), (0, 0, 39))
        return textured_scene(self, m, np.broadcast_to((n + 1) / 2, (2, 2, 3)), corners, coordinates, tangents,
                              others=[(lamp, above)], environment={"radiance": [0.0] * 3})

    def check(self, scene: Scene, degrees: float, is_lit: bool, along: str):
        rs, rp = (np.array(reflectance(degrees, complex(0.5, -2.2))) * is_lit)
        sign = {"y": 1, "x": -1}[along]  # x is the s direction if the plane of incidence is vertical
        np.testing.assert_allclose(scene.centre(), [(rs + rp) / 2, sign * (rs - rp) / 2, 0, 0], atol=2e-5)

    def test_the_top_of_the_image_is_the_second_direction(self):
        a = math.radians(40)
        for sign in (1, -1):
            self.check(self.scene((0, sign * math.sin(a), math.cos(a))), 40, sign > 0, "y")

    def test_mirrored_coordinates_keep_the_top(self):
        a = math.radians(40)
        mirrored = [[1 - s, t] for s, t in self.SQUARE]
        self.check(self.scene((0, math.sin(a), math.cos(a)), mirrored), 40, True, "y")
        upside_down = [[s, 1 - t] for s, t in self.SQUARE]
        self.check(self.scene((0, -math.sin(a), math.cos(a)), upside_down), 40, True, "y")

    def test_tangents_of_the_mesh_replace_the_derivatives(self):
        a = math.radians(40)
        upward = [[0, 1, 0, 1]] * 4  # x of the map is up, y to the left
        self.check(self.scene((math.sin(a), 0, math.cos(a)), tangents=upward), 40, True, "y")
        self.check(self.scene((0, math.sin(a), math.cos(a)), tangents=[[-1, 0, 0, -1]] * 4), 40, True, "y")

    def test_scale(self):
        self.check(self.scene((0, math.tan(math.radians(40)) / 0.5, 1), scale=0.5), 40, True, "y")

    def test_the_back_of_a_mirror_has_the_same_relief(self):
        """Seen from behind, a slope up on the front is a slope down."""
        a = math.radians(40)
        self.check(self.scene((0, -math.sin(a), math.cos(a)), flipped=True), 40, True, "y")

    def test_a_normal_that_reflects_below_the_face_is_replaced(self):
        a = math.radians(50)
        scene = self.scene((0, math.sin(a), math.cos(a)))
        scene.unpacked.json["environment"] = {"radiance": [1.0] * 3}
        rs, rp = reflectance(0, complex(0.5, -2.2))
        np.testing.assert_allclose(scene.centre(), [(rs + rp) / 2, 0, 0, 0], atol=2e-5)

    def test_mitsubas_normalmap_does_not_rotate_the_frame(self):
        """The reason for the plugin. If this fails, Mitsuba is repaired and the README is out of date."""
        n = np.array([0.2, -0.1, 1.0]) / np.linalg.norm([0.2, -0.1, 1.0])
        map_ = {"type": "bitmap", "raw": True, "bitmap": mi.Bitmap(np.full((2, 2, 3), (n + 1) / 2, np.float32))}
        conductor = {"type": "conductor", "eta": 0.5, "k": 2.2}
        si = dr.zeros(mi.SurfaceInteraction3f, 1)
        si.n, si.sh_frame = mi.Normal3f(0, 0, 1), mi.Frame3f(mi.Normal3f(0, 0, 1))
        si.dp_du, si.dp_dv = mi.Vector3f(si.sh_frame.s), mi.Vector3f(-si.sh_frame.t)
        si.wi = dr.normalize(mi.Vector3f(0.5, 0.3, 0.8))
        found = []
        for bsdf in ({"type": "normalmap", "normalmap": map_, "b": conductor},
                     {"type": textures.MAPPED_NORMAL, "normals": map_, "nested": conductor, "scale": 1.0,
                      "has_tangents": False}):
            out, weight = mi.load_dict(bsdf).sample(mi.BSDFContext(), si, 0.5, mi.Point2f(0.5))
            found.append((np.array(out.wo), integrator.matrices(si.to_world_mueller(weight, -out.wo, si.wi), 1)[0]))
        # The truth: the conductor in the frame of the mapped normal.
        turned = mi.SurfaceInteraction3f(si)
        turned.sh_frame = mi.Frame3f(mi.Normal3f(*(float(x) for x in n)))
        turned.wi = turned.to_local(si.to_world(si.wi))
        out, weight = mi.load_dict(conductor).sample(mi.BSDFContext(), turned, 0.5, mi.Point2f(0.5))
        truth = integrator.matrices(turned.to_world_mueller(weight, -out.wo, turned.wi), 1)[0]
        np.testing.assert_allclose(found[0][0], found[1][0], atol=1e-5)
        np.testing.assert_allclose(found[1][1], truth, atol=1e-6)
        self.assertGreater(np.abs(found[0][1] - truth).max(), 0.1)


def irradiance(corners: np.ndarray, p: np.ndarray, normal: np.ndarray) -> float:
    """Returns the irradiance at p by a polygon of radiance 1 above the horizon: Lambert's formula, as in Baum,
    Rushmeier and Winget, "Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors", 1989.
    """
    d = corners - p
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    total = 0.0
    for a, b in zip(d, np.roll(d, -1, axis=0)):
        across = np.cross(a, b)
        total += math.acos(np.clip(a @ b, -1, 1)) * (across / np.linalg.norm(across)) @ normal
    return abs(total) / 2


class LampsOnTextures(unittest.TestCase):
    """A textured floor under a rectangle: albedo of the texel times Lambert's formula over pi, in malus and Mitsuba."""
    WIDTH = 24
    LAMP = quad((0.3, 1.0, -0.2), (0.5, 0, 0), (0, 0, 0.4))

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        model = textured.Model("floor", [])
        paint = model.image_texture("paint", textured.colours(51, 80, 250))
        matt = model.material("matt", (1, 1, 1, 1), metallic=0.0, roughness=1.0,
                              maps={"baseColorTexture": {"index": paint}})
        lamp = model.material("lamp", (0, 0, 0, 1), emissiveFactor=[1, 1, 1])
        below = textured.quad(*(tuple(p) for p in self.LAMP))
        for name, surface, of in (("floor", textured.floor(), matt), ("lamp", below, lamp)):
            model.node(name, mesh=model.mesh(name, (surface, of)))
        model.write(self.folder / "floor.glb")
        scene = textured.described("floor", [0.0] * 3)
        scene["resolution"] = [self.WIDTH] * 2
        scene["camera"] = {"position": [0, 0.8, 0.01], "target": [0, 0, 0], "up": [0, 0, -1], "verticalFovDegrees": 70}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.malus("bake", "scene.json", "-o", "floor.pack")
        self.malus("unpack", "floor.pack", "-o", "unpacked")
        self.unpacked = export.Unpacked(self.folder / "unpacked")

    def malus(self, *arguments):
        done = subprocess.run([kRoot / "build/release/bin/malus", *arguments], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def truth(self) -> np.ndarray:
        texels = self.unpacked.texture(0)
        camera = self.unpacked.json["camera"]
        origin, right, up, forward = (np.array(camera[k]) for k in ("position", "right", "up", "forward"))
        half = math.tan(math.radians(camera["verticalFovDegrees"]) / 2)
        at = ((np.arange(self.WIDTH) + 0.5) / self.WIDTH * 2 - 1) * half
        floor = -np.array(self.unpacked.json["origin"])[1]
        lamp, image = self.LAMP - self.unpacked.json["origin"], np.zeros((self.WIDTH, self.WIDTH, 3))
        for row, column in np.ndindex(self.WIDTH, self.WIDTH):
            d = forward + at[column] * right - at[row] * up
            p = origin + d * (floor - origin[1]) / d[1]
            world = p + self.unpacked.json["origin"]
            # The coordinates of textured.floor(): u along +x, v along +z.
            albedo = bilinear(texels, (world[0] + 1) / 2, (world[2] + 1) / 2, "repeat")
            image[row, column] = albedo / math.pi * irradiance(lamp, p, np.array([0, 1.0, 0]))
        return image

    def test_both_agree_with_the_closed_form(self):
        truth = self.truth()
        # The middle pixels of an image of 9 times as many, as in compare.py.
        size = str(9 * self.WIDTH)
        self.malus("render", "floor.pack", "--backend", "reference", "--light-samples", "256", "-o", "out.exr",
                   "--width", size, "--height", size, "--compression", "zip")
        bitmap = mi.Bitmap(str(self.folder / "out.exr"))
        names = [field.name for field in bitmap.struct_()]
        ours = np.array(bitmap, np.float64)[4::9, 4::9][..., [names.index(c) for c in "RGB"]]
        ratio = ours / truth
        self.assertLess(np.abs(ratio - 1).max(), 0.03)
        self.assertLess(abs(ratio.mean() - 1), 5e-4)
        for colour in range(3):
            scene = export.mitsuba_scene(self.unpacked, colour, self.WIDTH, self.WIDTH, environment=False)
            rules = malus_rules.Rules(scene, self.unpacked, colour)
            image = integrator.render(scene, self.unpacked.up(), 2, rules, lamps=lamps.Lamps(4096, 1))
            ratio = image.stokes[:, 0].reshape(self.WIDTH, self.WIDTH) / truth[..., colour]
            self.assertLess(np.abs(ratio - 1).max(), 0.1)
            self.assertLess(abs(ratio.mean() - 1), 3e-3)


class RoughMetal(unittest.TestCase):
    """A plate with a roughness texture in a white environment, as Mitsuba's `roughconductor` with `path`. malus has the
    mean of 16 facets, which errs by 1 % where one of them reflects below the horizon or just does not. Mitsuba's masking
    is separable and that of malus height-correlated, which is 0.2 % at most here (alpha up to 0.3, 50 degrees)."""
    WIDTH = 20

    def test_texels_of_roughness(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        model = textured.Model("rough", [])
        # Roughness is the green channel, as stored: alpha is its square, from 0.02 to 0.3.
        texels = [[(0, 35 + 35 * ((x + 2 * y) % 4), 255) for x in range(4)] for y in range(4)]
        texture = model.image_texture("roughness", textured.texture_files.small_png(texels))
        plate = model.material("plate", (0.9, 0.5, 0.2, 1), metallic=1.0, roughness=1.0,
                               maps={"metallicRoughnessTexture": {"index": texture}})
        model.node("plate", mesh=model.mesh("plate", (textured.floor(), plate)))
        model.write(folder / "rough.glb")
        scene = textured.described("rough", [1.0] * 3) | {"resolution": [self.WIDTH] * 2, "depth": 2}
        scene["camera"] = {"position": [0, 1.4, 1.2], "target": [0, 0, 0], "verticalFovDegrees": 30}
        (folder / "scene.json").write_text(json.dumps(scene))
        program = kRoot / "build/release/bin/malus"
        size = str(9 * self.WIDTH)
        for arguments in (["bake", "scene.json", "-o", "p.pack"], ["unpack", "p.pack", "-o", "unpacked"],
                          ["render", "p.pack", "--backend", "reference", "--compression", "zip", "--width", size,
                           "--height", size, "-o", "out.exr"]):
            done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        ours = compare.read_stokes(folder / "out.exr")[4::9, 4::9].reshape(-1, 3, 4)
        unpacked = export.Unpacked(folder / "unpacked")
        for colour in (0, 2):
            described = export.mitsuba_scene(unpacked, colour, self.WIDTH, self.WIDTH, rough=True)
            other = stock.sampled(described, unpacked.up(), 3, 4096)
            mean = other[:, 0].mean()
            difference = (ours[:, colour] - other) / mean
            self.assertGreater(np.ptp(other[:, 0]) / mean, 0.1)  # the texture shows
            rms = np.sqrt((difference**2).mean(axis=0))
            self.assertLess(rms[0], 0.025)  # measured: 0.020 and 0.015
            self.assertLess(rms[1], 0.012)  # 0.001 and 0.009
            self.assertLess(rms[2], 0.007)  # 0.0004 and 0.005
            self.assertLess(np.abs(difference.mean(axis=0)).max(), 0.015)


class NoisyImages(unittest.TestCase):
    def images(self, seed: int, count=12, bias=0.0) -> list:
        random = np.random.default_rng(seed)
        truth = np.random.default_rng(0).random((400, 3, 4))
        return [truth * (1 + bias) + random.normal(0, 0.01, truth.shape) for _ in range(count)]

    def test_equal_images_are_within_the_bound(self):
        found = lamps.compare(self.images(1), self.images(2))
        self.assertEqual(found["violations"], 0)
        self.assertTrue(0.9 < found["rmsZ"] < 1.2, found)
        self.assertLess(max(found["bias"]), 4)

    def test_a_bias_below_the_noise_is_found(self):
        self.assertGreater(max(lamps.compare(self.images(1, bias=0.002), self.images(2))["bias"]), 4)

    def test_a_different_pixel_is_found(self):
        ours = self.images(1)
        for image in ours:
            image[7, 1, 2] += 0.2
        self.assertEqual(lamps.compare(ours, self.images(2))["violations"], 1)

    def test_quantiles_of_student(self):
        for probability, freedom, quantile in ((0.05, 10, 2.228), (0.01, 30, 2.750), (0.001, 5, 6.869)):
            self.assertAlmostEqual(lamps.student_quantile(probability, freedom), quantile, places=3)


if __name__ == "__main__":
    unittest.main()
