"""Scenes of effects of sources and media: absorption, polarized sky, displays, polarizers."""
import math

from .hard_glass import floor
from .hard_media import upright
from .hard_scene import BLACK_GLASS, BREWSTER, GLASS, camera, decimals, emitter, reflectances, write_hard
from .mesh import Soup
from .scene import Part
from .shapes import box, loft
from .vectors import rounded

SIZE = (401, 301)
BLUE, AMBER = (25.0, 8.0, 3.0), (2.0, 12.0, 45.0)


def staircase(x0, width, depths, low, high):
    """Returns a closed body of adjacent columns of increasing depth whose front is in z = 0."""
    soup = Soup()
    before = 0.0
    for i, depth in enumerate(depths):
        left, right = x0 + i * width, x0 + (i + 1) * width
        cap = [(right, 0.0), (left, 0.0), (left, -before), (left, -depth), (right, -depth)]
        soup.face([(x, low, z) for x, z in cap])
        soup.face([(x, high, z) for x, z in reversed(cap)])
        soup.face([(left, low, 0.0), (right, low, 0.0), (right, high, 0.0), (left, high, 0.0)])
        soup.face([(right, low, -depth), (left, low, -depth), (left, high, -depth), (right, high, -depth)])
        soup.face([(left, low, -depth), (left, low, -before), (left, high, -before), (left, high, -depth)])
        before = depth
    soup.face([(right, low, 0.0), (right, low, -depth), (right, high, -depth), (right, high, 0.0)])
    return soup


def plate(absorption, thickness, n=1.5):
    """Returns reflectance and transmittance of a plate at normal incidence, all orders."""
    r, a = ((n - 1) / (n + 1)) ** 2, math.exp(-absorption * thickness)
    return r + r * (1 - r) ** 2 * a * a / (1 - r * r * a * a), (1 - r) ** 2 * a / (1 - r * r * a * a)


def absorption(folder):
    depths = [0.02, 0.04, 0.06, 0.08, 0.1]
    lines = [f"{100 * d:2.0f} cm: {decimals([plate(a, d)[1] for a in BLUE], 4)}" for d in depths]
    walls = [plate(a, 0.02) for a in BLUE]
    hollow = [t * t / (1 - r * r) for r, t in walls]
    text = f"""\
Bodies of absorbing glass in front of a panel of radiance 1: above, a staircase of five steps, 2 to 10 cm thick; below,
a wedge of amber glass, thin on the left, and a block of the glass of the staircase, 10 cm thick, with an empty box
inside that leaves two walls of 2 cm.

Radiance at normal incidence, all orders of reflection, red / green / blue:
{lines[0]};
{lines[1]};
{lines[2]};
{lines[3]};
{lines[4]};
middle of the block: {decimals(hollow, 4)}, nearly that of the second step; its rim equals the fifth step.
Without absorption all bodies are clear; without `outsideAbsorption` of the box the middle of the block is as pale as
the first step.
"""
    prism = [(-0.3, -0.002), (-0.3, 0.0), (-0.02, 0.0), (-0.02, -0.062)]
    wedge = loft([[(x, y, z) for x, z in prism] for y in (-0.24, -0.06)])
    parts = [Part("staircase", "blue-glass", staircase(-0.3, 0.12, depths, 0.04, 0.24), flat=True),
             Part("wedge", "amber-glass", wedge, flat=True),
             Part("block", "blue-glass", box((0.26, 0.18, 0.1), (0.17, -0.15, -0.05)), flat=True),
             Part("hollow", "hollow", box((0.14, 0.1, 0.06), (0.17, -0.15, -0.05)), flat=True),
             Part("panel", "lamp", upright(-1.0, 1.0, -0.8, 0.8, -0.5), flat=True)]
    materials = {"blue-glass": {**GLASS, "absorption": list(BLUE)}, "amber-glass": {**GLASS, "absorption": list(AMBER)},
                 "hollow": {"type": "glass", "eta": 1.0, "outsideEta": 1.5, "outsideAbsorption": list(BLUE)},
                 "lamp": emitter(1.0)}
    return write_hard(folder, "Coloured glass: the deeper, the darker, by Lambert's law.", text,
                      camera((0.0, 0.0, 4.0), (0.0, 0.0, 0.0), 8.0), parts, materials, 8, resolution=SIZE)


def polarized_sky(folder):
    angle = math.degrees(math.atan(1.33))
    rs = reflectances(angle, 1.33)[0]
    dark, grey = decimals([rs * (1 - 0.8) / 2]), decimals([rs / 2])
    text = f"""\
Water and a pane of glass in front of a dark wall under a clear sky. The sun is low on the right, outside the image, at
right angles to the part of the sky that both reflect, whose light is therefore polarized nearly vertically.

The water has a dark spot at Brewster's angle, {angle:.2f} degrees: R_s (1 - 0.8)/2 = {dark} of the
radiance of the sky, a fifth of R_s/2 = {grey} of an unpolarized sky. Towards the sun the water is brighter.
The plane of incidence of the pane is crossed, so that it reflects this sky more than an unpolarized one.
"""
    parts = [Part("water", "water", floor(400.0, 0.0, 20.0, -400.0), flat=True),
             Part("wall", "black", box((0.2, 3.4, 5.4), (1.64, 1.7, -4.5)), flat=True),
             Part("pane", "glass", box((0.01, 3.2, 5.0), (1.5, 1.65, -4.5)), flat=True)]
    materials = {"water": {"type": "mirror-glass", "eta": 1.33}, "black": {"type": "lambert", "albedo": 0.02},
                 "glass": GLASS}
    sky = {"sun": [0.9, 0.06, -0.42], "maxDegree": 0.8}
    return write_hard(folder, "Clear sky in water: light polarized by the air vanishes at Brewster's angle.", text,
                      camera((0.0, 1.5, 0.0), (0.0, 0.0, -4.5), 70.0), parts, materials, 6, resolution=SIZE,
                      environment={"radiance": [0.6, 0.85, 1.2], "sky": sky})


def display(folder):
    rs = reflectances(BREWSTER)[0]
    text = f"""\
Two displays of radiance 1 at the end of a black glass table. The light of the left one is polarized horizontally, that
of the right one vertically; the table reflects both near Brewster's angle.

At that angle the reflection of the left display is R_s = {decimals([rs], 4)}, that of the right one 0. With
unpolarized light both are R_s/2 = {decimals([rs / 2], 4)}. Seen directly, the displays are equal.
"""
    parts = [Part("table", "glass", floor(1.2, 0.0, 0.9, -0.8), flat=True)]
    materials = {"glass": BLACK_GLASS}
    for name, axis, x in (("level", [1.0, 0.0, 0.0], -0.3), ("upright", [0.0, 1.0, 0.0], 0.3)):
        materials[name] = emitter(1.0, polarization={"axis": axis, "degree": 1.0})
        parts.append(Part(name, name, upright(x - 0.25, x + 0.25, 0.1, 0.5, -0.8), flat=True))
    return write_hard(folder, "Displays are polarized: a glass table shows one and not the other.", text,
                      camera((0.0, 1.0, 1.15), (0.0, 0.06, -0.6), 38.0), parts, materials, 4, resolution=SIZE,
                      environment={"radiance": [0.004, 0.004, 0.005]})


def axis(degrees):
    """Returns a direction in the plane of the polarizing elements."""
    return rounded((math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0.0))


def polarizing_sheets(folder):
    full = rounded([360.0 * 532.0 / wavelength for wavelength in (630.0, 532.0, 465.0)], 3)
    purple = [0.5 * math.sin(math.radians(delay / 2)) ** 2 for delay in full]
    text = f"""\
Eight pairs of ideal polarizers in front of a panel of radiance 1; the back one is always horizontal. Upper row, from
the left: the front one is horizontal, at 45 degrees, vertical, and vertical with a third at 45 degrees between. Lower
row: the front one is vertical; between the two is a wave plate at 45 degrees of a quarter wave, of a half wave, and of
a full wave at 532 nm (another fraction in other colours), and a half wave with a horizontal axis. The elements between
are smaller than the pair.

Radiance of one polarizer: 0.5. Upper row: 0.5, 0.25, 0, 0.125 with 0 around it. Lower row: 0.25, 0.5,
{decimals(purple)}, 0, with 0 around. Without polarization: 0.25 for every pair, 0.125 with a third.
"""
    materials = {"lamp": emitter(1.0),
                 "level": {"type": "polarizer", "axis": axis(0.0)},
                 "diagonal": {"type": "polarizer", "axis": axis(45.0)},
                 "upright": {"type": "polarizer", "axis": axis(90.0)},
                 "quarter": {"type": "wave-plate", "axis": axis(45.0)},
                 "half": {"type": "wave-plate", "axis": axis(45.0), "retardanceDegrees": 180.0},
                 "full": {"type": "wave-plate", "axis": axis(45.0), "retardanceDegrees": full},
                 "half-level": {"type": "wave-plate", "axis": axis(0.0), "retardanceDegrees": 180.0}}
    pairs = [(None, "level"), (None, "diagonal"), (None, "upright"), ("diagonal", "upright"),
             ("quarter", "upright"), ("half", "upright"), ("full", "upright"), ("half-level", "upright")]
    places = {}
    for i, (between, front) in enumerate(pairs):
        x, y = 0.5 * (i % 4) - 0.75, 0.25 - 0.5 * (i // 4)
        for layer, material, shift, z in (("behind", "level", -0.03, 0.0), ("between", between, 0.0, 0.04),
                                          ("front", front, 0.03, 0.08)):
            if material:
                place = {"translate": rounded((x + shift, y + shift, z))}
                places.setdefault((layer, material), []).append(place)
    parts = [Part("panel", "lamp", upright(-1.2, 1.2, -0.8, 0.8, -0.4), flat=True)]
    for (layer, material), instances in places.items():
        half = 0.08 if layer == "between" else 0.15
        parts.append(Part(f"{layer}-{material}", material, upright(-half, half, -half, half, 0.0), flat=True,
                          instances=instances))
    return write_hard(folder, "Polarizers and wave plates, two or three in a row.", text,
                      camera((0.0, 0.0, 8.0), (0.0, 0.0, 0.0), 7.4), parts, materials, 4, resolution=(401, 201))
