"""Scene written by Blender's exporter: blender --background --factory-startup --python blender_scene.py -- FILE.glb

Textured floor, a glass body, a metal with a normal map, painted instances, an emitting plane, a spot light, a sun and a
camera."""
import math
import sys

import bpy

IMAGE_SIZE = 64


def image(name, colour, data=False):
    """colour: function of (x, y) in pixels to (red, green, blue), 0 to 1."""
    made = bpy.data.images.new(name, IMAGE_SIZE, IMAGE_SIZE)
    if data:
        made.colorspace_settings.name = "Non-Color"
    pixels = []
    for y in range(IMAGE_SIZE):
        for x in range(IMAGE_SIZE):
            pixels += [*colour(x, y), 1.0]
    made.pixels = pixels
    made.pack()
    return made


def material(name, **inputs):
    """inputs: of the node Principled BSDF, with '_' for ' '."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    node = made.node_tree.nodes["Principled BSDF"]
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    return made, node


def textured(made, node, socket, colours, normal=False):
    tree = made.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = colours
    if not normal:
        tree.links.new(texture.outputs["Color"], node.inputs[socket])
        return
    between = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(texture.outputs["Color"], between.inputs["Color"])
    tree.links.new(between.outputs["Normal"], node.inputs["Normal"])


def give(made, smooth=False):
    made_object = bpy.context.object
    made_object.data.materials.append(made)
    if smooth:
        bpy.ops.object.shade_smooth()
    return made_object


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    checks, node = material("checks", Roughness=0.9)
    textured(checks, node, "Base Color", image("checks", lambda x, y: (0.8, 0.78, 0.7) if (x // 8 + y // 8) % 2 else (0.1, 0.12, 0.2)))
    bpy.ops.mesh.primitive_plane_add(size=8)
    give(checks)

    glass, _ = material("glass", Transmission=1.0, Roughness=0.0, IOR=1.5)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.6, location=(-1.3, -0.4, 0.61), segments=48, ring_count=24)
    give(glass, smooth=True)

    waves, node = material("waves", Base_Color=(0.9, 0.9, 0.92, 1), Metallic=1.0, Roughness=0.0)
    textured(waves, node, "Normal", image("waves", lambda x, y: (0.5 + 0.15 * math.sin(x / 64 * 4 * math.pi), 0.5, 0.97), data=True), normal=True)
    bpy.ops.mesh.primitive_cube_add(size=1.2, location=(0.3, 0.9, 0.6), rotation=(0, 0, 0.5))
    give(waves)

    paint, _ = material("paint", Base_Color=(0.5, 0.05, 0.03, 1), Roughness=0.05)
    bpy.ops.mesh.primitive_monkey_add(size=0.9, location=(1.4, -0.6, 0.6), rotation=(-0.4, 0, 0.4))
    head = give(paint, smooth=True)
    for i in range(3):
        copy = bpy.data.objects.new(f"copy {i}", head.data)
        copy.location, copy.scale = (-1.5 + 1.5 * i, 2.5, 0.5), (0.6, 0.6, 0.6)
        bpy.context.collection.objects.link(copy)

    lamp, _ = material("lamp", Base_Color=(0, 0, 0, 1), Emission=(1, 0.95, 0.85, 1), Emission_Strength=6.0)
    bpy.ops.mesh.primitive_plane_add(size=1.5, location=(0, 0, 4), rotation=(math.pi, 0, 0))
    give(lamp)

    bpy.ops.object.light_add(type="SUN", location=(3, -3, 5), rotation=(0.7, 0.3, 0.4))
    bpy.context.object.data.energy = 2.0
    bpy.ops.object.light_add(type="SPOT", location=(-3, -3, 4), rotation=(0.75, 0, -0.78))
    bpy.context.object.data.energy = 600
    bpy.ops.object.camera_add(location=(0.5, -6.5, 2.6), rotation=(1.25, 0, 0.07))
    bpy.context.scene.camera = bpy.context.object
    bpy.ops.export_scene.gltf(filepath=sys.argv[-1], export_format="GLB", export_cameras=True, export_lights=True,
                              export_tangents=True)


main()
