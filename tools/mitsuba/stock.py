"""Comparison of Mitsuba's `stokes` and `path` integrators with the deterministic one, on the same Mitsuba scene and
without the rules of malus.

`path` also lights diffuse surfaces by each other, by emitters and by the environment, so two parts are compared:
smooth surfaces under emitters and environment with black diffuse surfaces, and directly visible diffuse surfaces
under point lights only.

`path` follows one branch of glass at random and lights diffuse surfaces by one light at random. Its mean over N
samples through the centre of a pixel must approach the deterministic value mu. The deterministic recursion knows all
branches and their probabilities, and therefore the variance s^2 of one sample and a bound M on |sample - mu|.
Bernstein's inequality makes no assumption about the distribution:

    P(|mean - mu| >= t) <= 2 exp(-N t^2 / (2 (s^2 + M t / 3))),

so that t(p) = (M L/3 + sqrt((M L/3)^2 + 2 N s^2 L)) / N with L = ln(2/p). With Bonferroni's correction, p is
SIGNIFICANCE divided by the number of pixels and components. (A z-test would assume a normal distribution of the mean,
which rare bright branches violate; z is reported only.) Source: Boucheron, Lugosi and Massart, Concentration
Inequalities, 2013. ROUNDING times the mean S0 of the image is allowed for single precision.
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
    """Returns the mean Stokes vectors (pixels, 4) of `samples` runs of `path` through the centre of each pixel, in the
    camera frame. max_depth: as counted by `path`, one more than the specular interactions."""
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


def stokes_image(scene: mi.Scene, max_depth: int) -> np.ndarray:
    """Returns the image (pixels, 4) of Mitsuba's `stokes` integrator, which loops over the centres of the pixels and
    uses its camera frame. It is deterministic in scenes without glass."""
    stokes = mi.load_dict({"type": "stokes", "path": path_integrator(max_depth)})
    names = stokes.aov_names()
    channels = np.array(mi.render(scene, integrator=stokes, spp=1), dtype=np.float64)
    first = channels.shape[2] - len(names)
    return channels.reshape(-1, channels.shape[2])[:, [first + names.index(f"S{k}.R") for k in range(4)]]


def path_integrator(max_depth: int) -> dict:
    return {"type": "path", "max_depth": max_depth, "rr_depth": 1000}


def bound(image: integrator.Image, samples: int) -> np.ndarray:
    """Returns the largest difference (pixels, 4) allowed between the mean of `samples` and the image."""
    level = np.log(2 * image.stokes.size / SIGNIFICANCE)
    tail = (image.largest + np.abs(image.stokes)) * level / 3
    spread = np.maximum(image.square - image.stokes**2, 0)
    return (tail + np.sqrt(tail**2 + 2 * samples * spread * level)) / samples


def compare(unpacked, colour: int, width: int, height: int, samples: int) -> dict:
    """Compares both parts of one scene, and `stokes` if the scene has no glass."""
    smooth, diffuse = unpacked.smooth_part(), unpacked.diffuse_part()
    result = {}
    scene = mitsuba_scene(smooth, colour, width, height)
    image = integrator.render(scene, smooth.up(), smooth.depth)
    result["smooth"] = check_bounds(image, sampled(scene, smooth.up(), smooth.depth + 1, samples), samples)
    if all(m["type"] != "glass" for m in unpacked.materials.values()):
        difference = np.abs(stokes_image(scene, smooth.depth + 1) - image.stokes)
        result["stokesMax"] = float(difference.max() / max(image.stokes[:, 0].mean(), 1e-30))
    if diffuse.json["lights"]:
        scene = mitsuba_scene(diffuse, colour, width, height)
        image = integrator.render(scene, diffuse.up(), 0)
        result["diffuse"] = check_bounds(image, sampled(scene, diffuse.up(), 2, samples), samples)
    return result


def check_bounds(image: integrator.Image, mean: np.ndarray, samples: int) -> dict:
    """Returns statistics of the comparison; `violations` is the number of values outside the bound."""
    scale = max(image.stokes[:, 0].mean(), 1e-30)
    difference = np.abs(mean - image.stokes)
    spread = np.sqrt(np.maximum(image.square - image.stokes**2, 0) / samples)
    random = spread > ROUNDING * scale
    z = difference[random] / spread[random]
    return {"samples": samples, "values": int(mean.size), "random": int(random.sum()),
            "violations": int((difference > bound(image, samples) + ROUNDING * scale).sum()),
            "rmsZ": float(np.sqrt((z**2).mean())) if z.size else None, "maxZ": float(z.max()) if z.size else None,
            "maxFixed": float(difference[~random].max() / scale) if (~random).any() else None}
