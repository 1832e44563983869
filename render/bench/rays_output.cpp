// The results of `malus bench rays` as JSON and as text.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/text.h"
#include "render/bench/rays.h"
#include "render/compare/machine.h"
#include "render/compare/statistics.h"

namespace malus::render {

namespace {

nlohmann::json classesJson(const RayFloor& floor, bool isEmbree) {
  nlohmann::json list = nlohmann::json::array();
  for (const ClassFloor& c : floor.classes) {
    nlohmann::json calls = nlohmann::json::object();
    for (const auto& [name, ms] : c.calls) calls[name] = ms;
    list.push_back({{"depth", c.kind.bounce},
                    {"shadow", c.kind.shadow},
                    {"rays", c.rays},
                    {"hits", c.hits},
                    {"bestCall", c.bestCall()},
                    {"ms", c.ms()},
                    {"calls", calls}});
    if (isEmbree) list.back()["singleMs"] = c.singleMs();
  }
  return list;
}

nlohmann::json floorJson(const RayFloor& floor, bool isEmbree) {
  nlohmann::json json{{"methods", floor.methods}, {"floorMs", floor.ms()}, {"classes", classesJson(floor, isEmbree)}};
  if (isEmbree) json["singleMs"] = floor.singleMs();
  return json;
}

nlohmann::json vulkanJson(const RaysBench& bench) {
  if (bench.vulkanDevice.empty()) return nullptr;
  nlohmann::json floors = nlohmann::json::array();
  for (const RayFloor& floor : bench.vulkanFloors) floors.push_back(floorJson(floor, false));
  return {{"device", bench.vulkanDevice}, {"floors", floors}};
}

std::string floorTable(const RayFloor& floor, bool isEmbree) {
  const auto single = [&](double ms) { return isEmbree ? fmt::format(" {:>10.2f}", ms) : ""; };
  std::string text = fmt::format("rays of {}{}\n", fmt::join(floor.methods, ", "), isEmbree ? "" : ", Vulkan");
  text += fmt::format("  {:<14} {:>10} {:>7} {:<22} {:>8}{}\n", "bounce", "rays", "met", "fastest call", "ms",
                      isEmbree ? fmt::format(" {:>10}", "single ms") : "");
  for (const ClassFloor& c : floor.classes)
    text += fmt::format("  {:<14} {:>10} {:>5.0f} % {:<22} {:>8.2f}{}\n",
                        fmt::format("{}{}", c.kind.bounce, c.kind.shadow ? ", shadow" : ""), c.rays,
                        100.0 * static_cast<double>(c.hits) / static_cast<double>(c.rays), c.bestCall(), c.ms(),
                        single(c.singleMs()));
  return text + fmt::format("  {:<14} {:>10} {:>7} {:<22} {:>8.2f}{}\n", "floor", floor.rays(), "", "", floor.ms(),
                            single(floor.singleMs()));
}

}  // namespace

nlohmann::json toJson(const RaysBench& bench) {
  nlohmann::json rows = nlohmann::json::array();
  for (const BenchRow& row : bench.rows) {
    const RayFloor& floor = bench.floor(row);
    rows.push_back({{"backend", backendInfo(row.backend()).name},
                    {"method", row.method},
                    {"path", row.pathName()},
                    {"rays", floor.rays()},
                    {"floorMs", floor.ms()},
                    {"totalMs", row.totalMs()},
                    {"medianMs", computeSpread(row.samples).median},
                    {"ratio", row.totalMs() / floor.ms()}});
  }
  nlohmann::json json{{"scene", bench.scene},   {"device", bench.device}, {"machine", machineJson()},
                      {"date", currentDate()},  {"width", bench.width},   {"height", bench.height},
                      {"rounds", bench.rounds}, {"rows", rows},           {"vulkan", vulkanJson(bench)}};
  if (bench.floors.empty()) return json;
  const RayFloor& first = bench.floors.front();
  json["floorMs"] = first.ms();
  json["singleMs"] = first.singleMs();
  json["classes"] = classesJson(first, true);
  nlohmann::json& others = json["otherFloors"] = nlohmann::json::array();
  for (std::size_t i = 1; i < bench.floors.size(); ++i) others.push_back(floorJson(bench.floors[i], true));
  return json;
}

std::string toTable(const RaysBench& bench) {
  const nlohmann::json cpu = machineJson().at("cpu");
  std::string text = fmt::format("{}, {} x {}, {}, {}\nleast times of {} rounds [ms]\n", printable(bench.scene),
                                 bench.width, bench.height, bench.device,
                                 cpu.is_string() ? printable(cpu.get<std::string>()) : "unknown CPU", bench.rounds);
  if (!bench.vulkanDevice.empty()) text += fmt::format("Vulkan: {}\n", printable(bench.vulkanDevice));
  for (const RayFloor& floor : bench.floors) text += floorTable(floor, true);
  for (const RayFloor& floor : bench.vulkanFloors) text += floorTable(floor, false);
  text += fmt::format("{:<8} {:<18} {:<8} {:>8} {:>8} {:>8} {:>7}\n", "renderer", "method", "path", "floor", "total",
                      "median", "ratio");
  for (const BenchRow& row : bench.rows) {
    const double floor = bench.floor(row).ms();
    text += fmt::format("{:<8} {:<18} {:<8} {:>8.1f} {:>8.1f} {:>8.1f} {:>7.2f}\n", backendInfo(row.backend()).name,
                        row.method, row.pathName(), floor, row.totalMs(), computeSpread(row.samples).median,
                        row.totalMs() / floor);
  }
  return text;
}

}  // namespace malus::render
