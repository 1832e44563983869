"""Small textures of colours and indices: PNG and EXR files without compression, with the same bytes in every run and
with every version of a library."""
import struct
import zlib


def write_png(path, rows):
    """rows: lists of (red, green, blue), 0 to 255, top row first."""
    path.write_bytes(_png(rows, 2, lambda row: bytes(c for pixel in row for c in pixel)))


def small_png(rows):
    """Bytes of a PNG file of pixels (red, green, blue) or (red, green, blue, alpha): with a palette if they have at
    most 256 values."""
    palette = sorted({pixel for row in rows for pixel in row})
    channels = len(palette[0])
    if len(palette) > 256:
        return _png(rows, 2 if channels == 3 else 6, lambda row: bytes(c for pixel in row for c in pixel))
    index = {pixel: i for i, pixel in enumerate(palette)}
    tables = _chunk(b"PLTE", bytes(c for pixel in palette for c in pixel[:3]))
    if channels == 4:
        tables += _chunk(b"tRNS", bytes(pixel[3] for pixel in palette))
    return _png(rows, 3, lambda row: bytes(index[pixel] for pixel in row), tables)


def write_exr(path, rows):
    """rows: lists of numbers, top row first; each becomes a half in R, G and B."""
    width, height = len(rows[0]), len(rows)
    channels = b"".join(name + struct.pack("<xIIII", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    attributes = [(b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"),
                  (b"dataWindow", b"box2i", window), (b"displayWindow", b"box2i", window),
                  (b"lineOrder", b"lineOrder", b"\0"), (b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
                  (b"screenWindowCenter", b"v2f", struct.pack("<ff", 0.0, 0.0)),
                  (b"screenWindowWidth", b"float", struct.pack("<f", 1.0))]
    head = struct.pack("<II", 20000630, 2)
    head += b"".join(name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value
                     for name, kind, value in attributes) + b"\0"
    lines = [struct.pack("<iI", y, 6 * width) + 3 * struct.pack(f"<{width}e", *row) for y, row in enumerate(rows)]
    first = len(head) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * len(lines[0])) for y in range(height))
    path.write_bytes(head + offsets + b"".join(lines))


def _png(rows, colour_type, encode, tables=b""):
    data = b"".join(b"\0" + encode(row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, colour_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + tables + _chunk(b"IDAT", _stored(data)) +
            _chunk(b"IEND", b""))


def _chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _stored(data):
    """Returns a zlib stream of stored blocks."""
    starts = range(0, len(data), 65535)
    blocks = [struct.pack("<BHH", start == starts[-1], len(block), 65535 - len(block)) + block
              for start, block in ((start, data[start:start + 65535]) for start in starts)]
    return b"\x78\x01" + b"".join(blocks) + struct.pack(">I", zlib.adler32(data))
