"""How far two pictures of Stokes vectors are apart, and whether rounding explains it.

Pictures are (height, width, colour, 4) in double precision. Differences are relative to each colour's mean S0. A
pixel is an outlier where a component differs by more than OUTLIER of (its S0 + the mean S0). Most outliers lie on
edges, where single precision decides between hit and miss, or on paths that small changes send elsewhere: they
are explained where moving the pixel's centre by NUDGE changes Mitsuba's own value by as much. NUDGE is about 30
roundings of a direction in single precision at 256 pixels and 35 degrees.
"""
import numpy as np

import integrator

OUTLIER = 1e-3
NUDGE = 1e-3  # pixels


def statistics(picture: np.ndarray, other: np.ndarray) -> dict:
    """RMS and maximum per component, share of outliers, and RMS without them."""
    difference = np.abs(picture - other) / mean_light(other)[:, None]
    out = outliers(picture, other)
    ordinary = difference[~out]
    return {"rms": root_mean_square(difference.reshape(-1, 4)), "max": difference.max(axis=(0, 1, 2)).tolist(),
            "rmsOrdinary": root_mean_square(ordinary.reshape(-1, 4)), "outliers": int(out.sum()),
            "outlierShare": float(out.mean())}


def mean_light(picture: np.ndarray) -> np.ndarray:
    """Mean S0 per colour."""
    return np.maximum(picture[..., 0].mean(axis=(0, 1)), 1e-30)


def root_mean_square(values: np.ndarray) -> list[float]:
    return np.sqrt((values**2).mean(axis=0)).tolist() if len(values) else [0.0] * 4


def outliers(picture: np.ndarray, other: np.ndarray) -> np.ndarray:
    """(height, width), whether any colour and component is too far off."""
    local = other[..., :1] + mean_light(other)[:, None]
    return (np.abs(picture - other) > OUTLIER * local).any(axis=(2, 3))


def explained(picture: np.ndarray, other: np.ndarray, scenes: list, unpacked, rules: list) -> np.ndarray:
    """Which of the outliers (in row order) are explained. picture: malus's, other: that of scenes and rules."""
    at = np.flatnonzero(outliers(picture, other))
    if not len(at):
        return np.zeros(0, bool)
    difference = np.abs(picture - other).reshape(-1, 3, 4)[at]
    change = np.zeros_like(difference)
    for colour in range(3):
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)):
            moved = integrator.render(scenes[colour], unpacked.up(), unpacked.depth, rules[colour], at,
                                      (x * NUDGE, y * NUDGE)).stokes
            change[:, colour] = np.maximum(change[:, colour], np.abs(moved - other.reshape(-1, 3, 4)[at, colour]))
    # The largest of colours and components: an edge changes them together. A tenth for another rounding there.
    return difference.max(axis=(1, 2)) <= 1.1 * change.max(axis=(1, 2))
