"""The scene cornell-box: red and green walls, a floor of black glass, a tower of black glass and a gold block. The
tower reflects the lit window in the right wall; the floor reflects the tower with a crossed plane of incidence, which
extinguishes the window."""
from .scene import Part, total, write_scene
from .shapes import box, quad, strip

EXPECTED = (74, 38)
HALF, HEIGHT = 1.0, 2.0
# Distance of a panel from its wall.
GAP = 0.005
# Depth of the blocks below the floor, so that no two faces coincide.
SUNK = 0.01


def back_and_ceiling():
    """Returns back wall and ceiling as one open mesh, folded once."""
    h, y = HALF, HEIGHT
    return strip([(h, 0.0, -h), (h, y, -h), (h, y, h)], (-2 * h, 0.0, 0.0))


def block(name, material, width, height, turn, x, z, inside_out=False, **options):
    soup = box((width, height, width))
    return Part(name, material, soup.flipped() if inside_out else soup,
                instances=[{"rotateDegrees": [0.0, turn, 0.0], "translate": [x, round(height / 2 - SUNK, 4), z]}],
                **options)


def lamp(x, z, half):
    y = HEIGHT - GAP
    return quad((x - half, y, z - half), (x + half, y, z - half), (x + half, y, z + half), (x - half, y, z + half))


def window(y0, y1, z0, z1):
    x = HALF - GAP
    return quad((x, y0, z0), (x, y0, z1), (x, y1, z1), (x, y1, z0))


README = """\
# cornell-box

A Cornell box with a floor of black glass, a tower of black glass, a block of gold, a lamp in the ceiling and
a lit window in the green wall. Walls and ceiling are paint under an interface. 2048 x 2048, depth 6.

| part | material | vertices | triangles | file |
|---|---|---|---|---|
| back wall and ceiling | white paint | 6 | 4 | `back-and-ceiling.obj` |
| floor | black glass, n = 1.8 | 4 | 2 | `floor.off` |
| left wall, right wall | red and green paint | 8 | 4 | `left.ply`, `right.ply` |
| lamp, window | emitter | 8 | 4 | `lamp.off`, `window.off` |
| tower | black glass (BK7) | 24 | 12 | `tower.stl` |
| block | gold | 24 | 12 | `block.obj` |
| **all** | | **74** | **38** | |

**Visible effect.** The right face of the tower reflects the window: a single reflection, the same with and
without polarization. Below, the floor reflects that face, and the window nearly vanishes; with the
unpolarized mean of Fresnel's equations it is grey (columns 41 to 54 %, rows 73 to 100 % of the image). The
red reflection in the left face of the tower also loses half of its radiance in the floor.

**Cause.** Two reflections of unpolarized light give I = A1 A2 (1 + D1 D2 cos 2phi) L, with
A = (Rs + Rp)/2, D = (Rs - Rp)/(Rs + Rp) and phi the angle between the planes of incidence. Floor: 65
degrees, D = .98. Tower: 59 degrees, D = .99. The plane of incidence is vertical at the floor and nearly
horizontal at the tower: cos 2phi = -.84, so that 1 + D1 D2 cos 2phi = .19. Light from paint is polarized as
well, so that a single reflection of paint needs the full calculation.

No surface transmits light, so a renderer may leave out refraction. The source mesh of the tower is inside
out; that of the block has a duplicate face and one without area. The environment is constant grey.
"""


def write(folder):
    h, y = HALF, HEIGHT
    parts = [
        Part("back-and-ceiling", "white", back_and_ceiling(), "obj", flat=True),
        Part("floor", "floor", quad((-h, 0, h), (h, 0, h), (h, 0, -h), (-h, 0, -h)), "off", flat=True),
        Part("left", "red", quad((-h, 0, h), (-h, 0, -h), (-h, y, -h), (-h, y, h)), "ply", flat=True),
        Part("right", "green", quad((h, 0, -h), (h, 0, h), (h, y, h), (h, y, -h)), "ply", flat=True),
        Part("lamp", "lamp", lamp(0.0, -0.15, 0.30), "off", flat=True),
        Part("window", "window", window(0.10, 1.70, -0.92, -0.22), "off", flat=True),
        block("tower", "black-glass", 0.60, 1.15, 56.0, -0.30, -0.34, format="stl", inside_out=True),
        block("block", "gold", 0.46, 0.46, -17.0, 0.48, 0.20, format="obj", blemishes=(1, 1)),
    ]
    materials = {
        "floor": {"type": "mirror-glass", "eta": 1.8},
        "black-glass": {"type": "mirror-glass", "preset": "bk7"},
        "red": {"type": "paint", "eta": 1.5, "albedo": [0.62, 0.05, 0.04]},
        "green": {"type": "paint", "eta": 1.5, "albedo": [0.1, 0.48, 0.1]},
        "white": {"type": "paint", "eta": 1.5, "albedo": [0.74, 0.72, 0.68]},
        "lamp": {"type": "emitter", "radiance": [9.0, 8.1, 6.9]},
        "window": {"type": "emitter", "radiance": [4.2, 4.4, 4.8]},
        "gold": {"type": "metal", "preset": "gold"},
    }
    settings = {
        "name": "cornell-box", "title": "A Cornell box on black glass",
        "origin": [0.0, 1.0, 0.0],
        "camera": {"position": [0.0, 1.72, 3.95], "target": [0.0, 0.844, 0.0], "up": [0.0, 1.0, 0.0],
                   "verticalFovDegrees": 35.0},
        "resolution": [2048, 2048], "depth": 6, "exposureEv": 0.0,
        "environment": {"radiance": [0.42, 0.41, 0.40], "ambientIrradiance": 0.5},
        "lights": [{"type": "point", "position": [0.0, 1.9, -0.15], "intensity": [2.4, 2.2, 1.9]}],
    }
    write_scene(folder, settings, materials, parts, EXPECTED, readme=README)
    return total(parts)
