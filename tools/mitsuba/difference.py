"""Differences between two images of Stokes vectors, and a test whether rounding explains the outliers.

Images are (height, width, colour, 4) in double precision. Differences are relative to the mean S0 of each colour. A
pixel is an outlier if a component differs by more than OUTLIER * (its S0 + the mean S0). Most outliers are on edges,
where rounding decides between hit and miss, or on paths that diverge. An outlier is explained if moving the centre of
the pixel by NUDGE changes the value of Mitsuba by as much. NUDGE is about 30 roundings of a direction in single
precision, at 256 pixels and 35 degrees.
"""
import numpy as np

import integrator

OUTLIER = 1e-3
NUDGE = 1e-3  # pixels


def statistics(image: np.ndarray, other: np.ndarray) -> dict:
    """Returns RMS and maximum per component, the share of outliers, and the RMS without them."""
    difference = np.abs(image - other) / mean_light(other)[:, None]
    out = outliers(image, other)
    ordinary = difference[~out]
    return {"rms": root_mean_square(difference.reshape(-1, 4)), "max": difference.max(axis=(0, 1, 2)).tolist(),
            "rmsOrdinary": root_mean_square(ordinary.reshape(-1, 4)), "outliers": int(out.sum()),
            "outlierShare": float(out.mean())}


def mean_light(image: np.ndarray) -> np.ndarray:
    """Returns the mean S0 per colour."""
    return np.maximum(image[..., 0].mean(axis=(0, 1)), 1e-30)


def root_mean_square(values: np.ndarray) -> list[float]:
    return np.sqrt((values**2).mean(axis=0)).tolist() if len(values) else [0.0] * 4


def outliers(image: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Returns (height, width): whether any component of any colour is an outlier."""
    local = other[..., :1] + mean_light(other)[:, None]
    return (np.abs(image - other) > OUTLIER * local).any(axis=(2, 3))


def explained(image: np.ndarray, other: np.ndarray, scenes: list, unpacked, rules: list) -> np.ndarray:
    """Returns for each outlier, in row order, whether it is explained. image: of malus; other: of scenes and rules."""
    at = np.flatnonzero(outliers(image, other))
    if not len(at):
        return np.zeros(0, bool)
    difference = np.abs(image - other).reshape(-1, 3, 4)[at]
    change = np.zeros_like(difference)
    for colour in range(3):
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)):
            moved = integrator.render(scenes[colour], unpacked.up(), unpacked.depth, rules[colour], at,
                                      (x * NUDGE, y * NUDGE)).stokes
            change[:, colour] = np.maximum(change[:, colour], np.abs(moved - other.reshape(-1, 3, 4)[at, colour]))
    # Compare the maxima over colours and components, since an edge changes all. 10 % allow for rounding.
    return difference.max(axis=(1, 2)) <= 1.1 * change.max(axis=(1, 2))
