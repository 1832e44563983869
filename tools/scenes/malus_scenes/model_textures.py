"""Images of the models' materials, as PNG files."""
import math

from .noise import hashed, noise, octaves
from .texture_files import small_png


def _levels(value, count=32):
    """value from 0 to 1 in steps, so that few colours are left and a palette is enough."""
    return round(min(1.0, max(0.0, value)) * (count - 1)) / (count - 1)


def _mixed(low, high, t):
    return tuple(round(255 * (a + (b - a) * t)) for a, b in zip(low, high))


def blended(rows, low, high):
    """Colours from low to high (0 to 1, encoded as sRGB)."""
    return small_png([[_mixed(low, high, _levels(v)) for v in row] for row in rows])


def roughness_map(rows, low, high, metallic=1.0):
    """Metallic-roughness map: roughness, from low to high, in green, metallic in blue."""
    return small_png([[(255, round(255 * (low + (high - low) * _levels(v))), round(255 * metallic)) for v in row]
                      for row in rows])


def normal_map(rows, strength):
    """Normals of a relief: strength is its height over the width of a texel."""
    size = len(rows)
    out = []
    for y in range(size):
        row = []
        for x in range(size):
            dx = (rows[y][(x + 1) % size] - rows[y][x - 1]) * strength / 2
            dy = (rows[(y + 1) % size][x] - rows[y - 1][x]) * strength / 2
            length = math.sqrt(dx * dx + dy * dy + 1)
            # The second direction of the tangent frame is toward the top of the image.
            row.append(tuple(round(127.5 * (c / length + 1)) for c in (-dx, dy, 1.0)))
        out.append(row)
    return small_png(out)


def planks(size=256, count=4, seed=5):
    """Rows of values of a floor of planks: grain along x, dark joints."""
    grain = noise(size, 32, seed)
    rows = []
    for y in range(size):
        plank, within = divmod(y * count, size)
        joint = within < count * 2
        row = []
        for x in range(size):
            end = (x + hashed(plank, 0, seed) % size) % size < 2
            fibre = grain[y][(x // 8 + plank * 37) % size]
            row.append(0.05 if joint or end else 0.35 + 0.25 * hashed(plank, 1, seed) / 65535 + 0.35 * fibre)
        rows.append(row)
    return rows


def brushed(size=128, seed=9):
    """Rows of values that vary across y, as the marks of a brush do."""
    return [[0.75 * hashed(0, y, seed) / 65535 + 0.25 * hashed(x // 32, y, seed) / 65535 for x in range(size)]
            for y in range(size)]


def leather(size=128, seed=3):
    grain, folds = octaves(size, 16, 2, seed), octaves(size, 4, 2, seed + 7)
    return [[0.6 * abs(2 * g - 1) + 0.4 * f for g, f in zip(a, b)] for a, b in zip(grain, folds)]


def asphalt(size=256, seed=1):
    return octaves(size, 32, 2, seed)


def plaster(size=128, seed=11):
    return octaves(size, 8, 3, seed)


def dial(size=256):
    """Dial of a watch: ticks of minutes and bars of hours on dark blue, with a ring."""
    rows = []
    for y in range(size):
        row = []
        for x in range(size):
            px, py = (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1
            radius = math.hypot(px, py)
            minute = math.degrees(math.atan2(px, -py)) % 6
            hour = math.degrees(math.atan2(px, -py)) % 30
            off_minute, off_hour = (radius * math.radians(min(a, n - a)) for a, n in ((minute, 6), (hour, 30)))
            mark = (0.74 < radius < 0.90 and off_hour < 0.022) or (0.85 < radius < 0.90 and off_minute < 0.007)
            ring = 0.93 < radius < 0.945
            row.append((232, 226, 205) if mark or ring else (14, 24, 58))
        rows.append(row)
    return small_png(rows)


def plate(width=192, height=48):
    """Licence plate: five blocks of bars between a frame."""
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            frame = x < 4 or y < 4 or x >= width - 4 or y >= height - 4
            cell, within = divmod(x - 16, 33)
            inside = 0 <= cell < 5 and 4 <= within < 27 and 10 <= y < height - 10
            stroke = inside and hashed(cell * 4 + within // 6, (y - 10) // 7, 21) % 5 < 3
            row.append((20, 22, 30) if frame or stroke else (236, 236, 228))
        rows.append(row)
    return small_png(rows)


def lattice(size=64, cells=4):
    """Wire mesh: opaque bars, holes with an alpha of 0."""
    cell = size // cells
    return small_png([[(150, 150, 155, 255 if x % cell < 4 or y % cell < 4 else 0) for x in range(size)]
                      for y in range(size)])


def painting(size=128):
    """Coloured rectangles between black lines."""
    colours = [(214, 40, 40), (240, 196, 20), (30, 70, 170), (238, 236, 228), (238, 236, 228), (238, 236, 228)]
    columns, lines = (0, 38, 90, 128), (0, 52, 84, 128)
    rows = []
    for y in range(size):
        j = sum(y >= line for line in lines) - 1
        row = []
        for x in range(size):
            i = sum(x >= column for column in columns) - 1
            black = any(abs(x - c) < 3 for c in columns[1:3]) or any(abs(y - c) < 3 for c in lines[1:3])
            row.append((16, 16, 18) if black else colours[hashed(i, j, 4) % len(colours)])
        rows.append(row)
    return small_png(rows)
