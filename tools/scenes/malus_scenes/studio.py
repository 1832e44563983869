"""A studio as a latitude-longitude image: a gradient and soft light boxes, written as Radiance RGBE.

Directions: azimuth 0 is -z, 90 is +x; elevation 90 is up. The centre column of the image is azimuth 0. Radiance is linear RGB.
"""
import math

from .vectors import dot


class Box:
    """A light of width x height degrees about a direction, its edges soft over `edge` degrees. panes
    (columns, rows) cuts it into panes by bars of `bar` degrees."""

    def __init__(self, azimuth, elevation, width, height, radiance, edge=1.5, panes=(1, 1), bar=2.0, roll=0.0):
        az, el = math.radians(azimuth), math.radians(elevation)
        self.forward = (math.cos(el) * math.sin(az), math.sin(el), -math.cos(el) * math.cos(az))
        right = (math.cos(az), 0.0, math.sin(az))
        up = (-math.sin(el) * math.sin(az), math.cos(el), math.sin(el) * math.cos(az))
        c, s = math.cos(math.radians(roll)), math.sin(math.radians(roll))
        self.right = tuple(c * r + s * u for r, u in zip(right, up))
        self.up = tuple(c * u - s * r for r, u in zip(right, up))
        self.size, self.radiance, self.edge = (width, height), radiance, edge
        self.panes, self.bar = panes, bar

    def weight(self, d):
        """0 outside to 1 inside, for a unit direction."""
        z = dot(d, self.forward)
        if z <= 0.02:
            return 0.0
        weight = 1.0
        for axis, size, panes in zip((self.right, self.up), self.size, self.panes):
            x = math.degrees(math.atan2(dot(d, axis), z))
            weight *= _ramp((size / 2 - abs(x)) / self.edge + 0.5)
            if weight == 0.0:
                return 0.0
            for bar in range(1, panes):
                centre = size * (bar / panes - 0.5)
                weight *= _ramp((abs(x - centre) - self.bar / 2) / (0.5 * self.edge) + 0.5)
        return weight


def render(width, height, gradient, boxes):
    """Returns rows of pixels. gradient: function of (elevation, azimuth) [degrees] to radiance; boxes cover it in
    order."""
    rows = []
    for y in range(height):
        theta = math.pi * (y + 0.5) / height
        row = []
        for x in range(width):
            phi = 2 * math.pi * ((x + 0.5) / width - 0.5)
            d = (math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi))
            colour = gradient(90.0 - math.degrees(theta), math.degrees(phi))
            for box in boxes:
                w = box.weight(d)
                if w > 0.0:
                    colour = tuple(c + w * (b - c) for c, b in zip(colour, box.radiance))
            row.append(_rgbe(colour))
        rows.append(row)
    return rows


def write_hdr(path, rows):
    """Radiance RGBE, each row's four channels run-length encoded."""
    height, width = len(rows), len(rows[0])
    out = bytearray(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode("ascii"))
    for row in rows:
        out += bytes((2, 2, width >> 8, width & 255))
        for channel in range(4):
            out += _runs(bytes(p[channel] for p in row))
    path.write_bytes(bytes(out))


def smooth_steps(stops):
    """A function that passes through (x, value) stops with smooth steps between them; values are tuples."""
    def at(x):
        if x <= stops[0][0]:
            return stops[0][1]
        for (x0, v0), (x1, v1) in zip(stops, stops[1:]):
            if x <= x1:
                t = _ramp((x - x0) / (x1 - x0))
                return tuple(a + t * (b - a) for a, b in zip(v0, v1))
        return stops[-1][1]
    return at


def _ramp(t):
    t = min(1.0, max(0.0, t))
    return t * t * (3.0 - 2.0 * t)


def _rgbe(colour):
    # Rounded first, so that the last bits of the maths library do not reach the file.
    colour = tuple(round(c, 6) for c in colour)
    largest = max(colour)
    if largest < 1e-6:
        return (0, 0, 0, 0)
    mantissa, exponent = math.frexp(largest)
    scale = 256.0 / 2.0 ** exponent
    return (*(min(255, int(c * scale)) for c in colour), exponent + 128)


def _runs(data):
    out, i = bytearray(), 0
    while i < len(data):
        run = 1
        while i + run < len(data) and run < 127 and data[i + run] == data[i]:
            run += 1
        if run >= 4:
            out += bytes((128 + run, data[i]))
            i += run
            continue
        start = i
        while i < len(data) and i - start < 128:
            if i + 3 < len(data) and data[i] == data[i + 1] == data[i + 2] == data[i + 3]:
                break
            i += 1
        out += bytes((i - start,)) + data[start:i]
    return bytes(out)
