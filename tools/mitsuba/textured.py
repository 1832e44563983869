"""Scenes with textures for the comparison: glTF files of a few quads and curved sheets, which malus imports.

A texel covers several pixels everywhere, also in mirrors, so that malus reads level 0 of every texture, and Mitsuba,
which has no levels, the same texels.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scenes"))

from malus_scenes import model_textures, noise, texture_files  # noqa: E402
from malus_scenes.gltf_file import Model  # noqa: E402
from malus_scenes.surface import flipped, grid, quad  # noqa: E402

CLAMP, MIRROR = 33071, 33648  # of glTF's samplers
SIZE = 8  # texels per side


def colours(seed: int, low, high) -> bytes:
    """Returns a PNG file of random colours, each channel from low to high (0 to 255, encoded as sRGB)."""
    return texture_files.small_png([[tuple(round(low + (high - low) * noise.hashed(x, y, seed + c) / 65535)
                                           for c in range(3)) for x in range(SIZE)] for y in range(SIZE)])


def relief(seed: int, strength: float) -> bytes:
    """Returns a normal map whose slopes are a few degrees."""
    return model_textures.normal_map(noise.noise(SIZE, 8, seed), strength)


def transformed(texture: int, **keys) -> dict:
    return {"index": texture, "extensions": {"KHR_texture_transform": keys}}


def floor(y=0.0, half=1.0):
    return quad((-half, y, half), (half, y, half), (half, y, -half), (-half, y, -half), (1.0, 1.0))


def wall(right=1.0, z=-1.0, repeats=(1.0, 1.0)):
    return quad((-1.0, 0.0, z), (right, 0.0, z), (right, 1.5, z), (-1.0, 1.5, z), repeats)


def wave():
    """Curved sheet with smooth normals beside the wall. Its back is not seen; its image covers more than the texture."""
    def point(u, v):
        return (0.1 + 0.9 * u, 0.1 + 0.9 * v, -0.9 + 0.12 * math.sin(3 * u + 1) * math.cos(2 * v))
    sheet = grid(point, 24, 24, (1.5, 1.5))
    sheet.coordinates = [(s - 0.25, t - 0.25) for s, t in sheet.coordinates]
    return sheet


def metal(path: pathlib.Path) -> None:
    """Polished metals whose colours are textures: repeated with a transform, mirrored, and clamped."""
    model = Model("metal", ["KHR_texture_transform"])
    repeated = model.image_texture("repeated", colours(1, 90, 240))
    mirrored = model.image_texture("mirrored", colours(11, 120, 240), wrapS=MIRROR, wrapT=MIRROR)
    clamped = model.image_texture("clamped", colours(21, 60, 230), wrapS=CLAMP, wrapT=CLAMP)
    turned = transformed(repeated, offset=[0.3, 0.1], rotation=0.4, scale=[1.2, 0.9])
    beside = wall(right=0.0, repeats=(0.9, 1.4))
    for name, surface, texture, factor in (("floor", floor(), turned, (1, 0.9, 0.8, 1)),
                                           ("wall", beside, {"index": mirrored}, (1, 1, 1, 1)),
                                           ("wave", wave(), {"index": clamped}, (0.9, 1, 1, 1))):
        material = model.material(name, factor, metallic=1.0, roughness=0.0, maps={"baseColorTexture": texture})
        model.node(name, mesh=model.mesh(name, (surface, material)))
    model.write(path)


def normals(path: pathlib.Path) -> None:
    """Mirrors with normal maps: tangents of derivatives and of the file, mirrored coordinates, smooth normals."""
    model = Model("normals", [])
    waves = model.image_texture("waves", relief(3, 0.8))
    dents = model.image_texture("dents", relief(5, 0.5), wrapS=CLAMP, wrapT=CLAMP)
    mirrored = wall(right=0.0)
    mirrored.coordinates = [(1 - s, t) for s, t in mirrored.coordinates]
    turned = floor()  # with tangents that are not those of the coordinates
    turned.tangents = [(math.cos(0.7), 0.0, -math.sin(0.7), 1.0)] * 4
    for name, surface, texture, scale in (("floor", turned, waves, 1.0), ("wall", mirrored, waves, 0.6),
                                          ("wave", wave(), dents, 1.0)):
        colour = {"floor": (0.9, 0.6, 0.3, 1), "wall": (0.5, 0.6, 0.7, 1), "wave": (0.8, 0.5, 0.4, 1)}[name]
        material = model.material(name, colour, metallic=1.0, roughness=0.0,
                                  normalTexture={"index": texture, "scale": scale})
        model.node(name, mesh=model.mesh(name, (surface, material)))
    model.write(path)


def lamps(path: pathlib.Path) -> None:
    """Textured diffuse surfaces under area lamps, seen directly and in a mirror with a normal map and a colour map."""
    model = Model("lamps", ["KHR_materials_emissive_strength"])
    paint = model.image_texture("paint", colours(31, 60, 250))
    waves = model.image_texture("waves", relief(7, 0.6))
    gilt = model.image_texture("gilt", colours(41, 100, 240))
    matt = model.material("matt", (1, 0.9, 0.8, 1), metallic=0.0, roughness=1.0,
                          maps={"baseColorTexture": {"index": paint}})
    mirror = model.material("mirror", (1, 1, 1, 1), metallic=1.0, roughness=0.0,
                            maps={"baseColorTexture": {"index": gilt}}, normalTexture={"index": waves})
    gold = model.material("gold", (0.9, 0.6, 0.3, 1), metallic=1.0, roughness=0.0)
    black = (0, 0, 0, 1)
    lamp = model.material("lamp", black, emissiveFactor=[1, 0.9, 0.7],
                          extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 6.0}})
    panel = model.material("panel", black, emissiveFactor=[0.5, 0.7, 1.0], doubleSided=True,
                           extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 4.0}})
    block = quad((-0.7, 0.0, 0.3), (-0.2, 0.0, 0.5), (-0.2, 0.4, 0.5), (-0.7, 0.4, 0.3))
    ceiling = flipped(quad((-0.5, 1.6, 0.3), (0.3, 1.6, 0.3), (0.3, 1.6, -0.4), (-0.5, 1.6, -0.4)))
    left = quad((-1.0, 0.0, 1.0), (-1.0, 0.0, -1.0), (-1.0, 1.2, -1.0), (-1.0, 1.2, 1.0))
    side = quad((0.98, 0.3, 0.6), (0.98, 0.3, 0.1), (0.9, 0.9, 0.1), (0.9, 0.9, 0.6))
    for name, surface, material in (("floor", floor(), matt), ("block", block, matt), ("wall", wall(), mirror),
                                    ("left", left, gold), ("ceiling", ceiling, lamp), ("side", side, panel)):
        model.node(name, mesh=model.mesh(name, (surface, material)))
    model.write(path)


def described(model: str, environment: list) -> dict:
    return {"malus": 1, "name": f"textured-{model}", "resolution": [192, 144], "depth": 6, "materials": {},
            "camera": {"position": [0.35, 0.95, 2.3], "target": [0.0, 0.45, -0.2], "verticalFovDegrees": 42},
            "environment": {"radiance": environment}, "imports": [{"file": f"{model}.glb"}]}


SCENES = {"textured/metal": (metal, [1.0, 0.9, 0.8]), "textured/normals": (normals, [1.0, 0.9, 0.8]),
          "textured/lamps": (lamps, [0.0, 0.0, 0.0])}


def write(name: str, folder: pathlib.Path) -> pathlib.Path:
    """Writes a scene of SCENES into a folder and returns the path of its scene.json."""
    model = name.split("/")[1]
    function, environment = SCENES[name]
    function(folder / f"{model}.glb")
    path = folder / "scene.json"
    path.write_text(json.dumps(described(model, environment), indent=1))
    return path
