"""Reads the EXR images and encodes them for the page."""
import base64
import io
import pathlib
import zlib

import numpy
import OpenImageIO as oiio
from PIL import Image

from report_data import ReportError

kImageWidth = 640  # largest width of an image in the page; the EXR files have the full resolution
kHeroWidth = 400  # largest width of an image in the summary
kStokesWidth = 480  # largest width of a Stokes image in the page


class ExrImage:
    """rgb: height x width x 3, radiance. stokes: height x width x 4 x 3 (S0..S3 of R, G, B), or None."""

    def __init__(self, path: pathlib.Path):
        file = oiio.ImageInput.open(str(path))
        if not file:
            raise ReportError(f"{path}: cannot be read as an image: {oiio.geterror().splitlines()[0]}")
        spec = file.spec()
        pixels = file.read_image(oiio.FLOAT)
        file.close()
        if pixels is None:
            raise ReportError(f"{path}: damaged image: {file.geterror()}")
        names = list(spec.channelnames)
        missing = [c for c in "RGB" if c not in names]
        if missing:
            raise ReportError(f"{path}: has no channel {missing[0]}; expected R, G and B, found {' '.join(names)}")
        pixels = numpy.asarray(pixels, dtype=numpy.float32).reshape(spec.height, spec.width, len(names))
        self.rgb = pixels[:, :, [names.index(c) for c in "RGB"]]
        stokes = [f"S{s}.{c}" for s in range(4) for c in "RGB"]
        self.stokes = None
        if all(c in names for c in stokes):
            self.stokes = pixels[:, :, [names.index(c) for c in stokes]].reshape(spec.height, spec.width, 4, 3)


def shrunk(pixels: numpy.ndarray, widest: int) -> numpy.ndarray:
    """Downsamples by averaging blocks of pixels until the width is at most `widest`."""
    step = -(-pixels.shape[1] // widest)
    if step == 1:
        return pixels
    height, width = pixels.shape[0] // step * step or pixels.shape[0], pixels.shape[1] // step * step
    rows = step if height >= step else height
    blocks = pixels[:height, :width].reshape(height // rows, rows, width // step, step, *pixels.shape[2:])
    return blocks.mean(axis=(1, 3))


def data_uri(data: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def jpeg(rgb: numpy.ndarray) -> str:
    """Encodes an image for visual comparison: quality 93, no chroma subsampling."""
    file = io.BytesIO()
    Image.fromarray(rgb, "RGB").save(file, "JPEG", quality=93, subsampling=0)
    return data_uri(file.getvalue(), "image/jpeg")


def png(steps: numpy.ndarray, palette: numpy.ndarray) -> str:
    """Encodes a colour-mapped image losslessly, with a palette of 255 steps."""
    file = io.BytesIO()
    image = Image.fromarray(steps, "P")
    image.putpalette(palette.tobytes())
    image.save(file, "PNG")
    return data_uri(file.getvalue(), "image/png")


def packed_stokes(stokes: numpy.ndarray) -> dict:
    """Encodes the Stokes image of the polarizer demonstration as zlib-compressed bytes in base64.

    Twelve planes of bytes, each stored as differences along its rows (modulo 256): the high and the low byte of
    round(65535 sqrt(S0 / largest)) for R, G, B; then round(127 (S1 / S0)) + 128 for R, G, B; then the same for S2.
    S0 has a resolution of largest / 30,000 and is clamped at the 99.99th percentile. S1/S0 and S2/S0 have a
    resolution of 0.004, so the filtered radiance has an error of at most 0.3 % of the unfiltered radiance.
    """
    pixels = numpy.nan_to_num(shrunk(stokes, kStokesWidth).astype(float))
    s0 = numpy.maximum(pixels[:, :, 0], 0)
    # Clamp highlights: they display as white in any case and would reduce the resolution of all other pixels.
    largest = max(float(numpy.quantile(s0, 0.9999)), 1e-6)
    level = numpy.round(65535 * numpy.sqrt(numpy.minimum(s0 / largest, 1))).astype(numpy.uint16)
    safe = numpy.where(s0 > 0, s0, 1)
    relative = [numpy.round(127 * numpy.clip(numpy.where(s0 > 0, pixels[:, :, s] / safe, 0), -1, 1)) + 128
                for s in (1, 2)]
    planes = numpy.concatenate([level >> 8, level & 255, *relative], axis=2).astype(numpy.uint8).transpose(2, 0, 1)
    planes = numpy.diff(planes, axis=2, prepend=numpy.uint8(0))
    data = base64.b64encode(zlib.compress(planes.tobytes(), 6)).decode()
    return {"width": s0.shape[1], "height": s0.shape[0], "largest": largest, "data": data}
