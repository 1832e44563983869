// Prints the reflectance of glass at normal incidence, and what a pack holds.
#include <cstdio>
#include <exception>

#include "bake/pack/reader.h"
#include "shaders/optics/optics.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::printf("R %.6f\n", malus::f64::dielectricReflectance(1.0, 1.0, 1.5).rs);
    const malus::pack::Pack pack = malus::pack::read(argv[1]);
    std::printf("%s: %zu meshes, %llu vertices\n", pack.scene.name.c_str(), pack.scene.meshes.size(),
                static_cast<unsigned long long>(pack.scene.vertexCount()));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 1;
  }
}
