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
    """Returns the square cut into strips, with a sliver 1 micrometre wide after each; one begins in the middle."""
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
    """Returns the quad twice, cut along one diagonal and along the other."""
    vertices = [(p, square.normal) for p in square.corners()] * 2
    return vertices, [[0, 1, 2], [0, 2, 3], [4, 5, 7], [5, 6, 7]]


def contradicting(square):
    """Returns a fan whose vertex normals face away, along the face and towards each other."""
    corners = square.corners()
    aside, up = unit(square.x), unit(square.y)
    vertices = [(square.middle, square.normal), (corners[0], times(square.normal, -1.0)), (corners[1], aside),
                (corners[2], plus(square.normal, up)), (corners[3], times(aside, -1.0))]
    return vertices, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]


def without_area(square):
    """Returns a quad with triangles that are lines and points, on it and in front of it."""
    vertices = [(p, square.normal) for p in square.corners()]
    vertices += [(square.at(u, u), square.normal) for u in (-0.5, 0.0, 0.5)]
    vertices += [(plus(square.at(u, -u), square.normal, 0.2), square.normal) for u in (-0.8, 0.0, 0.8)]
    vertices += [(square.at(0.0, 0.0), square.normal)] * 2
    return vertices, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9], [5, 10, 11]]


def bad_triangles(folder):
    text = """\
Four squares with defects that preparation does not remove (`asIs`): top left, black glass cut by slivers 1 micrometre
wide (aspect ratio 1e6); top right, gold twice in one plane, cut along different diagonals; bottom left, gold whose
vertex normals contradict the face and each other; bottom right, clear glass with triangles that are lines and points. A
lamp is behind the camera, a panel behind the squares.

There is no closed form. The duplicate gold looks like single gold; no pixel is NaN, negative or above 1. The grid of
the pack is wider than the slivers and makes them lines.
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
A mirror of black glass, 1 m wide, cut into strips with slivers between them, 1 micrometre wide and a million times as
long. It fills the grid of the pack, whose steps are as wide as the slivers, so that each sliver has a different tilt.
The rays of the middle row hit the middle sliver, which is tilted by 45 degrees, not by 17. A lamp is in front of the
mirror.

Closed form: no sliver is visible. The middle row equals its neighbours, and no ray passes through the mirror (it would
have the radiance of the sky, 0.3 / 0.1 / 0.1).
"""
    y = MICRON / 2
    # Moved back so that the middle sliver spans one step of the grid: 45 degrees, not 17.
    square = Square((0.0, 0.0, -0.4 * MICRON), (0.0, 0.3, 1.0), 0.5)
    parts = [PartAsIs("mirror", "black-glass", *with_slivers(square)),
             Part("lamp", "lamp", quad((-0.3, 0.2, 0.6), (-0.3, 0.5, 0.6), (0.05, 0.5, 0.6), (0.05, 0.2, 0.6)),
                  flat=True)]
    return write_hard(folder, "Slivers a million times as long as wide: their normals are rounding errors.", text,
                      {"position": [0.0, y, 0.8], "target": [0.0, y, 0.0], "verticalFovDegrees": 50.0}, parts,
                      {"black-glass": BLACK_GLASS, "lamp": emitter(1.0)}, 4, exposureEv=3.0,
                      environment={"radiance": [0.3, 0.1, 0.1]})
