#include "render/options.h"

#include <map>
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

void addDevice(CLI::App& command, std::string& device, unsigned& threads) {
  command.add_option("--threads", threads, "CPU threads; 0 for all")
      ->transform(wholeNumberBetween(0, 1024))
      ->capture_default_str();
  command.add_option("--device", device,
                     "Vulkan device: number or part of its name from --list-devices (default: the best)");
}

void addVulkanPath(CLI::App& command, VulkanPath& path) {
  std::map<std::string, VulkanPath> paths;
  for (const VulkanPath p : {VulkanPath::automatic, VulkanPath::pipeline, VulkanPath::query})
    paths[vulkanPathName(p)] = p;
  command
      .add_option_function<std::string>(
          "--vulkan-path", [&path, paths](const std::string& name) { path = paths.at(name); },
          "Rays of the Vulkan renderer: by pipelines or by ray queries")
      ->check(CLI::IsMember(std::vector<std::string>(kVulkanPathNames.begin(), kVulkanPathNames.end())))
      ->default_str(vulkanPathName(path));
}

void addExposure(CLI::App& command, std::optional<double>& exposure) {
  command.add_option("--exposure", exposure, "Exposure of 8-bit images and mosaics [stops] (default: the pack's)")
      ->transform(numberBetween(-100, 100));
}

void addJobOptions(CLI::App& command, std::string& pack, JobSettings& settings) {
  command.add_option("pack", pack, "Scene pack")->required()->type_name("PACK");
  addBackend(command, settings.backend);
  addMethod(command, settings.method);
  addWidth(command, settings.width);
  addHeight(command, settings.height);
  addDepth(command, settings.depth);
  command.add_option("--samples", settings.samples, "Rays per pixel along each axis")
      ->transform(wholeNumberBetween(1, 64))
      ->capture_default_str();
  command.add_option("--region", settings.region, "Part of the image: x y width height [pixels] (default: all of it)")
      ->transform(wholeNumberBetween(0, pack::kMaxResolution))
      ->expected(4);
  addDevice(command, settings.device, settings.threads);
  addVulkanPath(command, settings.vulkanPath);
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
