#include "tools/python/bindings/scene.h"

#include <unistd.h>

#include <filesystem>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bake/bake_file.h"
#include "bake/model/model_scene.h"
#include "bake/pack/instances.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/base/error.h"
#include "render/batch/frame.h"
#include "render/make_renderer.h"
#include "render/scene/methods.h"
#include "tools/python/bindings/run.h"

namespace malus::python {
namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

// A file that is removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() : path_((fs::temp_directory_path() / "malus-XXXXXX").string()) {
    const int file = ::mkstemp(path_.data());
    if (file < 0) throw Error(path_, "cannot create", "a writable folder for temporary files (TMPDIR)");
    ::close(file);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::shared_ptr<Scene> load(const fs::path& file) {
  return withoutLock([&] { return std::make_shared<Scene>(pack::read(file)); });
}

// As `malus bake`. output: empty for none.
std::shared_ptr<Scene> bakeScene(const fs::path& file, const std::optional<fs::path>& output, const std::string& camera,
                                 const std::optional<fs::path>& environment, bool allowOpenGlass) {
  return withoutLock([&] {
    const bake::ModelOptions model{camera, environment.value_or(fs::path())};
    const bool isModel = bake::isModelFile(file);
    if (!isModel && (!camera.empty() || environment))
      throw Error(file.string(), "camera and environment are for model files",
                  "glTF, OBJ, PLY, STL or OFF; a scene.json has its own");
    const bake::SceneDescription description = isModel ? bake::describeModel(file, model) : bake::readSceneFile(file);
    std::optional<TemporaryFile> temporary;
    if (!output) temporary.emplace();
    bake::BakeJob job;
    job.output = output ? *output : fs::path(temporary->path());
    job.options.allowOpenGlass = allowOpenGlass;
    job.measure = render::probeDepth;
    job.isForced = !output;
    bake::bakeFile(description, job);
    return std::make_shared<Scene>(pack::read(job.output));
  });
}

// settings: JSON.
Image renderScene(Scene& scene, const std::string& settings, const std::string& backend, const std::string& device,
                  unsigned threads, std::vector<std::uint32_t> region, double tolerance, bool stokes, bool truth) {
  const RenderOptions options{
      render::backendNamed(backend), device, threads, std::move(region), tolerance, stokes, truth};
  return withoutLock([&] { return scene.render(nlohmann::json::parse(settings), options); });
}

py::dict effectReasons(const Scene& scene) {
  py::dict effects;
  for (const pack::Effect& e : scene.scene().effects) effects[py::str(e.name)] = py::make_tuple(e.on, e.reason);
  return effects;
}

std::size_t countTriangles(const Scene& scene) {
  std::size_t count = 0;
  for (const pack::Mesh& mesh : scene.scene().meshes) count += mesh.triangles.size();
  return count;
}

std::vector<std::string> materialNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const pack::Material& material : scene.scene().materials) names.push_back(material.name);
  return names;
}

std::vector<std::string> meshNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const pack::Placement& placement : pack::placements(scene.scene())) names.push_back(placement.name());
  return names;
}

}  // namespace

render::FrameRenderer& Scene::renderer(const RenderOptions& options) {
  std::unique_ptr<render::FrameRenderer>& found = renderers_[{options.backend, options.device, options.threads}];
  if (!found) found = std::make_unique<render::FrameRenderer>(pack_, options.backend, options.device, options.threads);
  return *found;
}

Image Scene::render(const nlohmann::json& settings, const RenderOptions& options) {
  const std::lock_guard lock(rendering_);
  render::FrameDefaults defaults;
  defaults.job.backend = options.backend;
  defaults.job.method = render::completeRecursiveMethod().name;
  defaults.job.region = options.region;
  defaults.job.tolerance = options.tolerance;
  std::vector<std::string> outputs = {options.stokes ? "exr" : "png"};
  if (options.truth) outputs.emplace_back("truth");
  defaults.outputs = render::FrameOutputs(outputs, "render");
  render::FrameRenderer& renderer = this->renderer(options);
  const render::Frame frame =
      render::readFrame({0, pack_.scene.name, 0, settings, "render"}, defaults, renderer.scene());
  render::RenderedFrame rendered = renderer.render(frame);
  return {std::move(rendered), render::backendInfo(options.backend).name, renderer.device(), frame.exposureEv};
}

void addScene(py::module_& module) {
  using namespace py::literals;
  py::class_<Scene, std::shared_ptr<Scene>>(module, "_Scene")
      .def_property_readonly("name", [](const Scene& s) { return s.scene().name; })
      .def_property_readonly("width", [](const Scene& s) { return s.scene().width; })
      .def_property_readonly("height", [](const Scene& s) { return s.scene().height; })
      .def_property_readonly("depth", [](const Scene& s) { return s.scene().depth; })
      .def_property_readonly("triangles", &countTriangles)
      .def_property_readonly("materials", &materialNames)
      .def_property_readonly("meshes", &meshNames)
      .def_property_readonly("effects", &effectReasons)
      .def("render", &renderScene, "settings"_a, "backend"_a, "device"_a, "threads"_a, "region"_a, "tolerance"_a,
           "stokes"_a, "truth"_a);
  module.def("_load", &load, "file"_a);
  module.def("_bake", &bakeScene, "file"_a, "output"_a, "camera"_a, "environment"_a, "allow_open_glass"_a);
}

}  // namespace malus::python
