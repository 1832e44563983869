"""Surfaces with normals and texture coordinates, for glTF files. Metres; triangles counter-clockwise seen from outside;
texture coordinates as in glTF: the origin is the top left corner of the image."""
import math

from .vectors import cross, dot, minus, plus, times, unit


class Surface:
    """Vertices (position, normal, coordinates; tangents (x, y, z, sign) or none) and triangles of their numbers."""

    def __init__(self):
        self.positions, self.normals, self.coordinates, self.tangents, self.triangles = [], [], [], [], []

    def vertex(self, position, normal, coordinates):
        self.positions.append(position)
        self.normals.append(normal)
        self.coordinates.append(coordinates)
        return len(self.positions) - 1

    def add(self, other, transform=lambda p: p):
        """Appends another surface; transform keeps angles and does not mirror."""
        first, origin = len(self.positions), transform((0.0, 0.0, 0.0))
        for position, normal, coordinates in zip(other.positions, other.normals, other.coordinates):
            self.vertex(transform(position), unit(minus(transform(normal), origin)), coordinates)
        self.triangles += [tuple(first + i for i in t) for t in other.triangles]
        return self

    def with_tangents(self):
        """Adds the direction in which the first coordinate grows, as the mean over the triangles of a vertex."""
        sums = [((0.0, 0.0, 0.0), 0.0)] * len(self.positions)
        for triangle in self.triangles:
            (p, q, r), (a, b, c) = ([values[i] for i in triangle] for values in (self.positions, self.coordinates))
            determinant = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
            if determinant == 0:
                continue
            along = plus(times(minus(q, p), c[1] - a[1]), minus(r, p), -(b[1] - a[1]))
            for i in triangle:
                sums[i] = plus(sums[i][0], along, 1 if determinant > 0 else -1), sums[i][1] + determinant
        self.tangents = []
        for normal, (along, determinant) in zip(self.normals, sums):
            tangent = plus(along, normal, -dot(along, normal))
            if dot(tangent, tangent) < 1e-24:
                tangent = cross(normal, (0.0, 1.0, 0.0) if abs(normal[1]) < 0.9 else (1.0, 0.0, 0.0))
            # glTF: bitangent = cross(normal, tangent) * sign, toward the top of the image, where the second
            # coordinate decreases.
            self.tangents.append((*unit(tangent), -1.0 if determinant > 0 else 1.0))
        return self


def grid(function, columns, rows, repeats=(1.0, 1.0)):
    """Surface of function(u, v), u and v from 0 to 1, with normals of the direction cross(dp/du, dp/dv). Where an edge
    contracts to one point, the triangles without area are left out."""
    surface = Surface()
    step = 1e-4
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            surface.vertex(function(u, v), _normal(function, u, v, step), (u * repeats[0], (1 - v) * repeats[1]))
    def same(a, b):
        return max(abs(x - y) for x, y in zip(surface.positions[a], surface.positions[b])) < 1e-7
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            for triangle in ((a, b, c), (a, c, d)):
                if not any(same(triangle[k], triangle[k - 1]) for k in range(3)):
                    surface.triangles.append(triangle)
    return surface


def _normal(function, u, v, step):
    """Unit normal by differences inside the square; at a point where an edge contracts, the one next to it."""
    for nearer in (0.0, 10 * step, 100 * step):
        at_u, at_v = (min(1 - step - nearer, max(step + nearer, x)) for x in (u, v))
        du = minus(function(at_u + step, at_v), function(at_u - step, at_v))
        dv = minus(function(at_u, at_v + step), function(at_u, at_v - step))
        normal = cross(du, dv)
        if dot(normal, normal) > 1e-18 * max(dot(du, du), dot(dv, dv)) ** 2 and dot(normal, normal) > 0:
            return unit(normal)
    return (0.0, 1.0, 0.0)


def quad(a, b, c, d, repeats=(1.0, 1.0)):
    """Counter-clockwise from the bottom left of the image."""
    surface = Surface()
    normal = unit(cross(minus(b, a), minus(d, a)))
    for corner, (u, v) in zip((a, b, c, d), ((0, 1), (1, 1), (1, 0), (0, 0))):
        surface.vertex(corner, normal, (u * repeats[0], v * repeats[1]))
    surface.triangles = [(0, 1, 2), (0, 2, 3)]
    return surface


def flipped(surface):
    """The same surface seen from the other side; changes it."""
    surface.triangles = [(a, c, b) for a, b, c in surface.triangles]
    surface.normals = [times(n, -1) for n in surface.normals]
    return surface


def box(size, centre=(0.0, 0.0, 0.0), per_metre=1.0):
    """Six quads, outside out. per_metre: repeats of the image."""
    surface = Surface()
    half = tuple(s / 2 for s in size)
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for side in (-1, 1):
            corners = []
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[b], corner[c] = side * half[axis], x * side * half[b], y * half[c]
                corners.append(plus(tuple(corner), centre))
            surface.add(quad(*corners, repeats=(size[b] * per_metre, size[c] * per_metre)))
    return surface


def lathe(profile, sides, repeats=(1.0, 1.0)):
    """Turned about +y: profile is a list of (radius, y), outside on its right as y grows. Edges at its points are
    sharp: vertices there have one normal for each side."""
    surface = Surface()
    length = sum(math.dist(a, b) for a, b in zip(profile, profile[1:]))
    done = 0.0
    for low, high in zip(profile, profile[1:]):
        part = math.dist(low, high)
        surface.add(_turned([low, high], sides, repeats, done / length, part / length))
        done += part
    return surface


def smooth_lathe(profile, sides, repeats=(1.0, 1.0)):
    """As lathe, with smooth normals along the profile."""
    return _turned(profile, sides, repeats, 0.0, 1.0)


def _turned(profile, sides, repeats, first, share):
    def slope(i):
        a, b = profile[max(0, i - 1)], profile[min(len(profile) - 1, i + 1)]
        size = math.dist(a, b) or 1.0
        return (b[1] - a[1]) / size, -(b[0] - a[0]) / size
    surface = Surface()
    for i, (radius, y) in enumerate(profile):
        outward, upward = slope(i)
        v = first + share * i / (len(profile) - 1)
        for k in range(sides + 1):
            angle = 2 * math.pi * (k % sides) / sides
            c, s = math.cos(angle), -math.sin(angle)
            surface.vertex((radius * c, y, radius * s), (outward * c, upward, outward * s),
                           (k / sides * repeats[0], (1 - v) * repeats[1]))
    for i in range(len(profile) - 1):
        for k in range(sides):
            a = i * (sides + 1) + k
            b, c, d = a + 1, a + sides + 2, a + sides + 1
            if profile[i][0] > 0:
                surface.triangles.append((a, b, c))
            if profile[i + 1][0] > 0:
                surface.triangles.append((a, c, d))
    return surface


def disc(radius, sides, y=0.0):
    """Disc that faces +y; the image covers the square around it, with its top toward -z."""
    surface = Surface()
    centre = surface.vertex((0.0, y, 0.0), (0.0, 1.0, 0.0), (0.5, 0.5))
    for k in range(sides):
        angle = 2 * math.pi * k / sides
        c, s = math.cos(angle), -math.sin(angle)
        surface.vertex((radius * c, y, radius * s), (0.0, 1.0, 0.0), (0.5 + 0.5 * c, 0.5 + 0.5 * s))
    surface.triangles = [(centre, 1 + k, 1 + (k + 1) % sides) for k in range(sides)]
    return surface


def tube(path, radius, sides, repeats=(1.0, 1.0)):
    """Round tube without ends along a path of points that is in one plane or bends little."""
    def at(u, v):
        x = v * (len(path) - 1)
        i = min(len(path) - 2, int(x))
        t = x - i
        a, b = path[i], path[i + 1]
        point = plus(times(a, 1 - t), b, t)
        before, after = path[max(0, i - (1 if t == 0 else 0))], path[i + 1]
        along = unit(minus(after, before))
        side = unit(cross(along, (0.0, 1.0, 0.0) if abs(along[1]) < 0.9 else (1.0, 0.0, 0.0)))
        up = cross(side, along)
        angle = 2 * math.pi * (0.0 if u == 1 else u)
        return plus(plus(point, side, radius * math.cos(angle)), up, radius * math.sin(angle))
    return grid(at, sides, len(path) - 1, repeats)
