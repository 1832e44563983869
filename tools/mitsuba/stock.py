"""Mitsuba's own `stokes` and `path` integrators against the deterministic one, on the same Mitsuba scene and with
none of malus's rules.

`path` also lights diffuse surfaces from each other, from emitters and from infinity, so two parts are compared:
smooth surfaces under emitters and infinity with black diffuse surfaces, and diffuse surfaces seen directly under
point lights alone.

`path` follows one branch of glass at random and lights diffuse surfaces by one light at random. Its mean over N
samples through a pixel's centre must approach the deterministic value mu. The deterministic recursion knows all
branches and their probabilities, hence also the variance s^2 of one sample and a bound M on |sample - mu|.
Bernstein's inequality then holds without any assumption about the distribution:

    P(|mean - mu| >= t) <= 2 exp(-N t^2 / (2 (s^2 + M t / 3))),

so that t(p) = (M L/3 + sqrt((M L/3)^2 + 2 N s^2 L)) / N with L = ln(2/p). With Bonferroni's correction p is
SIGNIFICANCE divided by the number of pixels and components. (A z-test would take the mean of rare bright
branches for normally distributed; z is reported.) Source: Boucheron, Lugosi and Massart, Concentration
Inequalities, 2013, theorem 2.10. ROUNDING of the picture's mean S0 is allowed for single precision.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

import integrator
from export import mitsuba_scene

SIGNIFICANCE = 0.01
ROUNDING = 1e-5
RAYS_AT_ONCE = 2**21


def sampled(scene: mi.Scene, up, max_depth: int, samples: int) -> np.ndarray:
    """Mean Stokes vectors of `samples` runs of `path` through each pixel's centre, (pixels, 4), in the camera
    frame. max_depth: as `path` counts, one more than specular interactions."""
    path = mi.load_dict(path_integrator(max_depth))
    pixels = int(np.prod(scene.sensors()[0].film().size()))
    total, done = np.zeros((pixels, 4)), 0
    while done < samples:
        n = min(max(1, RAYS_AT_ONCE // pixels), samples - done)
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(done, pixels * n)
        ray = integrator.camera_rays(scene, dr.arange(mi.UInt32, pixels * n) // n)
        light = path.sample(scene, sampler, mi.RayDifferential3f(ray))[0]
        column = integrator.matrices(integrator.to_camera(ray.d, up) @ light, pixels * n)[:, :, 0]
        total += column.reshape(pixels, n, 4).sum(axis=1)
        done += n
    return total / samples


def stokes_picture(scene: mi.Scene, max_depth: int) -> np.ndarray:
    """What Mitsuba's `stokes` integrator renders of the pixels' centres, (pixels, 4): its own loop over pixels
    and its own camera frame. Without glass there is nothing random in it."""
    stokes = mi.load_dict({"type": "stokes", "path": path_integrator(max_depth)})
    names = stokes.aov_names()
    channels = np.array(mi.render(scene, integrator=stokes, spp=1), dtype=np.float64)
    first = channels.shape[2] - len(names)
    return channels.reshape(-1, channels.shape[2])[:, [first + names.index(f"S{k}.R") for k in range(4)]]


def path_integrator(max_depth: int) -> dict:
    return {"type": "path", "max_depth": max_depth, "rr_depth": 1000}


def bound(picture: integrator.Picture, samples: int) -> np.ndarray:
    """How far the mean of `samples` may be from the picture, (pixels, 4)."""
    level = np.log(2 * picture.stokes.size / SIGNIFICANCE)
    tail = (picture.largest + np.abs(picture.stokes)) * level / 3
    spread = np.maximum(picture.square - picture.stokes**2, 0)
    return (tail + np.sqrt(tail**2 + 2 * samples * spread * level)) / samples


def compare(unpacked, colour: int, width: int, height: int, samples: int) -> dict:
    """Both parts of one scene; `stokes` where it has no glass."""
    smooth, diffuse = unpacked.smooth_part(), unpacked.diffuse_part()
    result = {}
    scene = mitsuba_scene(smooth, colour, width, height)
    picture = integrator.render(scene, smooth.up(), smooth.depth)
    result["smooth"] = judge(picture, sampled(scene, smooth.up(), smooth.depth + 1, samples), samples)
    if all(m["type"] != "glass" for m in unpacked.materials.values()):
        difference = np.abs(stokes_picture(scene, smooth.depth + 1) - picture.stokes)
        result["stokesMax"] = float(difference.max() / max(picture.stokes[:, 0].mean(), 1e-30))
    if diffuse.json["lights"]:
        scene = mitsuba_scene(diffuse, colour, width, height)
        picture = integrator.render(scene, diffuse.up(), 0)
        result["diffuse"] = judge(picture, sampled(scene, diffuse.up(), 2, samples), samples)
    return result


def judge(picture: integrator.Picture, mean: np.ndarray, samples: int) -> dict:
    """What the comparison says; `violations` counts values outside the bound."""
    scale = max(picture.stokes[:, 0].mean(), 1e-30)
    difference = np.abs(mean - picture.stokes)
    spread = np.sqrt(np.maximum(picture.square - picture.stokes**2, 0) / samples)
    random = spread > ROUNDING * scale
    z = difference[random] / spread[random]
    return {"samples": samples, "values": int(mean.size), "random": int(random.sum()),
            "violations": int((difference > bound(picture, samples) + ROUNDING * scale).sum()),
            "rmsZ": float(np.sqrt((z**2).mean())) if z.size else None, "maxZ": float(z.max()) if z.size else None,
            "maxFixed": float(difference[~random].max() / scale) if (~random).any() else None}
