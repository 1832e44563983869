"""Runs Mitsuba's polvis on an image and checks one of its results; run by tools/viewers/check.

  polvis.py IMAGE.exr     channels R, G, B, A, S0.R ... S3.B

The function is called directly: the command `python -m mitsuba.python.polvis` of Mitsuba 3.5.2 calls it in a thread
without a logger, where it fails without a message. Exit code: 0 or 3.
"""

import os
import sys
import types

import numpy as np


def main(file):
    from mitsuba.python.polvis import polvis
    images = {"intensity": True, "stokes": True, "dop": True, "top": True, "lin": True, "cir": True}
    arguments = types.SimpleNamespace(scale=None, polarizer=30.0, channel=None, stokes_nrm=False, direct_overlay=False,
                                      luminance_overlay=False, **images)
    base = file[:-4]
    written = [f"{base}_{name}.png" for name in ("intensity", "polarizer_30.00", "s0", "s1", "s2", "s3", "dop", "top",
                                                  "lin", "cir")]
    for name in written:
        if os.path.exists(name):
            os.remove(name)
    polvis(file, arguments)  # prints an error and returns if the image does not have 16 channels
    missing = [name for name in written if not os.path.exists(name)]
    if missing:
        print(f"viewers/check: polvis wrote no {missing[0]}  FAILED")
        return False

    # The degree of polarization of the mean of the colours, sRGB-encoded in the red channel.
    import mitsuba.scalar_rgb as mi
    channels = np.array(mi.Bitmap(file))
    names = [field.name for field in mi.Bitmap(file).struct_()]
    stokes = [np.mean([channels[..., names.index(f"S{s}.{c}")] for c in "RGB"], axis=0) for s in range(4)]
    with np.errstate(divide="ignore", invalid="ignore"):
        dop = np.nan_to_num(np.sqrt(stokes[1]**2 + stokes[2]**2 + stokes[3]**2) / stokes[0])
    encoded = np.where(dop <= 0.0031308, 12.92 * dop, 1.055 * np.clip(dop, 0, 1)**(1 / 2.4) - 0.055)
    found = np.array(mi.Bitmap(f"{base}_dop.png"))[..., 0]
    difference = np.abs(found - 255 * np.clip(encoded, 0, 1)).max()
    good = difference <= 1
    print(f"viewers/check: polvis of Mitsuba {mi.__version__}: 10 images; degree of polarization within "
          f"{difference:.2f} of 255{'' if good else '  FAILED'}")
    return good


if __name__ == "__main__":
    sys.exit(0 if main(sys.argv[1]) else 3)
