"""Colours of radiance, differences and polarization. All take and give numpy arrays; angles in radians."""
import matplotlib
import numpy

kSignificantDoLP = 0.01  # under it an angle is rounding: drawn grey


def tone_mapped(radiance: numpy.ndarray, exposure_ev: float) -> numpy.ndarray:
    """Bytes for the screen, by the curve of render/image/output.cpp: linear to 0.7, then an exponential
    shoulder that reaches 1 at infinity, then sRGB."""
    x = numpy.clip(numpy.nan_to_num(radiance.astype(float) * 2.0**exposure_ev, nan=0.0, posinf=1e6), 0, 1e6)
    linear = 0.7
    x = numpy.where(x > linear, linear + (1 - linear) * (1 - numpy.exp(-(x - linear) / (1 - linear))), x)
    s = numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.power(x, 1 / 2.4) - 0.055)
    return numpy.floor(s * 255 + 0.5).astype(numpy.uint8)


def luminance(rgb: numpy.ndarray) -> numpy.ndarray:
    return rgb @ numpy.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709


def signed_difference(picture: numpy.ndarray, reference: numpy.ndarray) -> numpy.ndarray:
    """Per pixel the colour's difference that is farthest from 0, with its sign: above 0 is too bright."""
    d = numpy.nan_to_num(picture - reference, nan=0.0, posinf=1e6, neginf=-1e6)
    return numpy.take_along_axis(d, numpy.abs(d).argmax(axis=2)[:, :, None], axis=2)[:, :, 0]


def difference_limit(differences: list) -> float:
    """End of a scene's scale: covers 99.9 % of the pixels of every picture, rounded up to 1, 2 or 5."""
    largest = max([float(numpy.quantile(numpy.abs(d), 0.999)) for d in differences], default=0)
    if largest < 1e-6:
        return 1e-6
    power = 10.0 ** numpy.floor(numpy.log10(largest))
    return float(next(step * power for step in (1, 2, 5, 10) if step * power >= largest * (1 - 1e-9)))


def difference_position(d: numpy.ndarray, limit: float) -> numpy.ndarray:
    """0..1 on the scale, 0.5 where nothing is off; about linear below a hundredth of the limit, then logarithmic."""
    knee = limit / 100
    return 0.5 + 0.5 * numpy.sign(d) * numpy.log1p(numpy.minimum(numpy.abs(d), limit) / knee) / numpy.log1p(limit / knee)


def mapped(position: numpy.ndarray, name: str) -> numpy.ndarray:
    return (matplotlib.colormaps[name](position)[..., :3] * 255 + 0.5).astype(numpy.uint8)


def indexed(position: numpy.ndarray, name: str) -> tuple:
    """Steps 0..254 on a scale and their colours; step 255 is grey, for what has no place on it."""
    palette = numpy.vstack([mapped(numpy.arange(255) / 254, name), numpy.full((1, 3), 96, numpy.uint8)])
    return numpy.round(position * 254).astype(numpy.uint8), palette


def difference_colours(d: numpy.ndarray, limit: float) -> tuple:
    return indexed(difference_position(d, limit), "RdBu_r")


def linear_polarization(s0, s1, s2):
    """DoLP (0 where there is no light) and AoLP in 0..pi, counter-clockwise from the picture's x."""
    s0, s1, s2 = (numpy.nan_to_num(s) for s in (s0, s1, s2))
    dolp = numpy.where(s0 > 0, numpy.hypot(s1, s2) / numpy.where(s0 > 0, s0, 1), 0)
    return numpy.clip(dolp, 0, 1), numpy.mod(numpy.arctan2(s2, s1) / 2, numpy.pi)


def dolp_colours(dolp: numpy.ndarray) -> tuple:
    return indexed(dolp, "viridis")


def aolp_colours(aolp: numpy.ndarray, dolp: numpy.ndarray) -> tuple:
    steps, palette = indexed(aolp / numpy.pi, "hsv")
    return numpy.where(dolp > kSignificantDoLP, steps, numpy.uint8(255)), palette
