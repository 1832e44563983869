"""Colour maps for radiance, differences and polarization. Functions take and return numpy arrays; angles in radians."""
import matplotlib
import numpy

kSignificantDoLP = 0.01  # below this degree the angle is rounding noise and is drawn grey


def tone_mapped(radiance: numpy.ndarray, exposure_ev: float) -> numpy.ndarray:
    """Returns 8-bit display values with the tone curve of render/image/output.cpp: linear up to 0.7, then an
    exponential shoulder with limit 1, then the sRGB transfer function."""
    x = numpy.clip(numpy.nan_to_num(radiance.astype(float) * 2.0**exposure_ev, nan=0.0, posinf=1e6), 0, 1e6)
    linear = 0.7
    x = numpy.where(x > linear, linear + (1 - linear) * (1 - numpy.exp(-(x - linear) / (1 - linear))), x)
    s = numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.power(x, 1 / 2.4) - 0.055)
    return numpy.floor(s * 255 + 0.5).astype(numpy.uint8)


def luminance(rgb: numpy.ndarray) -> numpy.ndarray:
    return rgb @ numpy.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709


def signed_difference(image: numpy.ndarray, reference: numpy.ndarray) -> numpy.ndarray:
    """Returns per pixel the signed difference of the colour channel with the largest error; positive is too bright."""
    d = numpy.nan_to_num(image - reference, nan=0.0, posinf=1e6, neginf=-1e6)
    return numpy.take_along_axis(d, numpy.abs(d).argmax(axis=2)[:, :, None], axis=2)[:, :, 0]


def difference_limit(differences: list) -> float:
    """Returns the limit of a scene's scale: covers 99.9 % of the pixels of each image, rounded up to 1, 2 or 5."""
    largest = max([float(numpy.quantile(numpy.abs(d), 0.999)) for d in differences], default=0)
    if largest < 1e-6:
        return 1e-6
    power = 10.0 ** numpy.floor(numpy.log10(largest))
    return float(next(step * power for step in (1, 2, 5, 10) if step * power >= largest * (1 - 1e-9)))


def difference_position(d: numpy.ndarray, limit: float) -> numpy.ndarray:
    """Maps a difference to 0..1 with 0.5 for no error; near linear below limit / 100, then logarithmic."""
    knee = limit / 100
    return 0.5 + 0.5 * numpy.sign(d) * numpy.log1p(numpy.minimum(numpy.abs(d), limit) / knee) / numpy.log1p(limit / knee)


def mapped(position: numpy.ndarray, name: str) -> numpy.ndarray:
    return (matplotlib.colormaps[name](position)[..., :3] * 255 + 0.5).astype(numpy.uint8)


def indexed(position: numpy.ndarray, name: str) -> tuple:
    """Returns palette indices 0..254 and the palette; index 255 is grey and marks pixels without a value."""
    palette = numpy.vstack([mapped(numpy.arange(255) / 254, name), numpy.full((1, 3), 96, numpy.uint8)])
    return numpy.round(position * 254).astype(numpy.uint8), palette


def difference_colours(d: numpy.ndarray, limit: float) -> tuple:
    return indexed(difference_position(d, limit), "RdBu_r")


def linear_polarization(s0, s1, s2):
    """Returns DoLP (0 where S0 is 0) and AoLP in 0..pi, counter-clockwise from the image's x axis."""
    s0, s1, s2 = (numpy.nan_to_num(s) for s in (s0, s1, s2))
    dolp = numpy.where(s0 > 0, numpy.hypot(s1, s2) / numpy.where(s0 > 0, s0, 1), 0)
    return numpy.clip(dolp, 0, 1), numpy.mod(numpy.arctan2(s2, s1) / 2, numpy.pi)


def dolp_colours(dolp: numpy.ndarray) -> tuple:
    return indexed(dolp, "viridis")


def aolp_colours(aolp: numpy.ndarray, dolp: numpy.ndarray) -> tuple:
    steps, palette = indexed(aolp / numpy.pi, "hsv")
    return numpy.where(dolp > kSignificantDoLP, steps, numpy.uint8(255)), palette
