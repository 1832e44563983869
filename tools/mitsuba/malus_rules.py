"""Rules of shading of malus (shaders/optics/SHADING.md) that differ from those of Mitsuba's integrators.

- Environment: the octahedral map of malus, looked up in numpy.
- Opaque surfaces have two sides: the frame is rotated to face the ray. (Mitsuba's `twosided` mirrors it, which is not
  a rotation: on the back it returns the Mueller matrix of the mirror image, with wrong signs of S2 and S3; see
  tools/mitsuba/README.md.)
- Interpolated normals: the face normal replaces them if they face away from the ray, or if the mirror direction is
  below the face or the refracted direction above it.
- A point light behind the face gives no light, also if the interpolated normal faces it.
- Basic radiance L/n^2 by the indices of the materials: the environment is in index 1, the light of a surface in its
  outsideEta, the camera in mediumEta. It equals Mitsuba's radiance if every path has these indices, which is not so
  for a ray that leaves a pane without rims between its faces.
- Rays start on their line and shadow rays end at the light. Mitsuba's spawn_ray moves the origin off the line by 1e-4
  of the coordinates, and its shadow rays end early by 1e-3 of their length.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

ORIGIN_STEP = 1e-6  # relative to the largest coordinate of the scene: about 10 roundings in single precision


class Rules:
    """Environment and refractive indices of one scene."""

    def __init__(self, scene: mi.Scene, unpacked, colour: int):
        self.environment = unpacked.environment(colour)
        self.camera_index = unpacked.json["camera"]["mediumEta"]
        outside = {f"mesh{i}": unpacked.materials[mesh["material"]]["outsideEta"]
                   for i, (mesh, _) in enumerate(unpacked.places())}
        box = scene.bbox()
        self.step = ORIGIN_STEP * max(abs(x) for corner in (box.min, box.max) for x in corner)
        shapes = {int(shape_number(mi.ShapePtr(shape))[0]): outside[shape.id()] for shape in scene.shapes()}
        self.outside_index = np.ones(max(shapes) + 1)
        for number, index in shapes.items():
            self.outside_index[number] = index

    def offset_origin(self, si: mi.SurfaceInteraction3f, d: mi.Vector3f) -> mi.Point3f:
        """Returns the origin of a ray that leaves the surface in direction d: on the line, just off the surface."""
        return dr.fma(d, self.step / dr.maximum(dr.abs(dr.dot(si.n, d)), 1e-2), si.p)

    def shadow_ray(self, si: mi.SurfaceInteraction3f, sample: mi.DirectionSample3f) -> mi.Ray3f:
        """Returns the ray to the point light, from off the surface to just before the light."""
        ray = mi.Ray3f(self.offset_origin(si, sample.d), sample.d)
        ray.maxt = sample.dist * (1 - ORIGIN_STEP) - dr.norm(ray.o - si.p)
        return ray

    def source_scale(self, si: mi.SurfaceInteraction3f, index: np.ndarray, hit: np.ndarray) -> np.ndarray:
        """Returns (index of the medium of the ray / index of the medium of the source)^2."""
        number = np.broadcast_to(np.array(shape_number(si.shape)), hit.shape)
        return (index / np.where(hit, self.outside_index[number], 1)) ** 2


def shape_number(shape: mi.ShapePtr) -> mi.UInt32:
    return dr.reinterpret_array(mi.UInt32, shape)


def before_face(si: mi.SurfaceInteraction3f, d: mi.Vector3f) -> mi.Bool:
    """Returns whether direction d is on the side of the face from which the ray came."""
    return dr.dot(si.n, d) * dr.dot(si.n, si.to_world(si.wi)) > 0


def orient_normal(si: mi.SurfaceInteraction3f, ray: mi.Ray3f, bsdf, hit: mi.Bool, smooth: mi.Bool,
                  glass: mi.Bool) -> None:
    """Sets the shading frame."""
    def shade_with(normal):
        si.sh_frame.n = normal
        si.initialize_sh_frame()
        si.wi = si.to_local(-ray.d)

    face = dr.select(dr.dot(si.n, ray.d) < 0, si.n, -si.n)  # faces the ray
    normal = dr.select(dr.dot(si.n, ray.d) < 0, si.sh_frame.n, -si.sh_frame.n)
    c = dr.dot(normal, -ray.d)
    usable = (c > 0) & (dr.dot(face, dr.fma(normal, 2 * c, ray.d)) > 0)
    against = dr.select(usable, normal, face)
    # Glass keeps its orientation, which distinguishes inside and outside.
    outward = dr.select(dr.dot(si.n, ray.d) < 0, against, -against)
    shade_with(dr.select(hit & ~glass, against, outward))

    context = mi.BSDFContext()
    context.type_mask = mi.BSDFFlags.DeltaTransmission
    through, weight = bsdf.sample(context, si, 0.5, mi.Point2f(0.5), glass)
    wrong = glass & (weight[0, 0].x > 0) & (dr.dot(face, si.to_world(through.wo)) >= 0)
    shade_with(dr.select(wrong, si.n, si.sh_frame.n))
