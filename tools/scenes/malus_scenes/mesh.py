"""Polygons as a modeller keeps them, and the counts that they have after `malus prep`.

A `Soup` is a list of polygons; corners are points on a grid of one micrometre, kept as whole numbers, so
that files show fixed decimals and equal positions stay equal. `prepare` follows the rule of `malus prep`:
weld equal positions, drop degenerate and duplicate faces, orient, split vertices at creases. It is here
so that a generator can reach exact counts and fail loudly when it does not.
"""
import math
from collections import defaultdict

from .vectors import cross, dot, minus

UNITS_PER_METRE = 1000000
# No edge may come this close to the crease angle: counts must not hang on rounding.
CREASE_MARGIN_DEGREES = 2.0


def grid(point):
    """A point in metres as whole grid units. Rounds a little below the half up, so that the last bits of
    the maths library decide nothing where a coordinate is half a unit by design."""
    return tuple(int(math.floor(c * UNITS_PER_METRE + 0.5001)) for c in point)


def decimals(units):
    """Grid units as text in metres: always six decimals, never a negative zero."""
    sign = "-" if units < 0 else ""
    return f"{sign}{abs(units) // UNITS_PER_METRE}.{abs(units) % UNITS_PER_METRE:06d}"


class Soup:
    """Polygons (lists of grid points), counter-clockwise seen from outside."""

    def __init__(self, polygons=()):
        self.polygons = list(polygons)

    def face(self, points):
        """Adds one polygon of points in metres. Corners that coincide on the grid are merged."""
        self.grid_face([grid(p) for p in points])

    def grid_face(self, corners):
        """Adds one polygon of grid points. Corners that coincide are merged."""
        kept = [c for i, c in enumerate(corners) if c != corners[i - 1]]
        if len(kept) >= 3:
            self.polygons.append(kept)

    def add(self, other, transform=None):
        """Appends another soup, its points passed through transform (metres to metres)."""
        if transform is None:
            self.polygons.extend(other.polygons)
            return self
        moved = {}
        for polygon in other.polygons:
            for corner in polygon:
                if corner not in moved:
                    moved[corner] = grid(transform(tuple(c / UNITS_PER_METRE for c in corner)))
            self.grid_face([moved[corner] for corner in polygon])
        return self

    def moved(self, offset):
        """The same polygons elsewhere; offset in metres."""
        by = grid(offset)
        return Soup([[tuple(a + b for a, b in zip(corner, by)) for corner in p] for p in self.polygons])

    def flipped(self):
        """The same polygons seen from the other side."""
        return Soup([list(reversed(p)) for p in self.polygons])

    def triangles(self):
        """Fans: every polygon here is convex and planar or a triangle."""
        for p in self.polygons:
            for i in range(1, len(p) - 1):
                yield p[0], p[i], p[i + 1]


class Prepared:
    """A mesh after preparation: positions (grid units), vertex count, triangles of position ids,
    the vertex of each corner, and the edges with their dihedral angles in degrees."""

    def __init__(self, positions, triangles, corner_vertex, vertices, open_edges):
        self.positions = positions
        self.triangles = triangles
        self.corner_vertex = corner_vertex
        self.vertices = vertices
        self.open_edges = open_edges

    @property
    def counts(self):
        return self.vertices, len(self.triangles)


def face_normal(a, b, c):
    """Twice the area times the normal, exact in whole numbers."""
    return cross(minus(b, a), minus(c, a))


def prepare(soup, flat=False, crease_degrees=40.0, name="mesh"):
    """Welds, cleans, orients and splits. Raises ValueError on edges with more than two faces, on faces
    that cannot be oriented and on edges too close to the crease angle."""
    # Weld equal positions; drop faces without area and faces met before.
    ids, positions, triangles, seen = {}, [], [], set()
    for corners in soup.triangles():
        if face_normal(*corners) == (0, 0, 0):
            continue
        tri = []
        for corner in corners:
            if corner not in ids:
                ids[corner] = len(positions)
                positions.append(corner)
            tri.append(ids[corner])
        key = tuple(sorted(tri))
        if key not in seen:
            seen.add(key)
            triangles.append(tri)

    # Edges: at most two faces each.
    faces_of_edge = defaultdict(list)
    for f, tri in enumerate(triangles):
        for i in range(3):
            faces_of_edge[tuple(sorted((tri[i], tri[(i + 1) % 3])))].append(f)
    for edge, faces in faces_of_edge.items():
        if len(faces) > 2:
            where = ", ".join(decimals(c) for c in positions[edge[0]])
            raise ValueError(f"{name}: an edge at {where} has {len(faces)} faces")
    _orient(positions, triangles, faces_of_edge, name)

    used = {corner for tri in triangles for corner in tri}
    open_edges = sum(1 for faces in faces_of_edge.values() if len(faces) == 1)
    if flat:
        return Prepared(positions, triangles, [list(t) for t in triangles], len(used), open_edges)

    # Around each vertex, faces that share an edge no sharper than the crease share one stored vertex.
    normals = [face_normal(*(positions[v] for v in tri)) for tri in triangles]
    parent = list(range(3 * len(triangles)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for edge, faces in faces_of_edge.items():
        if len(faces) != 2:
            continue
        angle = angle_degrees(normals[faces[0]], normals[faces[1]])
        if abs(angle - crease_degrees) < CREASE_MARGIN_DEGREES:
            where = ", ".join(decimals(c) for c in positions[edge[0]])
            raise ValueError(f"{name}: an edge at {where} bends by {angle:.2f} degrees, too close to the crease")
        if angle < crease_degrees:
            for v in edge:
                a, b = (3 * f + triangles[f].index(v) for f in faces)
                parent[root(a)] = root(b)
    roots = {}
    corner_vertex = [[roots.setdefault(root(3 * f + i), len(roots)) for i in range(3)] for f in range(len(triangles))]
    return Prepared(positions, triangles, corner_vertex, len(roots), open_edges)


def angle_degrees(n0, n1):
    """Angle between two normals of any length."""
    sine = math.sqrt(sum(c * c for c in cross(n0, n1)))
    return math.degrees(math.atan2(sine, dot(n0, n1)))


def _orient(positions, triangles, faces_of_edge, name):
    """Makes every component consistent: closed ones outward, open ones to the side of their majority."""
    done = [False] * len(triangles)
    for seed in range(len(triangles)):
        if done[seed]:
            continue
        done[seed] = True
        component, turned, closed, stack = [], [], True, [seed]
        while stack:
            f = stack.pop()
            component.append(f)
            for i in range(3):
                a, b = triangles[f][i], triangles[f][(i + 1) % 3]
                faces = faces_of_edge[tuple(sorted((a, b)))]
                if len(faces) == 1:
                    closed = False
                    continue
                g = faces[0] if faces[1] == f else faces[1]
                tri = triangles[g]
                same_way = any(tri[j] == a and tri[(j + 1) % 3] == b for j in range(3))
                if same_way and done[g]:
                    raise ValueError(f"{name}: a component has no consistent orientation")
                if same_way:
                    tri.reverse()
                    turned.append(g)
                if not done[g]:
                    done[g] = True
                    stack.append(g)
        if closed:
            volume = sum(_volume(*(positions[v] for v in triangles[f])) for f in component)
            flip = volume < 0
        else:
            flip = 2 * len(turned) > len(component)
        if flip:
            for f in component:
                triangles[f].reverse()


def _volume(a, b, c):
    """Six times the signed volume of the tetrahedron to the origin."""
    return dot(a, cross(b, c))
