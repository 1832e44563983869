#include "render/options.h"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "render/method_option.h"
#include "render/scene/methods.h"

namespace malus::render {

void addBackend(CLI::App& command, Backend& backend) {
  command
      .add_option_function<std::string>(
          "--backend", [&backend](const std::string& name) { backend = backendNamed(name); }, "Renderer")
      ->check(CLI::IsMember(backendNames()))
      ->default_str(backendInfo(backend).name);
}

void addMethod(CLI::App& command, std::string& method) {
  command.add_option("--method", method, "Polarization that rays carry (ignored by the reference)")
      ->transform(methodName())
      ->capture_default_str();
}

void addBackends(CLI::App& command, std::vector<Backend>& backends, const char* description) {
  command
      .add_option_function<std::vector<std::string>>(
          "--backends",
          [&backends](const std::vector<std::string>& names) {
            backends.clear();
            for (const std::string& name : names) backends.push_back(backendNamed(name));
          },
          description)
      ->delimiter(',')
      ->check(CLI::IsMember(methodBackendNames()));
}

void addDevice(CLI::App& command, std::string& device, unsigned& threads) {
  command.add_option("--threads", threads, "CPU threads; 0 for all")
      ->transform(wholeNumberBetween(0, 1024))
      ->capture_default_str();
  command.add_option("--device", device,
                     "Vulkan device: number or part of its name from --list-devices (default: the best)");
}

namespace {
// An option whose values are the names of an enumeration, in its order.
template <class Enum, std::size_t N>
void addNamed(CLI::App& command, const char* option, Enum& value, const std::array<const char*, N>& names,
              const char* description) {
  const auto choose = [&value, names](const std::string& name) {
    value = static_cast<Enum>(std::ranges::find(names, name) - names.begin());
  };
  command.add_option_function<std::string>(option, choose, description)
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->default_str(names[static_cast<std::size_t>(value)]);
}
}  // namespace

void addPaths(CLI::App& command, VulkanPath& vulkan, EmbreePath& embree) {
  addNamed(command, "--vulkan-path", vulkan, kVulkanPathNames,
           "Rays of the Vulkan renderer: by pipelines or by ray queries");
  addNamed(command, "--embree-path", embree, kEmbreePathNames,
           "Rays of the Embree renderer: in SIMD packets or one at a time");
}

void addCompression(CLI::App& command, image::ExrCompression& compression) {
  addNamed(command, "--compression", compression, image::kExrCompressionNames,
           "Compression of .exr files: dwaa is lossy, none the fastest");
}

void addExposure(CLI::App& command, std::optional<double>& exposure) {
  command
      .add_option("--exposure", exposure, "Exposure of 8-bit images, mosaics and sensors [stops] (default: the pack's)")
      ->transform(numberBetween(-100, 100));
}

void addView(CLI::App& command, std::string& camera) {
  command
      .add_option(
          "--view", camera,
          "Camera in place of the pack's: JSON with position, target, up, verticalFovDegrees (BATCH.md, camera)")
      ->type_name("JSON");
}

void addSamples(CLI::App& command, std::uint32_t& samples, std::uint32_t& lightSamples) {
  command.add_option("--samples", samples, "Rays per pixel along each axis")
      ->transform(wholeNumberBetween(1, 64))
      ->capture_default_str();
  command
      .add_option("--light-samples", lightSamples,
                  "Shadow rays to area lights, and to the environment, at each diffuse hit")
      ->transform(wholeNumberBetween(1, kMostLightSamples))
      ->capture_default_str();
}

CLI::Option* addFrames(CLI::App& command, unsigned& frames) {
  return command.add_option("--frames", frames, "Number of images")->transform(wholeNumberBetween(1, 100000));
}

void addJobOptions(CLI::App& command, PackInput& input, JobSettings& settings) {
  addPackInput(command, input);
  addBackend(command, settings.backend);
  addMethod(command, settings.method);
  addWidth(command, settings.width);
  addHeight(command, settings.height);
  addDepth(command, settings.depth);
  addSamples(command, settings.samples, settings.lightSamples);
  command.add_option("--region", settings.region, "Part of the image: x y width height [pixels] (default: all of it)")
      ->transform(wholeNumberBetween(0, pack::kMaxResolution))
      ->expected(4);
  addDevice(command, settings.device, settings.threads);
  addPaths(command, settings.vulkanPath, settings.embreePath);
}

void requireStokes(Backend backend, std::string_view method, const std::string& option) {
  if (!backendInfo(backend).hasMethods || methodNamed(method).hasStokes) return;
  std::vector<std::string> able;
  for (const MethodInfo& m : methods())
    if (m.hasStokes) able.push_back(m.name);
  throw CLI::ValidationError(
      option,
      fmt::format("needs Stokes vectors, which method '{}' does not have; use --method {} or --backend reference",
                  method, fmt::join(able, ", ")));
}

}  // namespace malus::render
