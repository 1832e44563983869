"""The model room: a floor of planks, walls of plaster, a window with a pane, two ceiling lamps, a glass table, a mirror,
a framed painting and a screen of wire mesh."""
import math

from . import model_textures as images
from .gltf_file import Model
from .surface import Surface, box, lathe, quad, smooth_lathe

EXTENSIONS = ("KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
              "KHR_materials_transmission", "KHR_materials_volume", "KHR_texture_transform")
WIDTH, DEPTH, HEIGHT = 4.0, 5.0, 2.6
# The window, in the left wall: from and to, along z and y.
WINDOW = ((-1.6, 0.2), (0.9, 2.2))


def wall(a, b, c, d):
    """Quad counter-clockwise from its bottom left, seen from inside; the image repeats once per metre."""
    return quad(a, b, c, d, (math.dist(a, b), math.dist(a, d)))


def left_wall():
    """Wall around the window."""
    x = -WIDTH / 2
    (z0, z1), (y0, y1) = WINDOW
    surface = Surface()
    for low, high, near, far in ((0.0, y0, DEPTH / 2, -DEPTH / 2), (y1, HEIGHT, DEPTH / 2, -DEPTH / 2),
                                 (y0, y1, DEPTH / 2, z1), (y0, y1, z0, -DEPTH / 2)):
        surface.add(wall((x, low, near), (x, low, far), (x, high, far), (x, high, near)))
    return surface


def walls():
    w, d, h = WIDTH / 2, DEPTH / 2, HEIGHT
    surface = left_wall()
    surface.add(wall((-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)))
    surface.add(wall((w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d)))
    surface.add(wall((w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d)))
    return surface.add(wall((-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)))


def window_frame():
    (z0, z1), (y0, y1) = WINDOW
    x, bar = -WIDTH / 2, 0.06
    surface = Surface()
    for y in (y0, (y0 + y1) / 2, y1):
        surface.add(box((0.08, bar, z1 - z0 + bar), (x, y, (z0 + z1) / 2)))
    for z in (z0 + 0.001, (z0 + z1) / 2, z1 - 0.001):
        surface.add(box((0.07, y1 - y0 - 0.002, bar), (x, (y0 + y1) / 2, z)))
    return surface


def pane():
    (z0, z1), (y0, y1) = WINDOW
    x = -WIDTH / 2 - 0.005
    return quad((x, y0, z1), (x, y0, z0), (x, y1, z0), (x, y1, z1))


def frame(width, height, bar):
    """Frame around a rectangle in the plane z = 0."""
    surface = Surface()
    for side in (-1, 1):
        surface.add(box((width + 2 * bar, bar, 0.04), (0.0, side * (height + bar) / 2, 0.0)))
        surface.add(box((bar, height - 0.001, 0.038), (side * (width + bar) / 2, 0.0, 0.0)))
    return surface


def table_legs():
    surface = Surface()
    for x in (-0.5, 0.5):
        for z in (-0.28, 0.28):
            leg = lathe([(0.0, 0.0), (0.03, 0.0), (0.02, 0.41), (0.0, 0.41)], 24)
            surface.add(leg, lambda p, x=x, z=z: (p[0] + x, p[1], p[2] + z))
    return surface


def vase():
    outside = [(0.0, 0.0), (0.045, 0.0), (0.06, 0.03), (0.07, 0.09), (0.055, 0.16), (0.03, 0.21), (0.04, 0.25)]
    return smooth_lathe(outside, 48)


def materials(model):
    wood, grain, coarse = images.planks(), images.plaster(), images.planks(128)
    twice = {"KHR_texture_transform": {"scale": [0.5, 0.5]}}
    floor = {"baseColorTexture": {"index": model.image_texture(
        "planks", images.blended(wood, (0.16, 0.09, 0.05), (0.68, 0.48, 0.31))), "extensions": twice},
        "metallicRoughnessTexture": {"index": model.image_texture(
            "planks-roughness", images.roughness_map(coarse, 0.5, 0.25, 0.0)), "extensions": twice}}
    relief = {"index": model.image_texture("plaster-normals", images.normal_map(grain, 2.0)), "scale": 0.7}
    glass = {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": 1.52}}
    return {
        "floor": model.material("planks", roughness=1.0, maps=floor),
        "plaster": model.material("plaster", (0.74, 0.72, 0.68, 1.0), roughness=0.9, normalTexture=relief),
        "white": model.material("white paint", (0.8, 0.8, 0.78, 1.0), roughness=0.3),
        "pane": model.material("pane", roughness=0.0, extensions=glass),
        "glass": model.material("table glass", roughness=0.0, extensions={
            **glass, "KHR_materials_volume": {"thicknessFactor": 0.012, "attenuationDistance": 0.4,
                                              "attenuationColor": [0.72, 0.90, 0.80]}}),
        "mirror": model.material("mirror", (0.95, 0.95, 0.95, 1.0), 1.0, 0.0),
        "brass": model.material("brass", (0.89, 0.73, 0.38, 1.0), 1.0, 0.12),
        "ceramic": model.material("ceramic", (0.05, 0.16, 0.32, 1.0), roughness=0.1),
        "painting": model.material("painting", roughness=0.8, maps={"baseColorTexture": {
            "index": model.image_texture("painting", images.painting(), wrapS=33071, wrapT=33071)}}),
        "mesh": model.material("wire mesh", (1, 1, 1, 1), roughness=0.6, alphaMode="MASK", doubleSided=True,
                               maps={"baseColorTexture": {"index": model.image_texture("lattice", images.lattice())}}),
        "lamp": model.material("lamp", (0, 0, 0, 1), emissiveFactor=[1.0, 0.93, 0.82], extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 30.0}}),
        "sky": model.material("sky", (0, 0, 0, 1), emissiveFactor=[0.62, 0.80, 1.0], extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 0.8}}),
    }


def write(path):
    """Writes the file."""
    model = Model("room", EXTENSIONS)
    m = materials(model)
    w, d = WIDTH / 2, DEPTH / 2

    def add(name, surface, material, **keys):
        model.node(name, mesh=model.mesh(name, (surface, m[material])), **keys)

    add("floor", wall((-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)), "floor")
    add("walls", walls().with_tangents(), "plaster")
    add("window frame", window_frame(), "white")
    add("pane", pane(), "pane")
    add("table top", box((1.2, 0.012, 0.7)), "glass", translation=[0.1, 0.417, -0.5])
    add("table legs", table_legs(), "brass", translation=[0.1, 0.0, -0.5])
    add("vase", vase(), "ceramic", translation=[-0.1, 0.424, -0.6])
    back = -d + 0.025
    add("mirror", quad((-0.5, -0.7, 0.0), (0.5, -0.7, 0.0), (0.5, 0.7, 0.0), (-0.5, 0.7, 0.0)), "mirror",
        translation=[-0.8, 1.45, back])
    add("mirror frame", frame(1.0, 1.4, 0.05), "brass", translation=[-0.8, 1.45, back])
    add("painting", quad((-0.4, -0.4, 0.0), (0.4, -0.4, 0.0), (0.4, 0.4, 0.0), (-0.4, 0.4, 0.0)), "painting",
        translation=[0.85, 1.5, back])
    add("painting frame", frame(0.8, 0.8, 0.03), "white", translation=[0.85, 1.5, back])
    add("screen", quad((0.0, 0.0, 0.0), (0.7, 0.0, 0.0), (0.7, 1.3, 0.0), (0.0, 1.3, 0.0), (3.5, 6.5)), "mesh",
        translation=[1.2, 0.0, -1.7], rotation=[0.0, -0.258819, 0.0, 0.965926])

    lamp = model.mesh("lamp", (quad((-0.3, 0, -0.3), (0.3, 0, -0.3), (0.3, 0, 0.3), (-0.3, 0, 0.3)), m["lamp"]))
    for i, z in enumerate((-1.2, 0.9)):
        model.node(f"lamp {i + 1}", mesh=lamp, translation=[0.3, HEIGHT - 0.02, z])
    sky = quad((0, -3, 4), (0, -3, -4), (0, 1.6, -4), (0, 1.6, 4))
    model.node("sky", mesh=model.mesh("sky", (sky, m["sky"])), translation=[-w - 2.5, 1.2, -0.7])
    model.light("sun", (-6.0, 7.0, 1.3), (-2.0, 1.5, -0.7), type="directional", intensity=14.0, color=[1.0, 0.92, 0.8])
    model.camera("door", (1.55, 1.5, 2.3), (-0.35, 0.95, -1.5), math.radians(52.0), 1.5)
    model.write(path)
