"""Scene written by trimesh: trimesh_scene.py FILE.glb

A textured ground, a metal sphere, a painted torus placed three times and an emitting plane; no camera, no lights."""
import sys

import numpy
import trimesh
from PIL import Image
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial


def coloured(mesh, **material):
    mesh.visual = TextureVisuals(uv=numpy.zeros((len(mesh.vertices), 2)), material=PBRMaterial(**material))
    return mesh


def ground():
    mesh = trimesh.Trimesh([[-3, 0, 3], [3, 0, 3], [3, 0, -3], [-3, 0, -3]], [[0, 1, 2], [0, 2, 3]], process=False)
    y, x = numpy.mgrid[0:64, 0:64]
    checks = numpy.where(((x // 8 + y // 8) % 2)[..., None], [220, 215, 200], [40, 46, 70]).astype(numpy.uint8)
    material = PBRMaterial(name="checks", baseColorTexture=Image.fromarray(checks), metallicFactor=0.0, roughnessFactor=0.2)
    mesh.visual = TextureVisuals(uv=[[0, 0], [2, 0], [2, 2], [0, 2]], material=material)
    return mesh


def main():
    scene = trimesh.Scene()
    scene.add_geometry(ground(), geom_name="ground")
    sphere = coloured(trimesh.creation.icosphere(4, 0.7), name="steel", baseColorFactor=[145, 148, 150, 255], metallicFactor=1.0,
                      roughnessFactor=0.0)
    scene.add_geometry(sphere, geom_name="sphere", transform=trimesh.transformations.translation_matrix([-0.8, 0.71, 0]))
    torus = coloured(trimesh.creation.torus(0.4, 0.15), name="paint", baseColorFactor=[30, 80, 170, 255], metallicFactor=0.0,
                     roughnessFactor=0.05)
    for i in range(3):
        scene.add_geometry(torus, geom_name="torus", node_name=f"torus {i}",
                           transform=trimesh.transformations.translation_matrix([0.9, 0.7, 0.9 - 0.9 * i]))
    lamp = coloured(trimesh.Trimesh([[-1, 3, 1], [-1, 3, -1], [1, 3, -1], [1, 3, 1]], [[0, 2, 1], [0, 3, 2]][::-1]),
                    name="lamp", baseColorFactor=[0, 0, 0, 255], emissiveFactor=[1.0, 0.95, 0.9], doubleSided=True)
    scene.add_geometry(lamp, geom_name="lamp")
    scene.export(sys.argv[1])


main()
