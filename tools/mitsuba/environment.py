"""The environment of a pack in numpy and as an emitter of Mitsuba.

A pack's environment is a constant or an octahedral map (Cigolle et al., JCGT 3(2), 2014) of N x N texels with
a border of one texel that repeats the texels across the edges; the lookup is bilinear
(shaders/optics/environment.h, shaders/surfaces/environment.h). Mitsuba's `envmap` is a latitude-longitude image.
The deterministic integrator looks up the octahedral map in double precision. Mitsuba's integrators use a
latitude-longitude image resampled from it, and are compared with the deterministic integrator on the same image.
Directions are unit vectors in the axes of the pack, +y up.
"""
import pathlib

import mitsuba as mi
import numpy as np


class Environment:
    """Radiance of one colour (0: 630, 1: 532, 2: 465 nm) as a function of direction."""

    def __init__(self, description: dict, folder: pathlib.Path, colour: int):
        self.size = description.get("size", 0) if "image" in description else 0
        if self.size:
            texels = np.array(mi.Bitmap(str(folder / description["image"])))
            if texels.shape[:2] != (self.size + 2, self.size + 2):
                raise ValueError(f"{folder / description['image']}: expected {self.size + 2} x {self.size + 2} texels")
            self.texels = texels[:, :, colour].astype(np.float64)
        else:
            self.radiance = description["radiance"][colour]

    def __call__(self, d: np.ndarray) -> np.ndarray:
        """d: unit directions, shape (n, 3). Returns n radiances."""
        if not self.size:
            return np.full(len(d), self.radiance)
        p = octahedral(d) * self.size + 0.5
        i = np.minimum(p.astype(int), self.size)
        fx, fy = (p - i).T
        x, y = i.T
        t = self.texels
        top = t[y, x] * (1 - fx) + t[y, x + 1] * fx
        bottom = t[y + 1, x] * (1 - fx) + t[y + 1, x + 1] * fx
        return top * (1 - fy) + bottom * fy

    def emitter(self) -> dict | None:
        """Returns the environment as a Mitsuba emitter, or None if it is black."""
        if not self.size:
            return {"type": "constant", "radiance": float(self.radiance)} if self.radiance > 0 else None
        height, width = 2 * self.size, 4 * self.size
        row, column = np.mgrid[0:height, 0:width]
        radiance = self(lat_long_directions((column + 0.5) / width, row / (height - 1)).reshape(-1, 3))
        image = np.repeat(radiance.reshape(height, width, 1), 3, axis=2).astype(np.float32)
        return {"type": "envmap", "bitmap": mi.Bitmap(image)}


def octahedral(d: np.ndarray) -> np.ndarray:
    """Maps unit directions (n, 3) to the unit square (n, 2)."""
    d = d / np.abs(d).sum(axis=1, keepdims=True)
    xy, sign = d[:, :2], np.where(d[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(xy[:, ::-1])) * sign
    return 0.5 + 0.5 * np.where(d[:, 2:] < 0, folded, xy)


def lat_long_directions(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Returns the directions of Mitsuba's `envmap`: +y at v = 0; at v = 1/2, -z at u = 0 and +x at u = 1/4. Its first
    and last row are at the poles (v = row / (rows - 1)), its columns at the centres of their ranges of u (measured)."""
    phi, theta = u * 2 * np.pi, v * np.pi
    return np.stack([np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)], axis=-1)
