#include "tools/python/bindings/compare.h"

#include <filesystem>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "meshprep/base/console.h"
#include "render/compare/comparison.h"
#include "render/compare/results.h"
#include "render/pack_input.h"
#include "render/scene/methods.h"
#include "tools/python/bindings/run.h"

namespace malus::python {
namespace py = pybind11;

namespace {

std::string compare(const std::vector<std::filesystem::path>& packs, const std::filesystem::path& folder,
                    std::vector<std::string> methods, const std::vector<std::string>& backends,
                    std::optional<std::uint32_t> width, std::uint32_t rounds, double minutes,
                    std::optional<double> polarizer, unsigned threads, const std::string& device) {
  render::ComparisonSettings settings;
  settings.methods = methods.empty() ? render::methodNames() : std::move(methods);
  settings.backends.clear();
  for (const std::string& name : backends) settings.backends.push_back(render::backendNamed(name));
  if (width) settings.widths = {*width};
  settings.rounds = rounds;
  settings.minutes = minutes;
  settings.polarizerDegrees = polarizer;
  settings.threads = threads;
  settings.device = device;
  return withoutLock([&] {
    std::filesystem::create_directories(folder / "images");
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& file : packs) files.emplace_back(render::packFile({file.string(), {}}));
    const render::Comparison comparison =
        render::compare(files, settings, folder, console::progress, [](const render::Comparison&) {});
    if (comparison.interrupted) throw Interrupted{};
    return render::toJson(comparison, settings).dump();
  });
}

}  // namespace

void addCompare(py::module_& module) {
  using namespace py::literals;
  module.def("_compare", &compare, "packs"_a, "folder"_a, "methods"_a, "backends"_a, "width"_a, "rounds"_a, "minutes"_a,
             "polarizer"_a, "threads"_a, "device"_a);
}

}  // namespace malus::python
