"""From a scene pack to Mitsuba 3: reads a folder that `malus unpack PACK -o FOLDER` wrote and describes it as
a Mitsuba scene for one wavelength (variant llvm_ad_mono_polarized: full Stokes vectors, single precision).

Lengths in metres relative to the pack's origin; radiance in W/(m^2 sr). Mitsuba carries radiance L, not basic
radiance L/n^2 as malus does (shaders/optics/CONVENTIONS.md): a source inside index n has its own radiance on
both sides, and the refractive interface itself brings the factor n^2.
"""
import copy
import json
import pathlib

import drjit as dr
import mitsuba as mi
import numpy as np

if mi.variant() is None:  # speed.py has chosen another
    mi.set_variant("llvm_ad_mono_polarized")

import textures  # noqa: E402  (needs the variant, as the next)
from environment import Environment  # noqa: E402

WAVELENGTHS_NM = (630, 532, 465)  # of the colours 0, 1, 2
TWO_SIDED_AREA = "two_sided_area"  # plugin below: Mitsuba's `area` is black on the back of its shape


class TwoSidedArea(mi.Emitter):
    """Area emitter of constant unpolarized radiance on both sides of its shape."""

    def __init__(self, properties: mi.Properties):
        super().__init__(properties)
        self.radiance = properties["radiance"]
        self.m_flags = mi.EmitterFlags.Surface

    def light(self, active: mi.Bool) -> mi.Spectrum:
        return mi.depolarizer(mi.UnpolarizedSpectrum(self.radiance)) & active

    def eval(self, si, active=True):
        return self.light(active)

    def sample_direction(self, it, sample, active=True):
        found = self.get_shape().sample_direction(it, sample, active)
        found.emitter = mi.EmitterPtr(self)
        active = active & (found.pdf > 0)
        return found, self.light(active) / dr.select(active, found.pdf, 1)

    def eval_direction(self, it, ds, active=True):
        return self.light(active)

    def pdf_direction(self, it, ds, active=True):
        return self.get_shape().pdf_direction(it, ds, active)


mi.register_emitter(TWO_SIDED_AREA, TwoSidedArea)


class Unpacked:
    """A scene pack, unpacked into a folder."""

    def __init__(self, folder: pathlib.Path):
        self.folder = pathlib.Path(folder)
        self.json = json.loads((self.folder / "scene.json").read_text())

    @property
    def depth(self) -> int:
        return self.json["depth"]

    @property
    def materials(self) -> dict:
        return {m["name"]: m for m in self.json["materials"]}

    def places(self) -> list:
        """Returns the meshes with their transforms, then the instances, each with the entry of its mesh."""
        meshes = {mesh["name"]: mesh for mesh in self.json["meshes"]}
        places = [(mesh, mi.ScalarTransform4f()) for mesh in meshes.values()]
        for instance in self.json.get("instances", []):
            matrix = np.eye(4)
            for column, axis in enumerate("xyz"):
                matrix[:3, column] = instance["linear"][axis]
            matrix[:3, 3] = instance["translation"]
            places.append((meshes[instance["mesh"]], mi.ScalarTransform4f(matrix)))
        return places

    def has_lamps(self) -> bool:
        """Returns whether emitters light diffuse surfaces."""
        return any(m.get("illuminates") for m in self.materials.values())

    def up(self) -> list:
        """Returns the y axis of the image, to which the camera frame of every ray refers."""
        return self.json["camera"]["up"]

    def environment(self, colour: int) -> Environment:
        return Environment(self.json["environment"], self.folder, colour)

    def texture(self, index: int) -> np.ndarray:
        """Returns the linear texels (height, width, 3), rows from the top."""
        return np.array(mi.Bitmap(str(self.folder / self.json["textures"][index]["file"])), dtype=np.float64)

    def smooth_part(self) -> "Unpacked":
        """The same with black diffuse surfaces."""
        part = copy.deepcopy(self)
        for m in part.json["materials"]:
            m["albedo"] = [0.0] * 3
            m.get("meshMaps", {}).pop("albedo", None)
        return part

    def diffuse_part(self) -> "Unpacked":
        """The same without emitters and environment."""
        part = copy.deepcopy(self)
        part.json["environment"] = {"radiance": [0.0] * 3}
        for m in part.json["materials"]:
            m["radiance"] = [0.0] * 3
        return part


def glass(m: dict, colour: int, maps: textures.Maps) -> dict:
    # No dispersion: the index at 532 nm in every colour.
    return {"type": "dielectric", "int_ior": m["eta"][1], "ext_ior": m["outsideEta"]}


def metal(m: dict, colour: int, maps: textures.Maps) -> dict:
    index = {part: m[part][colour] / m["outsideEta"] for part in ("eta", "k")}
    if "reflectance" in maps:
        index = maps.conductor(colour, m["outsideEta"])
    return {"type": "conductor"} | index


def mirror_glass(m: dict, colour: int, maps: textures.Maps) -> dict:
    # A conductor with k = 0 is a dielectric that only reflects.
    return {"type": "conductor", "eta": m["eta"][1] / m["outsideEta"], "k": 0.0}


def diffuse(m: dict, colour: int, maps: textures.Maps) -> dict:
    return {"type": "diffuse",
            "reflectance": maps.bitmap("albedo", colour) if "albedo" in maps else m["albedo"][colour]}


def black(m: dict, colour: int, maps: textures.Maps) -> dict:
    return {"type": "diffuse", "reflectance": 0.0}


# BSDF of each kind of material that Mitsuba can describe. Mitsuba has no polarizing element with the rules of malus,
# and its `thindielectric` depolarizes and sums the reflections of the mean of s and p (a test shows it).
BSDFS = {"glass": glass, "metal": metal, "mirror-glass": mirror_glass, "lambert": diffuse, "paint": diffuse,
         "emitter": black}


# Maps that Mitsuba is given; others are left out.
EXPORTED_MAPS = {"albedo", "reflectance", "metallic", "normal", "normalScale", "cutoff"}


def bsdf(m: dict, colour: int, maps: textures.Maps, has_tangents: bool, rough: bool) -> dict:
    """Returns the BSDF of material m on the side of its normal. The kind of m must be in BSDFS. has_tangents: of the
    mesh. rough: metals have their roughness, as `roughconductor`; it is left out otherwise."""
    result = BSDFS[m["type"]](m, colour, maps)
    alpha = maps.bitmap("roughness", 0) if "roughness" in maps else m.get("roughness", 0)
    if rough and result["type"] == "conductor" and alpha:
        result |= {"type": "roughconductor", "distribution": "ggx", "alpha": alpha}
    return maps.with_normal(result, has_tangents)


def require_exportable(scene: Unpacked) -> None:
    """Raises ValueError that names every material, light or camera without an equivalent in Mitsuba."""
    others = [f"'{m['name']}' ({m['type']})" for m in scene.materials.values() if m["type"] not in BSDFS]
    if others:
        raise ValueError(f"{scene.folder / 'scene.json'}: Mitsuba has no equivalent of material {', '.join(others)}; "
                         f"expected materials of type {', '.join(BSDFS)}")
    mirrored = [i["name"] for i in scene.json.get("instances", [])
                if np.linalg.det([i["linear"][axis] for axis in "xyz"]) < 0]
    if mirrored:
        raise ValueError(f"{scene.folder / 'scene.json'}: mirrored instances are not exported ({', '.join(mirrored)}); "
                         "expected transforms of positive determinant")
    kinds = {light["type"] for light in scene.json["lights"]} - {"point"}
    if kinds:
        raise ValueError(f"{scene.folder / 'scene.json'}: {', '.join(sorted(kinds))} lights are not exported; "
                         "expected point lights")
    if "pixelAspect" in scene.json["camera"]:  # written for cameras that are not plain (bake/FORMAT.md)
        raise ValueError(f"{scene.folder / 'scene.json'}: orthographic cameras and cameras by intrinsics are not "
                         "exported; expected verticalFovDegrees")


# Optional keys of materials (bake/unpack.cpp).
OPTIONAL = {"absorption": "absorption is", "outsideAbsorption": "absorption outside is", "coating": "the thin film is",
           "roughness": "roughness is", "polarization": "polarization is", "maps": "textures are"}


def omissions(scene: Unpacked) -> list[str]:
    """Returns a sentence for each property of the pack that the Mitsuba scene lacks."""
    omitted = []
    for m in scene.materials.values():
        if m["type"] == "paint":
            omitted.append(f"Material '{m['name']}': the interface above the paint is left out; it is bare Lambert.")
        if m["type"] == "metal" and any(m["albedo"]):
            omitted.append(f"Material '{m['name']}': the diffuse light under the metal is left out.")
        for key, what in OPTIONAL.items():
            value = m.get(key)
            if key == "coating" and value:
                value = value["thicknessNm"]
            if key == "maps" and value:
                value = any(value[name] is not None for name in ("albedo", "eta", "k"))
            if np.any(value):
                omitted.append(f"Material '{m['name']}': {what} left out.")
        for name in sorted(set(m.get("meshMaps", {})) - EXPORTED_MAPS):
            omitted.append(f"Material '{m['name']}': the map '{name}' is left out.")
        if m.get("specularFactor", 1) != 1:
            omitted.append(f"Material '{m['name']}': the specular factor is left out.")
        if m.get("clearCoat", {}).get("factor", 0) > 0:
            omitted.append(f"Material '{m['name']}': the clear coat is left out.")
        if m["type"] == "glass" and np.any(np.array(m.get("transmittanceParallel", 1)) != 1):
            omitted.append(f"Material '{m['name']}': the tint of its surface is left out.")
        if m["highlight"]:
            omitted.append(f"Material '{m['name']}': the highlight is left out.")
    if "sky" in scene.json["environment"]:
        omitted.append("The polarization of the sky is left out.")
    if scene.json["environment"].get("ambientIrradiance", 0) > 0:
        omitted.append("The ambient light on diffuse surfaces (ambientIrradiance) is left out.")
    if scene.json["camera"]["mediumEta"] != 1:
        omitted.append("The medium of the camera has an index other than 1, which Mitsuba's camera lacks: the images "
                       "agree only if a closed glass mesh of that index encloses the camera.")
    return omitted


def sensor(scene: Unpacked, width: int, height: int) -> dict:
    """Returns the pinhole camera. That of Mitsuba looks along +z, and its x points to the left of the image."""
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


def mitsuba_scene(scene: Unpacked, colour: int, width: int, height: int, environment: bool = True,
                  rough: bool = False) -> mi.Scene:
    """Returns the scene at WAVELENGTHS_NM[colour], with or without its environment and the roughness of metals. Raises
    ValueError for materials without an equivalent in Mitsuba."""
    require_exportable(scene)
    description = {"type": "scene", "sensor": sensor(scene, width, height)}
    infinity = scene.environment(colour).emitter() if environment else None
    if infinity:
        description["environment"] = infinity
    for i, light in enumerate(scene.json["lights"]):
        description[f"light{i}"] = {"type": "point", "position": light["position"],
                                    "intensity": light["intensity"][colour]}
    tangents = {}
    for i, (mesh, to_world) in enumerate(scene.places()):
        material = scene.materials[mesh["material"]]
        maps = textures.Maps(scene, material)
        path = scene.folder / mesh["file"]
        found = textures.read_tangents(path) if "normal" in maps else None
        if found is not None:
            tangents[f"mesh{i}"] = found
        shape = {"type": "ply", "id": f"mesh{i}", "filename": str(path), "face_normals": not has_normals(path),
                 "to_world": to_world, "bsdf": bsdf(material, colour, maps, found is not None, rough)}
        if material["type"] == "emitter" and material["radiance"][colour] > 0:
            shape["emitter"] = {"type": TWO_SIDED_AREA if material.get("twoSided") else "area",
                                "radiance": material["radiance"][colour]}
        description[f"mesh{i}"] = shape
    # The PLY reader warns about the tangents, which it does not read.
    level = mi.log_level()
    mi.set_log_level(mi.LogLevel.Error if tangents else level)
    result = mi.load_dict(description, parallel=False, optimize=False)
    mi.set_log_level(level)
    textures.add_tangents(result, tangents)
    return result


def has_normals(path: pathlib.Path) -> bool:
    """Returns whether a PLY file has vertex normals."""
    with open(path, "rb") as file:
        return b"property float nx" in file.read(2048).split(b"end_header")[0]
