"""Hard scenes of chains of mirrors in which polarization decides whether light arrives."""
from .chain import Chain
from .hard_scene import BLACK_GLASS, BREWSTER, GOLD, GOLD_INDEX, camera, decimals, emitter, write_hard
from .scene import Part
from .vectors import cross, plus, times, unit

CAMERA, TARGET = (0.0, 0.0, 3.0), (0.0, 0.0, 0.0)
DIM = {"radiance": [0.02, 0.02, 0.025]}


def brewster_pair(folder):
    chain, beside = Chain(CAMERA, TARGET), Chain(CAMERA, TARGET)
    first = chain.mirror(3.0, BREWSTER, 0.0, 0.6)
    beside.mirror(3.0, BREWSTER, 0.0, 0.6)
    crossed, parallel = chain.mirror(2.0, BREWSTER, 90.0, 0.2), beside.mirror(2.0, BREWSTER, 0.0, 0.12)
    parallel = parallel.moved(times(chain.x, -0.5))
    glass = (1.5, 0.0)
    (bright, *_), (dark, *_) = beside.stokes([glass, glass]), chain.stokes([glass, glass])
    text = f"""\
A glass mirror at Brewster's angle reflects a white sky and two more glass mirrors at Brewster's angle: the plane of
incidence of the middle one is crossed, that of the left one parallel.

Closed form, R_s = ((n^2 - 1)/(n^2 + 1))^2, n = 1.5: S0 = {decimals([dark])} in the crossed mirror, R_s^2/2 =
{decimals([bright])} in the parallel one, R_s/2 = 0.073964 in the first mirror alone. At the centre pixel S0
stays under 1e-6 of the parallel case as long as both mirrors are within 4e-4 rad of Brewster's angle. Without
polarization the crossed mirror has R_s^2/4.
"""
    parts = [Part("first", "glass", first, flat=True), Part("crossed", "glass", crossed, flat=True),
             Part("parallel", "glass", parallel, flat=True)]
    return write_hard(folder, "Two glass mirrors at Brewster's angle, crossed: only rounding remains.", text,
                      camera(CAMERA, TARGET, 16.0), parts, {"glass": BLACK_GLASS}, 4, exposureEv=3.0,
                      environment={"radiance": [1.0, 1.0, 1.0]})


def folded(kinds, incidences, twists):
    """Returns a chain of four mirrors and their parts; the panel behind it is smaller than the mirrors."""
    chain, parts = Chain(CAMERA, TARGET), []
    for i, (kind, incidence, twist) in enumerate(zip(kinds, incidences, twists)):
        reach = 1.4 if parts else 3.0
        parts.append(Part(f"mirror-{i + 1}", kind, chain.mirror(reach, incidence, twist, 0.3 + 0.06 * i), flat=True))
    parts.append(Part("panel", "lamp", chain.panel(1.4, 0.35), flat=True))
    return chain, parts


def gold_periscope(folder):
    chain, parts = folded(["gold"] * 4, [70.0] * 4, [0.0, 45.0, 45.0, -45.0])
    full = [chain.stokes([index] * 4) for index in GOLD_INDEX]
    linear = [chain.stokes([index] * 4, circular=False) for index in GOLD_INDEX]
    text = f"""\
The camera looks into a periscope of four gold mirrors at 70 degrees, with planes of incidence rotated by 45, 45 and -45
degrees from one to the next; behind the last one is a panel of radiance 1.

Closed form at the centre, red / green / blue:
S0 = {decimals([s[0] for s in full])}, S1 = {decimals([s[1] for s in full])},
S2 = {decimals([s[2] for s in full])}, S3 = {decimals([s[3] for s in full])}.
Without circular light S0 = {decimals([s[0] for s in linear])}: the relative error is a quarter in blue and
1/500 in red, so the colours are checked separately.
"""
    return write_hard(folder, "Four gold mirrors, twisted: light that turns circular and back decides the colour.",
                      text, camera(CAMERA, TARGET, 12.0), parts, {"gold": GOLD, "lamp": emitter(1.0)}, 6,
                      environment=DIM)


def glass_gold_gold_glass(folder):
    chain, parts = folded(["glass", "gold", "gold", "glass"], [BREWSTER, 70.0, 70.0, BREWSTER],
                          [0.0, 45.0, 90.0, -45.0])
    indices = [[(1.5, 0.0), gold, gold, (1.5, 0.0)] for gold in GOLD_INDEX]
    full = [chain.stokes(index)[0] for index in indices]
    linear = [chain.stokes(index, circular=False)[0] for index in indices]
    text = f"""\
The last mirror polarizes at Brewster's angle; two crossed gold mirrors at 70 degrees make the light circular and linear
again; and the first mirror, again at Brewster's angle, is crossed to it.

Closed form at the centre, red / green / blue: S0 = {decimals(full)}, extinct. Without circular light
S0 = {decimals(linear)}. The shortest chain in which S3 matters.
"""
    return write_hard(folder, "Two gold mirrors between crossed glass mirrors: without circular light the dark is lit.",
                      text, camera(CAMERA, TARGET, 12.0), parts,
                      {"glass": BLACK_GLASS, "gold": GOLD, "lamp": emitter(1.0)}, 6, exposureEv=6.0,
                      environment=DIM)


def mirror_loop(folder):
    chain, parts = Chain((0.0, 0.0, -3.0), (0.0, 0.0, 0.0)), []
    turns = [(1.0, 0.0, -1.0), (-1.0, 1.0, 0.0), (0.0, -1.0, 1.0)]
    for i, normal in enumerate(turns):
        part = Part(f"mirror-{i + 1}", "ideal", chain.reflect(1.2 if i else 3.0, unit(normal), 0.3 + 0.06 * i),
                    flat=True)
        parts.append(part)
    parts.append(Part("glass", "glass", chain.mirror(1.2, BREWSTER, 0.0, 0.55), flat=True))
    for name, at in (("white", (0.0, 0.0)), ("red", (-0.62, 0.0)), ("green", (0.0, 0.62))):
        parts.append(Part(name, name, chain.panel(1.2 if name == "white" else 0.0, 0.3).moved(
            plus(times(chain.s, at[0]), cross(chain.d, chain.s), at[1])), flat=True))
    s = chain.stokes([(0.0, 1000.0)] * 3 + [(1.5, 0.0)])
    text = f"""\
Three ideal mirrors (n = 0, k = 1000) reflect the ray from z to x, to y and back to z; then a glass mirror at Brewster's
angle reflects three panels, white, red and green. The ray has its first direction again, but the product of the
matrices (2 n n^T - 1) of the mirrors is not the identity: image and polarization are rotated by 90 degrees.

Closed form at the centre: (S0, S1, S2, S3) =
{decimals(s)}. Light that leaves the glass
horizontally polarized arrives vertically polarized: S1 = -S0, while frames that ignore the rotation give +S0.
"""
    materials = {"ideal": {"type": "metal", "eta": 0.0, "k": 1000.0}, "glass": BLACK_GLASS, "white": emitter(1.0),
                 "red": emitter(1.0, 0.1, 0.1), "green": emitter(0.1, 1.0, 0.1)}
    return write_hard(folder, "Three mirrors lead back to the first direction: the plane of polarization is rotated.",
                      text, camera((0.0, 0.0, -3.0), (0.0, 0.0, 0.0), 12.0), parts, materials, 6, exposureEv=2.0,
                      environment=DIM)
