"""Where and how much a picture is off, by the measure of render/compare/picture_error.h."""
import numpy

kOff = 0.01  # a pixel is off where a colour is by more than this share of the reference


def relative_error(picture: numpy.ndarray, reference: numpy.ndarray) -> numpy.ndarray:
    """Per pixel the largest error of a colour relative to the reference, or to a thousandth of the reference's
    mean where that is more. Not finite where the picture is not."""
    floor = max(1e-3 * float(reference.astype(float).mean()), 1e-30)
    difference = numpy.abs(picture.astype(float) - reference)
    difference = numpy.where(numpy.isfinite(picture), difference, numpy.inf)
    return (difference / numpy.maximum(numpy.abs(reference), floor)).max(axis=2)


def place(off: numpy.ndarray) -> str:
    """Where in the picture the pixels of a mask are, by thirds: for "mostly in ...", or "" for no pixel."""
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
    return "all parts of the picture"


class Wrongness:
    """What the sentences say of one picture: share of pixels off by more than 1 %, where, and how much at most.
    apart: mask of pixels that are not counted."""

    def __init__(self, picture: numpy.ndarray, reference: numpy.ndarray, dolp: numpy.ndarray = None,
                 apart: numpy.ndarray = None):
        error = relative_error(picture, reference)
        if apart is not None:
            error = numpy.where(apart, 0, error)
        off = error > kOff
        self.share = float(off.mean())
        self.largest = float(error.max())
        self.p99 = float(numpy.quantile(error, 0.99))
        self.place = place(off)
        # Median degree of polarization of the pixels that are off, and of the others.
        self.dolp_off = float(numpy.median(dolp[off])) if dolp is not None and off.any() else None
        self.dolp_rest = float(numpy.median(dolp[~off])) if dolp is not None and (~off).any() else None
