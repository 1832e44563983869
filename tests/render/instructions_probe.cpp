// Images by the Embree renderer for callgrind: one dump per image, of the call of the renderer. Arguments: PACK METHOD
// OFF EFFECTS for each image; OFF is an effect to leave out or "-", EFFECTS is "auto", "all", or "DEPTH=n" for auto at
// that depth. The method is not replaced by a cheaper one.
#include <valgrind/callgrind.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "bake/effects/effects.h"
#include "bake/pack/reader.h"
#include "meshprep/base/error.h"
#include "render/embree/renderer.h"

// Wide enough that the scheduler and the allocator, some 2000 instructions per image, are below 0.2 % of the least
// work.
constexpr std::uint32_t kWidth = 48;

int main(int argc, char** argv) {
  using namespace malus;
  if (argc < 5 || argc % 4 != 1) {
    std::fprintf(stderr, "usage: instructions_probe (PACK METHOD OFF auto|all|DEPTH=n)...\n");
    return 2;
  }
  try {
    for (int i = 1; i + 3 < argc; i += 4) {
      const std::string pack = argv[i], method = argv[i + 1], off = argv[i + 2], effects = argv[i + 3];
      pack::Scene scene = pack::read(pack).scene;
      if (off != "-") scene = bake::withoutEffects(std::move(scene), {off});
      render::RenderParameters parameters = render::defaultParameters(scene);
      parameters.height = std::max(1u, parameters.height * kWidth / parameters.width);
      parameters.width = kWidth;
      parameters.region = {0, 0, parameters.width, parameters.height};
      parameters.everyEffect = effects == "all";
      if (effects.starts_with("DEPTH=")) parameters.depth = static_cast<std::uint32_t>(std::stoul(effects.substr(6)));
      embree::Renderer renderer(scene, 1);
      renderer.render(method, parameters);  // starts the scheduler
      CALLGRIND_TOGGLE_COLLECT;
      renderer.render(method, parameters);
      CALLGRIND_TOGGLE_COLLECT;
      CALLGRIND_DUMP_STATS_AT("image");
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "instructions_probe: %s\n", error.what());
    return 1;
  }
  return 0;
}
