"""Light of area lamps on diffuse surfaces: samples in Mitsuba, and the comparison of two noisy images.

Mitsuba samples positions on the lamps independently; malus samples their solid angle by stratified sets. Both make
several independent images, whose spread is the standard error of each value. The difference divided by the standard
error of the difference has about the distribution of Student's t; its degrees of freedom are at least those of one side
(B. L. Welch, "The generalization of `Student's' problem when several different population variances are involved",
Biometrika 34, 1947). `quantile` is its bound at the probability SIGNIFICANCE, divided by the number of values
(Bonferroni's correction). The mean over all pixels has a much smaller error: `bias` is its difference in standard
errors.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

import malus_rules

SIGNIFICANCE = 0.01
ROUNDING = 1e-5  # of the pixel's S0 and the mean S0


class Lamps:
    """Independent samples of the lamps of a scene."""

    def __init__(self, samples: int, seed: int):
        """samples: at each diffuse hit."""
        self.samples = samples
        self.sampler = mi.load_dict({"type": "independent"})
        self.seeds = iter(range(seed * 1000, seed * 1000 + 1000))

    @dr.syntax
    def light(self, scene: mi.Scene, si: mi.SurfaceInteraction3f, where: mi.Bool, n: int) -> mi.Float:
        """Returns the unpolarized radiance of diffuse surfaces by the lamps. n: number of lanes."""
        self.sampler.seed(next(self.seeds), n)
        sampler, bsdf = self.sampler, si.bsdf()
        total, k = mi.Float(0), mi.UInt32(0)
        while k < self.samples:
            sample, arriving = scene.sample_emitter_direction(si, sampler.next_2d(where), True, where)
            reflectance = bsdf.eval(mi.BSDFContext(), si, si.to_local(sample.d), where)
            lit = where & malus_rules.before_face(si, sample.d)
            total += dr.select(lit, (reflectance @ arriving)[0, 0].x, 0)
            k += 1
        return total / self.samples


def student_quantile(probability: float, freedom: int) -> float:
    """Returns t with P(|T| > t) = probability, by integration of the density of Student's t."""
    # With t = tan(x) sqrt(freedom) the density is that of cos(x)^(freedom - 1).
    x = np.linspace(0, np.pi / 2, 2_000_001)
    tail = np.cumsum((np.cos(x) ** (freedom - 1))[::-1])[::-1]
    return float(np.tan(x[np.searchsorted(-tail, -probability * tail[0])]) * np.sqrt(freedom))


def mean_and_error(images: list) -> tuple[np.ndarray, np.ndarray]:
    """Returns the mean of independent images and its standard error."""
    images = np.asarray(images)
    return images.mean(axis=0), images.std(axis=0, ddof=1) / np.sqrt(len(images))


def compare(ours: list, others: list) -> dict:
    """ours, others: images (pixels, colours, 4) of malus and Mitsuba, at least three of each. Returns statistics of the
    comparison; `violations` is the number of values outside the bound."""
    image, error = mean_and_error(ours)
    other, other_error = mean_and_error(others)
    scale = np.maximum(other[..., 0].mean(axis=0), 1e-30)[:, None]
    spread = np.sqrt(error**2 + other_error**2)
    rounding = ROUNDING * (other[..., :1] + scale)
    difference = image - other
    quantile = student_quantile(SIGNIFICANCE / image.size, min(len(ours), len(others)) - 1)
    random = spread > rounding
    z = np.abs(difference[random] / spread[random])
    of_mean = np.sqrt((spread**2).sum(axis=0)) / len(image) + ROUNDING * scale
    bias = difference.mean(axis=0)
    return {"values": int(image.size), "random": int(random.sum()),
            "violations": int((np.abs(difference) > quantile * spread + rounding).sum()),
            "rmsZ": float(np.sqrt((z**2).mean())), "maxZ": float(z.max()), "quantile": quantile,
            "bias": np.abs(bias / of_mean).max(axis=0).tolist(),
            "meanDifference": np.abs(bias / scale).max(axis=0).tolist(),
            "noise": (np.sqrt((spread**2).mean(axis=(0, 1))) / scale.mean()).tolist()}
