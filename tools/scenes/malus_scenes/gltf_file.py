"""A model as a binary glTF 2.0 file (GLB), with the same bytes in every run."""
import json
import struct

from .vectors import cross, minus, rounded, unit

_ARRAY_BUFFER, _ELEMENT_BUFFER = 34962, 34963
_UNSIGNED_SHORT, _UNSIGNED_INT, _FLOAT = 5123, 5125, 5126
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class Model:
    """The objects of the file; every `add` returns the index of its object."""

    def __init__(self, name, extensions=()):
        self._document = {"asset": {"version": "2.0", "generator": "malus tools/scenes"}, "scene": 0,
                          "scenes": [{"name": name, "nodes": []}]}
        if extensions:
            self._document["extensionsUsed"] = sorted(extensions)
        self._bytes = bytearray()

    def image_texture(self, name, png, **sampler):
        """Adds an image, a texture of it, and its sampler: by default repeated, with mip levels."""
        view = self._view(png)
        image = self._add("images", {"name": name, "mimeType": "image/png", "bufferView": view})
        sampler = self._add("samplers", {"magFilter": 9729, "minFilter": 9987, **sampler})
        return self._add("textures", {"name": name, "source": image, "sampler": sampler})

    def material(self, name, base=(1, 1, 1, 1), metallic=0.0, roughness=1.0, maps=None, **others):
        """maps: keys of pbrMetallicRoughness; others: keys of the material."""
        pbr = {"baseColorFactor": list(base), "metallicFactor": metallic, "roughnessFactor": roughness, **(maps or {})}
        return self._add("materials", {"name": name, "pbrMetallicRoughness": pbr, **others})

    def mesh(self, name, *primitives):
        """primitives: (Surface, material) pairs."""
        entries = []
        for surface, material in primitives:
            attributes = {"POSITION": self._accessor(surface.positions, bounds=True),
                          "NORMAL": self._accessor(surface.normals), "TEXCOORD_0": self._accessor(surface.coordinates)}
            if surface.tangents:
                attributes["TANGENT"] = self._accessor(surface.tangents)
            entries.append({"attributes": attributes, "indices": self._indices(surface), "material": material})
        return self._add("meshes", {"name": name, "primitives": entries})

    def node(self, name, parent=None, **keys):
        """keys: mesh, camera, translation, rotation, scale, extensions. Without a parent it is a root."""
        index = self._add("nodes", {"name": name, **keys})
        if parent is None:
            self._document["scenes"][0]["nodes"].append(index)
        else:
            self._document["nodes"][parent].setdefault("children", []).append(index)
        return index

    def camera(self, name, position, target, vertical_fov, aspect):
        """Adds a perspective camera and its node. vertical_fov: radians."""
        camera = self._add("cameras", {"name": name, "type": "perspective", "perspective": {
            "yfov": round(vertical_fov, 6), "aspectRatio": aspect, "znear": 0.01}})
        return self.node(name, camera=camera, translation=rounded(position), rotation=looking(position, target))

    def light(self, name, position, target, **keys):
        """Adds a light of KHR_lights_punctual and its node, which shines toward target."""
        lights = self._document.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": name, **keys})
        return self.node(name, translation=rounded(position), rotation=looking(position, target),
                         extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def write(self, path):
        data = bytes(self._bytes) + b"\0" * (-len(self._bytes) % 4)
        document = {**self._document, "buffers": [{"byteLength": len(data)}]}
        text = json.dumps(document, separators=(",", ":")).encode("utf-8")
        text += b" " * (-len(text) % 4)
        chunks = b"".join(struct.pack("<II", len(body), kind) + body for kind, body in
                          ((0x4E4F534A, text), (0x004E4942, data)))
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)

    def _add(self, kind, value):
        self._document.setdefault(kind, []).append(value)
        return len(self._document[kind]) - 1

    def _view(self, data, **keys):
        self._bytes += b"\0" * (-len(self._bytes) % 4)
        offset = len(self._bytes)
        self._bytes += data
        return self._add("bufferViews", {"buffer": 0, "byteOffset": offset, "byteLength": len(data), **keys})

    def _accessor(self, rows, bounds=False):
        # Rounded first, so that the last bits of the maths library do not reach the file.
        size = len(rows[0])
        data = struct.pack(f"<{size * len(rows)}f", *(round(c, 6) + 0.0 for row in rows for c in row))
        accessor = {"bufferView": self._view(data, target=_ARRAY_BUFFER), "componentType": _FLOAT,
                    "count": len(rows), "type": _TYPES[size]}
        if bounds:
            columns = list(zip(*struct.iter_unpack(f"<{size}f", data)))
            accessor.update(min=[min(c) for c in columns], max=[max(c) for c in columns])
        return self._add("accessors", accessor)

    def _indices(self, surface):
        flat = [i for triangle in surface.triangles for i in triangle]
        small = len(surface.positions) < 65535
        data = struct.pack(f"<{len(flat)}{'H' if small else 'I'}", *flat)
        return self._add("accessors", {
            "bufferView": self._view(data, target=_ELEMENT_BUFFER),
            "componentType": _UNSIGNED_SHORT if small else _UNSIGNED_INT, "count": len(flat), "type": "SCALAR"})


def looking(position, target):
    """Quaternion (x, y, z, w) of a node whose -z axis points from position to target, with +y upward."""
    back = unit(minus(position, target))
    right = unit(cross((0.0, 1.0, 0.0) if abs(back[1]) < 0.999 else (0.0, 0.0, -1.0), back))
    up = cross(back, right)
    m = [[right[i], up[i], back[i]] for i in range(3)]
    # Shepperd, "Quaternion from rotation matrix", 1978: divides by the largest component.
    trace = m[0][0] + m[1][1] + m[2][2]
    squares = [1 + 2 * m[i][i] - trace for i in range(3)] + [1 + trace]
    largest = squares.index(max(squares))
    half = 0.5 / squares[largest] ** 0.5
    if largest == 3:
        q = [(m[2][1] - m[1][2]) * half, (m[0][2] - m[2][0]) * half, (m[1][0] - m[0][1]) * half, 0.25 / half]
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        q = [0.0] * 4
        q[i] = 0.25 / half
        q[j], q[k] = (m[j][i] + m[i][j]) * half, (m[k][i] + m[i][k]) * half
        q[3] = (m[k][j] - m[j][k]) * half
    return rounded(q)
