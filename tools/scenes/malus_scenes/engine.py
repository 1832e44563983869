"""The scene engine: a V-twin motorcycle engine on polished black glass."""
from . import engine_fittings as fit
from . import engine_parts as eng
from . import studio
from .mesh import Soup
from .scene import Part, total, write_scene
from .shapes import aimed, box, placed, quad, tube

EXPECTED = (10448, 12510)
V_HALF_DEGREES = 25.0
CRANK_HEIGHT = 0.30
FLOOR_HEIGHT = -0.08
# The edges of the floor are parallel to those of the image; an edge of the plinth faces the camera.
CAMERA = {"position": [0.48, 0.92, 1.70], "target": [-0.15, 0.275, 0.0], "up": [0.0, 1.0, 0.0],
          "verticalFovDegrees": 31.0}
CAMERA_AZIMUTH_DEGREES = 20.334
LEAN = placed((0.0, CRANK_HEIGHT, 0.0), (0.0, 0.0, -V_HALF_DEGREES))

# (vertices, triangles) of the parts whose number meets the expected counts.
BOLT, TICK, PIPE_PIECE = (30, 16), (4, 2), (12, 24)


def remainder(vertices, triangles):
    """Returns numbers of bolts, ticks and pipe pieces with exactly these vertices and triangles, with the number of
    bolts nearest to 22. Raises ValueError if there are none."""
    for bolts in sorted(range(16, 41), key=lambda n: abs(n - 22)):
        for pieces in range(10, 80):
            left_v = vertices - bolts * BOLT[0] - pieces * PIPE_PIECE[0]
            left_t = triangles - bolts * BOLT[1] - pieces * PIPE_PIECE[1]
            ticks = left_t // TICK[1]
            if 20 <= ticks <= 80 and (ticks * TICK[0], ticks * TICK[1]) == (left_v, left_t):
                return bolts, ticks, pieces
    raise ValueError(f"engine: no bolts, ticks and pipes have {vertices} vertices and {triangles} triangles")


def both(soup):
    """Returns a part for both cylinders: leaning forward as modelled, leaning back mirrored in x."""
    front = Soup().add(soup, LEAN)
    rear = Soup().add(front, lambda p: (-p[0], p[1], p[2])).flipped()
    return front.add(rear)


def sky():
    """Returns a dark studio: a glow behind the engine, soft boxes at both sides and above, and cards in front that the
    chrome of the covers reflects."""
    gradient = studio.smooth_steps([(-90, (0.03, 0.03, 0.033)), (-30, (0.10, 0.10, 0.108)), (-6, (0.055, 0.056, 0.062)),
                                    (50, (0.035, 0.036, 0.042)), (90, (0.04, 0.04, 0.045))])
    lights = [studio.Box(-17, -20, 36, 8, (0.50, 0.50, 0.52), edge=34),
              studio.Box(200, 60, 80, 34, (3.4, 3.4, 3.5)),
              studio.Box(-106, 24, 40, 62, (4.6, 4.7, 5.0)),
              studio.Box(74, 26, 34, 56, (3.9, 3.7, 3.4)),
              studio.Box(203, -3, 64, 30, (1.35, 1.35, 1.38), edge=9),
              studio.Box(158, 12, 10, 46, (1.6, 1.6, 1.65)),
              studio.Box(0, 62, 130, 18, (2.6, 2.6, 2.7))]
    return studio.render(1024, 512, lambda elevation, azimuth: gradient(elevation), lights)


def parts(bolt_count, tick_count, pipe_pieces):
    shell, boot = eng.spark_plug()
    boot_end = LEAN((0.0, 0.352 + 0.060 * 0.447, 0.068 + 0.060 * 0.894))
    at_gauge = placed((-0.262, 0.470, 0.100), (-18.0, 8.0, 0.0))
    at_sight = placed((0.0, 0.205, 0.1179))
    stacks = [aimed((x, 0.500, 0.105), fit.STACK_AXIS) for x in (-0.047, 0.047)]
    cam_bolts = bolt_count * 3 // 5

    case = Soup().add(eng.crankcase()).add(eng.lifter_blocks())
    cylinders = both(eng.barrel()).add(both(eng.head()))
    covers = Soup().add(eng.cam_cover()).add(eng.gearbox_cover())
    chrome = Soup().add(both(eng.pushrod_tubes())).add(fit.exhaust()).add(fit.oil_filter().flipped())
    bolts = both(eng.rocker_bolts()).add(both(shell))
    bolts.add(eng.cover_bolts(eng.CAM_COVER_EDGE, 0.1178, cam_bolts))
    bolts.add(eng.cover_bolts(eng.GEARBOX_COVER_EDGE, 0.1138, bolt_count - cam_bolts))
    aluminium = Soup().add(fit.sight_bezel(), at_sight).add(fit.gauge_cup(), at_gauge)
    for place in stacks:
        chrome.add(fit.velocity_stack(), place)
        aluminium.add(fit.carburettor(), place)
    black = Soup().add(eng.primary_cover()).add(fit.starter()).add(fit.coil().flipped()).add(both(boot))
    cables = fit.cables(boot_end, (-boot_end[0], boot_end[1], boot_end[2]))
    red = both(eng.rocker_cover()).add(eng.points_cover())
    glass = Soup().add(fit.gauge_glass(), at_gauge).add(fit.sight_glass(), at_sight)
    y = FLOOR_HEIGHT
    plinth = box((0.33, 0.14, 0.33), (0.0, y + 0.07, 0.0)).add(box((0.19, 0.10, 0.19), (0.0, y + 0.1901, 0.0)))
    return [
        Part("case", "case", case, blemishes=(2, 2)),
        Part("cylinders", "cylinders", cylinders, welded=True, blemishes=(3, 2)),
        Part("fins", "cylinders", both(eng.barrel_fins()), crease=115.0, welded=True),
        Part("covers", "chrome", covers),
        Part("bright", "chrome", chrome, "ply", crease=55.0, welded=True, blemishes=(2, 3)),
        Part("bolts", "chrome", bolts, "ply", welded=True),
        Part("fittings", "aluminium", aluminium, "off", crease=35.0),
        Part("black", "black", black),
        Part("cables", "black", cables, crease=65.0, welded=True),
        Part("red", "red", red), Part("glass", "glass", glass, "stl"),
        Part("gaskets", "copper", both(eng.head_gasket())),
        Part("oil-lines", "copper", fit.oil_lines(pipe_pieces), crease=65.0),
        Part("dial", "white", Soup().add(fit.gauge_face(), at_gauge), flat=True),
        Part("ticks", "black", Soup().add(fit.gauge_dial(tick_count), at_gauge), flat=True),
        Part("needle", "red", Soup().add(fit.gauge_needle(), at_gauge), flat=True),
        Part("floor", "black-glass", quad((-2.4, y, 0.60), (2.4, y, 0.60), (2.4, y, -1.5), (-2.4, y, -1.5)), flat=True,
             instances=[{"rotateDegrees": [0.0, CAMERA_AZIMUTH_DEGREES, 0.0]}]),
        Part("plinth", "plinth", plinth,
             instances=[{"rotateDegrees": [0.0, CAMERA_AZIMUTH_DEGREES + 45.0, 0.0], "translate": [-0.08, 0.0, 0.0]}]),
    ]


README = """\
# engine

A V-twin motorcycle engine on a plinth of black glass, on a floor of black glass, in a dark studio between
soft boxes. 2048 x 2048, depth 8. 10448 vertices and 12510 triangles after preparation.

| mesh | material | contents |
|---|---|---|
| `case` | aluminium | crankcase, gearbox, sump, mounting lugs, lifter blocks |
| `cylinders`, `fins` | black enamel (paint, n = 1.6) | barrels, heads, their fins, ports |
| `covers`, `bolts` | chromium | cam cover, gearbox cover, all hexagons |
| `bright` | chromium | exhausts, velocity stacks, pushrod tubes, oil filter |
| `fittings` | aluminium | carburettors, cup of the gauge, bezel of the sight glass |
| `red` | red paint | rocker covers, ignition cover |
| `black`, `cables` | black paint | primary cover, starter, coil, plugs and their cables |
| `gaskets`, `oil-lines` | copper | head gaskets, two pipes |
| `glass` | glass (BK7), closed bodies | domed cover of the gauge, sight glass of the oil |
| `dial`, `ticks`, `needle` | bare white, black and red paint | face of the gauge |
| `plinth`, `floor` | black glass, n = 1.517 and 1.9 | |

**Visible effect.** In the two faces of the plinth (columns 35 to 77 %, rows 73 to 100 % of the image) and
their reflections in the floor: soft boxes reflected by floor and plinth lose about two thirds of their light
compared with the unpolarized mean of Fresnel's equations. Inside the velocity stacks, between the fins and
along the edges of the chrome tubes, where metal reflects metal, the highlights change.

**Cause.** Two reflections of unpolarized light give I = A1 A2 (1 + D1 D2 cos 2phi) L, with
A = (Rs + Rp)/2, D = (Rs - Rp)/(Rs + Rp) and phi the angle between the planes of incidence. An edge of
the plinth faces the camera: 54 to 57 degrees at its sides (D = .99), 59 degrees at the floor (D = .99), planes
of incidence nearly crossed (cos 2phi = -.63 on the left side, -.70 on the right). So 1 + D1 D2 cos 2phi is
.3 to .4. Chromium has D up to .67 at grazing angles, aluminium .18.

The generator models the engine from parameters and reaches the exact counts by the numbers of cover bolts,
ticks on the dial and pieces of the oil pipes. Most source meshes have separate vertices for each face; there
are a few duplicate faces and faces without area, and oil filter and coil are inside out.
"""


MATERIALS = {
    "case": {"type": "metal", "preset": "aluminium"},
    "cylinders": {"type": "paint", "eta": 1.6, "albedo": [0.022, 0.022, 0.024]},
    "chrome": {"type": "metal", "preset": "chromium"},
    "aluminium": {"type": "metal", "preset": "aluminium"},
    "copper": {"type": "metal", "preset": "copper"},
    "black": {"type": "paint", "eta": 1.5, "albedo": 0.02},
    "red": {"type": "paint", "eta": 1.5, "albedo": [0.42, 0.012, 0.016],
            "highlight": {"exponent": 400, "strength": 1}},
    "white": {"type": "lambert", "albedo": 0.8},
    "glass": {"type": "glass", "preset": "bk7"},
    "black-glass": {"type": "mirror-glass", "eta": 1.9},
    "plinth": {"type": "mirror-glass", "preset": "bk7"},
}
SETTINGS = {
    "name": "engine", "title": "A V-twin motorcycle engine", "origin": [0.0, 0.35, 0.0],
    "camera": CAMERA,
    "resolution": [2048, 2048], "depth": 8, "exposureEv": 0.0,
    "environment": {"image": "studio.hdr", "scale": 1.0, "ambientIrradiance": 0.8},
    "lights": [{"type": "point", "position": [-1.2, 2.2, 2.0], "intensity": [7.0, 6.8, 6.4]},
               {"type": "point", "position": [1.8, 1.6, -0.9], "intensity": [3.5, 3.7, 4.2]}],
}


def counts():
    """Returns the numbers of bolts, ticks and pipe pieces of `parts` with the expected vertices and triangles."""
    vertices, triangles = total(parts(20, 20, 20))
    spent = [20 * sum(kind) for kind in zip(BOLT, TICK, PIPE_PIECE)]
    return remainder(EXPECTED[0] - vertices + spent[0], EXPECTED[1] - triangles + spent[1])


def write(folder):
    pieces = parts(*counts())
    write_scene(folder, SETTINGS, MATERIALS, pieces, EXPECTED, sky(), README)
    return total(pieces)
