#include "render/bench/ray_file.h"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::render {

void writeRays(const std::string& file, const RaySets::Set& set) {
  writeBeside(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << "malus-rays 1\n";
    for (const RaySets::Class& c : set.classes) {
      const embree::RayClass& kind = c.floor.kind;
      const embree::RayArrays& rays = c.traced;
      out << fmt::format("{} {} {}\n", kind.bounce, kind.shadow ? 1 : 0, rays.size());
      for (const auto* arrays : {&rays.origin, &rays.direction})
        for (const std::vector<float>& array : *arrays)
          out.write(reinterpret_cast<const char*>(array.data()),
                    static_cast<std::streamsize>(array.size() * sizeof(float)));
    }
    if (!out.flush()) throw Error(file, "cannot write the rays", "a disk with free space");
  });
}

}  // namespace malus::render
