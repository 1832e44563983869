"""Rays per second of malus (Embree, packets, `stokes`) and of Mitsuba 3 on the same scenes.

Run by `tools/mitsuba/compare --speed`. Mitsuba's variant is llvm_ad_spectral_polarized, one sample per pixel through
its centre, Stokes output. Its path ends at diffuse surfaces as that of malus, so that both trace camera rays, specular
rays and a shadow ray per point light; at glass Mitsuba follows one branch and malus both, so that rays per second are
compared, not times of images. Mitsuba is warm: its kernels are compiled by an untimed render. Renders alternate in
rounds. Exit codes: 0, 1 failed (one line), 2 usage.
"""
import argparse
import json
import pathlib
import statistics
import sys
import tempfile
import time

sys.dont_write_bytecode = True

import mitsuba as mi  # noqa: E402

VARIANT = "llvm_ad_spectral_polarized"
mi.set_variant(VARIANT)

import drjit as dr  # noqa: E402

import command  # noqa: E402
import export  # noqa: E402  (needs the variant)
from simplify import write_simplified  # noqa: E402

DEFAULT_SCENES = "cornell-box,engine,glass-wall"
COLOUR = 1  # materials at 532 nm, at every wavelength


class PathToDiffuse(mi.SamplingIntegrator):
    """A path of at most `depth` specular interactions that ends at a diffuse surface, with the point lights there."""

    def __init__(self, properties: mi.Properties):
        super().__init__(properties)
        self.depth = int(properties["depth"])

    def aov_names(self):
        return ["rays"]

    @dr.syntax
    def sample(self, scene, sampler, ray, medium=None, active=True):
        context = mi.BSDFContext()
        ray = mi.Ray3f(ray)
        throughput, light = mi.Spectrum(1.0), mi.Spectrum(0.0)
        rays, left = mi.UInt32(0), mi.UInt32(self.depth)
        active = mi.Bool(active)
        valid = mi.Bool(False)
        while active:
            si = scene.ray_intersect(ray, active)
            rays += 1
            valid |= si.is_valid()
            light += throughput @ si.emitter(scene).eval(si, active)
            bsdf = si.bsdf(ray)
            hit = active & si.is_valid()
            diffuse = hit & mi.has_flag(bsdf.flags(), mi.BSDFFlags.DiffuseReflection)
            for emitter in self.point_lights(scene):
                sample, arriving = emitter.sample_direction(si, mi.Point2f(0.5), diffuse)
                lit = diffuse & ~scene.ray_test(si.spawn_ray_to(sample.p), diffuse)
                rays += dr.select(diffuse, mi.UInt32(1), mi.UInt32(0))
                wo = si.to_local(sample.d)
                value = si.to_world_mueller(bsdf.eval(context, si, wo, lit), -wo, si.wi)
                light += dr.select(lit, throughput @ (value @ arriving), mi.Spectrum(0.0))
            active = hit & mi.has_flag(bsdf.flags(), mi.BSDFFlags.Delta) & (left > 0)
            chosen, weight = bsdf.sample(context, si, sampler.next_1d(active), sampler.next_2d(active), active)
            throughput = throughput @ si.to_world_mueller(weight, -chosen.wo, si.wi)
            ray = si.spawn_ray(si.to_world(chosen.wo))
            left -= 1
        return light, valid, [mi.Float(rays)]

    @staticmethod
    def point_lights(scene):
        return [e for e in scene.emitters() if mi.has_flag(e.flags(), mi.EmitterFlags.DeltaPosition)]


mi.register_integrator("path_to_diffuse", PathToDiffuse)


class Mitsuba:
    """A scene in Mitsuba, with compiled kernels."""

    def __init__(self, unpacked: export.Unpacked, width: int, height: int):
        self.scene = export.mitsuba_scene(unpacked, COLOUR, width, height)
        path = {"type": "path_to_diffuse", "depth": unpacked.depth}
        self.integrator = mi.load_dict({"type": "stokes", "path": path})
        channels = self.render()
        names = [name.split(".")[-1] for name in mi.load_dict({"type": "stokes", "path": path}).aov_names()]
        first = channels.shape[2] - len(names)
        self.rays = int(round(float(dr.sum(channels[:, :, first + names.index("rays")].array)[0])))

    def render(self) -> mi.TensorXf:
        image = mi.render(self.scene, integrator=self.integrator, spp=1)
        dr.eval(image)
        dr.sync_thread()
        return image

    def milliseconds(self) -> float:
        start = time.perf_counter()
        self.render()
        return 1e3 * (time.perf_counter() - start)


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/mitsuba/compare --speed", description=__doc__.splitlines()[0])
    command.add_options(parser, width=768, scenes=DEFAULT_SCENES)
    parser.add_argument("--rounds", type=int, default=7, help="timed renders of each")
    return command.parse(parser, "rounds")


def measure(name: str, given: argparse.Namespace, folder: pathlib.Path) -> dict:
    write_simplified(command.SCENES / name / "scene.json", folder / "scene.json")
    command.malus(given.malus, "bake", folder / "scene.json", "-o", folder / "scene.pack")
    command.malus(given.malus, "unpack", folder / "scene.pack", "-o", folder / "unpacked")
    unpacked = export.Unpacked(folder / "unpacked")
    width, height = unpacked.json["resolution"]
    if width > given.width:
        width, height = given.width, round(given.width * height / width)
    other = Mitsuba(unpacked, width, height)
    ours, theirs, rays = [], [], 0
    for _ in range(given.rounds):
        result = json.loads(command.malus(given.malus, "render", folder / "scene.pack", "--method", "stokes", "--effects", "auto",
                                  "--width", str(width), "--height", str(height), "-o", folder / "a.exr", "--json"))
        rays = result["rays"]
        ours.append(result["traceMs"])
        theirs.append(other.milliseconds())
    per_second = rays / statistics.median(ours) / 1e3, other.rays / statistics.median(theirs) / 1e3
    return {"width": width, "height": height, "rays": rays, "ms": statistics.median(ours), "mitsubaRays": other.rays,
            "mitsubaMs": statistics.median(theirs), "millionRaysPerSecond": per_second[0],
            "mitsubaMillionRaysPerSecond": per_second[1], "ratio": per_second[0] / per_second[1]}


def table(results: dict) -> str:
    rows = ["| scene | malus: rays, ms, M rays/s | Mitsuba: rays, ms, M rays/s | ratio |", "|---|---|---|---|"]
    for name, r in results.items():
        rows.append(f"| {name} | {r['rays']}, {r['ms']:.0f}, {r['millionRaysPerSecond']:.1f} | {r['mitsubaRays']}, "
                    f"{r['mitsubaMs']:.0f}, {r['mitsubaMillionRaysPerSecond']:.1f} | {r['ratio']:.2f} |")
    return "\n".join(rows)


def main() -> int:
    given = options()
    results = {}
    for name in (given.scenes or DEFAULT_SCENES).split(","):
        with tempfile.TemporaryDirectory(prefix="malus-mitsuba-") as folder:
            results[name] = measure(name, given, pathlib.Path(folder))
    print(table(results))
    if given.json:
        report = {"mitsuba": mi.__version__, "variant": VARIANT, "rounds": given.rounds, "scenes": results}
        given.json.write_text(json.dumps(report, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        print(f"mitsuba/compare: {' '.join(str(error).split())}", file=sys.stderr)
        sys.exit(1)
