// The results of `malus bench rays` as JSON and as text.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/text.h"
#include "render/bench/rays.h"
#include "render/compare/machine.h"
#include "render/compare/statistics.h"

namespace malus::render {

namespace {

nlohmann::json classesJson(const RayFloor& floor) {
  nlohmann::json list = nlohmann::json::array();
  for (const ClassFloor& c : floor.classes) {
    nlohmann::json calls = nlohmann::json::object();
    for (const auto& [name, ms] : c.calls) calls[name] = ms;
    list.push_back({{"depth", c.kind.bounce},
                    {"shadow", c.kind.shadow},
                    {"rays", c.rays},
                    {"hits", c.hits},
                    {"bestCall", c.bestCall.name()},
                    {"ms", c.ms},
                    {"singleMs", c.singleMs},
                    {"calls", calls}});
  }
  return list;
}

std::string floorTable(const RayFloor& floor) {
  std::string text = fmt::format("rays of {}\n", fmt::join(floor.methods, ", "));
  text += fmt::format("  {:<14} {:>10} {:>7} {:<22} {:>8} {:>10}\n", "bounce", "rays", "met", "fastest call", "ms",
                      "single ms");
  for (const ClassFloor& c : floor.classes)
    text += fmt::format("  {:<14} {:>10} {:>5.0f} % {:<22} {:>8.2f} {:>10.2f}\n",
                        fmt::format("{}{}", c.kind.bounce, c.kind.shadow ? ", shadow" : ""), c.rays,
                        100.0 * static_cast<double>(c.hits) / static_cast<double>(c.rays), c.bestCall.name(), c.ms,
                        c.singleMs);
  return text + fmt::format("  {:<14} {:>10} {:>7} {:<22} {:>8.2f} {:>10.2f}\n", "floor", floor.rays(), "", "",
                            floor.ms(), floor.singleMs());
}

}  // namespace

nlohmann::json toJson(const RaysBench& bench) {
  nlohmann::json rows = nlohmann::json::array();
  for (const BenchRow& row : bench.rows) {
    const RayFloor& floor = bench.floors[row.floor];
    rows.push_back({{"method", row.method},
                    {"path", embreePathName(row.path)},
                    {"rays", floor.rays()},
                    {"floorMs", floor.ms()},
                    {"totalMs", row.totalMs()},
                    {"medianMs", computeSpread(row.samples).median},
                    {"ratio", row.totalMs() / floor.ms()}});
  }
  nlohmann::json others = nlohmann::json::array();
  for (std::size_t i = 1; i < bench.floors.size(); ++i)
    others.push_back({{"methods", bench.floors[i].methods},
                      {"floorMs", bench.floors[i].ms()},
                      {"singleMs", bench.floors[i].singleMs()},
                      {"classes", classesJson(bench.floors[i])}});
  return {{"scene", bench.scene},
          {"device", bench.device},
          {"machine", machineJson()},
          {"date", currentDate()},
          {"width", bench.width},
          {"height", bench.height},
          {"rounds", bench.rounds},
          {"floorMs", bench.floors.front().ms()},
          {"singleMs", bench.floors.front().singleMs()},
          {"classes", classesJson(bench.floors.front())},
          {"rows", rows},
          {"otherFloors", others}};
}

std::string toTable(const RaysBench& bench) {
  const nlohmann::json cpu = machineJson().at("cpu");
  std::string text = fmt::format("{}, {} x {}, {}, {}\nleast times of {} rounds [ms]\n", printable(bench.scene),
                                 bench.width, bench.height, bench.device,
                                 cpu.is_string() ? printable(cpu.get<std::string>()) : "unknown CPU", bench.rounds);
  for (const RayFloor& floor : bench.floors) text += floorTable(floor);
  text += fmt::format("{:<16} {:<8} {:>8} {:>8} {:>8} {:>7}\n", "method", "path", "floor", "total", "median", "ratio");
  for (const BenchRow& row : bench.rows) {
    const double floor = bench.floors[row.floor].ms();
    text += fmt::format("{:<16} {:<8} {:>8.1f} {:>8.1f} {:>8.1f} {:>7.2f}\n", row.method, embreePathName(row.path),
                        floor, row.totalMs(), computeSpread(row.samples).median, row.totalMs() / floor);
  }
  return text;
}

}  // namespace malus::render
