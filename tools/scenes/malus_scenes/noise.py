"""Value noise that repeats, of whole numbers alone, so that it is equal everywhere."""


def hashed(x, y, seed):
    """0 to 65535."""
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 2654435769) & 0xFFFFFFFF
    return h >> 16


def noise(size, cells, seed):
    """Rows of size x size values from 0 to 1, with cells x cells random values between which it is interpolated
    smoothly. size: a multiple of cells."""
    step = size // cells
    rows = []
    for y in range(size):
        j, fy = divmod(y, step)
        ty = (2 * fy + 1) / (2 * step)
        ty = ty * ty * (3 - 2 * ty)
        row = []
        for x in range(size):
            i, fx = divmod(x, step)
            tx = (2 * fx + 1) / (2 * step)
            tx = tx * tx * (3 - 2 * tx)
            a, b, c, d = (hashed((i + p) % cells, (j + q) % cells, seed) / 65535
                          for p, q in ((0, 0), (1, 0), (0, 1), (1, 1)))
            row.append((a + (b - a) * tx) * (1 - ty) + (c + (d - c) * tx) * ty)
        rows.append(row)
    return rows


def octaves(size, cells, count, seed):
    """Sum of noise of doubled cells and halved weight, from 0 to 1."""
    layers = [noise(size, cells << k, seed + k) for k in range(count)]
    total = sum(0.5 ** k for k in range(count))
    return [[sum(layer[y][x] * 0.5 ** k for k, layer in enumerate(layers)) / total for x in range(size)]
            for y in range(size)]
