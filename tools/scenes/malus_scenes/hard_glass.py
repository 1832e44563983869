"""Hard scenes of clear glass: a slab at grazing angles, a ball, a Fresnel rhomb."""
import math

from .chain import Chain
from .hard_scene import BLACK_GLASS, BREWSTER, GLASS, camera, decimals, emitter, reflectances, write_hard
from .scene import Part
from .shapes import box, lathe, loft, quad


def ball(radius, bands=24, sides=48, low=-90.0):
    """Returns a ball about the origin, or its part above a latitude, closed by a flat face."""
    latitudes = [low + (90.0 - low) * i / bands for i in range(bands + 1)]
    profile = [(0.0 if abs(a) == 90.0 else radius * math.cos(math.radians(a)), radius * math.sin(math.radians(a)))
               for a in latitudes]
    return lathe(profile if low == -90.0 else [(0.0, profile[0][1]), *profile], sides, phase=0.5)


def floor(x, y, near, far, x0=None):
    """Returns a horizontal quad that faces up, from x0 (default -x) to x."""
    x0 = -x if x0 is None else x0
    return quad((x0, y, near), (x, y, near), (x, y, far), (x0, y, far))


def glass_slab(folder):
    distance = 0.5 * math.tan(math.radians(60.0))
    lines = []
    for degrees in (60.0, 70.0, 80.0):
        ts, tp = ((1 - r) / (1 + r) for r in reflectances(degrees))
        lines.append(f"{degrees:.0f} degrees: S0 = {decimals([(ts + tp) / 2])}, S1 = {decimals([(ts - tp) / 2])}")
    text = f"""\
A plate of glass, 1 cm thick, over a larger emitting panel; the camera looks down through the plate, at 60 degrees in
the centre and at 80 near the top.

Closed form, all orders of reflection inside: T_s, T_p = (1 - R)/(1 + R), S0 = (T_s + T_p)/2, S1 = (T_s - T_p)/2.
{lines[0]} (the centre);
{lines[1]};
{lines[2]} (20 degrees above the centre).
"""
    parts = [Part("plate", "glass", box((0.9, 0.01, 9.0), (0.0, -0.005, -3.5)), flat=True),
             Part("panel", "lamp", floor(5.0, -0.4, 1.5, -12.0), flat=True)]
    return write_hard(folder, "One slab of glass at 60 to 85 degrees: light reflected inside it is polarized.",
                      text, camera((0.0, 0.5, 0.0), (0.0, 0.0, -distance), 50.0), parts,
                      {"glass": GLASS, "lamp": emitter(1.0)}, 28)


def glass_sphere(folder):
    text = """\
A ball and a half ball of glass with interpolated normals in front of an orange and a blue panel under a dim sky; the
ball shows them upside down. At its rim the incidence is grazing: the interpolated normal faces away from the ray, and
the mirror direction may be below the face. In the half ball light is totally reflected at the flat side.

There is no closed form, but two bounds: no radiance is above 1, that of the brightest panel, or negative.
"""
    parts = [Part("ball", "glass", ball(0.62), "ply", welded=True, instances=[{"translate": [-0.65, 0.0, 0.0]}]),
             Part("half-ball", "glass", ball(0.62, bands=12, low=0.0), "ply", welded=True,
                  instances=[{"rotateDegrees": [35.0, 0.0, 120.0], "translate": [0.85, 0.0, 0.0]}]),
             Part("left", "orange", quad((-2.2, -0.9, -2.0), (-0.8, -0.9, -2.0), (-0.8, 0.7, -2.0), (-2.2, 0.7, -2.0)),
                  flat=True),
             Part("right", "blue", quad((-0.8, -0.9, -2.0), (2.2, -0.9, -2.0), (2.2, 0.7, -2.0), (-0.8, 0.7, -2.0)),
                  flat=True)]
    return write_hard(folder, "A ball of glass: grazing light at its rim, total reflection, interpolated normals.",
                      text, camera((0.0, 0.25, 4.2), (0.0, 0.0, 0.0), 26.0), parts,
                      {"glass": GLASS, "orange": emitter(1.0, 0.45, 0.08), "blue": emitter(0.08, 0.3, 1.0)}, 9,
                      resolution=(96, 64), environment={"radiance": [0.08, 0.09, 0.1]})


def fresnel_rhomb(folder):
    # tan(delta/2) = cos a sqrt(sin^2 a - 1/n^2)/sin^2 a for delta = 45 degrees: a quadratic in sin^2 a.
    n, tangent = 1.5, math.tan(math.radians(22.5))
    a, b, c = 1 + tangent ** 2, 1 + n ** -2, n ** -2
    sine_sq = (b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
    sine, cosine = math.sqrt(sine_sq), math.sqrt(1 - sine_sq)

    # A prism along x with vertical ends of this height and sides that rise away from the camera.
    height, width = 0.4, 0.5
    length = 2 * height * sine_sq / cosine
    rise, run = length * cosine, length * sine
    outline = [(0.0, 0.0), (-run, rise), (-run, rise + height), (0.0, height)]
    rhomb = loft([[(x, y - height / 2, z) for z, y in outline] for x in (width / 2, -width / 2)])

    chain = Chain((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    chain.go(3.0)
    inner = height / 2 / cosine  # from the near end to the first reflection, along the side
    chain.reflect(inner * sine, (0.0, sine, cosine), 0.1)
    chain.reflect(height * sine / cosine, (0.0, -sine, -cosine), 0.1)
    chain.go(inner * sine)
    mirror = chain.mirror(1.0, BREWSTER, 45.0, 0.3)
    panel = chain.panel(1.0, 0.5)
    s = [v * 0.96 ** 2 for v in chain.stokes([(1 / n, 0.0), (1 / n, 0.0), (n, 0.0)])]
    degrees = math.degrees(math.asin(sine))
    text = f"""\
The camera looks into the end of a glass rhomb at normal incidence; light is totally reflected in it twice at
{degrees:.4f} degrees, with a phase difference of 45 degrees each (n = 1.5). Behind its other end a glass mirror at
Brewster's angle, rotated by 45 degrees, reflects a panel: linear light enters the rhomb, circular light leaves it.

Closed form at the centre: (S0, S1, S2, S3) =
{decimals(s)}: 0.96^2 R_s/2 and |S3| = S0.
Depth 5: light that passes through the rhomb three times is left out.
"""
    parts = [Part("rhomb", "glass", rhomb, flat=True), Part("mirror", "black-glass", mirror, flat=True),
             Part("panel", "lamp", panel, flat=True)]
    return write_hard(folder, "A Fresnel rhomb: two total reflections make linear light circular.", text,
                      camera((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 12.0), parts,
                      {"glass": GLASS, "black-glass": BLACK_GLASS, "lamp": emitter(1.0)}, 5, exposureEv=3.0)
