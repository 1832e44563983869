#include "render/devices_cli.h"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/console.h"
#include "meshprep/json_text.h"
#include "render/vulkan/device_description.h"

namespace malus::render {

namespace {

void printLine(std::size_t number, const vulkan::DeviceDescription& d) {
  console::printLine("{}  {}; driver {}{}{}", number, d.name, d.driver,
                     d.problem.empty() ? "" : "; not usable: " + d.problem, d.isDefault ? "; used by default" : "");
}

void printDevices(bool asJson) {
  const std::vector<vulkan::DeviceDescription> list = vulkan::devices();
  nlohmann::json document = nlohmann::json::array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const vulkan::DeviceDescription& d = list[i];
    if (asJson) {
      document.push_back(toJson(d));
      document.back()["number"] = i;
      document.back()["isDefault"] = d.isDefault;
      continue;
    }
    printLine(i, d);
    console::printLine("   {}, Vulkan {}, ray-tracing cores: {}", d.type, d.vulkan, d.rayTracingCores);
    for (const auto& [name, value] : d.values) console::printLine("   {:<48} {}", name, value);
  }
  if (asJson) console::printText(jsonText(document, 1) + "\n");
}

}  // namespace

void addDevicesCommand(CLI::App& app) {
  auto asJson = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("devices", "List the Vulkan devices with their features and limits");
  command->add_flag("--json", *asJson, "Print the list as JSON");
  command->callback([asJson] { printDevices(*asJson); });
}

void listDevices() {
  const std::vector<vulkan::DeviceDescription> list = vulkan::devices();
  for (std::size_t i = 0; i < list.size(); ++i) printLine(i, list[i]);
}

}  // namespace malus::render
