#include "render/compare/devices_table.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/text.h"
#include "render/scene/methods.h"

namespace malus::render {
using nlohmann::json;

namespace {

// A renderer of one file, with the rows of its largest view.
struct Column {
  std::string device, view;
  std::map<std::string, const json*> rows;  // by method, with the path of a second one
};

std::uint64_t pixels(const json& row) {
  return row.at("width").get<std::uint64_t>() * row.at("height").get<std::uint64_t>();
}

std::string rowName(const json& row, bool isSecondPath) {
  const std::string method = row.at("method").get<std::string>();
  if (!isSecondPath) return method;
  const json path = row.value("embreePath", json());  // not of an earlier version
  return fmt::format("{}, {}", method, (path.is_string() ? path : row.at("vulkanPath")).get<std::string>());
}

// The columns of a scene in one file: one per renderer.
std::vector<Column> makeColumns(const json& results, const std::string& scene) {
  std::map<std::string, std::uint64_t> largest;
  for (const json& row : results.at("rows"))
    if (row.at("scene") == scene) {
      std::uint64_t& size = largest[row.at("renderer").get<std::string>()];
      size = std::max(size, pixels(row));
    }
  std::vector<Column> columns;
  for (const auto& [renderer, size] : largest) {
    Column column{printable(results.at("devices").value(renderer, renderer)), "", {}};
    for (const char* list : {"rows", "rowsOnSecondPath"}) {
      if (!results.contains(list)) continue;  // by an earlier version
      for (const json& row : results.at(list))
        if (row.at("scene") == scene && row.at("renderer") == renderer && pixels(row) == size) {
          column.view = fmt::format("{} x {}, depth {}", row.at("width").get<int>(), row.at("height").get<int>(),
                                    row.at("depth").get<int>());
          column.rows.emplace(rowName(row, std::string_view(list) != "rows"), &row);
        }
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

std::string cell(const Column& column, const std::string& name) {
  const auto found = column.rows.find(name);
  if (found == column.rows.end()) return "-";
  const json& row = *found->second;
  if (row.at("status") != "ok") return "failed";
  const json& ratio = row.at("ratioToSchlick");
  if (!row.at("medianMs").is_number()) return "not timed";
  const std::string time = fmt::format("{:.2f} ms", row.at("medianMs").get<double>());
  return ratio.is_object() ? fmt::format("{:.3f} ({})", ratio.at("median").get<double>(), time) : time;
}

// Methods in the order of the table of methods, then second paths.
std::vector<std::string> rowNames(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    const bool exists =
        std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.rows.contains(name); });
    if (exists && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& method : methodNames()) add(method);
  for (const Column& column : columns)
    for (const auto& [name, row] : column.rows) add(name);
  return names;
}

std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string text = " ";
  for (std::size_t i = 0; i < cells.size(); ++i) text += fmt::format(" {:<{}} ", cells[i], widths[i]);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string sceneTable(const std::string& scene, const std::vector<Column>& columns) {
  std::vector<std::vector<std::string>> lines(2);
  lines[0].emplace_back("method");
  lines[1].emplace_back();
  for (const Column& c : columns) {
    lines[0].push_back(c.device);
    lines[1].push_back(c.view);
  }
  for (const std::string& name : rowNames(columns)) {
    lines.push_back({name});
    for (const Column& c : columns) lines.back().push_back(cell(c, name));
  }
  std::vector<std::size_t> widths(columns.size() + 1, 0);
  for (const auto& cells : lines)
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  std::string text = fmt::format("\n{}: time relative to schlick in the same round (median of the times)\n", scene);
  for (const auto& cells : lines) text += line(cells, widths);
  return text;
}

}  // namespace

json readResults(const std::filesystem::path& path) {
  json results;
  try {
    results = json::parse(readTextFile(path));
  } catch (const json::exception& error) {
    throw Error(path.string(), "not JSON", "a results.json of malus compare", error.what());
  }
  const auto is = [&](const char* name, json::value_t type) {
    return results.is_object() && results.contains(name) && results.at(name).type() == type;
  };
  if (is("ablation", json::value_t::array))
    throw Error(path.string(), "results of malus compare --effects", "those of a comparison of methods");
  if (!is("rows", json::value_t::array) || !is("devices", json::value_t::object) ||
      !is("scenes", json::value_t::object))
    throw Error(path.string(), "not a results.json", "the keys rows, devices and scenes, as malus compare writes them");
  for (const json& row : results.at("rows"))
    for (const char* name :
         {"scene", "renderer", "method", "width", "height", "depth", "status", "medianMs", "ratioToSchlick"})
      if (!row.is_object() || !row.contains(name))
        throw Error(path.string(), fmt::format("a row has no '{}'", name), "a results.json of malus compare");
  return results;
}

std::string devicesTable(const std::vector<json>& results) {
  std::vector<std::string> scenes;
  for (const json& r : results)
    for (const auto& [name, scene] : r.at("scenes").items())
      if (std::find(scenes.begin(), scenes.end(), name) == scenes.end()) scenes.push_back(name);
  std::string text;
  for (const std::string& scene : scenes) {
    std::vector<Column> columns;
    for (const json& r : results)
      for (Column& column : makeColumns(r, scene)) columns.push_back(std::move(column));
    if (!columns.empty()) text += sceneTable(scene, columns);
  }
  for (const json& r : results) {
    const json info = r.value("deviceInfo", json());
    if (info.is_object() && info.value("rayTracingCores", "unknown") == "no")
      text += fmt::format("\n{} has no ray-tracing cores.\n", info.value("name", "The device"));
  }
  return text;
}

}  // namespace malus::render
