"""Textures of a pack in Mitsuba: `bitmap` with the linear texels of the pack, and two plugins.

A pack's texture is read at (dot(u, p), dot(v, p)), p = (s, t, 1), (0, 0) being the upper left corner of the image
(bake/FORMAT.md, MAPS). Mitsuba's `bitmap` has the same corner at its v = 0, and the same bilinear filter and ways to
continue beyond the edges, but no mip levels: the scenes that are compared have less than a texel per pixel, where malus
reads level 0 alone.

Importing the module registers the plugins in the variant that is set.
"""
import pathlib

import drjit as dr
import mitsuba as mi
import numpy as np

CONDUCTOR_INDEX = "conductor_index"
MAPPED_NORMAL = "mapped_normal"
TANGENT, HANDEDNESS = "vertex_tangent", "vertex_handedness"  # attributes of meshes
LEAST_REFLECTANCE, MOST_REFLECTANCE = 0.001, 0.999  # shaders/optics/texture_map.h


class ConductorIndex(mi.Texture):
    """eta or k of the conductor that reflects r at normal incidence, with an edge tint g: O. Gulbrandsen, "Artist
    Friendly Metallic Fresnel", JCGT 3(4), 2014. malus filters r, so that interpolated textures of eta and k would
    differ."""

    def __init__(self, properties: mi.Properties):
        super().__init__(properties)
        self.reflectance = properties["reflectance"]
        self.tint = properties["tint"]
        self.part = properties["part"]  # "eta" or "k"
        self.outside = properties["outside"]

    def eval(self, si, active=True):
        return self.eval_1(si, active)

    def eval_1(self, si, active=True):
        r = dr.clip(self.reflectance.eval_1(si, active), LEAST_REFLECTANCE, MOST_REFLECTANCE)
        g, root = self.tint.eval_1(si, active), dr.sqrt(r)
        n = g * (1 - r) / (1 + r) + (1 - g) * (1 + root) / (1 - root)
        if self.part == "eta":
            return n / self.outside
        # The form of the article, which loses digits for r near 1.
        return dr.sqrt(dr.maximum((r * (n + 1)**2 - (n - 1)**2) / (1 - r), 0)) / self.outside

    def mean(self):
        return mi.Float(1.0)

    def is_spatially_varying(self):
        return True

    def to_string(self):
        return f"{CONDUCTOR_INDEX}[{self.part}]"


class MappedNormal(mi.BSDF):
    """A BSDF in the frame of the normal of a map. Mitsuba's `normalmap` returns the Mueller matrix in the frames of the
    nested BSDF without a rotation to those of its caller (a test shows it), and has no handedness for mirrored texture
    coordinates, no given tangents and no scale.

    Tangent frame: glTF 2.0 Specification, sections 3.7.2.1 and 3.9.3; the tangent is the attribute TANGENT of the mesh,
    or dp/du. As in malus the face normal replaces a normal that faces away from the ray or reflects it below the face
    (shaders/optics/SHADING.md).
    """

    def __init__(self, properties: mi.Properties):
        super().__init__(properties)
        self.nested = properties["nested"]
        self.normals = properties["normals"]
        self.scale = properties["scale"]
        self.has_tangents = properties["has_tangents"]
        self.m_components = [self.nested.flags(i) for i in range(self.nested.component_count())]
        self.m_flags = self.nested.flags()

    def mapped(self, si: mi.SurfaceInteraction3f, active) -> mi.SurfaceInteraction3f:
        """Returns the interaction in the frame of the mapped normal."""
        side = dr.select(dr.dot(si.sh_frame.n, si.n) < 0, mi.Float(-1), mi.Float(1))  # the caller may have flipped it
        normal = mi.Vector3f(si.sh_frame.n) * side
        if self.has_tangents:
            tangent = mi.Vector3f(si.shape.eval_attribute_3(TANGENT, si, active))
            handedness = si.shape.eval_attribute_1(HANDEDNESS, si, active)
        else:
            tangent = si.dp_du
            # The bitangent is in the direction of shrinking v.
            handedness = dr.select(dr.dot(dr.cross(normal, tangent), si.dp_dv) < 0, mi.Float(1), mi.Float(-1))
        tangent = dr.normalize(tangent - normal * dr.dot(normal, tangent))
        x, y, z = mi.Vector3f(self.normals.eval_3(si, active)) * 2 - 1
        bitangent = dr.cross(normal, tangent) * dr.sign(handedness)
        normal = dr.normalize((tangent * x + bitangent * y) * self.scale + normal * z) * side

        # Replace normals that face away from the ray, or reflect it below the face.
        to_camera, face = si.to_world(si.wi), mi.Vector3f(si.n) * side
        c = dr.dot(normal, to_camera)
        usable = (c > 0) & (dr.dot(face, normal * (2 * c) - to_camera) > 0)
        result = mi.SurfaceInteraction3f(si)
        result.sh_frame = mi.Frame3f(mi.Normal3f(dr.select(usable, normal, face)))
        result.wi = result.to_local(to_camera)
        return result

    def sample(self, context, si, sample1, sample2, active=True):
        mapped = self.mapped(si, active)
        out, weight = self.nested.sample(context, mapped, sample1, sample2, active)
        direction = mapped.to_world(out.wo)
        weight = mapped.to_world_mueller(weight, -out.wo, mapped.wi)
        out.wo = si.to_local(direction)
        return out, si.to_local_mueller(weight, -direction, si.to_world(si.wi)) & active

    def eval(self, context, si, wo, active=True):
        mapped, direction = self.mapped(si, active), si.to_world(wo)
        local = mapped.to_local(direction)
        value = mapped.to_world_mueller(self.nested.eval(context, mapped, local, active), -local, mapped.wi)
        return si.to_local_mueller(value, -direction, si.to_world(si.wi)) & active

    def pdf(self, context, si, wo, active=True):
        mapped = self.mapped(si, active)
        return dr.select(active, self.nested.pdf(context, mapped, mapped.to_local(si.to_world(wo)), active), 0)

    def eval_pdf(self, context, si, wo, active=True):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def to_string(self):
        return f"{MAPPED_NORMAL}[{self.nested}]"


mi.register_texture(CONDUCTOR_INDEX, ConductorIndex)
mi.register_bsdf(MAPPED_NORMAL, MappedNormal)


class Maps:
    """The maps of one material of an unpacked pack."""

    def __init__(self, scene, material: dict):
        self.scene, self.name = scene, material["name"]
        self.maps = material.get("meshMaps", {})

    def __contains__(self, role: str) -> bool:
        return role in self.maps

    def bitmap(self, role: str, channels) -> dict:
        """Returns the texture of a map. channels: of its texels, a number or a list of three. Raises ValueError for
        what Mitsuba's `bitmap` lacks."""
        described = self.maps[role]
        wrap = described["wrapU"]
        if described["wrapV"] != wrap or described["set"] != 0:
            raise ValueError(
                f"{self.scene.folder / 'scene.json'}: map '{role}' of material '{self.name}': Mitsuba has one set of texture "
                "coordinates, and continues textures alike in both directions; expected set 0 and equal wrapU and wrapV, "
                f"found set {described['set']}, {wrap} and {described['wrapV']}")
        texels = self.scene.texture(described["texture"])[..., channels]
        pixels = np.ascontiguousarray(texels.reshape(*texels.shape[:2], -1), dtype=np.float32)
        to_uv = [described["u"], described["v"], [0, 0, 1]]
        return {"type": "bitmap", "bitmap": mi.Bitmap(pixels), "raw": True, "wrap_mode": wrap,
                "filter_type": "bilinear", "to_uv": mi.ScalarTransform3f(to_uv)}

    def conductor(self, colour: int, outside: float) -> dict:
        """Returns eta and k of a metal that has the map `reflectance`."""
        tint = self.bitmap("metallic", 0) if "metallic" in self else {"type": "uniform", "value": 1.0}
        return {part: {"type": CONDUCTOR_INDEX, "reflectance": self.bitmap("reflectance", colour), "tint": tint,
                       "part": part, "outside": outside} for part in ("eta", "k")}

    def with_normal(self, bsdf: dict, has_tangents: bool) -> dict:
        """Returns the BSDF under the normal map of the material, if it has one."""
        if "normal" not in self:
            return bsdf
        return {"type": MAPPED_NORMAL, "nested": bsdf, "normals": self.bitmap("normal", [0, 1, 2]),
                "scale": self.maps["normalScale"], "has_tangents": has_tangents}


def read_tangents(path: pathlib.Path) -> np.ndarray | None:
    """Returns the tangents (vertices, 4) of a PLY file that `malus unpack` wrote, or None."""
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    if b"property float tx" not in head:
        return None
    lines = [line.split() for line in head.decode().splitlines()]
    count = next(int(line[2]) for line in lines if line[:2] == ["element", "vertex"])
    formats = {"float": "<f4", "double": "<f8"}
    row = np.dtype([(line[2], formats[line[1]]) for line in lines if line[0] == "property" and line[1] in formats])
    vertices = np.frombuffer(body, row, count)
    return np.stack([vertices[name].astype(np.float32) for name in ("tx", "ty", "tz", "tw")], axis=-1)


def add_tangents(scene: mi.Scene, tangents: dict) -> None:
    """Adds the attributes TANGENT and HANDEDNESS. tangents: by the id of a shape."""
    for shape in scene.shapes():
        if shape.id() in tangents:
            values = tangents[shape.id()]
            shape.add_attribute(TANGENT, 3, np.ascontiguousarray(values[:, :3]).ravel())
            shape.add_attribute(HANDEDNESS, 1, np.ascontiguousarray(values[:, 3]).ravel())
