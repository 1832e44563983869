"""The model watch: a wristwatch with a coated crystal over a printed dial, brushed and polished steel, and a leather
strap, between two lamps. Millimetres are written as thousandths of a metre."""
import math

from . import model_textures as images
from .gltf_file import Model
from .shapes import placed
from .surface import Surface, box, disc, flipped, grid, lathe, quad, smooth_lathe

MM = 0.001
EXTENSIONS = ("KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
              "KHR_materials_iridescence", "KHR_materials_transmission", "KHR_materials_volume")


def scaled(profile):
    return [(radius * MM, y * MM) for radius, y in profile]


def arc(centre, radius, first, last, pieces):
    """Profile of a circular arc, between angles in degrees from the direction of the radius."""
    return [(centre[0] + radius * math.cos(math.radians(first + (last - first) * k / pieces)),
             centre[1] + radius * math.sin(math.radians(first + (last - first) * k / pieces)))
            for k in range(pieces + 1)]


def crystal():
    """Closed body: a cylinder of 15.5 mm with a domed top."""
    dome = [(15.5 * math.cos(math.radians(a)), 8.2 + 1.1 * math.sin(math.radians(a))) for a in range(0, 91, 6)]
    dome[-1] = (0.0, 9.3)
    body = lathe(scaled([(0.0, 7.0), (15.5, 7.0), (15.5, 8.2)]), 72)
    return body.add(smooth_lathe(scaled(dome), 72))


def hand(length, width, height, angle_degrees):
    turn = placed((0.0, 0.0, 0.0), (0.0, -angle_degrees, 0.0))
    blade = box((width * MM, 0.25 * MM, length * MM), (0.0, height * MM, (-0.5 * length + 2.2) * MM))
    return Surface().add(blade, turn)


def strap(side):
    """Half of the strap, bent downward. side: +1 toward the camera, -1 away from it. Closed across its width."""
    def at(u, v):
        angle = 2 * math.pi * (0.0 if u == 1 else u)
        along = 17.0 + 30.0 * v
        sag = -9.0 * (v * v)
        taper = 10.0 - 1.5 * v
        # Superellipse of exponent 4: flat above and below, rounded at the edges.
        c, s = math.cos(angle), math.sin(angle)
        x = taper * math.copysign(abs(c) ** 0.5, c)
        y = 2.4 + 1.4 * math.copysign(abs(s) ** 0.5, s) + sag
        return (x * MM * side, y * MM, along * side * MM)
    return grid(at, 40, 20, repeats=(2.0, 3.0))


def lugs():
    surface = Surface()
    for x in (-12.3, 12.3):
        for z in (-17.5, 17.5):
            surface.add(box((3.4 * MM, 5.0 * MM, 9.0 * MM), (x * MM, 3.2 * MM, z * MM), per_metre=100))
    return surface


def crown():
    knurled = [(2.6 if k % 2 else 2.9, 19.0 + 0.35 * k) for k in range(9)]
    return Surface().add(lathe(scaled([(0.0, 18.6), (2.6, 18.6), *knurled, (0.0, 22.4)]), 32),
                         placed((0.0, 4.5 * MM, 0.0), (0.0, 0.0, -90.0)))


def materials(model):
    brushed = images.brushed()
    marks = model.image_texture("brushed-roughness", images.roughness_map(brushed, 0.22, 0.40))
    relief = model.image_texture("brushed-normals", images.normal_map(brushed, 0.25))
    skin = images.leather()
    steel = (0.56, 0.57, 0.58, 1.0)
    return {
        "steel": model.material("polished steel", steel, 1.0, 0.05),
        "brushed": model.material("brushed steel", steel, 1.0, 1.0, {"metallicRoughnessTexture": {"index": marks}},
                                  normalTexture={"index": relief, "scale": 0.5}),
        "gold": model.material("gold", (1.0, 0.77, 0.34, 1.0), 1.0, 0.08),
        "dial": model.material("dial", metallic=1.0, roughness=0.0, maps={"baseColorTexture": {
            "index": model.image_texture("dial", images.dial(), wrapS=33071, wrapT=33071)}}),
        "leather": model.material(
            "leather", roughness=0.6,
            maps={"baseColorTexture": {"index": model.image_texture(
                "leather", images.blended(skin, (0.20, 0.11, 0.07), (0.42, 0.24, 0.14)))}},
            normalTexture={"index": model.image_texture("leather-normals", images.normal_map(skin, 3.0))}),
        # A quarter wave of magnesium fluoride on sapphire.
        "crystal": model.material(
            "sapphire", roughness=0.0, extensions={
                "KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": 1.77},
                "KHR_materials_volume": {"thicknessFactor": 0.002},
                "KHR_materials_iridescence": {"iridescenceFactor": 1.0, "iridescenceIor": 1.38,
                                              "iridescenceThicknessMaximum": 97.0}}),
        "table": model.material("table", (0.035, 0.035, 0.04, 1.0), roughness=0.09),
        "lamp": model.material("lamp", (0, 0, 0, 1), emissiveFactor=[1.0, 0.98, 0.94], extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 12.0}}),
    }


def write(path):
    """Writes the file."""
    model = Model("watch", EXTENSIONS)
    m = materials(model)
    case = [(0.0, 0.2), (16.5, 0.2), (18.6, 1.6), (18.6, 5.6), (17.6, 6.4)]
    bezel = arc((16.2, 7.0), 1.4, -25.0, 150.0, 10)
    parts = [
        ("case", (lathe(scaled(case), 72, (8.0, 1.0)).with_tangents(), m["brushed"]), (lugs().with_tangents(), m["brushed"])),
        ("bezel", (smooth_lathe(scaled(bezel), 96), m["steel"]), (crown(), m["steel"])),
        ("dial", (disc(15.3 * MM, 72, 4.6 * MM), m["dial"])),
        ("hands", (hand(9.5, 1.1, 5.3, 305.0).add(hand(13.5, 0.8, 5.8, 50.0)), m["gold"]),
         (hand(14.0, 0.25, 6.2, 200.0).add(lathe(scaled([(0.9, 4.6), (0.9, 6.5), (0.0, 6.5)]), 24)), m["steel"])),
        ("crystal", (crystal(), m["crystal"])),
        ("strap", (strap(1).with_tangents(), m["leather"]), (strap(-1).with_tangents(), m["leather"])),
    ]
    watch = model.node("watch", rotation=[0.0, 0.087156, 0.0, 0.996195])
    for name, *primitives in parts:
        model.node(name, watch, mesh=model.mesh(name, *primitives))
    ground = quad((-0.4, -7.5 * MM, 0.25), (0.4, -7.5 * MM, 0.25), (0.4, -7.5 * MM, -0.4), (-0.4, -7.5 * MM, -0.4))
    model.node("table", mesh=model.mesh("table", (ground, m["table"])))
    above = quad((-0.12, 0.16, -0.24), (-0.03, 0.16, -0.24), (-0.03, 0.19, -0.12), (-0.12, 0.19, -0.12))
    right = quad((0.14, 0.05, 0.06), (0.14, 0.05, -0.12), (0.12, 0.17, -0.12), (0.12, 0.17, 0.06))
    model.node("lamps", mesh=model.mesh("lamps", (above.add(flipped(right)), m["lamp"])))
    model.light("spot", (0.05, 0.25, 0.15), (0.0, 0.0, 0.0), type="spot", intensity=0.4, color=[1.0, 0.95, 0.9],
                spot={"innerConeAngle": 0.1, "outerConeAngle": 0.3})
    model.camera("close", (0.035, 0.085, 0.075), (0.0, 0.002, 0.002), math.radians(32.0), 1.3333)
    model.write(path)
