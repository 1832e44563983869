#include "render/material_cli.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/materials/optical_file.h"
#include "bake/materials/presets.h"
#include "bake/pack/scene.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "render/material/surface_response.h"
#include "render/report_script.h"

namespace malus::render {
using nlohmann::json;

namespace {

struct MaterialArguments {
  std::string name, wavelength = "532", precision = "double", plot;
  std::optional<std::string> angle;
  std::optional<double> eta;
  double k = 0, outside = 1;
  bool csv = false, json = false;
};

struct Row {
  std::optional<double> wavelengthNm;  // nothing: constants from the command line
  Interface interface;
  SurfaceResponse response;
};

constexpr std::size_t kMostValues = 100000;

// Returns the values of "VALUE" or "FROM:TO:STEP", with both ends; the last step may be shorter. Throws
// CLI::ValidationError if the text has another form, or a value is not within low to high.
std::vector<double> parseRange(const char* option, const std::string& text, double low, double high) {
  const auto refuse = [&] {
    throw CLI::ValidationError(option, fmt::format("expected VALUE or FROM:TO:STEP within {:g} to {:g} with at most {} "
                                                   "steps, found '{}'",
                                                   low, high, kMostValues, text));
  };
  std::vector<double> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t colon = std::min(text.find(':', at), text.size());
    const std::optional<double> value = parseNumber(std::string_view(text).substr(at, colon - at));
    if (!value || (parts.size() < 2 && (*value < low || *value > high))) refuse();
    parts.push_back(*value);
    at = colon + 1;
  }
  if (parts.size() == 1) return parts;
  if (parts.size() != 3 || parts[2] <= 0 || parts[1] < parts[0]) refuse();
  const double steps = (parts[1] - parts[0]) / parts[2];
  if (steps > static_cast<double>(kMostValues)) refuse();
  std::vector<double> values;
  for (std::size_t i = 0; static_cast<double>(i) < steps - 1e-9; ++i)
    values.push_back(parts[0] + static_cast<double>(i) * parts[2]);
  values.push_back(parts[1]);
  return values;
}

// The index of a preset or of a file over the wavelength in nanometres.
class NamedMaterial {
 public:
  explicit NamedMaterial(const std::string& name) {
    if (bake::isOpticalFile(name))
      file_ = bake::readOpticalFile(name);
    else
      preset_ = &bake::requirePreset(name);
  }
  double at(bake::OpticalData::Quantity quantity, double nanometres) const {
    return file_ ? file_->at(quantity, nanometres) : preset_->at(quantity, nanometres);
  }

 private:
  std::optional<bake::OpticalData> file_;
  const bake::Preset* preset_ = nullptr;
};

void requireIndex(const Interface& interface, const std::string& location) {
  if (interface.n2 < pack::kMinEta && interface.k2 < pack::kMinEta)
    throw Error(location, "the index is too small",
                fmt::format("{:g} or more, or k of {:g} or more", pack::kMinEta, pack::kMinEta),
                fmt::format("{:g}", interface.n2));
}

// Returns a row per wavelength and angle.
std::vector<Row> computeRows(const MaterialArguments& a) {
  using Quantity = bake::OpticalData::Quantity;
  const std::vector<double> wavelengths =
      parseRange("--wavelength", a.wavelength, pack::kMinWavelengthNm, pack::kMaxWavelengthNm);
  const std::string angle = a.angle.value_or(wavelengths.size() > 1 ? "0" : "0:90:5");
  const std::vector<double> angles = parseRange("--angle", angle, 0, 90);
  if (a.eta && wavelengths.size() > 1)
    throw CLI::ValidationError("--wavelength", "needs a NAME or file; --eta is the same at every wavelength");
  if (wavelengths.size() * angles.size() > kMostValues)
    throw CLI::ValidationError("--wavelength", fmt::format("times the number of angles is over {} rows", kMostValues));
  const Precision precision = a.precision == "float" ? Precision::singlePrecision : Precision::doublePrecision;
  std::vector<Row> rows;
  const auto add = [&](std::optional<double> wavelength, const Interface& interface) {
    requireIndex(interface, wavelength ? fmt::format("{} at {:g} nm", a.name, *wavelength) : "--eta");
    for (const double degrees : angles)
      rows.push_back({wavelength, interface, surfaceResponse(interface, degrees, precision)});
  };
  if (a.eta) {
    add(std::nullopt, {a.outside, *a.eta, a.k});
    return rows;
  }
  const NamedMaterial material(a.name);
  for (const double nm : wavelengths) add(nm, {a.outside, material.at(Quantity::n, nm), material.at(Quantity::k, nm)});
  return rows;
}

json toJson(const MaterialArguments& a, const Row& row) {
  const auto optional = [](const auto& value) { return value ? json(*value) : json(); };
  const SurfaceResponse& r = row.response;
  return {{"material", a.eta ? json() : json(a.name)},
          {"wavelengthNm", optional(row.wavelengthNm)},
          {"eta", row.interface.n2},
          {"k", row.interface.k2},
          {"outside", row.interface.n1},
          {"precision", a.precision},
          {"angleDegrees", r.angleDegrees},
          {"rs", r.rs},
          {"rp", r.rp},
          {"ts", optional(r.ts)},
          {"tp", optional(r.tp)},
          {"diattenuation", r.diattenuation},
          {"phaseDegrees", r.phaseDegrees},
          {"reflection", r.reflection},
          {"transmission", optional(r.transmission)}};
}

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

std::string matrixText(const std::array<double, 16>& m) {
  std::string text;
  for (std::size_t row = 0; row < 4; ++row)
    text += fmt::format("  {:>10.6f} {:>10.6f} {:>10.6f} {:>10.6f}\n", m[4 * row], m[4 * row + 1], m[4 * row + 2],
                        m[4 * row + 3]);
  return text;
}

bool hasSpectrum(const std::vector<Row>& rows) { return rows.front().wavelengthNm != rows.back().wavelengthNm; }

void printTable(const MaterialArguments& a, const std::vector<Row>& rows) {
  const Row& first = rows.front();
  if (hasSpectrum(rows))
    console::printLine("{} against {:g}, {}", a.name, first.interface.n1, a.precision);
  else
    console::printLine(
        "{}, index {:g} - i {:g} against {:g}, {}",
        a.eta ? std::string("given constants") : fmt::format("{} at {:g} nm", a.name, *first.wavelengthNm),
        first.interface.n2, first.interface.k2, first.interface.n1, a.precision);
  const std::string columns =
      fmt::format("{:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}", "angle", "R_s", "R_p", "T_s", "T_p", "D", "phase");
  console::printOneLine(hasSpectrum(rows) ? fmt::format("{:>9} {:>10} {:>10} {}", "nm", "n", "k", columns) : columns);
  for (const Row& row : rows) {
    const SurfaceResponse& r = row.response;
    std::string line;
    if (hasSpectrum(rows))
      line = fmt::format("{:>9g} {:>10.6f} {:>10.6f} ", *row.wavelengthNm, row.interface.n2, row.interface.k2);
    console::printOneLine(line + fmt::format("{:>8g} {:>10.6f} {:>10.6f} {:>10} {:>10} {:>10.6f} {:>10.4f}",
                                             r.angleDegrees, r.rs, r.rp, number(r.ts), number(r.tp), r.diattenuation,
                                             r.phaseDegrees));
  }
  if (rows.size() > 1) return;
  console::printText("Mueller matrix of the reflection (frames: x is the s direction)\n" +
                     matrixText(first.response.reflection));
  if (first.response.transmission)
    console::printText("Mueller matrix of the transmission, in flux\n" + matrixText(*first.response.transmission));
}

void printCsv(const std::vector<Row>& rows) {
  std::string heading = "angleDegrees,rs,rp,ts,tp,diattenuation,phaseDegrees";
  for (const char* matrix : {"reflection", "transmission"})
    for (int i = 0; i < 16; ++i) heading += fmt::format(",{}{}{}", matrix, i / 4, i % 4);
  console::printOneLine(heading + ",wavelengthNm,eta,k");
  const auto optional = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : std::string(); };
  for (const Row& row : rows) {
    const SurfaceResponse& r = row.response;
    std::string line = fmt::format("{},{},{},{},{},{},{}", r.angleDegrees, r.rs, r.rp, optional(r.ts), optional(r.tp),
                                   r.diattenuation, r.phaseDegrees);
    for (const double v : r.reflection) line += fmt::format(",{}", v);
    for (std::size_t i = 0; i < 16; ++i) line += r.transmission ? fmt::format(",{}", (*r.transmission)[i]) : ",";
    line += fmt::format(",{},{},{}", optional(row.wavelengthNm), row.interface.n2, row.interface.k2);
    console::printOneLine(line);
  }
}

void runMaterial(const MaterialArguments& a) {
  if (a.name.empty() == !a.eta) throw CLI::ValidationError("material", "needs either a NAME or --eta");
  OutputFiles files;
  if (!a.eta && bake::isOpticalFile(a.name)) files.addInput(a.name);
  files.addOutput(a.plot, "--plot");
  files.check();
  const std::vector<Row> rows = computeRows(a);
  json document = json::array();
  for (const Row& row : rows) document.push_back(toJson(a, row));
  if (!a.plot.empty()) {
    const auto extension = std::filesystem::path(a.plot).extension();
    if (extension != ".png" && extension != ".svg" && extension != ".pdf")
      throw Error(a.plot, "unknown plot format", ".png, .svg or .pdf", extension.string());
    writeBeside(a.plot, [&](const std::filesystem::path& file) {
      runReportScript("material_plot.py", {file.string()}, jsonText(document, -1), "cannot draw the plot");
    });
  }
  if (a.json)
    console::printText(jsonText(rows.size() == 1 ? document[0] : document, 1) + "\n");
  else if (a.csv)
    printCsv(rows);
  else if (a.plot.empty())
    printTable(a, rows);
}

}  // namespace

void addMaterialCommand(CLI::App& app) {
  auto a = std::make_shared<MaterialArguments>();
  CLI::App* command = app.add_subcommand("material", "Print the response of a surface to polarized light");
  command->add_option("name", a->name, "Material from --list-materials, or a file of n and k (.yml, .csv)");
  CLI::Option* eta = command->add_option("--eta", a->eta, "Real part of the index, in place of a name")
                         ->transform(numberBetween(0, pack::kMaxEta));
  command->add_option("--k", a->k, "Imaginary part: the index is eta - i k; a metal if above 0")
      ->transform(numberBetween(0, pack::kMaxEta))
      ->needs(eta);
  command->add_option("--outside", a->outside, "Index of the medium of the incident light")
      ->transform(numberBetween(pack::kMinEta, pack::kMaxEta))
      ->capture_default_str();
  command
      ->add_option("--wavelength", a->wavelength, "Wavelength in vacuum for a named material: NM, or FROM:TO:STEP [nm]")
      ->capture_default_str();
  command->add_option(
      "--angle", a->angle,
      "Angle of incidence: DEG, or FROM:TO:STEP [degrees]; default 0:90:5, or 0 with several wavelengths");
  command->add_option("--precision", a->precision, "Precision of the arithmetic")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  CLI::Option* csv = command->add_flag("--csv", a->csv, "Print comma-separated values with every digit");
  command->add_flag("--json", a->json, "Print JSON: an object for one angle, a list for several")->excludes(csv);
  command->add_option("--plot", a->plot, "Plot of the curves over the angle: .png, .svg or .pdf")
      ->check(outputName())
      ->type_name("FILE");
  command->callback([a] { runMaterial(*a); });
}

}  // namespace malus::render
