"""Reads images of malus by OpenCV and polanalyser and compares the values with OpenEXR's; run by tools/viewers/check.

  readers.py FOLDER     reads image.exr, raw.png and raw.json of the folder

Exit code: 0 or 3.
"""

import json
import sys

import cv2
import numpy as np
import OpenEXR
import polanalyser as pa
from polanalyser.io import image_io


def report(name, good):
    print(f"viewers/check: {name}{'' if good else '  FAILED'}")
    return good


def main(folder):
    channels = OpenEXR.File(f"{folder}/image.exr", separate_channels=True).channels()
    image = cv2.imread(f"{folder}/image.exr", cv2.IMREAD_UNCHANGED)
    good = image is not None and image.dtype == np.float32 and image.shape == (256, 256, 4) and all(
        np.array_equal(image[..., i], channels[name].pixels) for i, name in enumerate("BGRA"))
    passed = report(f"OpenCV {cv2.__version__}: R, G, B and A of the EXR image; the layers S0 to S3 are not read", good)

    with open(f"{folder}/raw.json", encoding="utf-8") as file:
        description = json.load(file)
    raw = cv2.imread(f"{folder}/raw.png", cv2.IMREAD_UNCHANGED)
    good = raw is not None and raw.dtype == np.uint16 and raw.max() <= 4095
    passed &= report(f"OpenCV {cv2.__version__}: raw image, 12 bits unshifted in 16", good)

    image, properties = image_io.imread(f"{folder}/raw.png")
    good = np.array_equal(image, raw) and properties["gain"] == description["gain"] and len(
        pa.demosaicing(image, pa.COLOR_PolarMono)) == 4
    return report("polanalyser 3.0.0: raw image with its JSON file as properties, demosaicked", good) and passed


if __name__ == "__main__":
    sys.exit(0 if main(sys.argv[1]) else 3)
