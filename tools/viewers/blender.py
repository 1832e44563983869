"""Prints the passes that Blender finds in an EXR image; run by tools/viewers/check inside Blender.

  blender --background --factory-startup --python blender.py -- IMAGE.exr

A file with layers is a multi-layer image, whose passes are the outputs of an image node of the compositor.
"""

import sys

import bpy

image = bpy.data.images.load(sys.argv[sys.argv.index("--") + 1])
bpy.context.scene.use_nodes = True
node = bpy.context.scene.node_tree.nodes.new("CompositorNodeImage")
node.image = image
passes = sorted(output.name for output in node.outputs if output.enabled)
if {"S0", "S1", "S2", "S3"} <= set(passes):
    print(f"viewers/check: Blender {bpy.app.version_string}: type {image.type}, passes {', '.join(passes)}")
