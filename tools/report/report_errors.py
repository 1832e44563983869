"""Location and size of the error of an image, with the measure of render/compare/image_error.h."""
import numpy

kOff = 0.01  # relative error of a colour above which a pixel counts as wrong


def relative_error(image: numpy.ndarray, reference: numpy.ndarray) -> numpy.ndarray:
    """Returns per pixel the largest error of a colour relative to the reference, or to 0.001 of the reference's mean
    if that is larger. Not finite where the image is not finite."""
    floor = max(1e-3 * float(reference.astype(float).mean()), 1e-30)
    difference = numpy.abs(image.astype(float) - reference)
    difference = numpy.where(numpy.isfinite(image), difference, numpy.inf)
    return (difference / numpy.maximum(numpy.abs(reference), floor)).max(axis=2)


def location(off: numpy.ndarray) -> str:
    """Describes the location of the pixels of a mask by thirds of the image; "" for an empty mask."""
    if not off.any():
        return ""
    rows = [part.sum() for part in numpy.array_split(off, 3, axis=0)]
    columns = [part.sum() for part in numpy.array_split(off, 3, axis=1)]
    cells = [[cell.sum() for cell in numpy.array_split(part, 3, axis=1)] for part in numpy.array_split(off, 3, axis=0)]
    total = off.sum()
    vertical, horizontal = ("upper", "middle", "lower"), ("left", "centre", "right")
    share, y, x = max((cells[y][x] / total, -y, -x) for y in range(3) for x in range(3))
    y, x = -y, -x
    if share >= 0.5:
        return "the centre" if (y, x) == (1, 1) else f"the {vertical[y]} {horizontal[x]}"
    if max(rows) >= 0.6 * total:
        return ("the upper third", "the strip across the middle", "the lower third")[rows.index(max(rows))]
    if max(columns) >= 0.6 * total:
        return ("the left third", "the strip down the middle", "the right third")[columns.index(max(columns))]
    return "all parts of the image"


class ErrorSummary:
    """Summary of one image: share of pixels with an error above 1 %, their location and the largest error.
    excluded: mask of pixels that are not counted."""

    def __init__(self, image: numpy.ndarray, reference: numpy.ndarray, dolp: numpy.ndarray = None,
                 excluded: numpy.ndarray = None):
        error = relative_error(image, reference)
        if excluded is not None:
            error = numpy.where(excluded, 0, error)
        off = error > kOff
        self.share = float(off.mean())
        self.largest = float(error.max())
        self.p99 = float(numpy.quantile(error, 0.99))
        self.location = location(off)
        # Median degree of polarization of the wrong pixels and of the others.
        self.dolp_off = float(numpy.median(dolp[off])) if dolp is not None and off.any() else None
        self.dolp_rest = float(numpy.median(dolp[~off])) if dolp is not None and (~off).any() else None
