"""Common parts of the hard scenes and the scenes of effects: small images with a pixel in their exact centre, and a
README whose first line is the title of the scene: the failure that it provokes or the effect that it shows."""
import math

from .scene import total, write_scene
from .vectors import rounded

BREWSTER = math.degrees(math.atan(1.5))
BLACK_GLASS = {"type": "mirror-glass", "eta": 1.5}
GLASS = {"type": "glass", "eta": 1.5}
GOLD = {"type": "metal", "preset": "gold"}
# (eta, k) of the preset at 630, 532 and 465 nm: bake/presets.yml.
GOLD_INDEX = ((0.1884, 3.4034), (0.5439, 2.2309), (1.3319, 1.8693))
SILVER = {"type": "metal", "preset": "silver"}
SILVER_INDEX = ((0.0569, 4.2543), (0.054, 3.429), (0.0469, 2.8028))


def reflectances(degrees, n=1.5):
    """R_s and R_p of an interface of relative index n. Source: Fresnel 1823."""
    c = math.cos(math.radians(degrees))
    t = math.sqrt(n * n - 1 + c * c)
    return ((c - t) / (c + t)) ** 2, ((n * n * c - t) / (n * n * c + t)) ** 2


def emitter(red, green=None, blue=None, **more):
    return {"type": "emitter", "radiance": [red, red if green is None else green, red if blue is None else blue],
            **more}


def camera(position, target, fov, **more):
    return {"position": rounded(position), "target": rounded(target), **more, "verticalFovDegrees": fov}


def write_hard(folder, title, text, view, parts, materials, depth, resolution=(65, 65), **settings):
    """Writes one hard scene; returns its numbers of vertices and triangles."""
    settings = {"name": folder.name, "title": title, "camera": view, "resolution": list(resolution), "depth": depth,
                **settings}
    write_scene(folder, settings, materials, parts, total(parts), readme=f"{title}\n\n{text}")
    return total(parts)


def decimals(values, digits=6):
    """Formats rounded numbers, so that the last bit of a library function changes no digit."""
    return " / ".join(f"{v:.{digits}f}" for v in rounded(values, digits))
