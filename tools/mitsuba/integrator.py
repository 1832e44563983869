"""A deterministic integrator in Mitsuba: one ray through each pixel's centre, both branches of glass.

Ray intersection, reflected and refracted directions, Mueller matrices and the changes of their frames are those of
Mitsuba. This file chooses the rays (shaders/optics/SHADING.md): at most `depth` specular interactions, then black; at
a diffuse surface the path ends with the point lights, each with a shadow ray that every surface blocks; a miss takes
the environment.

A ray that is followed from the camera in direction d carries the Mueller matrix that takes light along -d, in
Mitsuba's frame stokes_basis(-d), to the pixel, in the camera frame x = cross(d, up) of its primary ray. Products and
sums are in double precision; results of Mitsuba are in single precision.
"""
from __future__ import annotations

import dataclasses

import drjit as dr
import mitsuba as mi
import numpy as np

import lamps
import malus_rules

REFLECTION, TRANSMISSION = mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.DeltaTransmission


@dataclasses.dataclass
class Rays:
    """Rays of one generation, n of them."""
    origin: np.ndarray       # (n, 3)
    direction: np.ndarray    # (n, 3)
    pixel: np.ndarray        # (n,) index into the image
    weight: np.ndarray       # (n, 4, 4) Mueller matrix to the pixel
    index: np.ndarray        # (n,) refractive index of the medium
    probability: np.ndarray  # (n,) of these branches, if each is chosen at random

    @staticmethod
    def joined(parts: list[Rays]) -> Rays:
        return Rays(*(np.concatenate([getattr(p, f.name) for p in parts]) for f in dataclasses.fields(Rays)))


class Image:
    """Stokes vectors of n pixels, and the moments of the estimator that chooses one branch of glass at random,
    reflection with the probability of its unpolarized reflectance, as Mitsuba's `path` and `dielectric` do."""

    def __init__(self, n: int):
        self.stokes = np.zeros((n, 4))
        self.square = np.zeros((n, 4))   # mean square of that estimator
        self.largest = np.zeros((n, 4))  # its largest absolute value

    def add(self, rays: Rays, light: np.ndarray, choice: float = 1.0) -> None:
        """light: (n,) unpolarized radiance arriving along the rays. choice: probability of this source."""
        at = np.flatnonzero(light)
        value = rays.weight[at, :, 0] * light[at, None]
        pixel, p = rays.pixel[at], rays.probability[at, None] * choice
        np.add.at(self.stokes, pixel, value)
        np.add.at(self.square, pixel, value**2 / p)
        np.maximum.at(self.largest, pixel, np.abs(value) / p)


def render(scene: mi.Scene, up, depth: int, rules: malus_rules.Rules | None = None, pixels=None, shift=(0.0, 0.0),
           lamps: lamps.Lamps | None = None) -> Image:
    """Returns the image of `pixels` (default: all, row by row from the top), their centres moved by `shift` pixels.
    up: the y axis of the image. rules: those of malus; None: only those of Mitsuba. lamps: samples of the area lights
    that light diffuse surfaces; None: they do not."""
    rays = primary_rays(scene, up, pixels, shift)
    image = Image(len(rays.pixel))
    rays.index *= rules.camera_index if rules else 1
    for left in range(depth, -1, -1):
        rays = follow(scene, rays, left, image, rules, lamps)
    return image


def primary_rays(scene: mi.Scene, up, pixels=None, shift=(0.0, 0.0)) -> Rays:
    if pixels is None:
        pixels = np.arange(np.prod(scene.sensors()[0].film().size()))
    ray, n = camera_rays(scene, mi.UInt32(pixels), shift), len(pixels)
    return Rays(rows(ray.o, n), rows(ray.d, n), np.arange(n), matrices(to_camera(ray.d, up), n), np.ones(n), np.ones(n))


def camera_rays(scene: mi.Scene, pixel: mi.UInt32, shift=(0.0, 0.0)) -> mi.Ray3f:
    sensor = scene.sensors()[0]
    width, height = (int(x) for x in sensor.film().size())
    at = mi.Point2f((pixel % width + (0.5 + shift[0])) / width, (pixel // width + (0.5 + shift[1])) / height)
    ray = mi.Ray3f(sensor.sample_ray_differential(0.0, 0.5, at, mi.Point2f(0.5))[0])
    ray.o = sensor.world_transform().translation()  # not from the near clipping plane
    return ray


def to_camera(d: mi.Vector3f, up) -> mi.Spectrum:
    """Returns the rotation from Mitsuba's frame of light along -d to the camera frame x = cross(d, up)."""
    target = dr.normalize(dr.cross(d, mi.Vector3f(*up)))
    return mi.mueller.rotate_stokes_basis(-d, mi.mueller.stokes_basis(-d), target)


def matrices(mueller: mi.Spectrum, n: int) -> np.ndarray:
    """Converts a Mueller matrix of n lanes to (n, 4, 4)."""
    m = np.array(mueller, dtype=np.float64).reshape(4, 4, -1)
    return np.broadcast_to(np.moveaxis(m, 2, 0), (n, 4, 4))


def rows(vector, n: int) -> np.ndarray:
    return np.broadcast_to(np.array(vector, dtype=np.float64).T, (n, 3))


def lanes(value, n: int) -> np.ndarray:
    return np.broadcast_to(np.array(value), (n,))


def follow(scene: mi.Scene, rays: Rays, left: int, image: Image, rules: malus_rules.Rules | None,
           lamps: lamps.Lamps | None) -> Rays:
    """Adds the light of the sources along the rays to the image and returns the next generation.
    left: number of specular interactions that the paths may still have."""
    n = len(rays.pixel)
    if n == 0:
        return rays
    ray = mi.Ray3f(mi.Point3f(rays.origin.T), mi.Vector3f(rays.direction.T))
    si = scene.ray_intersect(ray)
    dr.eval(si)
    hit, bsdf = si.is_valid(), si.bsdf()
    smooth, glass = (hit & mi.has_flag(bsdf.flags(), flag) for flag in (REFLECTION, TRANSMISSION))

    # Add emitters, the environment, and point lights that light a diffuse surface.
    sources = [si.emitter(scene).eval(si)[0, 0].x]
    if rules:
        malus_rules.orient_normal(si, ray, bsdf, hit, smooth, glass)
    diffuse = hit & mi.has_flag(bsdf.flags(), mi.BSDFFlags.DiffuseReflection)
    sources += point_lights(scene, si, diffuse, rules)

    # Follow both branches of smooth interfaces.
    reflection = Branch(si, bsdf, REFLECTION, smooth, rules)
    transmission = Branch(si, bsdf, TRANSMISSION, glass, rules)
    dr.eval(sources, hit, smooth, glass, reflection, transmission)

    scale = rules.source_scale(si, rays.index, lanes(hit, n)) if rules else 1.0
    for i, light in enumerate(sources):
        image.add(rays, lanes(light, n) * scale, 1.0 if i == 0 else 1 / (len(sources) - 1))
    if lamps:
        image.add(rays, lanes(lamps.light(scene, si, diffuse, n), n) * scale)
    if rules:
        image.add(rays, np.where(lanes(hit, n), 0, rules.environment(rays.direction)) * scale)
    if left == 0:
        return Rays.joined([reflection.rays(rays, np.zeros(n, bool), np.ones(n))])  # none: black
    first, second = lanes(smooth, n), lanes(glass, n)
    r = np.minimum(matrices(reflection.mueller, n)[:, 0, 0], 1)
    return Rays.joined([reflection.rays(rays, first, np.where(second, r, 1)), transmission.rays(rays, second, 1 - r)])


def point_lights(scene: mi.Scene, si: mi.SurfaceInteraction3f, where: mi.Bool, rules) -> list[mi.Float]:
    """Returns the unpolarized radiance of diffuse surfaces by each point light."""
    result = []
    for light in scene.emitters():
        if mi.has_flag(light.flags(), mi.EmitterFlags.DeltaPosition):
            sample, arriving = light.sample_direction(si, mi.Point2f(0.5), where)
            reflectance = si.bsdf().eval(mi.BSDFContext(), si, si.to_local(sample.d), where)
            ray = rules.shadow_ray(si, sample) if rules else si.spawn_ray_to(sample.p)
            lit = where & ~scene.ray_test(ray, where)
            if rules:
                lit &= malus_rules.before_face(si, sample.d)
            result.append(dr.select(lit, (reflectance @ arriving)[0, 0].x, 0))
    return result


class Branch:
    """Reflection at or transmission through smooth surfaces by Mitsuba's BSDFs: directions, Mueller matrices in
    Mitsuba's frames, and the ratio of the refractive index beyond the surface to that before."""
    DRJIT_STRUCT = {"direction": mi.Vector3f, "origin": mi.Point3f, "mueller": mi.Spectrum, "eta": mi.Float}

    def __init__(self, si=None, bsdf=None, kind=None, where=None, rules=None):
        if si is None:
            return
        context = mi.BSDFContext()
        context.type_mask = kind
        out, weight = bsdf.sample(context, si, 0.5, mi.Point2f(0.5), where)
        self.direction = si.to_world(out.wo)
        self.origin = rules.offset_origin(si, self.direction) if rules else si.spawn_ray(self.direction).o
        self.mueller = si.to_world_mueller(weight, -out.wo, si.wi)
        self.eta = out.eta

    def rays(self, parents: Rays, where: np.ndarray, probability: np.ndarray) -> Rays:
        n = len(where)
        mueller = matrices(self.mueller, n)
        at = where & (mueller[:, 0, 0] > 0)
        return Rays(rows(self.origin, n)[at], rows(self.direction, n)[at], parents.pixel[at],
                    parents.weight[at] @ mueller[at], parents.index[at] * lanes(self.eta, n)[at],
                    parents.probability[at] * probability[at])
