"""Light from infinity as a pack keeps it, in numpy, and the same for Mitsuba.

A pack's environment is a constant or an octahedral map (Cigolle et al., JCGT 3(2), 2014) of N x N texels with
a border of one texel that repeats what lies across the edges; it is looked up bilinearly
(shaders/optics/environment.h, shaders/surfaces/environment.h). Mitsuba's `envmap` is a latitude-longitude picture.
The deterministic integrator looks up the octahedral map itself, in double precision; Mitsuba's own
integrators get a latitude-longitude picture resampled from it, and are compared with the deterministic
integrator on that same picture. Directions are unit vectors in the pack's axes, +y up.
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
        """The same as a Mitsuba emitter; None where it is black."""
        if not self.size:
            return {"type": "constant", "radiance": float(self.radiance)} if self.radiance > 0 else None
        height, width = 2 * self.size, 4 * self.size
        row, column = np.mgrid[0:height, 0:width]
        radiance = self(lat_long_directions((column + 0.5) / width, row / (height - 1)).reshape(-1, 3))
        picture = np.repeat(radiance.reshape(height, width, 1), 3, axis=2).astype(np.float32)
        return {"type": "envmap", "bitmap": mi.Bitmap(picture)}


def octahedral(d: np.ndarray) -> np.ndarray:
    """Unit directions (n, 3) to the unit square, (n, 2)."""
    d = d / np.abs(d).sum(axis=1, keepdims=True)
    xy, sign = d[:, :2], np.where(d[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(xy[:, ::-1])) * sign
    return 0.5 + 0.5 * np.where(d[:, 2:] < 0, folded, xy)


def lat_long_directions(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Directions of Mitsuba's `envmap`: +y up at v = 0, u = 0 looks toward -z, u = 1/4 toward +x. Its first and
    last row lie on the poles (v = row/(rows - 1)), its columns in the middle of their share of u (measured)."""
    phi, theta = u * 2 * np.pi, v * np.pi
    return np.stack([np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)], axis=-1)
