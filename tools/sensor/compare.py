"""Compares one raw image of `malus render --sensor` with polanalyser; run by tools/sensor/check.

  compare.py PREFIX     reads PREFIX-raw.png and .json, PREFIX-mask.png, PREFIX-stokes.exr and PREFIX-true.exr

polanalyser demosaics the raw image (bilinear, by OpenCV) and solves for the Stokes vectors with the extinction matrix of
the JSON file. OpenCV rounds interpolated numbers to integers, twice for colours, so each angle differs by half a
number at most for `mono` and by one for colours. DoLP and AoLP must agree within the error that follows from it. Exit code: 0 or 3.
"""

import json
import sys

import cv2
import numpy as np
import OpenEXR
import polanalyser as pa

BORDER = 8  # pixels; borders are extended in other ways
ORDER = [3, 1, 0, 2]  # of the angles 0, 45, 90, 135 in the rows of the JSON file (90, 45, 135, 0)


def read_exr(file):
    channels = OpenEXR.File(file, separate_channels=True).channels()
    return {name: channel.pixels.astype(np.float64) for name, channel in channels.items()}


def demosaic(raw, is_colour):
    """Images at 0, 45, 90 and 135 degrees, (4, height, width, channels) in the order R, G, B."""
    images = pa.demosaicing(raw, pa.COLOR_PolarRGB if is_colour else pa.COLOR_PolarMono)
    images = np.array(images, dtype=np.float64)
    return images[..., ::-1] if is_colour else images[..., np.newaxis]


def dolp_aolp(stokes):
    return pa.cvtStokesToDoLP(stokes), pa.cvtStokesToAoLP(stokes)


def angle_difference(a, b):
    difference = np.abs(a - b) % np.pi
    return np.minimum(difference, np.pi - difference)


def inner(image):
    return image[BORDER:-BORDER, BORDER:-BORDER]


def compare(prefix):
    with open(f"{prefix}-raw.json", encoding="utf-8") as file:
        sensor = json.load(file)
    raw, mask = (cv2.imread(f"{prefix}-{name}.png", cv2.IMREAD_UNCHANGED) for name in ("raw", "mask"))
    ours, truth = read_exr(f"{prefix}-stokes.exr"), read_exr(f"{prefix}-true.exr")
    is_colour = sensor["pattern"] == "quad-bayer"
    # Interpolation takes pixels at a distance of up to 4, which must not be saturated.
    usable = cv2.dilate(mask, np.ones((9, 9))) == 0
    images = demosaic(raw, is_colour)
    passed = True
    np.seterr(divide="ignore", invalid="ignore")  # black pixels, which are left out
    for index, channel in enumerate(sensor["channels"]):
        name = channel["name"]
        scale = sensor["gain"] / sensor["electronsPerRadiance"] / (channel["response"] if is_colour else 1)
        light = (images[..., index] - sensor["blackLevel"]) * scale
        rows = np.array(channel["rows"])[ORDER]
        found = pa.calcStokes(light, rows)
        mine = np.stack([ours[f"S{i}.{name}"] for i in range(3)], axis=-1)
        step = (1 if is_colour else 0.5) * scale * np.abs(np.linalg.pinv(rows)).sum(axis=1).max()
        # Errors of S0, S1, S2 up to `step` change DoLP by up to (1 + DoLP) step / S0, with sqrt(2) for two components.
        keep = inner(usable & (mine[..., 0] > 20 * step))
        dolp, aolp = dolp_aolp(found)
        my_dolp, my_aolp = dolp_aolp(mine)
        bound = 1.1 * (np.sqrt(2) + my_dolp) * step / mine[..., 0]
        dolp_error = inner(np.abs(dolp - my_dolp) / bound)[keep]
        aolp_error = inner(angle_difference(aolp, my_aolp) * my_dolp / (0.5 * bound))[keep & inner(my_dolp > 3 * bound)]
        if is_colour:
            true_stokes = np.stack([truth[f"S{i}.{name}"] for i in range(3)], axis=-1)
        else:
            true_stokes = np.stack([sum(w * truth[f"S{i}.{c}"] for w, c in zip(channel["response"], "RGB"))
                                    for i in range(3)], axis=-1)
        from_truth = np.median(inner(np.abs(dolp - pa.cvtStokesToDoLP(true_stokes)))[keep])
        enough = dolp_error.size > 1000 and aolp_error.size > 1000
        angles = inner(angle_difference(aolp, my_aolp))
        largest_angle = np.degrees(angles[keep & inner(my_dolp > 0.1)].max(initial=0))
        typical = np.median(inner(np.abs(dolp - my_dolp))[keep])
        good = enough and dolp_error.max() <= 1 and aolp_error.max() <= 1
        passed = passed and good
        print(f"{prefix} {name}: {dolp_error.size} pixels, difference of DoLP: median {typical:.2g}, largest "
              f"{inner(np.abs(dolp - my_dolp))[keep].max():.2g} ({dolp_error.max():.2f} of the bound), of AoLP "
              f"{largest_angle:.2g} degrees where DoLP > 0.1 ({aolp_error.max(initial=0):.2f}); median of "
              f"|DoLP - rendered| {from_truth:.2g}{'' if good else '  FAILED'}")
    return passed


if __name__ == "__main__":
    sys.exit(0 if compare(sys.argv[1]) else 3)
