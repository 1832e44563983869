"""Hard scenes of mirrors: one that bounces on and on, one that shows polarized paint."""
import math

from .chain import Chain
from .hard_scene import BLACK_GLASS, BREWSTER, SILVER, SILVER_INDEX, camera, decimals, emitter, reflectances, write_hard
from .scene import Part
from .shapes import quad
from .vectors import plus, rounded, times


def facing_mirrors(folder):
    # Between mirrors `gap` apart the ray climbs gap tan(30) a bounce; the mirrors end half a step after bounce 64.
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
Two silver mirrors 5 cm apart, the eye between them. The view climbs at 30 degrees; above the mirrors hang a warm
panel (seen after an even number of bounces) and a cool one (after an odd number). Depth 64: the lower half of
the picture would need more bounces and is black, the upper half shows bands of one number of bounces each.

Closed form at the centre, after 64 bounces at 30 degrees, red / green / blue: (R_s^64 + R_p^64)/2 times the warm
panel's 1 / 0.8 / 0.6 = {decimals([a[0] * w for a, w in zip(s, (1.0, 0.8, 0.6))])}, S1 = {decimals(
        [a[1] * w for a, w in zip(s, (1.0, 0.8, 0.6))])}.
Deeper than ray-tracing pipelines recurse: a Vulkan device that cannot do it must say so.
"""
    materials = {"silver": SILVER, "warm": emitter(1.0, 0.8, 0.6), "cool": emitter(0.3, 0.5, 1.0)}
    return write_hard(folder, "Two facing mirrors: 64 bounces, the depth at which paths end and rounding has grown.",
                      text, camera((0.0, 0.0, 0.0), (0.0, 0.5, -math.cos(slope)), 8.0), parts, materials, 64)


def paint_under_glass_in_brewster_mirror(folder):
    eye, target, albedo = (0.0, 0.0, 3.0), (0.0, 0.0, 0.0), 0.5
    chain, beside = Chain(eye, target), Chain(eye, target)
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
A glass mirror at Brewster's angle shows two sheets of paint (n = 1.5, albedo 1/2) under a point light, at 70 degrees
on the right and at 80 degrees on the left. Their light leaves polarized in the plane that the mirror puts out.

Closed form at the centre (70 degrees; the light of 4 W/sr stands 2 m above along the normal): below the interface
0.96 albedo/pi = {decimals([below])}, times T_s R_s/2: S0 = S1 = {decimals([below * ts * rs / 2])}.
Ignoring polarization gives (T_s + T_p)/2 R_s/2 = {decimals([below * (ts + tp) * rs / 4])}: too much by
{100 * ((ts + tp) / 2 / ts - 1):.0f} % of the truth at 70 degrees, by {100 * ((us + up) / 2 / us - 1):.0f} % at 80.
Depth 1: what the paint itself would mirror is left out.
"""
    paint = {"type": "paint", "eta": 1.5, "albedo": albedo}
    parts = [Part("mirror", "glass", mirror, flat=True), Part("seventy", "paint", seventy, flat=True),
             Part("eighty", "paint", eighty, flat=True)]
    return write_hard(folder, "Paint in a glass mirror at Brewster's angle: diffuse light is polarized when it leaves.",
                      text, camera(eye, target, 12.0), parts, {"glass": BLACK_GLASS, "paint": paint}, 1,
                      exposureEv=5.0, environment={"radiance": [0.005, 0.006, 0.01]},
                      lights=[{"type": "point", "position": rounded(light), "intensity": [4.0, 4.0, 4.0]}])
