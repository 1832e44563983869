"""Writers of OBJ, PLY (ascii), STL (ascii) and OFF files, with the blemishes that modellers leave."""
from .mesh import Soup, decimals, face_normal, grid


def write_mesh(path, soup, welded, comment):
    """Writes soup in the format of the path's ending. welded: corners at equal positions share one
    vertex in the file (an STL file has no shared vertices)."""
    writer = {".obj": _obj, ".ply": _ply_of_points, ".stl": _stl, ".off": _off}[path.suffix]
    if path.suffix == ".stl":
        text = _stl(soup, comment)
    else:
        text = writer(*_indexed(soup, welded), comment)
    path.write_text(text, encoding="ascii", newline="\n")


def write_ply_with_normals(path, vertices, faces, comment):
    """vertices: (position, normal) pairs, six decimals each; faces: lists of their numbers. Nothing is
    merged and nothing is left out."""
    properties = [f"property float {c}" for c in ("x", "y", "z", "nx", "ny", "nz")]
    rows = [f"{_row(grid(p))} {_row(grid(n))}" for p, n in vertices]
    path.write_text(_ply(rows, faces, comment, properties), encoding="ascii", newline="\n")


def with_blemishes(soup, duplicates=2, degenerates=2):
    """Adds duplicate faces and faces without area, spread over the soup; preparation removes them."""
    polygons = list(soup.polygons)
    step = max(1, len(polygons) // (duplicates + degenerates + 1))
    for i in range(duplicates):
        polygons.append(list(polygons[(i + 1) * step % len(polygons)]))
    for i in range(degenerates):
        p = polygons[(i + 1 + duplicates) * step % len(polygons)]
        polygons.append([p[0], p[1], p[1]])
    return Soup(polygons)


def _indexed(soup, welded):
    points, faces, ids = [], [], {}
    for polygon in soup.polygons:
        face = []
        for corner in polygon:
            if not welded or corner not in ids:
                ids[corner] = len(points)
                points.append(corner)
            face.append(ids[corner])
        faces.append(face)
    return points, faces


def _row(values):
    return " ".join(decimals(v) for v in values)


def _ply_of_points(points, faces, comment):
    return _ply([_row(p) for p in points], faces, comment, [f"property float {c}" for c in "xyz"])


def _obj(points, faces, comment):
    lines = [f"# {comment}"]
    lines += [f"v {_row(p)}" for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    return "\n".join(lines) + "\n"


def _ply(rows, faces, comment, properties):
    lines = ["ply", "format ascii 1.0", f"comment {comment}", f"element vertex {len(rows)}", *properties]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", *rows]
    lines += [f"{len(f)} " + " ".join(map(str, f)) for f in faces]
    return "\n".join(lines) + "\n"


def _off(points, faces, comment):
    lines = ["OFF", f"# {comment}", f"{len(points)} {len(faces)} 0"]
    lines += [_row(p) for p in points]
    lines += [f"{len(f)} " + " ".join(map(str, f)) for f in faces]
    return "\n".join(lines) + "\n"


def _stl(soup, comment):
    name = comment.split(":")[0].replace(" ", "-")
    lines = [f"solid {name}"]
    for a, b, c in soup.triangles():
        n = face_normal(a, b, c)
        length = sum(v * v for v in n) ** 0.5 or 1.0
        lines.append("facet normal " + " ".join(f"{v / length + 0.0:.4f}".replace("-0.0000", "0.0000") for v in n))
        lines += ["outer loop", *(f"vertex {_row(p)}" for p in (a, b, c)), "endloop", "endfacet"]
    lines.append(f"endsolid {name}")
    return "\n".join(lines) + "\n"
