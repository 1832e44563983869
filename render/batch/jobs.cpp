#include "render/batch/jobs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/number_option.h"
#include "render/batch/csv.h"
#include "render/batch/distributions.h"

namespace malus::render {
using nlohmann::json;

namespace {

// The most frames of a batch.
constexpr std::uint64_t kMostFrames = 10'000'000;

// Parses one line; a key that occurs twice in an object is an error, of which JSON would keep the last.
json parseLine(std::string_view text, const std::string& where) {
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw Error(where, fmt::format("key '{}' occurs twice", parsed.get<std::string>()), "each key once");
    return true;
  };
  try {
    json value = json::parse(std::string(text), check);
    if (!value.is_object()) throw Error(where, "the line is not an object", "{\"KEY\": VALUE, ...}");
    return value;
  } catch (const json::exception& error) {
    throw Error(where, "is not JSON", "an object in one line", error.what());
  }
}

std::vector<JobLine> readJsonLines(std::string_view text, const std::string& file) {
  std::vector<JobLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::string where = fmt::format("{}:{}", file, number);
    lines.push_back({parseLine(line, where), where});
  }
  return lines;
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found;
  while (true) {
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string_view::npos) return found;
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    found.emplace_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

json scalar(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  const std::optional<double> number = parseNumber(text);
  if (!number) return text;
  // A whole number stays one, for the keys that need it.
  if (*number == std::floor(*number) && std::abs(*number) < 1e15) return static_cast<std::int64_t>(*number);
  return *number;
}

// A cell: JSON if it begins with a bracket, brace or quote; numbers separated by spaces are a vector; "uniform LOW
// HIGH", "logUniform LOW HIGH" and "list A B ..." are distributions.
json readCell(const std::string& text, const std::string& where, const std::string& column) {
  if (text.find_first_of("[{\"") == 0) {
    const json value = json::parse(text, nullptr, false);
    if (value.is_discarded()) throw Error(where, fmt::format("{}: is not JSON", column), "a value in JSON", text);
    return value;
  }
  const std::vector<std::string> parts = words(text);
  if (parts.size() < 2) return scalar(parts.empty() ? "" : parts[0]);
  json values = json::array();
  for (std::size_t i = 1; i < parts.size(); ++i) values.push_back(scalar(parts[i]));
  if (parts[0] == "uniform" || parts[0] == "logUniform" || parts[0] == "list") return {{parts[0], values}};
  values.insert(values.begin(), scalar(parts[0]));
  const bool areNumbers = std::all_of(values.begin(), values.end(), [](const json& v) { return v.is_number(); });
  return areNumbers ? values : json(text);
}

// Sets the value at "camera.position", making the objects on the way.
void setAt(json& object, std::string_view path, json value, const std::string& where) {
  json* at = &object;
  for (std::string_view rest = path;;) {
    if (!at->is_object()) throw Error(where, fmt::format("{}: another column sets a part of its path", path));
    const std::size_t dot = rest.find('.');
    at = &(*at)[std::string(rest.substr(0, dot))];
    if (dot == std::string_view::npos) break;
    rest.remove_prefix(dot + 1);
    if (at->is_null()) *at = json::object();
  }
  *at = std::move(value);
}

std::vector<JobLine> readTable(std::string_view text, const std::string& file) {
  const std::vector<CsvRow> rows = parseCsv(text, file);
  if (rows.empty()) throw Error(file, "the table is empty", "a row with the names of the columns");
  const std::vector<std::string>& columns = rows[0].fields;
  const std::string head = fmt::format("{}:{}", file, rows[0].line);
  std::set<std::string> known;
  for (const std::string& column : columns) {
    if (column.empty()) throw Error(head, "a column has no name", "a key such as camera.position");
    if (!known.insert(column).second) throw Error(head, fmt::format("column '{}' occurs twice", column), "each once");
  }
  std::vector<JobLine> lines;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string where = fmt::format("{}:{}", file, rows[i].line);
    if (rows[i].fields.size() != columns.size())
      throw Error(where, "the row does not fit the columns", fmt::format("{} fields", columns.size()),
                  std::to_string(rows[i].fields.size()));
    json value = json::object();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string& cell = rows[i].fields[k];
      if (cell.empty()) continue;
      setAt(value, columns[k], columns[k] == "name" ? json(cell) : readCell(cell, where, columns[k]), where);
    }
    lines.push_back({std::move(value), where});
  }
  return lines;
}

bool isName(const std::string& name) {
  const auto isAllowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= 200 && name[0] != '-' && std::all_of(name.begin(), name.end(), isAllowed);
}

std::string readName(const JobLine& line) {
  if (!line.value.contains("name")) return {};
  const json& name = line.value.at("name");
  if (!name.is_string() || !isName(name.get<std::string>()))
    throw Error(line.where, "name: cannot be that of files", "1 to 200 letters, digits, '_' and '-', '-' not first",
                name.dump(-1, ' ', false, json::error_handler_t::replace));
  return name.get<std::string>();
}

std::uint64_t repetitions(const JobLine& line) {
  if (!line.value.contains("repeat")) return 1;
  const json& repeat = line.value.at("repeat");
  if (!repeat.is_number_integer() || repeat.get<std::int64_t>() < 1 ||
      repeat.get<std::int64_t>() > static_cast<std::int64_t>(kMostFrames))
    throw Error(line.where, "repeat: is not a number of frames", fmt::format("1 to {}", kMostFrames), repeat.dump());
  return repeat.get<std::uint64_t>();
}

}  // namespace

std::vector<JobLine> readJobLines(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".jsonl" && extension != ".csv")
    throw Error(file.string(), "unknown format of jobs", ".jsonl or .csv",
                extension.empty() ? "no extension" : extension);
  const std::string text = readTextFile(file);
  std::vector<JobLine> lines =
      extension == ".csv" ? readTable(text, file.string()) : readJsonLines(text, file.string());
  if (lines.empty()) throw Error(file.string(), "has no jobs", "a line per frame");
  return lines;
}

Jobs::Jobs(std::vector<JobLine> lines, std::uint64_t seed) : lines_(std::move(lines)), seed_(seed) {
  std::map<std::string, std::size_t> lineOfName;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const std::string name = readName(lines_[i]);
    const std::uint64_t count = repetitions(lines_[i]);
    if (frames_.size() + count > kMostFrames)
      throw Error(lines_[i].where, "the batch has too many frames", fmt::format("at most {}", kMostFrames));
    const std::size_t digits = std::to_string(count - 1).size();
    for (std::uint64_t k = 0; k < count; ++k) {
      std::string frame = name.empty() ? fmt::format("frame-{:06}", frames_.size())
                          : count == 1 ? name
                                       : fmt::format("{}-{:0{}}", name, k, digits);
      const auto [first, isNew] = lineOfName.emplace(frame, i);
      if (!isNew)
        throw Error(lines_[i].where,
                    fmt::format("name: '{}' is also the name of a frame of {}", frame, lines_[first->second].where),
                    "another name");
      frames_.push_back({i, std::move(frame)});
    }
  }
}

FrameJob Jobs::draw(std::size_t frame) const {
  const JobLine& line = lines_[frames_[frame].line];
  FrameJob job{frame, frames_[frame].name, frameSeed(seed_, frame), line.value, line.where};
  job.settings.erase("name");
  job.settings.erase("repeat");
  job.settings = drawValues(job.settings, seed_, frame, line.where);
  return job;
}

}  // namespace malus::render
