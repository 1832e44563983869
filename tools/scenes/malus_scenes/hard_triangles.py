"""A hard scene of triangles that preparation would clean or refuse."""
import math

from .hard_scene import BLACK_GLASS, GLASS, GOLD, camera, emitter, write_hard
from .scene import Part, PartAsIs
from .shapes import quad
from .vectors import cross, dot, plus, times, unit

MICRON = 0.000001


class Square:
    """A square of half size h about a middle; at(u, v) are its points, u and v from -1 to 1."""

    def __init__(self, middle, normal, h):
        self.middle, self.normal = middle, unit(normal)
        self.x = times(unit(cross((0.0, 1.0, 0.0), self.normal)), h)
        self.y = times(unit(cross(self.normal, self.x)), h)

    def at(self, u, v):
        return plus(plus(self.middle, self.x, u), self.y, v)

    def corners(self):
        return [self.at(u, v) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def with_slivers(square, count=8):
    """The square cut into strips, and after each strip a sliver a micrometre wide; one begins in the middle."""
    h = math.sqrt(dot(square.x, square.x))
    vertices, faces, low = [], [], -1.0
    for i in range(count):
        high = -1.0 + 2.0 * (i + 1) / count
        for a, b in ((low, high), (high, high + MICRON / h)):
            first = len(vertices)
            vertices += [(square.at(u, v), square.normal) for u, v in ((-1, a), (1, a), (1, b), (-1, b))]
            faces += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
        low = high + MICRON / h
    return vertices, faces


def twice(square):
    """The same quad two times, cut along one diagonal and along the other."""
    vertices = [(p, square.normal) for p in square.corners()] * 2
    return vertices, [[0, 1, 2], [0, 2, 3], [4, 5, 7], [5, 6, 7]]


def contradicting(square):
    """A fan whose corners' normals look away, along the face and to one another."""
    corners = square.corners()
    aside, up = unit(square.x), unit(square.y)
    vertices = [(square.middle, square.normal), (corners[0], times(square.normal, -1.0)), (corners[1], aside),
                (corners[2], plus(square.normal, up)), (corners[3], times(aside, -1.0))]
    return vertices, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]


def without_area(square):
    """A quad with triangles that are lines and points on it and before it."""
    vertices = [(p, square.normal) for p in square.corners()]
    vertices += [(square.at(u, u), square.normal) for u in (-0.5, 0.0, 0.5)]
    vertices += [(plus(square.at(u, -u), square.normal, 0.2), square.normal) for u in (-0.8, 0.0, 0.8)]
    vertices += [(square.at(0.0, 0.0), square.normal)] * 2
    return vertices, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9], [5, 10, 11]]


def bad_triangles(folder):
    text = """\
Four squares and what is wrong with them, taken as they are (`asIs`): top left, black glass cut by slivers a micrometre
wide (aspect 1e6); top right, gold that is there twice in one plane, cut along different diagonals; bottom left,
gold whose corners' normals contradict the face and one another; bottom right, clear glass with triangles that are
lines and points. A lamp stands behind the eye, a panel behind the squares.

No closed form for the picture. Where the gold lies twice it is seen as if it lay there once; no pixel holds a number
that is none, a negative radiance or one above 1. The pack's grid is wider than the slivers and turns them into lines.
"""
    bad = [("slivers", "black-glass", with_slivers(Square((-0.56, 0.56, 0.0), (0.25, -0.1, 1.0), 0.5))),
           ("twice", "gold", twice(Square((0.56, 0.56, 0.0), (-0.3, -0.2, 1.0), 0.5))),
           ("contradicting", "gold", contradicting(Square((-0.56, -0.56, 0.0), (0.2, 0.2, 1.0), 0.5))),
           ("without-area", "glass", without_area(Square((0.56, -0.56, 0.0), (-0.5, 0.3, 1.0), 0.5)))]
    parts = [PartAsIs(name, material, *mesh) for name, material, mesh in bad]
    lamp = quad((1.8, -1.5, 3.5), (-1.8, -1.5, 3.5), (-1.8, 1.5, 3.5), (1.8, 1.5, 3.5))
    panel = quad((-1.5, -1.5, -1.0), (1.5, -1.5, -1.0), (1.5, 1.5, -1.0), (-1.5, 1.5, -1.0))
    parts += [Part("lamp", "lamp", lamp, flat=True), Part("panel", "panel", panel, flat=True)]
    return write_hard(folder, "Slivers, doubled faces, contradicting normals, triangles without area.", text,
                      camera((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 45.0), parts,
                      {"black-glass": BLACK_GLASS, "gold": GOLD, "glass": GLASS, "lamp": emitter(1.0),
                       "panel": emitter(0.15, 0.3, 0.6)}, 6, resolution=(96, 96),
                      environment={"radiance": [0.1, 0.08, 0.05]})


def slivers(folder):
    text = """\
A mirror of black glass, 1 m wide, cut into strips with slivers between them that are a micrometre wide and a million
times as long; it fills the pack's grid, whose steps are as wide as the slivers, so each has a tilt of its own. The
rays of the middle row meet the middle sliver, which leans by 45 degrees instead of 17. A lamp hangs before the mirror.

Closed form: none of a sliver shows. The middle row looks like its neighbours, and no ray slips through (it would
read the sky, 0.3 / 0.1 / 0.1, behind the mirror as before it, unattenuated).
"""
    y = MICRON / 2
    # So far back that the middle sliver goes down one step of the grid: 45 degrees instead of 17.
    square = Square((0.0, 0.0, -0.4 * MICRON), (0.0, 0.3, 1.0), 0.5)
    parts = [PartAsIs("mirror", "black-glass", *with_slivers(square)),
             Part("lamp", "lamp", quad((-0.3, 0.2, 0.6), (-0.3, 0.5, 0.6), (0.05, 0.5, 0.6), (0.05, 0.2, 0.6)),
                  flat=True)]
    return write_hard(folder, "Slivers a million times as long as wide: each has a normal that means nothing.", text,
                      {"position": [0.0, y, 0.8], "target": [0.0, y, 0.0], "verticalFovDegrees": 50.0}, parts,
                      {"black-glass": BLACK_GLASS, "lamp": emitter(1.0)}, 4, exposureEv=3.0,
                      environment={"radiance": [0.3, 0.1, 0.1]})
