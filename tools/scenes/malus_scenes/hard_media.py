"""Hard scenes with the camera in glass or water, on a face and along an edge."""
from .hard_glass import ball
from .hard_scene import GLASS, GOLD, camera, decimals, emitter, write_hard
from .scene import Part
from .shapes import box, quad


def upright(x0, x1, y0, y1, z):
    """Returns a quad perpendicular to z that faces +z."""
    return quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))


def inside_glass(folder):
    text = """\
The camera is in a cube of glass, 2 m wide, under a white sky. An orange panel on the right and a blue one behind the
camera are in the glass as well (outsideEta 1.5).

Closed form at the centre, at normal incidence: 2.25 = n^2, the radiance of the sky inside the glass; every branch ends
in the sky. The orange panel has its radiance, 1 / 0.5 / 0.1. Outside the circle of 41.81 degrees light is totally
reflected; towards the corners it never leaves the glass, and the image is black.
"""
    glow = quad((0.75, -0.5, -0.2), (0.75, -0.5, 0.5), (0.75, 0.4, 0.5), (0.75, 0.4, -0.2)).flipped()
    parts = [Part("cube", "glass", box((2.0, 2.0, 2.0)), flat=True),
             Part("orange", "orange", glow, flat=True),
             Part("blue", "blue", upright(-0.9, -0.4, -0.3, 0.5, 0.6).flipped(), flat=True)]
    return write_hard(folder, "The camera inside glass: radiance changes by n^2, and light is caught.", text,
                      camera((0.0713, 0.0437, 0.3), (0.0713, 0.0437, -1.0), 110.0, mediumEta=1.5), parts,
                      {"glass": GLASS, "orange": emitter(1.0, 0.5, 0.1, outsideEta=1.5),
                       "blue": emitter(0.1, 0.4, 1.0, outsideEta=1.5)}, 10, exposureEv=-1.0,
                      environment={"radiance": [1.0, 1.0, 1.0]})


def into_the_edge(folder):
    text = """\
The camera is inside a cube of glass and looks into one of its vertical edges; behind it is an orange panel, in the glass
as well, under a white sky. The angle of incidence at both faces of the edge is 45 degrees, beyond the critical angle of
41.81: the panel is seen by two total reflections; above and below it light is reflected between this edge and the
opposite one and never leaves the glass.

Closed form in the middle column: 1 / 0.5 / 0.1 of the panel, unpolarized, in the middle, and 0 above and below, as
beside it. The rays hit the edges exactly: a ray that passes between two faces has 2.25 of the sky.
"""
    h, t = 0.3, 0.4
    panel = quad((t - h, -0.35, t + h), (t + h, -0.35, t - h), (t + h, 0.35, t - h), (t - h, 0.35, t + h)).flipped()
    parts = [Part("cube", "glass", box((2.0, 2.0, 2.0)), flat=True), Part("orange", "orange", panel, flat=True)]
    return write_hard(folder, "The view into an edge from inside glass: rays that meet the edge itself must not leak.",
                      text, camera((0.2, 0.0, 0.2), (-1.0, 0.0, -1.0), 40.0, mediumEta=1.5), parts,
                      {"glass": GLASS, "orange": emitter(1.0, 0.5, 0.1, outsideEta=1.5)}, 8, exposureEv=-1.0,
                      environment={"radiance": [1.0, 1.0, 1.0]})


def nested_media(folder):
    walls = [((1.5 - 1.33) / (1.5 + 1.33)) ** 2, 0.04]
    through = 1 / (1 + 2 * sum(r / (1 - r) for r in walls))
    text = f"""\
An empty bubble (n = 1, outsideEta 1.5) in a ball of glass (n = 1.5, outsideEta 1.33) in water, which contains the
camera (mediumEta 1.33) and the panels (outsideEta 1.33). Around the rim of the bubble light is totally reflected.

Closed form at the centre, four interfaces at normal incidence, all orders: 1/(1 + 2 r1/(1 - r1) + 2 r2/(1 - r2)), r1 =
(0.17/2.83)^2, r2 = 0.04: {decimals([through])} times 1, the radiance of the white panel.
The panels seen through the bubble are small and upright; with its sides exchanged they are upside down.
"""
    parts = [Part("ball", "glass", ball(0.8, bands=25), "ply", welded=True),
             Part("bubble", "bubble", ball(0.4, bands=25), "ply", welded=True),
             Part("white", "white", upright(-0.6, 0.6, -2.2, 2.2, -2.0), flat=True),
             Part("red", "red", upright(-3.0, -0.6, -2.2, 2.2, -2.0), flat=True),
             Part("green", "green", upright(0.6, 3.0, -2.2, 2.2, -2.0), flat=True)]
    return write_hard(folder, "A bubble in glass in water: three media, one on either side of each interface.", text,
                      camera((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 40.0, mediumEta=1.33), parts,
                      {"glass": {**GLASS, "outsideEta": 1.33},
                       "bubble": {"type": "glass", "eta": 1.0, "outsideEta": 1.5},
                       "white": emitter(1.0, outsideEta=1.33), "red": emitter(0.8, 0.15, 0.1, outsideEta=1.33),
                       "green": emitter(0.1, 0.6, 0.2, outsideEta=1.33)}, 10)


def camera_on_surface(folder):
    text = f"""\
The camera is in glass (mediumEta 1.5), exactly in the plane of a face of a cube (z = 0, the smallest z of the scene and
of its grid), and looks through the cube at panels behind the opposite face.

Closed form at the centre, at normal incidence: 2.25 (1 - R)/(1 - R^2) = 2.25/1.04 =
{decimals([2.25 / 1.04])} times 1, the radiance of the white panel. If the ray hit the face at the camera first, as from
outside, it would be 2.25 (1 - R)/(1 + R) = {decimals([2.25 * 0.96 / 1.04])} through a narrower view.
"""
    panel = [(-2.0, -0.3, "red"), (-0.3, 0.3, "white"), (0.3, 2.0, "green")]
    parts = [Part("cube", "glass", box((1.0, 1.0, 1.0), (0.0, 0.0, 0.5)), flat=True)]
    parts += [Part(name, name, upright(x0, x1, -1.2, 1.2, 1.6).flipped(), flat=True) for x0, x1, name in panel]
    return write_hard(folder, "The camera exactly on a face of glass: the ray starts at distance 0 from it.", text,
                      camera((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 70.0, mediumEta=1.5), parts,
                      {"glass": GLASS, "white": emitter(1.0), "red": emitter(0.8, 0.15, 0.1),
                       "green": emitter(0.1, 0.6, 0.2)}, 8, exposureEv=-1.0, origin=[0.0, 0.0, 0.0])


def camera_along_edge(folder):
    text = """\
The camera looks exactly along an edge of a cube of glass, in the planes of two of its faces (x = 0 and y = 0, the
smallest x and y of the scene and of its grid), through a corner of the cube. A gold cube beside it has a side in the
plane x = 0, too. Behind the cubes is a panel of radiance 1 that ends in the same planes.

There is no closed form in the middle row and column, which are in the planes of the faces: a pixel may see past a face
or through it, and equals its neighbour on one side. The pixels left of the edge and below it see the sky only: exactly
0.25 / 0.3 / 0.4.
"""
    parts = [Part("cube", "glass", box((0.6, 0.6, 0.6), (0.3, 0.3, 0.0)), flat=True),
             Part("block", "gold", box((0.4, 0.4, 0.4), (0.2, 0.9, 0.2)), flat=True),
             Part("panel", "lamp", upright(0.0, 0.45, 0.0, 1.0, -1.5), flat=True)]
    return write_hard(folder, "The view along an edge of a cube, in the plane of its faces.", text,
                      camera((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 40.0), parts,
                      {"glass": GLASS, "gold": GOLD, "lamp": emitter(1.0)}, 8, origin=[0.0, 0.0, 0.0],
                      environment={"radiance": [0.25, 0.3, 0.4]})
