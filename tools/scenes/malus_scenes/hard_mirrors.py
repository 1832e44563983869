"""Hard scenes of mirrors: many reflections, and polarized light from paint."""
import math

from .chain import Chain
from .hard_scene import BLACK_GLASS, BREWSTER, SILVER, SILVER_INDEX, camera, decimals, emitter, reflectances, write_hard
from .scene import Part
from .shapes import quad
from .vectors import plus, rounded, times


def facing_mirrors(folder):
    # The ray rises by gap tan(30) per reflection; the mirrors end half a step after reflection 64.
    gap, slope, bounces = 0.05, math.radians(30.0), 64
    top, z, half, end = bounces * gap * math.tan(slope), gap / 2, 0.4, 3.0
    parts = [
        Part("far", "silver", quad((-half, -0.1, -z), (half, -0.1, -z), (half, top, -z), (-half, top, -z)), flat=True),
        Part("near", "silver", quad((half, -0.1, z), (-half, -0.1, z), (-half, top, z), (half, top, z)), flat=True),
    ]
    y = round(top + 0.1, 3)
    for name, low, high in (("warm", -end, 0.0), ("cool", 0.0, end)):
        parts.append(Part(name, name, quad((-end, y, low), (end, y, low), (end, y, high), (-end, y, high)), flat=True))
    chain = Chain((0.0, 0.0, 0.0), (0.0, math.sin(slope), -math.cos(slope)))
    for i in range(bounces):
        chain.reflect(gap / math.cos(slope) * (0.5 if i == 0 else 1.0), (0.0, 0.0, 1.0 if i % 2 == 0 else -1.0), 1.0)
    s = [chain.stokes([index] * bounces) for index in SILVER_INDEX]
    text = f"""\
Two silver mirrors 5 cm apart with the camera between them. The view rises at 30 degrees; above the mirrors are a warm
panel (seen after an even number of reflections) and a cool one (after an odd number). Depth 64: the lower half of the
image needs more reflections and is black, the upper half has a band per number of reflections.

Closed form at the centre, after 64 reflections at 30 degrees, red / green / blue: (R_s^64 + R_p^64)/2 times 1 / 0.8 /
0.6 of the warm panel = {decimals([a[0] * w for a, w in zip(s, (1.0, 0.8, 0.6))])}, S1 = {decimals(
        [a[1] * w for a, w in zip(s, (1.0, 0.8, 0.6))])}.
A Vulkan device whose recursion limit is lower must report an error.
"""
    materials = {"silver": SILVER, "warm": emitter(1.0, 0.8, 0.6), "cool": emitter(0.3, 0.5, 1.0)}
    return write_hard(folder, "Two facing mirrors: 64 bounces, the depth at which paths end and rounding has grown.",
                      text, camera((0.0, 0.0, 0.0), (0.0, 0.5, -math.cos(slope)), 8.0), parts, materials, 64)


def paint_under_glass_in_brewster_mirror(folder):
    position, target, albedo = (0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 0.5
    chain, beside = Chain(position, target), Chain(position, target)
    mirror = chain.mirror(3.0, BREWSTER, 0.0, 0.5)
    beside.mirror(3.0, BREWSTER, 0.0, 0.5)
    seventy = chain.mirror(1.5, 70.0, 0.0, 0.35).moved(times(chain.x, 0.22))
    eighty = beside.mirror(1.5, 80.0, 0.0, 0.35).moved(times(chain.x, -0.55))
    light = plus(chain.point, chain.mirrors[1][1], 2.0)
    below = albedo / math.pi * (1 - 0.04)
    ts, tp = (1 - r for r in reflectances(70.0))
    us, up = (1 - r for r in reflectances(80.0))
    rs = (1.25 / 3.25) ** 2
    text = f"""\
A glass mirror at Brewster's angle reflects two painted tiles (n = 1.5, albedo 1/2) under a point light, at 70 degrees on
the right and at 80 degrees on the left. Their light is polarized in the plane that the mirror extinguishes.

Closed form at the centre (70 degrees; the light of 4 W/sr is 2 m away along the normal): below the interface
0.96 albedo/pi = {decimals([below])}, times T_s R_s/2: S0 = S1 = {decimals([below * ts * rs / 2])}.
Without polarization: (T_s + T_p)/2 R_s/2 = {decimals([below * (ts + tp) * rs / 4])}, a relative error of
{100 * ((ts + tp) / 2 / ts - 1):.0f} % at 70 degrees and of {100 * ((us + up) / 2 / us - 1):.0f} % at 80.
Depth 1: specular reflection by the paint is left out.
"""
    paint = {"type": "paint", "eta": 1.5, "albedo": albedo}
    parts = [Part("mirror", "glass", mirror, flat=True), Part("seventy", "paint", seventy, flat=True),
             Part("eighty", "paint", eighty, flat=True)]
    return write_hard(folder, "Paint in a glass mirror at Brewster's angle: diffuse light is polarized when it leaves.",
                      text, camera(position, target, 12.0), parts, {"glass": BLACK_GLASS, "paint": paint}, 1,
                      exposureEv=5.0, environment={"radiance": [0.005, 0.006, 0.01]},
                      lights=[{"type": "point", "position": rounded(light), "intensity": [4.0, 4.0, 4.0]}])
