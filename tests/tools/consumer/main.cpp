// consumer IN.pack OUT.pack: evaluates Fresnel's equations, reads a pack, writes it again and compares the geometry.
#include <malus/base/error.h>
#include <malus/optics/optics.h>
#include <malus/pack/reader.h>
#include <malus/pack/writer.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    std::printf("R %.6f\n", malus::f64::dielectricReflectance(1.0, 1.0, 1.5).rs);
    const malus::pack::Pack pack = malus::pack::read(argv[1]);
    std::printf("%s: %zu meshes, %llu vertices\n", pack.scene.name.c_str(), pack.scene.meshes.size(),
                static_cast<unsigned long long>(pack.scene.vertexCount()));
    malus::pack::write(argv[2], pack.scene, {});
    const malus::pack::Pack copy = malus::pack::read(argv[2]);
    const bool same = copy.scene.name == pack.scene.name && copy.scene.vertexCount() == pack.scene.vertexCount() &&
                      copy.scene.materials.size() == pack.scene.materials.size();
    std::printf("written: %s\n", same ? "same scene" : "another scene");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 1;
  }
  try {
    malus::pack::read("/no/such.pack");
  } catch (const malus::Error& error) {
    std::printf("error: %s\n", error.what());
    return 0;
  }
  return 1;
}
