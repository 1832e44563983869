"""The scene cornell-box: a box of paint on polished black glass, with a gold and a glass block."""
from .scene import Part, total, write_scene
from .shapes import box, quad, strip

EXPECTED = (74, 38)
HALF, HEIGHT = 1.0, 2.0


def back_and_ceiling():
    """Back wall and ceiling in one sheet, folded once."""
    h, y = HALF, HEIGHT
    return strip([(h, 0.0, -h), (h, y, -h), (h, y, h)], (-2 * h, 0.0, 0.0))


def write(folder):
    h, y = HALF, HEIGHT
    lamp = 0.34
    parts = [
        Part("back-and-ceiling", "white", back_and_ceiling(), "obj", flat=True),
        Part("floor", "black-glass", quad((-h, 0, h), (h, 0, h), (h, 0, -h), (-h, 0, -h)), "off", flat=True),
        Part("left", "red", quad((-h, 0, h), (-h, 0, -h), (-h, y, -h), (-h, y, h)), "ply", flat=True),
        Part("right", "green", quad((h, 0, -h), (h, 0, h), (h, y, h), (h, y, -h)), "ply", flat=True),
        Part("lamp", "lamp", quad((-lamp, 1.995, -lamp), (lamp, 1.995, -lamp), (lamp, 1.995, lamp), (-lamp, 1.995, lamp)),
             "off", flat=True),
        Part("window", "window", quad((0.995, 0.35, 0.0), (0.995, 0.35, 0.8), (0.995, 1.7, 0.8), (0.995, 1.7, 0.0)),
             "ply", flat=True),
        Part("tall-block", "flint", box((0.56, 1.2, 0.56)), "stl",
             instances=[{"rotateDegrees": [0.0, 36.0, 0.0], "translate": [-0.34, 0.601, -0.40]}]),
        Part("short-block", "gold", box((0.46, 0.46, 0.46)).flipped(), "obj", blemishes=(1, 1),
             instances=[{"rotateDegrees": [0.0, -18.0, 0.0], "translate": [0.50, 0.232, 0.12]}]),
    ]
    materials = {
        "black-glass": {"type": "mirror-glass", "eta": 1.9},
        "red": {"type": "paint", "eta": 1.5, "albedo": [0.62, 0.05, 0.04]},
        "green": {"type": "paint", "eta": 1.5, "albedo": [0.1, 0.48, 0.1]},
        "white": {"type": "paint", "eta": 1.5, "albedo": [0.74, 0.72, 0.68]},
        "lamp": {"type": "emitter", "radiance": [11.0, 10.0, 8.4]},
        "window": {"type": "emitter", "radiance": [2.4, 2.6, 2.9]},
        "flint": {"type": "mirror-glass", "eta": 1.9},
        "gold": {"type": "metal", "preset": "gold"},
        "glass": {"type": "glass", "preset": "bk7"},
    }
    settings = {
        "name": "cornell-box", "title": "A Cornell box on black glass",
        "origin": [0.0, 1.0, 0.0],
        "camera": {"position": [0.0, 1.82, 3.3], "target": [0.0, 0.72, 0.0], "up": [0.0, 1.0, 0.0],
                   "verticalFovDegrees": 42.0},
        "resolution": [2048, 2048], "depth": 6, "exposureEv": 0.0,
        "environment": {"radiance": [0.3, 0.3, 0.32], "diffuseFill": 0.5},
        "lights": [{"type": "point", "position": [0.0, 1.9, 0.0], "intensity": [2.4, 2.2, 1.9]}],
    }
    write_scene(folder, settings, materials, parts, EXPECTED, readme="")
    return total(parts)
