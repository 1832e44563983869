"""Parts of a V-twin motorcycle engine, each a soup in its own frame. Metres; y is up in the bike, x points
to the front, z to the right-hand side, which the camera sees. Cylinder parts have y along the bore, from
the crankshaft."""
import math

from .mesh import Soup
from .shapes import aimed, belt, box, lathe, loft, placed, rounded_rectangle, slab

UPRIGHT = placed(rotate_degrees=(-90.0, 0.0, 0.0))  # slabs extend along +z: rotates +z to +y


def bolt(radius=0.0066, height=0.006):
    """Hexagonal head of a bolt along +y, open at the bottom: 30 vertices, 16 triangles."""
    return _turned([(radius, 0.0), (radius, height)], 6)


def _turned(profile, n):
    """Lathed about y and closed by a flat polygon at the top only."""
    return loft([[(r * math.cos(2 * math.pi * i / n), y, -r * math.sin(2 * math.pi * i / n)) for i in range(n)]
                 for r, y in profile], cap_first=False)


def plate(width, depth, radius, y0, y1, steps=3, chamfer=0.0):
    """A rounded plate across the bore, from y0 to y1."""
    outline = rounded_rectangle(width, depth, radius, steps)
    levels = [(y0, 0.0), (y1, 0.0)] if chamfer == 0.0 else [(y0, 0.0), (y1 - chamfer, 0.0), (y1, chamfer)]
    return Soup().add(slab(outline, levels), UPRIGHT)


# Cylinder, in its own frame -------------------------------------------------------------------------------

def barrel():
    """Bore wall and foot."""
    soup = lathe([(0.062, 0.12), (0.062, 0.30)], 20)
    return soup.add(plate(0.150, 0.150, 0.030, 0.146, 0.158))


def barrel_fins():
    """Cast fins, thinner at the rim than at the root, to be shaded smooth all over."""
    soup = Soup()
    for i in range(8):
        y, size = 0.170 + 0.0148 * i, 0.158 + 0.0025 * i
        outline = rounded_rectangle(size, size, 0.052, 3)
        fin = slab(outline, [(y, 0.040), (y + 0.0012, 0.0), (y + 0.0058, 0.0), (y + 0.0070, 0.040)], False, False)
        soup.add(fin, UPRIGHT)
    return soup


def head():
    """Head block, its fins, the exhaust port's boss (+x) and the intake boss (-x)."""
    soup = plate(0.128, 0.128, 0.040, 0.290, 0.372)
    for i in range(4):
        y = 0.302 + 0.0152 * i
        soup.add(plate(0.188 - 0.004 * i, 0.184, 0.048, y, y + 0.0058))
    soup.add(plate(0.170, 0.150, 0.042, 0.366, 0.376))
    soup.add(Soup().add(lathe([(0.034, 0.0), (0.034, 0.045)], 16), aimed((0.060, 0.332, 0.0), (1.0, 0.10, 0.0))))
    return soup


def head_gasket():
    return plate(0.150, 0.150, 0.040, 0.2885, 0.2915)


def rocker_cover():
    """Two steps with chamfers."""
    soup = plate(0.162, 0.142, 0.040, 0.3765, 0.402, steps=4, chamfer=0.008)
    soup.add(plate(0.122, 0.100, 0.034, 0.4020005, 0.418, steps=4, chamfer=0.006))
    return soup


def rocker_bolts():
    soup = Soup()
    for x in (-0.064, 0.064):
        for z in (-0.053, 0.053):
            soup.add(bolt(0.0085, 0.009), placed((x, 0.4015, z)))
    soup.add(bolt(0.0105, 0.008), placed((0.0, 0.4178, 0.0)))
    return soup


def pushrod_tubes():
    """Two tubes with collars, on the right-hand side of the barrel."""
    soup = Soup()
    for x0, x1 in ((-0.020, -0.043), (0.020, 0.043)):
        low, high = (x0, 0.128, 0.112), (x1, 0.351, 0.080)
        axis = tuple(b - a for a, b in zip(low, high))
        length = math.sqrt(sum(c * c for c in axis))
        place = aimed(low, axis)
        rod = [(0.0130, 0.0), (0.0130, 0.030), (0.0095, 0.036), (0.0095, 0.104), (0.0125, 0.110), (0.0125, 0.124),
               (0.0095, 0.130), (0.0095, length)]
        soup.add(lathe(rod, 11), place)
    return soup


def spark_plug():
    """(hexagon and shell, boot) on the right-hand side of the head, above the fins."""
    place = aimed((0.0, 0.352, 0.068), (0.0, 0.45, 0.9))
    shell = Soup().add(_turned([(0.012, 0.0), (0.012, 0.016)], 6), place)
    profile = [(0.0085, 0.016), (0.0085, 0.030), (0.0105, 0.036), (0.0105, 0.058), (0.0, 0.062)]
    boot = Soup().add(lathe(profile, 11), place)
    return shell, boot


# Bottom end -------------------------------------------------------------------------------------------------

def chamfered(circles, n, z0, z1, chamfer, far_chamfer=0.0):
    """A belt around circles as a solid from z0 to z1; chamfers of 45 degrees at its ends."""
    far = [(z0, far_chamfer), (z0 + far_chamfer, 0.0)] if far_chamfer else [(z0, 0.0)]
    near = [(z1 - chamfer, 0.0), (z1, chamfer)] if chamfer else [(z1, 0.0)]
    return slab(belt(circles, n), far + near)


def crankcase():
    outline = [(0.0, 0.30, 0.150), (-0.235, 0.305, 0.118), (0.085, 0.245, 0.085)]
    soup = chamfered(outline, 36, -0.095, 0.095, 0.012, 0.012)
    # Deck that carries the cylinders, sump and mounting lugs.
    soup.add(box((0.20, 0.06, 0.15), (0.0, 0.425, 0.0)))
    sump = [(-0.17, 0.175, 0.030), (0.04, 0.160, 0.030), (0.02, 0.20, 0.05), (-0.15, 0.21, 0.04)]
    soup.add(chamfered(sump, 18, -0.080, 0.080, 0.010, 0.010))
    for x, y in ((0.172, 0.275), (-0.345, 0.345)):
        soup.add(chamfered([(x, y, 0.026), (x * 0.85, y, 0.030)], 16, -0.040, 0.040, 0.006, 0.006))
    return soup


def cam_cover():
    """The big cover on the right, its edge stepped."""
    circles = [(0.0, 0.300, 0.118), (0.052, 0.372, 0.062), (-0.052, 0.372, 0.062)]
    soup = chamfered(circles, 40, 0.0951, 0.118, 0.006)
    soup.add(chamfered([(x, y, r - 0.020) for x, y, r in circles], 40, 0.1181, 0.132, 0.008))
    return soup


CAM_COVER_EDGE = [(0.0, 0.300, 0.105), (0.052, 0.372, 0.049), (-0.052, 0.372, 0.049)]
GEARBOX_COVER_EDGE = [(-0.235, 0.305, 0.077), (-0.200, 0.285, 0.077)]


def cover_bolts(edge, z, count):
    """`count` hexagons along the belt around `edge`, at equal distances, facing +z."""
    outline = belt(edge, 360)(0.0)
    lengths = [math.dist(outline[i - 1], outline[i]) for i in range(len(outline))]
    soup, along, placed_bolts = Soup(), 0.0, 0
    for point, length in zip(outline, lengths):
        along += length
        if placed_bolts < count and along >= (placed_bolts + 0.5) * sum(lengths) / count:
            placed_bolts += 1
            soup.add(bolt(), placed(rotate_degrees=(90.0, 0.0, 0.0), translate=(*point, z)))
    return soup


def points_cover():
    """The round cover over the ignition: a dished disc with a ring around it."""
    soup = Soup()
    place = placed(rotate_degrees=(90.0, 0.0, 0.0), translate=(0.0, 0.290, 0.1319))
    soup.add(_turned([(0.066, 0.0), (0.066, 0.010), (0.060, 0.016), (0.050, 0.016), (0.046, 0.012)], 28), place)
    return soup


def gearbox_cover():
    soup = chamfered([(-0.235, 0.305, 0.092), (-0.200, 0.285, 0.092)], 34, 0.0951, 0.114, 0.007)
    place = placed(rotate_degrees=(90.0, 0.0, 0.0), translate=(-0.232, 0.305, 0.1139))
    soup.add(_turned([(0.060, 0.0), (0.060, 0.008), (0.052, 0.016), (0.030, 0.020)], 24), place)
    return soup


def primary_cover():
    """The long cover on the far side."""
    return chamfered([(0.0, 0.30, 0.125), (-0.245, 0.305, 0.125)], 30, -0.150, -0.096, 0.0, 0.014)


def lifter_blocks():
    """Returns two blocks under the pushrod tubes."""
    soup = Soup()
    for side in (-1, 1):
        a = math.radians(25.0 * side)
        place = placed((math.sin(a) * 0.118, 0.30 + math.cos(a) * 0.118, 0.103), (0.0, 0.0, -25.0 * side))
        soup.add(Soup().add(box((0.088, 0.036, 0.042))), place)
    return soup
