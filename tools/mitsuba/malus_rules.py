"""Where malus's rules of shading (shaders/optics/SHADING.md) differ from those of Mitsuba's own integrators.

- Environment: malus's octahedral map, looked up in numpy.
- Opaque surfaces have two sides: the frame is turned against the ray. (Mitsuba's `twosided` mirrors it instead,
  which is not a rotation: on the back it returns the Mueller matrix of the mirror image, wrong in the signs of
  S2 and S3; see tools/mitsuba/README.md.)
- Interpolated normals: where they face away from the ray, or send the mirror direction below the face, or the
  refracted direction above it, the face's normal takes their place.
- A point light behind the face gives no light, whatever the interpolated normal says.
- Basic radiance L/n^2 by the materials' word: infinity is in index 1, a surface's light in its outsideEta, the
  camera in mediumEta. The same as Mitsuba's radiance where every path agrees with that; a ray that leaves a pane
  without rims between its faces does not.
- Rays start on their own line and shadow rays end at the light. Mitsuba's spawn_ray moves the origin off the line
  by 1e-4 of the coordinates, and its shadow rays end 1e-3 of their length early.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

ORIGIN_STEP = 1e-6  # of the scene's largest coordinate: some 10 roundings of single precision


class Rules:
    """Environment and refractive indices of one scene, as export.Unpacked describes it."""

    def __init__(self, scene: mi.Scene, unpacked, colour: int):
        self.environment = unpacked.environment(colour)
        self.camera_index = unpacked.json["camera"]["mediumEta"]
        outside = {f"mesh{i}": unpacked.materials[mesh["material"]]["outsideEta"]
                   for i, mesh in enumerate(unpacked.json["meshes"])}
        box = scene.bbox()
        self.step = ORIGIN_STEP * max(abs(x) for corner in (box.min, box.max) for x in corner)
        shapes = {int(shape_number(mi.ShapePtr(shape))[0]): outside[shape.id()] for shape in scene.shapes()}
        self.outside_index = np.ones(max(shapes) + 1)
        for number, index in shapes.items():
            self.outside_index[number] = index

    def on_the_line(self, si: mi.SurfaceInteraction3f, d: mi.Vector3f) -> mi.Point3f:
        """Origin of a ray in direction d that leaves the surface: on its own line, just off the surface."""
        return dr.fma(d, self.step / dr.maximum(dr.abs(dr.dot(si.n, d)), 1e-2), si.p)

    def shadow_ray(self, si: mi.SurfaceInteraction3f, sample: mi.DirectionSample3f) -> mi.Ray3f:
        """Ray to the point light, from off the surface to just before the light."""
        ray = mi.Ray3f(self.on_the_line(si, sample.d), sample.d)
        ray.maxt = sample.dist * (1 - ORIGIN_STEP) - dr.norm(ray.o - si.p)
        return ray

    def source_scale(self, si: mi.SurfaceInteraction3f, index: np.ndarray, hit: np.ndarray) -> np.ndarray:
        """(index of the ray's medium/index that the source is in)^2."""
        number = np.broadcast_to(np.array(shape_number(si.shape)), hit.shape)
        return (index / np.where(hit, self.outside_index[number], 1)) ** 2


def shape_number(shape: mi.ShapePtr) -> mi.UInt32:
    return dr.reinterpret_array(mi.UInt32, shape)


def before_face(si: mi.SurfaceInteraction3f, d: mi.Vector3f) -> mi.Bool:
    """Whether direction d leaves on the side of the face that the ray came from."""
    return dr.dot(si.n, d) * dr.dot(si.n, si.to_world(si.wi)) > 0


def turn_normal(si: mi.SurfaceInteraction3f, ray: mi.Ray3f, bsdf, hit: mi.Bool, smooth: mi.Bool, glass: mi.Bool) -> None:
    """Sets the frame to shade with."""
    def shade_with(normal):
        si.sh_frame.n = normal
        si.initialize_sh_frame()
        si.wi = si.to_local(-ray.d)

    face = dr.select(dr.dot(si.n, ray.d) < 0, si.n, -si.n)  # against the ray
    normal = dr.select(dr.dot(si.n, ray.d) < 0, si.sh_frame.n, -si.sh_frame.n)
    c = dr.dot(normal, -ray.d)
    usable = (c > 0) & (dr.dot(face, dr.fma(normal, 2 * c, ray.d)) > 0)
    against = dr.select(usable, normal, face)
    # Glass tells its side by the normal and keeps its orientation.
    outward = dr.select(dr.dot(si.n, ray.d) < 0, against, -against)
    shade_with(dr.select(hit & ~glass, against, outward))

    context = mi.BSDFContext()
    context.type_mask = mi.BSDFFlags.DeltaTransmission
    through, weight = bsdf.sample(context, si, 0.5, mi.Point2f(0.5), glass)
    wrong = glass & (weight[0, 0].x > 0) & (dr.dot(face, si.to_world(through.wo)) >= 0)
    shade_with(dr.select(wrong, si.n, si.sh_frame.n))
