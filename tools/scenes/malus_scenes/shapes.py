"""Solids and surfaces that the scenes are made of. Metres; faces counter-clockwise seen from outside.

Sections of prisms and lofts are closed outlines in a plane; `n` is always a number of sides.
"""
import contextlib
import math

from .mesh import Soup, grid
from .vectors import cross, unit

_steps = 1


@contextlib.contextmanager
def finer(steps):
    """Shapes made in this context have `steps` times as many sides, and as many pieces between two sections; their
    number of triangles grows with steps squared. Quads and boxes stay unchanged."""
    global _steps
    before, _steps = _steps, steps
    try:
        yield
    finally:
        _steps = before


def quad(a, b, c, d):
    """One open quad, its normal by the right hand around a, b, c, d."""
    soup = Soup()
    soup.face([a, b, c, d])
    return soup


def box(size, centre=(0.0, 0.0, 0.0)):
    """A box of six quads: 24 vertices after crease splitting, 8 when flat."""
    (sx, sy, sz), (cx, cy, cz) = size, centre
    p = [(cx + i * sx / 2, cy + j * sy / 2, cz + k * sz / 2) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    soup = Soup()
    for a, b, c, d in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
        soup.face([p[a], p[b], p[c], p[d]])
    return soup


def strip(points, offset):
    """A sheet folded along lines: the polyline `points` swept by `offset`, one quad a segment."""
    soup = Soup()
    far = [tuple(a + b for a, b in zip(p, offset)) for p in points]
    for i in range(len(points) - 1):
        soup.face([points[i], points[i + 1], far[i + 1], far[i]])
    return soup


def rounded_rectangle(width, height, radius, steps):
    """Function of an inset to an outline with quarter-circle corners of `steps` segments. The inset must
    stay below the radius."""
    steps *= _steps

    def outline(inset):
        points = []
        for quarter, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
            for i in range(steps + 1):
                a = math.pi / 2 * (quarter + i / steps)
                points.append((sx * (width / 2 - radius) + (radius - inset) * math.cos(a),
                               sy * (height / 2 - radius) + (radius - inset) * math.sin(a)))
        return points
    return outline


def belt(circles, n):
    """Function of an inset to the convex outline around circles (x, y, radius), like a belt: for each of
    n directions the point of the circle that reaches farthest."""
    n *= _steps

    def outline(inset):
        points = []
        for i in range(n):
            a = 2 * math.pi * (i + 0.5) / n
            c, s = math.cos(a), math.sin(a)
            x, y, r = max(circles, key=lambda k: round(k[0] * c + k[1] * s + k[2], 9))
            points.append((x + (r - inset) * c, y + (r - inset) * s))
        return points
    return outline


def _between(sections):
    """The sections with those of `finer` between them, interpolated linearly."""
    out = [sections[0]]
    for low, high in zip(sections, sections[1:]):
        for k in range(1, _steps):
            t = k / _steps
            out.append([tuple(a + (b - a) * t for a, b in zip(p, q)) for p, q in zip(low, high)])
        out.append(high)
    return out


def loft(sections, cap_first=True, cap_last=True):
    """A skin through closed sections (lists of 3D points, equally many, counter-clockwise seen from the
    last section). Caps are convex polygons."""
    soup = Soup()
    rings = [[grid(p) for p in section] for section in _between(sections)]
    for low, high in zip(rings, rings[1:]):
        n = len(low)
        for i in range(n):
            j = (i + 1) % n
            soup.grid_face([low[i], low[j], high[j]])
            soup.grid_face([low[i], high[j], high[i]])
    if cap_first:
        soup.face(list(reversed(sections[0])))
    if cap_last:
        soup.face(sections[-1])
    return soup


def slab(outline, levels, cap_first=True, cap_last=True):
    """A solid along +z from an outline in the xy plane: levels are (z, inset) for the outline function."""
    return loft([[(x, y, z) for x, y in outline(inset)] for z, inset in levels], cap_first, cap_last)


def lathe(profile, n, phase=0.0):
    """Turned about +y: profile is a list of (radius, y), outside on its right when y grows. A radius of 0
    closes that end; a profile whose first point is its last is a ring."""
    n *= _steps
    rings = []
    for radius, y in profile:
        if radius == 0.0:
            rings.append([(0.0, y, 0.0)] * n)
        else:
            rings.append([(radius * math.cos(2 * math.pi * (i + phase) / n), y,
                           -radius * math.sin(2 * math.pi * (i + phase) / n)) for i in range(n)])
    return loft(rings, cap_first=False, cap_last=False)


def tube(path, radius, n, cap_first=True, cap_last=True):
    """A round tube along a polyline, its section carried along without twist. radius: a number, or one
    a point."""
    n *= _steps
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(path)
    tangents = []
    for i in range(len(path)):
        a, b = path[max(0, i - 1)], path[min(len(path) - 1, i + 1)]
        tangents.append(unit(tuple(y - x for x, y in zip(a, b))))
    helper = (0.0, 1.0, 0.0) if abs(tangents[0][1]) < 0.9 else (1.0, 0.0, 0.0)
    side = unit(cross(tangents[0], helper))
    sections = []
    for point, tangent, r in zip(path, tangents, radii):
        along = sum(a * b for a, b in zip(side, tangent))
        side = unit(tuple(a - along * b for a, b in zip(side, tangent)))
        up = cross(tangent, side)
        sections.append([tuple(p + r * (math.cos(t) * s + math.sin(t) * u) for p, s, u in zip(point, side, up))
                         for t in (2 * math.pi * i / n for i in range(n))])
    return loft(sections, cap_first, cap_last)


def curve(points, segments):
    """A Catmull-Rom curve through points, `segments` pieces between neighbours."""
    out = []
    padded = [points[0], *points, points[-1]]
    for i in range(len(points) - 1):
        a, b, c, d = padded[i:i + 4]
        for k in range(segments):
            t = k / segments
            out.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t
                                    + (3 * q - p - 3 * r + s) * t * t * t) for p, q, r, s in zip(a, b, c, d)))
    out.append(points[-1])
    return out


def resampled(path, pieces):
    """The polyline cut into `pieces` of equal length."""
    lengths = [0.0]
    for a, b in zip(path, path[1:]):
        lengths.append(lengths[-1] + math.dist(a, b))
    out, i = [], 0
    for k in range(pieces):
        wanted = lengths[-1] * k / pieces
        while lengths[i + 1] <= wanted:
            i += 1
        t = (wanted - lengths[i]) / (lengths[i + 1] - lengths[i])
        out.append(tuple(a + t * (b - a) for a, b in zip(path[i], path[i + 1])))
    return out + [path[-1]]


def placed(translate=(0.0, 0.0, 0.0), rotate_degrees=(0.0, 0.0, 0.0), scale=(1.0, 1.0, 1.0)):
    """A transform in the order of scene.json: scale, turn about x, then y, then z, translate."""
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in rotate_degrees)

    def transform(p):
        x, y, z = (a * b for a, b in zip(p, scale))
        y, z = cx * y - sx * z, sx * y + cx * z
        x, z = cy * x + sy * z, -sy * x + cy * z
        x, y = cz * x - sz * y, sz * x + cz * y
        return (x + translate[0], y + translate[1], z + translate[2])
    return transform


def aimed(origin, axis):
    """A transform that carries +y to the direction `axis` and the origin to `origin`."""
    y = unit(axis)
    x = unit(cross((0.0, 0.0, 1.0) if abs(y[2]) < 0.9 else (1.0, 0.0, 0.0), y))
    z = cross(x, y)
    return lambda p: tuple(o + p[0] * a + p[1] * b + p[2] * c for o, a, b, c in zip(origin, x, y, z))
