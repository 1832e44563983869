#include "bake/materials/optical_file.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/number_option.h"

namespace malus::bake {

namespace {

using Quantity = OpticalData::Quantity;

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 24;
constexpr std::string_view kTypes = "tabulated nk, tabulated n, tabulated k or formula 1 to 9";

std::string lowerCase(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Splits at any of the separators, and leaves out blanks around the pieces. Without separators: at blanks.
std::vector<std::string_view> split(std::string_view line, std::string_view separators) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (separators.empty() && first == std::string_view::npos) return pieces;
    if (separators.empty()) line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(separators.empty() ? kBlanks : separators), line.size());
    std::string_view piece = line.substr(0, end);
    piece.remove_prefix(std::min(piece.find_first_not_of(kBlanks), piece.size()));
    piece.remove_suffix(piece.size() - std::min(piece.find_last_not_of(kBlanks) + 1, piece.size()));
    pieces.push_back(piece);
    if (end == line.size()) return pieces;
    line.remove_prefix(end + 1);
  }
}

double toNumber(std::string_view text, const std::string& location) {
  const std::optional<double> number = parseNumber(text);
  if (!number) throw Error(location, "is not a number", "a finite decimal number", fmt::format("'{}'", text));
  return *number;
}

std::vector<double> toNumbers(const std::string& text, const std::string& location) {
  std::vector<double> numbers;
  for (const std::string_view piece : split(text, "")) numbers.push_back(toNumber(piece, location));
  return numbers;
}

// Line by line; at(): the number of the current line, from 1.
class Lines {
 public:
  Lines(std::string_view text, std::size_t first) : text_(text), line_(first - 1) {}
  bool next(std::string_view& line) {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_;
    return true;
  }
  std::size_t at() const { return line_; }

 private:
  std::string_view text_;
  std::size_t line_;
};

// A table under construction: the columns after the wavelength.
struct Table {
  std::vector<Quantity> columns;
  std::vector<std::vector<OpticalData::Row>> rows;  // of each column
  double micrometres = 1;                           // per unit of the wavelength

  void add(const std::vector<std::string_view>& cells, const std::string& location) {
    if (cells.size() != columns.size() + 1)
      throw Error(location, "wrong number of columns", fmt::to_string(columns.size() + 1),
                  fmt::to_string(cells.size()));
    rows.resize(columns.size());
    const double wavelength = toNumber(cells[0], location) * micrometres;
    for (std::size_t i = 0; i < columns.size(); ++i) rows[i].push_back({wavelength, toNumber(cells[i + 1], location)});
  }
  void finish(OpticalData& data, const std::string& location) {
    rows.resize(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) data.addTable(columns[i], std::move(rows[i]), location);
  }
};

// The text of a key of an entry of DATA.
std::string readText(const YAML::Node& entry, const char* key, const std::string& location) {
  const YAML::Node value = entry[key];
  if (!value || !value.IsScalar()) throw Error(location, fmt::format("key '{}' is missing or no text", key), key);
  return value.Scalar();
}

void addEntry(const YAML::Node& entry, const std::string& where, OpticalData& data) {
  const std::string location = fmt::format("{}:{}", where, entry.Mark().line + 1);
  if (!entry.IsMap()) throw Error(location, "entry of DATA is not a map", fmt::format("type: {}", kTypes));
  const std::string type = readText(entry, "type", location);
  if (type == "tabulated nk" || type == "tabulated n" || type == "tabulated k") {
    Table table;
    for (const char letter : type.substr(type.rfind(' ') + 1))
      table.columns.push_back(letter == 'n' ? Quantity::n : Quantity::k);
    const std::string text = readText(entry, "data", location);
    Lines lines(text, static_cast<std::size_t>(entry["data"].Mark().line) + 2);  // after "data: |"
    for (std::string_view line; lines.next(line);)
      if (const auto cells = split(line, ""); !cells.empty()) table.add(cells, fmt::format("{}:{}", where, lines.at()));
    table.finish(data, location);
    return;
  }
  constexpr std::string_view kFormula = "formula ";
  const std::optional<std::int64_t> formula =
      type.starts_with(kFormula) ? parseWholeNumber(std::string_view(type).substr(kFormula.size())) : std::nullopt;
  if (!formula || *formula < 1 || *formula > 9)
    throw Error(location, "unknown type of optical data", kTypes, fmt::format("'{}'", type));
  const std::string text = readText(entry, entry["wavelength_range"] ? "wavelength_range" : "range", location);
  const std::vector<double> range = toNumbers(text, location);
  if (range.size() != 2) throw Error(location, "range of wavelengths is not a pair", "two numbers", text);
  data.addFormula(static_cast<int>(*formula), toNumbers(readText(entry, "coefficients", location), location), range[0],
                  range[1], location);
}

void requireIndex(const OpticalData& data, const std::string& where) {
  if (!data.has(Quantity::n)) throw Error(where, "has no index of refraction", "a table or formula of n");
}

// Returns the columns of a line of headings; nothing if it is none.
std::optional<Table> parseHeadings(const std::vector<std::string_view>& cells) {
  const std::string first = lowerCase(cells[0]);
  if (!first.starts_with("wl") && !first.starts_with("wavelength") && !first.starts_with("lambda")) return {};
  Table table;
  if (first.find("nm") != std::string::npos) table.micrometres = 1e-3;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const std::string name = lowerCase(cells[i]);
    if (name != "n" && name != "k") return {};
    table.columns.push_back(name == "n" ? Quantity::n : Quantity::k);
  }
  return table.columns.empty() ? std::nullopt : std::optional(table);
}

}  // namespace

bool isOpticalFile(std::string_view name) {
  const std::string extension = lowerCase(std::filesystem::path(name).extension().string());
  return extension == ".yml" || extension == ".yaml" || extension == ".csv";
}

OpticalData parseOpticalData(const YAML::Node& object, const std::string& where) {
  OpticalData data(where);
  if (!object.IsMap() || !object["DATA"] || !object["DATA"].IsSequence())
    throw Error(where, "has no list DATA", "a file of n and k from refractiveindex.info");
  for (const YAML::Node& entry : object["DATA"]) addEntry(entry, where, data);
  requireIndex(data, where);
  return data;
}

OpticalData parseOpticalYaml(const std::string& text, const std::string& where) {
  try {
    return parseOpticalData(YAML::Load(text), where);
  } catch (const YAML::Exception& error) {
    throw Error(error.mark.is_null() ? where : fmt::format("{}:{}", where, error.mark.line + 1), "is not YAML",
                "a file of n and k from refractiveindex.info", error.msg);
  }
}

OpticalData parseOpticalCsv(std::string_view text, const std::string& where) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  OpticalData data(where);
  std::optional<Table> table;
  std::string location;  // of the headings
  Lines lines(text, 1);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> cells = split(line, ",;\t");
    if (std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell.empty(); })) continue;
    const std::string here = fmt::format("{}:{}", where, lines.at());
    if (auto headings = parseHeadings(cells)) {
      if (table) table->finish(data, location);
      table = std::move(headings);
      location = here;
    } else if (table) {
      table->add(cells, here);
    } else {
      throw Error(here, "has no headings", "a line such as 'wl,n,k'", fmt::format("'{}'", line.substr(0, 60)));
    }
  }
  if (table) table->finish(data, location);
  requireIndex(data, where);
  return data;
}

OpticalData readOpticalFile(const std::filesystem::path& path) {
  const std::string text = readTextFile(path, kMaxFileBytes), where = path.string();
  return lowerCase(path.extension().string()) == ".csv" ? parseOpticalCsv(text, where) : parseOpticalYaml(text, where);
}

}  // namespace malus::bake
