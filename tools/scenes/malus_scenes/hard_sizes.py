"""One room at the origin, far from the origin, and tiny. The images are the same."""
from .chain import tile
from .hard_glass import ball, floor
from .hard_scene import BLACK_GLASS, GLASS, GOLD, emitter, write_hard
from .scene import Part
from .shapes import box, quad
from .vectors import plus, times, unit

FAR = (100000.0, 20000.0, -100000.0)
CAMERA, TARGET, LIGHT, WATTS = (0.3, 1.0, 3.4), (0.0, 0.45, 0.0), (0.9, 2.2, 1.4), (20.0, 19.2, 17.6)

LAYOUT = """\
A floor and a wall of paint, a ball of glass, a block of gold, a leaning mirror of black glass and a lamp.
"""


def place(point, scale, offset):
    """Returns a point of the room in an instance of it, with twelve digits."""
    return [float(f"{v:.12g}") for v in plus(offset, point, scale)]


def room_at(folder, title, text, scale=1.0, offset=(0.0, 0.0, 0.0)):
    """Writes the room as an instance: scaled, then moved. Intensities are scaled by the square of the scale, which keeps
    radiances."""
    transform = {"scale": scale} if scale != 1.0 else {}
    transform |= {"translate": list(offset)} if any(offset) else {}
    wall = [(-1.6, 0.0), (1.6, 0.0), (1.6, 1.8), (-1.6, 1.8)]
    meshes = [("floor", "grey", floor(1.6, 0.0, 1.6, -1.2)),
              ("wall", "red", quad(*((x, y, -1.2) for x, y in wall))),
              ("ball", "glass", ball(0.36, bands=12, sides=24).moved((-0.45, 0.40, 0.5))),
              ("block", "gold", box((0.5, 0.7, 0.4), (0.55, 0.36, 0.0))),
              ("mirror", "black-glass", tile((-0.5, 0.75, -0.6), unit((0.35, 0.3, 1.0)),
                                             unit((1.0, 0.0, -0.35)), 0.5, 0.6)),
              ("lamp", "lamp", quad((1.3, 0.5, -0.6), (1.3, 0.5, 0.6), (1.3, 1.4, 0.6), (1.3, 1.4, -0.6)))]
    parts = [Part(name, material, soup, flat=name != "ball", welded=True, instances=[transform] if transform else None)
             for name, material, soup in meshes]
    materials = {"grey": {"type": "paint", "eta": 1.5, "albedo": 0.4},
                 "red": {"type": "paint", "eta": 1.5, "albedo": [0.5, 0.12, 0.1]},
                 "glass": GLASS, "gold": GOLD, "black-glass": BLACK_GLASS, "lamp": emitter(2.0, 1.9, 1.6)}
    view = {"position": place(CAMERA, scale, offset), "target": place(TARGET, scale, offset),
            "verticalFovDegrees": 34.0}
    light = {"type": "point", "position": place(LIGHT, scale, offset),
             "intensity": [float(f"{v:.12g}") for v in times(WATTS, scale ** 2)]}
    return write_hard(folder, title, LAYOUT + text, view, parts, materials, 8, resolution=(96, 96), exposureEv=0.5,
                      environment={"radiance": [0.1, 0.12, 0.15]}, lights=[light])


def room(folder):
    return room_at(folder, "A room at its own size, the reference of the scenes far-away and tiny.", """\
The reference: `far-away` and `tiny` are the same meshes, moved and scaled.
""")


def far_away(folder):
    return room_at(folder, "A room 143 km from the origin, where floats are rounded by up to 8 mm.", """\
The scene `room`, moved by (100000, 20000, -100000) m. The origin of the pack is the default, the middle of the meshes.
The image equals that of `room` except for single pixels at edges.
""", offset=FAR)


def tiny(folder):
    return room_at(folder, "A room as small as a grain of dust: fixed offsets would be larger than it.", """\
The scene `room`, scaled by 1e-5: 32 micrometres wide. The intensity of the point light is scaled by 1e-10, so that
all radiances, and the image, equal those of `room` except for single pixels at edges.
""", scale=1e-5)
