"""Scenes of effects of surfaces: textures, thin films, roughness."""
import cmath
import math

from .chain import Chain, tile
from .hard_glass import floor
from .hard_media import upright
from .hard_scene import BLACK_GLASS, BREWSTER, GLASS, GOLD, GOLD_INDEX, camera, decimals, emitter, reflectances, write_hard
from .texture_files import write_exr, write_png
from .scene import Part
from .shapes import box, quad
from .vectors import unit

SIZE = (401, 301)
WAVELENGTHS = (630.0, 532.0, 465.0)
BLACK, WHITE, RED = (0, 0, 0), (255, 255, 255), (255, 0, 0)
LETTER = ("#####", "#....", "#....", "####.", "#....", "#....", "#....")
# Rows of patches of the plate, from the top, in steps of 0.1 above 1.3.
PATCHES = ((0, 2, 7), (2, 7, 0), (7, 0, 2))


def letters(cell=32, dot=3):
    """Returns two by two cells, white and black, with a red F in the first."""
    left, top = (cell - dot * len(LETTER[0])) // 2, (cell - dot * len(LETTER)) // 2

    def colour(x, y):
        i, j = (x - left) // dot, (y - top) // dot
        if 0 <= i < len(LETTER[0]) and 0 <= j < len(LETTER) and LETTER[j][i] == "#":
            return RED
        return WHITE if x // cell == y // cell else BLACK
    return [[colour(x, y) for x in range(2 * cell)] for y in range(2 * cell)]


def textures(folder):
    indices = (1.3, 1.5, 2.0)
    straight = [((n - 1) / (n + 1)) ** 2 for n in indices]
    text = f"""\
A painted table with a texture, white and black with red letters, each 0.8 m wide, and at its far edge an upright plate
of black glass whose texture of indices has patches of 1.3, 1.5 and 2. The upper two rows of the plate reflect a panel
of radiance 4 behind the camera, the lowest row reflects the table.

Reflectances at normal incidence: {decimals(straight, 4)}. Their order is 1.3, 1.5, 2 in the top row, 1.5, 2, 1.3 below,
and 2, 1.3, 1.5 at the bottom. The letters are upright and read from left to right. Without textures the table is
uniformly white and the plate uniformly grey.
"""
    parts = [Part("table", "letters", floor(1.6, 0.0, 1.2, -1.2), flat=True),
             Part("plate", "patches", upright(-0.625, 0.625, 0.0, 1.25, -0.9), flat=True),
             Part("panel", "lamp", upright(-2.2, 2.2, -1.2, 1.9, 5.0).flipped(), flat=True)]
    materials = {
        "letters": {"type": "paint", "eta": 1.5, "albedo": 0.8, "albedoMap": {"image": "letters.png"},
                    "projection": {"origin": [-1.6, 0.0, -1.2], "u": [1.25, 0.0, 0.0], "v": [0.0, 0.0, 1.25]}},
        "patches": {**BLACK_GLASS, "etaMap": {"image": "patches.exr", "scale": 0.1, "offset": 1.3},
                    "projection": {"origin": [-0.625, 1.25, -0.9], "u": [0.8, 0.0, 0.0], "v": [0.0, -0.8, 0.0]}},
        "lamp": emitter(4.0)}
    counts = write_hard(folder, "An image gives a table its colours and a plate of black glass its index.", text,
                        camera((0.0, 1.2, 3.2), (0.0, 0.42, -0.3), 36.0), parts, materials, 4, resolution=SIZE,
                        environment={"radiance": [0.03, 0.03, 0.04]},
                        lights=[{"type": "point", "position": [-1.2, 2.6, 2.0], "intensity": [30.0, 30.0, 30.0]}])
    write_png(folder / "letters.png", letters())
    write_exr(folder / "patches.exr", [[step for step in row for _ in range(16)] for row in PATCHES for _ in range(16)])
    return counts


def coated(degrees, film, thickness, below):
    """Returns the mean reflectance of a film in air at the three wavelengths; below: complex indices of the substrate.
    Source: Born and Wolf, Principles of Optics, 7th edition, 1.6.4."""
    sine, means = math.sin(math.radians(degrees)), []
    for n, wavelength in zip(below, WAVELENGTHS):
        air, coat, ground = ((cmath.sqrt(i * i - sine * sine), i * i) for i in (1.0, film, n))
        delay = cmath.exp(-4j * math.pi * coat[0] * thickness / wavelength)
        mean = 0.0
        for weights in ((1.0, 1.0, 1.0), (air[1], coat[1], ground[1])):
            a, c, g = (layer[0] / weight for layer, weight in zip((air, coat, ground), weights))
            upper, lower = (a - c) / (a + c), (c - g) / (c + g)
            mean += 0.5 * abs((upper + lower * delay) / (1 + upper * lower * delay)) ** 2
        means.append(mean)
    return means


def coating(folder):
    glass, gold = [1.5] * 3, [complex(eta, -k) for eta, k in GOLD_INDEX]
    kinds = [("bare glass", 1.5, 0.0, glass), ("96.4 nm of 1.38 on glass", 1.38, 96.4, glass),
             ("400 nm of 2 on glass", 2.0, 400.0, glass), ("bare gold", 1.0, 0.0, gold),
             ("300 nm of 1.46 on gold", 1.46, 300.0, gold)]
    lines = [f"{name}: {decimals(coated(45.0, film, thickness, below), 4)}" for name, film, thickness, below in kinds]
    text = f"""\
Five adjacent strips reflect a ceiling, at angles of incidence from 20 degrees near the camera to 65 far away. From the
left: black glass without film, with a quarter wave of magnesium fluoride, and with a film of 400 nm; gold without film
and under 300 nm of silica. The radiance of the ceiling is 4 over the glass and 1 over the gold.

Reflectance at 45 degrees (the third strip: the centre), red / green / blue:
{lines[0]};
{lines[1]};
{lines[2]};
{lines[3]};
{lines[4]}.
Without interference the first three have the same grey and the last two the same gold. The colours of the films change
along the strips.
"""
    materials = {"glass": BLACK_GLASS, "quarter-wave": {**BLACK_GLASS, "coating": {"eta": 1.38, "thicknessNm": 96.4}},
                 "film": {**BLACK_GLASS, "coating": {"eta": 2.0, "thicknessNm": 400.0}},
                 "gold": GOLD, "gold-film": {**GOLD, "coating": {"eta": 1.46, "thicknessNm": 300.0}}}
    # Off the middle, so that the ray of the centre pixel does not hit the diagonal.
    parts = [Part(name, name, floor(0.25 * i - 0.39, 0.0, 0.0, -2.0, x0=0.25 * i - 0.6), flat=True)
             for i, name in enumerate(materials)]
    parts += [Part("ceiling-left", "bright", floor(0.36, 2.0, 1.0, -8.0, x0=-3.0).flipped(), flat=True),
              Part("ceiling-right", "dim", floor(3.0, 2.0, 1.0, -8.0, x0=0.36).flipped(), flat=True)]
    return write_hard(folder, "Thin films: their reflectance depends on the colour and on the angle.", text,
                      camera((0.0, 1.0, 0.3), (0.0, 0.0, -0.7), 58.0), parts,
                      {**materials, "bright": emitter(4.0), "dim": emitter(1.0)}, 4, resolution=SIZE)


def rough_reflection(folder):
    # On the right, a camera ray hits the table at Brewster's angle, then an upright glass, then a panel.
    position, x, reach = (0.0, 1.0, 1.8), 0.64, 1.5
    chain = Chain(position, (x, 0.0, position[2] - math.sqrt(reach * reach - x * x)))
    chain.mirror(math.sqrt(1.0 + reach * reach), BREWSTER, 0.0, 0.2)
    behind = chain.mirror(0.8, BREWSTER, 90.0, 0.4)
    # Tilted so that the camera and the glass tiles are behind the panel.
    panel = tile(chain.go(0.7), unit((-0.52, 0.44, -0.735)), unit((0.735, 0.0, -0.52)), 0.6)
    screen = quad((0.3, 0.0, 0.5), (0.3, 0.0, -0.6), (0.3, 0.9, -0.6), (0.3, 0.9, 0.5))
    parts = [Part("upright", "glass-0", behind, flat=True), Part("panel", "white", panel, flat=True),
             Part("screen", "black", screen, flat=True)]
    lost = 40.0 * reflectances(BREWSTER)[0] ** 2 / 4
    text = f"""\
Four gold tiles of roughness 0, 0.05, 0.15 and 0.3, from the left, in front of three bars of light. The smooth one
reflects them sharply; the others blur them, increasingly with the distance from the bar. On the right are two tiles of
black glass, smooth and of roughness 0.15. They reflect the upright glass behind them, whose plane of incidence is
crossed and which reflects a panel of radiance 40, both near Brewster's angle. A black screen blocks the light of the
panel from the gold.

If both angles are Brewster's, the smooth glass tile has 0, without polarization 40 R_s^2/4 = {decimals([lost])}. The
rough one is brighter, since its facets rotate the plane of incidence. Without roughness the four gold tiles are equal
and both glass tiles are black.
"""
    materials = {"white": emitter(40.0), "black": {"type": "lambert", "albedo": 0.0}}
    for i, roughness in enumerate((0.0, 0.05, 0.15, 0.3)):
        name = f"gold-{100 * roughness:.0f}"
        materials[name] = {**GOLD, "roughness": roughness}
        left = 0.3 * i - 0.99
        parts.append(Part(name, name, floor(left + 0.27, 0.0, 0.6, -0.1, x0=left), flat=True))
    for name, roughness, right in (("glass-0", 0.0, x - 0.01), ("glass-15", 0.15, x + 0.19)):
        materials[name] = {**BLACK_GLASS, "roughness": roughness}
        parts.append(Part(name, name, floor(right, 0.0, 0.7, 0.3, x0=right - 0.18), flat=True))
    bars = {"red": (1.0, 0.1, 0.05), "green": (0.1, 0.8, 0.1), "blue": (0.1, 0.2, 1.0)}
    for i, (name, colour) in enumerate(bars.items()):
        low = 0.12 + 0.25 * i
        materials[name] = emitter(*colour)
        parts.append(Part(name, name, upright(-1.8, 0.25, low, low + 0.1, -0.4), flat=True))
    return write_hard(folder, "Rough metal and rough black glass: mirror images blur and are less polarized.", text,
                      camera(position, (-0.02, 0.0, -0.4), 37.0), parts, materials, 4, resolution=(441, 241))


def thin_glass(folder):
    lines = []
    for degrees in (0.0, 60.0, 80.0):
        ts, tp = ((1 - r) / (1 + r) for r in reflectances(degrees))
        lines.append(f"{degrees:.0f} degrees: {decimals([(ts + tp) / 2])}")
    text = f"""\
Three windows in front of an emitting panel of radiance 1: on the left a pane of thin glass, in the middle a body of
glass 4 mm thick, on the right a tinted pane of thin glass with an internal transmittance of 0.9 / 0.6 / 0.3. The floor
is black glass and reflects the windows.

S0 of the panel through the left and the middle window, all internal reflections: (T_s + T_p)/2 with
T = (1 - R)/(1 + R) of one interface:
{chr(10).join(lines)}.
The left and the middle window are the same; the body takes an interaction per internal reflection, the pane one in all.
"""
    parts = [Part("pane", "pane", upright(-1.55, -0.55, 0.0, 1.4, 0.0), flat=True),
             Part("body", "glass", box((1.0, 1.4, 0.004), (0.0, 0.7, 0.0)), flat=True),
             Part("tinted", "tinted", upright(0.55, 1.55, 0.0, 1.4, 0.0), flat=True),
             Part("panel", "lamp", upright(-4.0, 4.0, -0.5, 4.0, -1.5), flat=True),
             Part("floor", "floor", floor(4.0, 0.0, 3.0, 0.2), flat=True)]
    materials = {"pane": {"type": "thin-glass", "eta": 1.5},
                 "tinted": {"type": "thin-glass", "eta": 1.5, "transmittance": [0.9, 0.6, 0.3]},
                 "glass": GLASS, "floor": BLACK_GLASS, "lamp": emitter(1.0)}
    return write_hard(folder, "Thin glass: a pane as one surface, next to a body of glass.", text,
                      camera((0.0, 1.1, 3.4), (0.0, 0.55, 0.0), 40.0), parts, materials, 12, resolution=SIZE,
                      environment={"radiance": [0.1, 0.1, 0.12]})
