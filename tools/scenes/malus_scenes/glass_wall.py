"""The scene glass-wall: two glass slabs, one seen in the other with crossed planes of incidence.

The camera sees the upright slab near Brewster's angle. It reflects the leaning slab, again near Brewster's angle,
which reflects the skylight. The first plane of incidence is horizontal, the second vertical, which extinguishes the
skylight.
"""
import math

from . import studio
from .scene import Part, total, write_scene
from .shapes import box, quad, strip
from .vectors import rounded

EXPECTED = (36, 28)
CAMERA = {"position": [0.15, 1.16, 4.6], "target": [0.12, 0.76, 0.0], "up": [0.0, 1.0, 0.0], "verticalFovDegrees": 32.0}

# The upright slab extends from the left front to the middle.
UPRIGHT = {"width": 3.0, "height": 1.95, "turn": 70.0, "middle": (-0.92, 0.35)}
# The leaning slab: `slope` from the horizontal, facing the mirror direction of the upright slab; its lower edge is on
# the floor at `foot`. The box behind it has the same direction and supports it.
LEANING = {"width": 2.3, "length": 1.85, "turn": -54.0, "slope": 38.0, "foot": (0.70, -0.46)}
BOX = {"size": (1.0, 0.76, 0.74)}
THICKNESS = 0.02


def slab(width, height):
    """Returns front (+z) and back (-z) face of a pane without rims, with normals out of the glass."""
    x, y, z = width / 2, height / 2, THICKNESS / 2
    soup = quad((-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z))
    return soup.add(quad((x, -y, -z), (-x, -y, -z), (-x, y, -z), (x, y, -z)))


def leaning_instance():
    turn, slope = math.radians(LEANING["turn"]), math.radians(LEANING["slope"])
    # From the lower edge to the middle of the slab: up the slope.
    run = 0.5 * LEANING["length"] * math.cos(slope)
    x, z = LEANING["foot"]
    middle = (x - run * math.sin(turn), 0.5 * LEANING["length"] * math.sin(slope) + THICKNESS, z - run * math.cos(turn))
    return {"rotateDegrees": [LEANING["slope"] - 90.0, LEANING["turn"], 0.0], "translate": rounded(middle, 4)}


def box_instance():
    """Returns the transform of the box, whose upper front edge touches the back of the leaning slab."""
    turn, slope = math.radians(LEANING["turn"]), math.radians(LEANING["slope"])
    width, height, depth = BOX["size"]
    run = height / math.tan(slope) + 0.5 * depth + 0.002
    x, z = LEANING["foot"]
    return {"rotateDegrees": [0.0, LEANING["turn"], 0.0],
            "translate": rounded((x - run * math.sin(turn), 0.5 * height, z - run * math.cos(turn)), 4)}


def room():
    """Returns floor and back wall as one open mesh, folded once."""
    return strip([(12.0, 0.0, 3.4), (12.0, 0.0, -2.6), (12.0, 4.0, -2.6)], (-16.0, 0.0, 0.0))


def folded_sheet():
    """Returns an upright sheet of metal, folded once."""
    return strip([(-0.42, 0.0, 0.16), (0.0, 0.0, 0.0), (0.46, 0.0, 0.20)], (0.0, 1.05, 0.0))


def sky():
    gradient = studio.smooth_steps([(-90, (0.02, 0.02, 0.025)), (0, (0.08, 0.09, 0.11)), (35, (0.12, 0.13, 0.16)),
                                    (90, (0.08, 0.09, 0.12))])
    lights = [studio.Box(60, 83, 46, 46, (14.0, 13.2, 12.0), edge=1.8, panes=(5, 5), bar=2.2),
              studio.Box(-100, 16, 30, 64, (2.6, 2.7, 3.0), edge=16),
              studio.Box(93, 8, 16, 60, (2.0, 1.9, 1.75), edge=6)]
    return studio.render(1024, 512, lambda elevation, azimuth: gradient(elevation), lights)


README = """\
# glass-wall

Two panes of glass in a dark room under a skylight: one upright, one leaning against a chromium box, and a
folded sheet of gold. 1920 x 1080, depth 6.

| part | material | vertices | triangles | file |
|---|---|---|---|---|
| upright pane, two faces | glass (BK7), `openSurface` | 8 | 4 | `slab-upright.obj` |
| leaning pane, two faces | glass (BK7), `openSurface` | 8 | 4 | `slab-leaning.obj` |
| box | chromium | 8 | 12 | `box.stl` |
| floor and back wall | dark paint under an interface | 6 | 4 | `room.ply` |
| folded sheet | gold | 6 | 4 | `sheet.off` |
| **all** | | **36** | **28** | |

**Visible effect.** In the left third of the image the upright pane reflects the leaning pane, which reflects
the skylight with its bars. The floor in front shows the same again. With polarization this reflection nearly
vanishes; with the unpolarized mean of Fresnel's equations it is bright.

**Cause.** Unpolarized light of radiance L has after two reflections the radiance
I = A1 A2 (1 + D1 D2 cos 2phi) L, with A = (Rs + Rp)/2, D = (Rs - Rp)/(Rs + Rp) and phi the angle between
the planes of incidence. One face of each pane, in the middle of the reflection: 53 degrees at
the upright pane (D = .98), 47 degrees at the leaning one (D = .88), planes of incidence crossed
(cos 2phi = -.97). So 1 + D1 D2 cos 2phi = .16: a sixth of the unpolarized mean. The back faces and
multiple reflections inside a pane have nearly the same effect. A single reflection of the sky, as in the
gold sheet, is the same in both.

The panes have no rims: rays that leave between their faces end black. Their shadows are black, since every
surface blocks a point light. The source meshes have separate vertices for each face; the box is inside out,
and box and sheet have a duplicate face and one without area.
"""


def write(folder):
    x, z = UPRIGHT["middle"]
    parts = [
        Part("slab-upright", "glass", slab(UPRIGHT["width"], UPRIGHT["height"]), "obj", sheet=True,
             instances=[{"rotateDegrees": [0.0, UPRIGHT["turn"], 0.0],
                         "translate": rounded((x, UPRIGHT["height"] / 2 + 0.002, z), 4)}]),
        Part("slab-leaning", "glass", slab(LEANING["width"], LEANING["length"]), "obj", sheet=True,
             instances=[leaning_instance()]),
        Part("box", "chromium", box(BOX["size"]).flipped(), "stl", flat=True, blemishes=(1, 1),
             instances=[box_instance()]),
        Part("room", "room", room(), "ply", flat=True),
        Part("sheet", "gold", folded_sheet(), "off", flat=True, blemishes=(1, 1),
             instances=[{"rotateDegrees": [0.0, -8.0, 0.0], "translate": [-0.2, 0.0, -1.7]}]),
    ]
    materials = {
        "glass": {"type": "glass", "preset": "bk7"},
        "chromium": {"type": "metal", "preset": "chromium"},
        "gold": {"type": "metal", "preset": "gold"},
        "room": {"type": "paint", "eta": 1.5, "albedo": [0.022, 0.050, 0.066]},
    }
    settings = {
        "name": "glass-wall", "title": "Two glass slabs, a metal box and a folded sheet",
        "origin": [0.0, 0.0, 0.0],
        "camera": CAMERA,
        "resolution": [1920, 1080], "depth": 6, "exposureEv": 0.0,
        "environment": {"image": "skylight.hdr", "scale": 1.0, "ambientIrradiance": 0.3},
        "lights": [{"type": "point", "position": [0.9, 3.1, -0.9], "intensity": [40.0, 38.0, 34.0]},
                   {"type": "point", "position": [1.8, 3.0, 5.0], "intensity": [20.0, 20.4, 21.6]}],
    }
    write_scene(folder, settings, materials, parts, EXPECTED, sky(), README)
    return total(parts)
