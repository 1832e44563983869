"""Hard scenes of bodies that touch: rims shared by thin slabs, faces shared by whole bodies."""
import math

from .hard_glass import floor
from .hard_scene import GLASS, GOLD, camera, decimals, emitter, reflectances, write_hard
from .scene import Part
from .shapes import box

SKY = {"radiance": [0.1, 0.12, 0.15]}


def plate(x0, x1, z0, z1, low, high):
    return box((x1 - x0, high - low, z1 - z0), ((x0 + x1) / 2, (low + high) / 2, (z0 + z1) / 2))


def panels(y):
    """Returns a warm and a cool panel side by side, facing up."""
    return [Part("warm", "warm", floor(0.0, y, 1.0, -1.5, -1.6), flat=True),
            Part("cool", "cool", floor(1.6, y, 1.0, -1.5, 0.0), flat=True)]


LAMPS = {"warm": emitter(1.0, 0.7, 0.4), "cool": emitter(0.4, 0.7, 1.0)}


def thin_slab(folder):
    ts, tp = ((1 - r) / (1 + r) for r in reflectances(60.0))
    distance = math.tan(math.radians(60.0))
    through = (ts + tp) / 2
    centre = [through * lamp + (1 - through) * sky
              for lamp, sky in zip(LAMPS["warm"]["radiance"], SKY["radiance"])]
    text = f"""\
Three adjacent slabs of glass, 1e-5 m thick in a scene 3 m wide: their rims coincide, their faces are in two planes. A
block of gold touches their front rims, with its top in the plane of theirs. Below are two panels.

Closed form at the centre, 60 degrees, all orders: T = (T_s + T_p)/2 = {decimals([through])} times the warm panel's
1 / 0.7 / 0.4, and 1 - T times the sky's 0.1 / 0.12 / 0.15: S0 = {decimals(centre)}.
A ray that starts too far from a face leaves the slab, or never enters it.
"""
    thin = 0.00001
    edges = [-0.8, -0.4, 0.4, 0.7]
    slabs = [Part(f"slab-{i + 1}", "glass", plate(x0, x1, -0.8, 0.5, -thin, 0.0), flat=True)
             for i, (x0, x1) in enumerate(zip(edges, edges[1:]))]
    parts = [*slabs, Part("block", "gold", plate(-0.8, 0.7, 0.5, 0.8, -0.3, 0.0), flat=True), *panels(-0.5)]
    return write_hard(folder, "A slab of glass as thin as its offsets allow, rim to rim with others.", text,
                      camera((-0.15, 1.0, distance - 0.2), (-0.15, 0.0, -0.2), 50.0), parts,
                      {"glass": GLASS, "gold": GOLD, **LAMPS}, 14, environment=SKY)


def touching_bodies(folder):
    text = """\
A plate of glass on a block of gold, on the right, and on another plate of glass, on the left. Each pair shares a face
exactly, so that two interfaces coincide and a ray hits one of them.

There is no closed form: either of the two may be hit, and each choice is wrong somewhere. No radiance is negative,
above 1, which is that of the brightest panel, or NaN. In real scenes, model the shared face once, with outsideEta.
"""
    parts = [Part("left-top", "glass", plate(-0.9, -0.05, -0.6, 0.6, 0.2, 0.4), flat=True),
             Part("left-bottom", "glass", plate(-0.9, -0.05, -0.6, 0.6, 0.0, 0.2), flat=True),
             Part("right-top", "glass", plate(0.05, 0.9, -0.6, 0.6, 0.2, 0.4), flat=True),
             Part("right-block", "gold", plate(0.05, 0.9, -0.6, 0.6, 0.0, 0.2), flat=True), *panels(-0.4)]
    return write_hard(folder, "Bodies that share a face: two interfaces in one place.", text,
                      camera((0.3, 1.7, 2.6), (0.0, 0.2, 0.0), 34.0), parts,
                      {"glass": GLASS, "gold": GOLD, **LAMPS}, 10, environment=SKY)
