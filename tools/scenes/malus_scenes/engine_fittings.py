"""Fittings of the engine of engine_parts: intake, exhaust, filter, gauge, lines. Same frame."""
import math

from .mesh import Soup
from .shapes import aimed, curve, lathe, placed, quad, resampled, rounded_rectangle, slab, tube

STACK_AXIS = (0.0, 0.30, 1.0)


def velocity_stack():
    """A double-walled trumpet along +y with a rounded lip, closed, 0.10 m long."""
    outer = [(0.0250, 0.0), (0.0252, 0.020), (0.0280, 0.045), (0.0325, 0.064), (0.0385, 0.080)]
    centre, r = (0.0425, 0.0850), 0.0052
    lip = [(centre[0] + r * math.cos(math.radians(a)), centre[1] + r * math.sin(math.radians(a)))
           for a in (-90, -45, 0, 45, 90, 135, 165)]
    inner = [(0.0330, 0.072), (0.0280, 0.054), (0.0245, 0.030), (0.0230, 0.008)]
    return lathe([(0.0, 0.0), *outer, *lip, *inner, (0.0, 0.008)], 20)


def carburettor():
    """Body, float bowl and throttle drum, its mouth at the origin looking along +y (up the stack)."""
    soup = lathe([(0.026, -0.085), (0.026, -0.050), (0.031, -0.045), (0.031, 0.0), (0.0, 0.0)], 14)
    soup.add(lathe([(0.0, 0.0), (0.017, 0.0), (0.024, 0.007), (0.024, 0.034)], 14),
             lambda p: (p[0], -0.030 + p[2], 0.060 - p[1]))
    return soup


def pipe_tip(radius):
    """The open end of an exhaust along +y: outer wall, rolled edge, inner wall and a floor inside."""
    return lathe([(0.0, 0.0), (radius, 0.0), (radius, 0.085), (radius - 0.003, 0.088), (radius - 0.006, 0.085),
                  (radius - 0.006, 0.030), (0.0, 0.030)], 18)


def front_header():
    return curve([(0.213, 0.586, 0.0), (0.262, 0.566, 0.012), (0.300, 0.500, 0.045), (0.285, 0.330, 0.110),
                  (0.215, 0.178, 0.160), (0.090, 0.112, 0.184), (-0.100, 0.098, 0.190), (-0.470, 0.092, 0.190)], 3)


def rear_header():
    return curve([(-0.213, 0.586, 0.0), (-0.268, 0.574, 0.004), (-0.340, 0.505, 0.020), (-0.376, 0.385, 0.065),
                  (-0.380, 0.265, 0.130), (-0.402, 0.196, 0.175), (-0.455, 0.170, 0.188), (-0.545, 0.164, 0.190)], 3)


def exhaust():
    """Both pipes with flanges at the ports and tips."""
    soup = Soup()
    for path in (front_header(), rear_header()):
        soup.add(tube(path, 0.0235, 15))
        soup.add(lathe([(0.0, 0.0), (0.037, 0.0), (0.037, 0.009), (0.0, 0.009)], 16),
                 aimed(path[0], tuple(b - a for a, b in zip(path[0], path[1]))))
        soup.add(pipe_tip(0.030), aimed(path[-2], tuple(b - a for a, b in zip(path[-2], path[-1]))))
    return soup


def oil_filter():
    place = aimed((0.150, 0.215, 0.030), (1.0, -0.12, 0.12))
    profile = [(0.038, 0.0), (0.038, 0.070), (0.0355, 0.0765), (0.029, 0.081), (0.018, 0.083), (0.0, 0.083)]
    return Soup().add(lathe(profile, 20), place)


def starter():
    """A motor across the case behind the rear cylinder."""
    place = placed((-0.262, 0.452, -0.060), (90.0, 0.0, 0.0))
    profile = [(0.0, 0.0), (0.034, 0.0), (0.040, 0.006), (0.040, 0.120), (0.034, 0.128), (0.016, 0.130), (0.0, 0.130)]
    return Soup().add(lathe(profile, 20), place)


OIL_LINES = [
    [(0.148, 0.232, 0.088), (0.176, 0.260, 0.116), (0.182, 0.318, 0.126), (0.152, 0.374, 0.118), (0.116, 0.404, 0.088)],
    [(-0.118, 0.218, 0.088), (-0.128, 0.190, 0.118), (-0.096, 0.166, 0.142), (-0.030, 0.158, 0.150),
     (0.032, 0.170, 0.138), (0.062, 0.202, 0.090)],
]


def oil_lines(pieces):
    """Two pipes of `pieces` cylinders in all; each piece has 12 vertices and 24 triangles."""
    soup = Soup()
    for points, share in zip(OIL_LINES, (pieces // 2, pieces - pieces // 2)):
        soup.add(tube(resampled(curve(points, 12), share), 0.0068, 12))
    return soup


def cables(front, rear):
    """Ignition cables from the boots of both cylinders to the coil between them."""
    soup = Soup()
    for (x, y, z), side in ((front, 1), (rear, -1)):
        path = [(x, y, z), (x + 0.003 * side, y + 0.012, z + 0.018), (x - 0.018 * side, y + 0.032, z + 0.020),
                (x - 0.055 * side, y + 0.030, z - 0.012),
                (0.040 * side, y - 0.004, 0.062), (0.022 * side, y - 0.040, 0.050)]
        soup.add(tube(curve(path, 3), 0.0046, 8))
    return soup


def coil():
    soup = slab(rounded_rectangle(0.066, 0.055, 0.012, 3), [(0.0, 0.004), (0.004, 0.0), (0.058, 0.0), (0.062, 0.004)])
    return Soup().add(soup, placed((0.0, 0.580, 0.012), (-90.0, 0.0, 0.0)))


# Gauge and sight glass: z is the axis of both, toward the viewer ------------------------------------------------

def gauge_cup():
    """Case of the gauge with its bezel, a cup that is open to the front."""
    soup = lathe([(0.0, -0.030), (0.030, -0.030), (0.038, -0.022), (0.038, 0.006), (0.0355, 0.0085), (0.0335, 0.0085),
                  (0.0320, 0.007), (0.0320, -0.004), (0.0, -0.004)], 28)
    return Soup().add(soup, placed(rotate_degrees=(90.0, 0.0, 0.0)))


def gauge_dial(ticks):
    """Ticks around three quarters of the dial, a quad each, just above it."""
    soup = Soup()
    for i in range(ticks):
        a = math.radians(225.0 - 270.0 * i / (ticks - 1))
        c, s = math.cos(a), math.sin(a)
        r0, w = (0.0215, 0.0009) if i % 5 == 0 else (0.0240, 0.0005)
        corner = lambda r, t: (r * c - t * s, r * s + t * c, -0.0032)
        soup.add(quad(corner(r0, w), corner(r0, -w), corner(0.0285, -w), corner(0.0285, w)))
    return soup


def gauge_face():
    soup = lathe([(0.0316, 0.0), (0.0, 0.0)], 28)
    return Soup().add(soup, placed(translate=(0.0, 0.0, -0.0036), rotate_degrees=(90.0, 0.0, 0.0)))


def gauge_needle():
    a = math.radians(62.0)
    c, s = math.cos(a), math.sin(a)
    outline = ((-0.006, 0.0014), (-0.006, -0.0014), (0.024, -0.0004), (0.024, 0.0004))
    return quad(*((r * c - t * s, r * s + t * c, -0.0024) for r, t in outline))


def gauge_glass():
    """A closed, slightly domed cover."""
    soup = lathe([(0.0, 0.0015), (0.0315, 0.0015), (0.0315, 0.0040), (0.024, 0.0058), (0.013, 0.0068),
                  (0.0, 0.0071)], 28)
    return Soup().add(soup, placed(rotate_degrees=(90.0, 0.0, 0.0)))


def sight_glass():
    soup = lathe([(0.0, 0.0), (0.0150, 0.0), (0.0150, 0.0025), (0.0125, 0.0062), (0.0085, 0.0085), (0.0, 0.0095)], 22)
    return Soup().add(soup, placed(rotate_degrees=(90.0, 0.0, 0.0)))


def sight_bezel():
    soup = lathe([(0.0155, 0.0), (0.0215, 0.0), (0.0215, 0.0035), (0.0195, 0.0055), (0.0155, 0.0055),
                  (0.0155, 0.0)], 22)
    return Soup().add(soup, placed(rotate_degrees=(90.0, 0.0, 0.0)))
