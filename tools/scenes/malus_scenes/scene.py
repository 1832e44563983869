"""A scene on its way to disk: parts with their meshes, counted as `malus prep` counts, and scene.json."""
import functools
import json

from .mesh import Soup, prepare
from .mesh_files import with_blemishes, write_mesh, write_ply_with_normals
from .studio import write_hdr


class Part:
    """One entry of `meshes` in scene.json with its soup. `format` is the file's ending. Instances are
    dictionaries as scene.json has them. `blemishes` are (duplicate, degenerate) faces in the file."""

    def __init__(self, name, material, soup, format="obj", flat=False, sheet=False, crease=None,
                 instances=None, welded=False, blemishes=(0, 0)):
        self.name, self.material, self.soup, self.format = name, material, soup, format
        self.flat, self.sheet, self.crease, self.instances = flat, sheet, crease, instances
        self.welded, self.blemishes = welded, blemishes

    @functools.cached_property
    def prepared(self):
        return prepare(self.soup, self.flat, self.crease if self.crease is not None else 40.0, self.name)

    @property
    def counts(self):
        copies = len(self.instances) if self.instances else 1
        vertices, triangles = self.prepared.counts
        return copies * vertices, copies * triangles

    def description(self):
        entry = {"name": self.name, "file": f"meshes/{self.name}.{self.format}", "material": self.material}
        if self.flat:
            entry["flat"] = True
        if self.sheet:
            entry["openSurface"] = True
        if self.crease is not None:
            entry["creaseDegrees"] = self.crease
        if self.instances:
            entry["instances"] = self.instances
        return entry

    @property
    def open_edges(self):
        return 0 if self.sheet else self.prepared.open_edges

    def write(self, folder, comment):
        """Writes the mesh file, blemishes included. Raises ValueError where they change the counts."""
        soup = self.soup
        if any(self.blemishes):
            soup = with_blemishes(soup, *self.blemishes)
            crease = self.crease if self.crease is not None else 40.0
            if prepare(soup, self.flat, crease).counts != self.prepared.counts:
                raise ValueError(f"{self.name}: the blemishes change the counts")
        write_mesh(folder / f"{self.name}.{self.format}", soup, self.welded, comment)


class PartAsIs:
    """A mesh that no preparation touches: vertices are (position, normal) in metres, faces lists of their
    numbers. A PLY file."""

    def __init__(self, name, material, vertices, faces):
        self.name, self.material, self.vertices, self.faces = name, material, vertices, faces
        self.counts = len(vertices), sum(len(f) - 2 for f in faces)
        self.open_edges = 0

    def description(self):
        return {"name": self.name, "file": f"meshes/{self.name}.ply", "material": self.material, "openSurface": True,
                "asIs": True}

    def write(self, folder, comment):
        write_ply_with_normals(folder / f"{self.name}.ply", self.vertices, self.faces, comment)


def total(parts):
    return tuple(sum(values) for values in zip((0, 0), *(part.counts for part in parts)))


def _check(name, materials, parts, expected):
    if total(parts) != expected:
        raise ValueError(f"{name}: {total(parts)} vertices and triangles instead of {expected}")
    glass = {name for name, m in materials.items() if m["type"] == "glass"}
    for part in parts:
        if part.material in glass and part.open_edges:
            raise ValueError(f"{part.name}: a glass body with {part.open_edges} open edges")


def write_scene(folder, settings, materials, parts, expected, sky=None, readme=""):
    """Writes scene.json, meshes/, the environment (`sky`: rows of RGBE pixels) and README.md. Raises
    ValueError unless all parts together have exactly the expected (vertices, triangles); None: unchecked."""
    if expected is not None:
        _check(settings["name"], materials, parts, expected)

    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    for old in (folder / "meshes").iterdir():
        if old.suffix in (".obj", ".ply", ".stl", ".off"):
            old.unlink()
    for part in parts:
        part.write(folder / "meshes", f"{part.name}: part of the scene {settings['name']}, metres")
    if sky:
        write_hdr(folder / settings["environment"]["image"], sky)
    document = {"malus": 1, **settings, "materials": materials, "meshes": [p.description() for p in parts]}
    (folder / "scene.json").write_text(_layout(document) + "\n", encoding="utf-8", newline="\n")
    (folder / "README.md").write_text(readme, encoding="utf-8", newline="\n")


def _layout(value, depth=0):
    """JSON with objects and lists of objects spread over lines, everything small on one line."""
    flat = json.dumps(value, ensure_ascii=False)
    if depth > 0 and len(flat) + 2 * depth <= 110 and not (depth < 2 and isinstance(value, dict)):
        return flat
    pad, end = "  " * (depth + 1), "  " * depth
    if isinstance(value, dict):
        items = [f"{pad}{json.dumps(k)}: {_layout(v, depth + 1)}" for k, v in value.items()]
        return "{\n" + ",\n".join(items) + f"\n{end}}}"
    if isinstance(value, list):
        return "[\n" + ",\n".join(pad + _layout(v, depth + 1) for v in value) + f"\n{end}]"
    return flat
