"""From a scene pack to Mitsuba 3: reads a folder that `malus unpack PACK -o FOLDER` wrote and describes it as
a Mitsuba scene for one wavelength (variant llvm_ad_mono_polarized: full Stokes vectors, single precision).

Lengths in metres relative to the pack's origin; radiance in W/(m^2 sr). Mitsuba carries radiance L, not basic
radiance L/n^2 as malus does (shaders/optics/CONVENTIONS.md): a source inside index n has its own radiance on
both sides, and the refractive interface itself brings the factor n^2.
"""
import copy
import json
import pathlib

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_mono_polarized")

from environment import Environment  # noqa: E402  (needs the variant)

WAVELENGTHS_NM = (630, 532, 465)  # of the colours 0, 1, 2


class Unpacked:
    """A scene pack that was taken apart into a folder."""

    def __init__(self, folder: pathlib.Path):
        self.folder = pathlib.Path(folder)
        self.json = json.loads((self.folder / "scene.json").read_text())

    @property
    def depth(self) -> int:
        return self.json["depth"]

    @property
    def materials(self) -> dict:
        return {m["name"]: m for m in self.json["materials"]}

    def up(self) -> list:
        """The picture's y axis, which the camera frame of every ray refers to."""
        return self.json["camera"]["up"]

    def environment(self, colour: int) -> Environment:
        return Environment(self.json["environment"], self.folder, colour)

    def smooth_part(self) -> "Unpacked":
        """The same with black diffuse surfaces."""
        part = copy.deepcopy(self)
        for m in part.json["materials"]:
            m["albedo"] = [0.0] * 3
        return part

    def diffuse_part(self) -> "Unpacked":
        """The same without emitters and environment."""
        part = copy.deepcopy(self)
        part.json["environment"] = {"radiance": [0.0] * 3}
        for m in part.json["materials"]:
            m["radiance"] = [0.0] * 3
        return part


def bsdf(m: dict, colour: int) -> dict:
    """What a surface of material m does to light that meets the side of its normal."""
    outside = m["outsideEta"]
    if m["type"] in ("polarizer", "wave-plate"):
        raise ValueError(f"material '{m['name']}': sheets of type {m['type']} are not handed to Mitsuba")
    if m["type"] == "glass":  # no dispersion: the index at 532 nm in every colour
        return {"type": "dielectric", "int_ior": m["eta"][1], "ext_ior": outside}
    if m["type"] == "metal":
        return {"type": "conductor", "eta": m["eta"][colour] / outside, "k": m["k"][colour] / outside}
    if m["type"] == "mirror-glass":  # a conductor without k is a dielectric that only reflects
        return {"type": "conductor", "eta": m["eta"][1] / outside, "k": 0.0}
    return {"type": "diffuse", "reflectance": 0.0 if m["type"] == "emitter" else m["albedo"][colour]}


# Keys that few materials have (bake/unpack.cpp).
UNUSUAL = {"absorption": "absorption is", "outsideAbsorption": "absorption outside is", "coating": "the thin film is",
           "roughness": "roughness is", "polarization": "polarization is", "maps": "textures are"}


def unsaid(scene: Unpacked) -> list[str]:
    """What the Mitsuba scene leaves out of the pack, as sentences."""
    said = []
    for m in scene.materials.values():
        if m["type"] == "paint":
            said.append(f"Material '{m['name']}': the interface above the paint is left out; it is bare Lambert.")
        if m["type"] == "metal" and any(m["albedo"]):
            said.append(f"Material '{m['name']}': the diffuse light under the metal is left out.")
        for key, what in UNUSUAL.items():
            value = m.get(key)
            if key == "coating" and value:
                value = value["thicknessNm"]
            if key == "maps" and value:
                value = any(value[name] is not None for name in ("albedo", "eta", "k"))
            if np.any(value):
                said.append(f"Material '{m['name']}': {what} left out.")
        if m["highlight"]:
            said.append(f"Material '{m['name']}': the highlight is left out.")
    if "sky" in scene.json["environment"]:
        said.append("The polarization of the sky is left out.")
    if scene.json["environment"].get("diffuseFill", 0) > 0:
        said.append("The environment's light on diffuse surfaces (diffuseFill) is left out.")
    if scene.json["camera"]["mediumEta"] != 1:
        said.append("The camera stands in an index other than 1: equal only if a closed glass mesh of that index "
                    "encloses it, for Mitsuba knows no index of the medium at the camera.")
    return said


def sensor(scene: Unpacked, width: int, height: int) -> dict:
    """Pinhole camera. Mitsuba's looks along +z, its x points to the left of the picture."""
    camera = scene.json["camera"]
    right, up, forward, position = (np.array(camera[k]) for k in ("right", "up", "forward", "position"))
    to_world = np.eye(4)
    to_world[:3] = np.stack([-right, up, forward, position], axis=1)
    return {
        "type": "perspective", "fov": camera["verticalFovDegrees"], "fov_axis": "y", "near_clip": 1e-4,
        "to_world": mi.ScalarTransform4f(to_world),
        "sampler": {"type": "stratified", "sample_count": 1, "jitter": False},  # the pixels' centres
        "film": {"type": "hdrfilm", "width": width, "height": height, "pixel_format": "luminance",
                 "rfilter": {"type": "box"}},
    }


def mitsuba_scene(scene: Unpacked, colour: int, width: int, height: int, environment: bool = True) -> mi.Scene:
    """The scene at WAVELENGTHS_NM[colour], with or without its environment."""
    description = {"type": "scene", "sensor": sensor(scene, width, height)}
    infinity = scene.environment(colour).emitter() if environment else None
    if infinity:
        description["environment"] = infinity
    for i, light in enumerate(scene.json["lights"]):
        description[f"light{i}"] = {"type": "point", "position": light["position"],
                                    "intensity": light["intensity"][colour]}
    for i, mesh in enumerate(scene.json["meshes"]):
        material = scene.materials[mesh["material"]]
        path = scene.folder / mesh["file"]
        shape = {"type": "ply", "id": f"mesh{i}", "filename": str(path), "face_normals": not has_normals(path),
                 "bsdf": bsdf(material, colour)}
        if material["type"] == "emitter" and material["radiance"][colour] > 0:
            shape["emitter"] = {"type": "area", "radiance": material["radiance"][colour]}
        description[f"mesh{i}"] = shape
    return mi.load_dict(description, parallel=False, optimize=False)


def has_normals(path: pathlib.Path) -> bool:
    """Whether a PLY file has normals of its vertices."""
    with open(path, "rb") as file:
        return b"property float nx" in file.read(2048).split(b"end_header")[0]
