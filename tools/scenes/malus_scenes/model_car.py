"""The model car: a car-like body with coated paint, windows, chrome and headlamps, on asphalt in a
studio of three area lamps and a spot light."""
import math

from . import model_textures as images
from .gltf_file import Model
from .shapes import placed
from .surface import Surface, box, disc, flipped, grid, lathe, quad, smooth_lathe, tube

EXTENSIONS = ("KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
              "KHR_materials_transmission")
LENGTH, AXLE = 4.3, 1.30


def superellipse(angle, width, height, exponent):
    """Point (z, y) of a superellipse; its normal is outside as the angle grows."""
    c, s = math.cos(angle), math.sin(angle)
    return (width * math.copysign(abs(c) ** (2 / exponent), c), height * math.copysign(abs(s) ** (2 / exponent), s))


def body():
    """Closed hull from the rear (u = 0) to the front (u = 1)."""
    def at(u, v):
        x = LENGTH * (u - 0.5)
        end = min(1.0, abs(2 * u - 1))
        shrink = max(0.0, 1 - end ** 8) ** 0.5
        width = 0.86 * shrink * (1 - 0.06 * end * end)
        belt = 0.92 - 0.16 * max(0.0, u - 0.55) / 0.45 - 0.04 * max(0.0, 0.25 - u) / 0.25
        bottom = 0.20
        middle = 0.5 * (belt + bottom)
        z, y = superellipse(2 * math.pi * (0.0 if v == 1 else v), width, 0.5 * (belt - bottom) * (0.35 + 0.65 * shrink), 3.4)
        return (x, middle + y, -z)
    return grid(at, 60, 40, repeats=(4.0, 4.0))


def cabin(u, v):
    """Cabin from the rear window (u = 0) to the windscreen (u = 1), from the right sill (v = 0) over the roof."""
    centre, half = -0.22, 1.28
    lean = math.copysign(abs(math.cos(math.pi * (1 - u))) ** 0.8, math.cos(math.pi * (1 - u)))
    rise = max(0.0, math.sin(math.pi * u)) ** 0.45
    angle = math.pi * v
    c, s = math.cos(angle), math.sin(angle)
    width = 0.80 - 0.16 * (abs(s) ** 0.8) * rise
    z = width * math.copysign(abs(c) ** 0.75, c)
    y = 0.80 + 0.58 * rise * abs(s) ** 0.6
    return (centre + half * lean, y, -z)


def patch(u, v, columns, rows):
    """Part of the cabin: u and v are (from, to)."""
    return grid(lambda a, b: cabin(u[0] + (u[1] - u[0]) * a, v[0] + (v[1] - v[0]) * b), columns, rows)


def cabin_parts():
    """(windows, painted parts): pillars and roof remain between the windows."""
    columns = [0.04, 0.23, 0.27, 0.50, 0.53, 0.77, 0.81, 0.96]
    lines = [0.05, 0.27, 0.31, 0.69, 0.73, 0.95]
    glass = {(0, 2), (6, 2), (2, 0), (4, 0), (2, 4), (4, 4)}
    windows, painted = Surface(), Surface()
    for i in range(len(columns) - 1):
        for j in range(len(lines) - 1):
            part = patch(columns[i:i + 2], lines[j:j + 2], 8, 10 if j == 2 else 5)
            (windows if (i, j) in glass else painted).add(part)
    return windows, painted


def wheel():
    """(tyre, rim) about the axle +y, which points outward."""
    tread = [(0.30 + 0.03 * math.sin(math.radians(a)), -0.10 + 0.20 * a / 180) for a in range(0, 181, 15)]
    tyre = smooth_lathe([(0.20, -0.10), *tread, (0.20, 0.10)], 48)
    rim = flipped(lathe([(0.18, 0.02), (0.185, 0.09), (0.20, 0.105), (0.215, 0.085)], 48))
    for k in range(5):
        turn = placed((0.0, 0.0, 0.0), (0.0, 72.0 * k, 0.0))
        rim.add(box((0.15, 0.02, 0.045), (0.11, 0.075, 0.0)), turn)
    rim.add(smooth_lathe([(0.05, 0.05), (0.05, 0.09), (0.03, 0.10), (0.0, 0.10)], 24))
    return tyre, rim.add(disc(0.19, 48, 0.015))


def trim():
    """Chrome: bumpers, a line along each side, mirrors, a bar in the grille."""
    surface = Surface()
    for sign in (-1, 1):
        path = [(sign * (2.02 + 0.12 * math.cos(math.radians(a))), 0.40, -0.78 * math.sin(math.radians(a)))
                for a in range(-90, 91, 10)]
        surface.add(tube(path if sign > 0 else path[::-1], 0.035, 16))
        line = [(-1.5 + 0.25 * k, 0.66, -sign * 0.865) for k in range(13)]
        surface.add(tube(line, 0.012, 12))
        mirror = [(0.07 * math.cos(math.radians(a)), 0.07 * math.sin(math.radians(a))) for a in range(-90, 91, 15)]
        mirror[0], mirror[-1] = (0.0, -0.07), (0.0, 0.07)
        surface.add(smooth_lathe(mirror, 24), placed((0.62, 0.98, -sign * 0.90)))
    return surface


def headlamps():
    """(rings of chrome, lenses that emit)."""
    cups, lamps = Surface(), Surface()
    for z in (-0.56, 0.56):
        place = placed((2.005, 0.60, z), (0.0, 0.0, -90.0))
        ring = smooth_lathe([(0.10, 0.0), (0.105, 0.10), (0.095, 0.10), (0.09, 0.02)], 32)
        cups.add(ring, place)
        lamps.add(disc(0.085, 32, 0.06), place)
    return cups, lamps


def materials(model):
    ground, flakes = images.asphalt(), images.octaves(64, 16, 2, 8)
    coat = {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.0}}
    return {
        "paint": model.material("paint", (1, 1, 1, 1), roughness=0.5, extensions=coat, maps={"baseColorTexture": {
            "index": model.image_texture("flakes", images.blended(flakes, (0.50, 0.03, 0.05), (0.62, 0.07, 0.08)))}}),
        "window": model.material("window", (0.75, 0.85, 0.80, 1.0), roughness=0.0, extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1.0}}),
        "chrome": model.material("chrome", (0.55, 0.556, 0.554, 1.0), 1.0, 0.0),
        "tyre": model.material("tyre", (0.02, 0.02, 0.02, 1.0), roughness=0.9),
        "seats": model.material("seats", (0.10, 0.07, 0.05, 1.0), roughness=0.8),
        "plate": model.material("plate", roughness=0.4, maps={"baseColorTexture": {
            "index": model.image_texture("plate", images.plate(), wrapS=33071, wrapT=33071)}}),
        "lamp": model.material("lamp", (0, 0, 0, 1), emissiveFactor=[1.0, 0.95, 0.85], extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 6.0}}),
        "asphalt": model.material(
            "asphalt", roughness=1.0,
            maps={"baseColorTexture": {"index": model.image_texture(
                "asphalt", images.blended(ground, (0.14, 0.14, 0.15), (0.42, 0.42, 0.43)))},
                "metallicRoughnessTexture": {"index": model.image_texture(
                    "asphalt-roughness", images.roughness_map(images.octaves(64, 4, 2, 15), 0.2, 0.9, 0.0))}},
            normalTexture={"index": model.image_texture("asphalt-normals", images.normal_map(images.asphalt(128, 2), 1.0))}),
        "backdrop": model.material("backdrop", (0.55, 0.56, 0.58, 1.0), roughness=1.0),
        "soft box": model.material("soft box", (0, 0, 0, 1), emissiveFactor=[1.0, 0.98, 0.95], extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 4.0}}),
    }


def backdrop():
    """Wall behind the car that curves into the ground."""
    radius, far, half, height = 1.5, 5.5, 8.0, 5.0

    def at(u, v):
        # Half of the length is the curve, half the wall.
        angle = 0.5 * math.pi * min(1.0, 2 * v)
        z = -far + radius * (1 - math.sin(angle)) + 0.0
        y = radius * (1 - math.cos(angle)) + max(0.0, 2 * v - 1) * (height - radius)
        return (half * (2 * u - 1), y, z)
    return grid(at, 4, 24)


def soft_boxes():
    """Lamps above, beside and in front of the car, which face it."""
    above = quad((-2.6, 3.6, -1.4), (2.6, 3.6, -1.4), (2.6, 3.6, 1.0), (-2.6, 3.6, 1.0))
    side = quad((3.0, 0.4, 5.0), (-3.0, 0.4, 5.0), (-3.0, 2.4, 5.0), (3.0, 2.4, 5.0))
    front = quad((5.5, 0.5, 1.2), (5.5, 0.5, -1.4), (5.5, 2.2, -1.4), (5.5, 2.2, 1.2))
    return above.add(side).add(flipped(front))


def write(path):
    """Writes the file."""
    model = Model("car", EXTENSIONS)
    m = materials(model)
    windows, painted = cabin_parts()
    tyre, rim = wheel()
    cups, lamps = headlamps()
    seats = Surface()
    for x in (-0.15, -0.75):
        for z in (-0.34, 0.34):
            seats.add(box((0.45, 0.12, 0.48), (x, 0.93, z))).add(box((0.12, 0.34, 0.46), (x - 0.2, 1.12, z)))
    plate = quad((0.0, -0.06, 0.26), (0.0, -0.06, -0.26), (0.0, 0.06, -0.26), (0.0, 0.06, 0.26))

    car = model.node("car")

    def add(name, *primitives, **keys):
        model.node(name, car, mesh=model.mesh(name, *((s, m[material]) for s, material in primitives)), **keys)

    add("body", (body(), "paint"), (painted, "paint"))
    add("windows", (windows, "window"))
    add("trim", (trim(), "chrome"), (cups, "chrome"))
    add("headlamps", (lamps, "lamp"))
    add("seats", (seats, "seats"))
    add("plate", (plate, "plate"), translation=[2.165, 0.40, 0.0])
    mesh = model.mesh("wheel", (tyre, m["tyre"]), (rim, m["chrome"]))
    for name, x, z in (("front left", AXLE, -1), ("front right", AXLE, 1), ("rear left", -AXLE, -1), ("rear right", -AXLE, 1)):
        model.node(f"wheel {name}", car, mesh=mesh, translation=[x, 0.33, z * 0.80],
                   rotation=[z * 0.707107, 0.0, 0.0, 0.707107])
    ground = quad((-8.0, 0.0, 7.0), (8.0, 0.0, 7.0), (8.0, 0.0, -4.0), (-8.0, 0.0, -4.0), (12.0, 8.25)).with_tangents()
    model.node("ground", mesh=model.mesh("ground", (ground, m["asphalt"])))
    model.node("backdrop", mesh=model.mesh("backdrop", (backdrop(), m["backdrop"])))
    model.node("soft boxes", mesh=model.mesh("soft boxes", (soft_boxes(), m["soft box"])))
    model.light("spot", (4.0, 3.0, 4.0), (1.0, 0.5, 0.5), type="spot", intensity=25.0, color=[1.0, 0.93, 0.82],
                spot={"innerConeAngle": 0.2, "outerConeAngle": 0.45})
    model.camera("three-quarter", (4.2, 1.5, 3.6), (0.15, 0.55, 0.0), math.radians(36.0), 1.6)
    model.write(path)
