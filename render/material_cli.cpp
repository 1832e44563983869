#include "render/material_cli.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/materials/library.h"
#include "bake/pack/scene.h"
#include "bake/scene_file/strict_object.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
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
  std::string name, angle = "0:90:5", precision = "double", plot;
  std::optional<double> eta;
  double k = 0, outside = 1;
  unsigned wavelengthNm = 532;
  bool csv = false, json = false;
};

constexpr std::size_t kMostAngles = 100000;

// "DEG" or "FROM:TO:STEP", with both ends; the last step may be shorter. Empty if the text has another form.
std::vector<double> parseAngles(const std::string& text) {
  std::vector<double> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t colon = std::min(text.find(':', at), text.size());
    const std::optional<double> value = parseNumber(std::string_view(text).substr(at, colon - at));
    if (!value || *value < 0 || *value > 90) return {};
    parts.push_back(*value);
    at = colon + 1;
  }
  if (parts.size() == 1) return parts;
  if (parts.size() != 3 || parts[2] <= 0 || parts[1] < parts[0]) return {};
  const double steps = (parts[1] - parts[0]) / parts[2];
  if (steps > static_cast<double>(kMostAngles)) return {};
  std::vector<double> angles;
  for (std::size_t i = 0; static_cast<double>(i) < steps - 1e-9; ++i)
    angles.push_back(parts[0] + static_cast<double>(i) * parts[2]);
  angles.push_back(parts[1]);
  return angles;
}

Interface interfaceFor(const MaterialArguments& a) {
  Interface interface { a.outside, 1, a.k };
  if (a.eta) {
    interface.n2 = *a.eta;
  } else {
    const bake::OpticalConstants* found = bake::findMaterial(a.name);
    if (!found) {
      const std::string near = nearestName(a.name, bake::materialNames());
      throw Error(a.name, "unknown material",
                  near.empty() ? "a name from 'malus --list-materials'"
                               : fmt::format("'{}' or another from 'malus --list-materials'", near));
    }
    const int colour = a.wavelengthNm == 630 ? 0 : a.wavelengthNm == 532 ? 1 : 2;
    interface.n2 = found->eta[colour];
    interface.k2 = found->k[colour];
  }
  if (interface.n2 < pack::kMinEta && interface.k2 < pack::kMinEta)
    throw Error("--eta", "the index is too small",
                fmt::format("{:g} or more, or --k {:g} or more", pack::kMinEta, pack::kMinEta),
                fmt::format("{:g}", interface.n2));
  return interface;
}

json toJson(const MaterialArguments& a, const Interface& interface, const SurfaceResponse& r) {
  const auto optional = [](const auto& value) { return value ? json(*value) : json(); };
  return {{"material", a.eta ? json() : json(a.name)},
          {"wavelengthNm", a.eta ? json() : json(a.wavelengthNm)},
          {"eta", interface.n2},
          {"k", interface.k2},
          {"outside", interface.n1},
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

void printTable(const MaterialArguments& a, const Interface& i, const std::vector<SurfaceResponse>& rows) {
  console::printLine("{}, index {:g} - i {:g} against {:g}, {}",
                     a.eta ? std::string("given constants") : fmt::format("{} at {} nm", a.name, a.wavelengthNm), i.n2,
                     i.k2, i.n1, a.precision);
  console::printLine("{:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}", "angle", "R_s", "R_p", "T_s", "T_p", "D",
                     "phase");
  for (const SurfaceResponse& r : rows)
    console::printLine("{:>8g} {:>10.6f} {:>10.6f} {:>10} {:>10} {:>10.6f} {:>10.4f}", r.angleDegrees, r.rs, r.rp,
                       number(r.ts), number(r.tp), r.diattenuation, r.phaseDegrees);
  if (rows.size() > 1) return;
  console::printText("Mueller matrix of the reflection (frames: x is the s direction)\n" +
                     matrixText(rows[0].reflection));
  if (rows[0].transmission)
    console::printText("Mueller matrix of the transmission, in flux\n" + matrixText(*rows[0].transmission));
}

void printCsv(const std::vector<SurfaceResponse>& rows) {
  std::string heading = "angleDegrees,rs,rp,ts,tp,diattenuation,phaseDegrees";
  for (const char* matrix : {"reflection", "transmission"})
    for (int i = 0; i < 16; ++i) heading += fmt::format(",{}{}{}", matrix, i / 4, i % 4);
  console::printOneLine(heading);
  const auto optional = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : std::string(); };
  for (const SurfaceResponse& r : rows) {
    std::string line = fmt::format("{},{},{},{},{},{},{}", r.angleDegrees, r.rs, r.rp, optional(r.ts), optional(r.tp),
                                   r.diattenuation, r.phaseDegrees);
    for (const double v : r.reflection) line += fmt::format(",{}", v);
    for (std::size_t i = 0; i < 16; ++i) line += r.transmission ? fmt::format(",{}", (*r.transmission)[i]) : ",";
    console::printOneLine(line);
  }
}

void runMaterial(const MaterialArguments& a) {
  if (a.name.empty() == !a.eta) throw CLI::ValidationError("material", "needs either a NAME or --eta");
  const std::vector<double> angles = parseAngles(a.angle);
  if (angles.empty())
    throw CLI::ValidationError(
        "--angle", fmt::format("expected DEG or FROM:TO:STEP within 0 to 90 with at most {} steps, found '{}'",
                               kMostAngles, a.angle));
  OutputFiles files;
  files.addOutput(a.plot, "--plot");
  files.check();
  const Interface interface = interfaceFor(a);
  std::vector<SurfaceResponse> rows;
  for (const double angle : angles)
    rows.push_back(surfaceResponse(interface, angle,
                                   a.precision == "float" ? Precision::singlePrecision : Precision::doublePrecision));

  json document = json::array();
  for (const SurfaceResponse& r : rows) document.push_back(toJson(a, interface, r));
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
    printTable(a, interface, rows);
}

}  // namespace

void addMaterialCommand(CLI::App& app) {
  auto a = std::make_shared<MaterialArguments>();
  CLI::App* command = app.add_subcommand("material", "Print the response of a surface to polarized light");
  command->add_option("name", a->name, "Material from --list-materials");
  CLI::Option* eta = command->add_option("--eta", a->eta, "Real part of the index, in place of a name")
                         ->transform(numberBetween(0, pack::kMaxEta));
  command->add_option("--k", a->k, "Imaginary part: the index is eta - i k; a metal if above 0")
      ->transform(numberBetween(0, pack::kMaxEta))
      ->needs(eta);
  command->add_option("--outside", a->outside, "Index of the medium of the incident light")
      ->transform(numberBetween(pack::kMinEta, pack::kMaxEta))
      ->capture_default_str();
  command->add_option("--wavelength", a->wavelengthNm, "Wavelength for a named material: red, green or blue [nm]")
      ->check(CLI::IsMember({630u, 532u, 465u}))
      ->transform(wholeNumberBetween(0, 1000000))
      ->capture_default_str();
  command->add_option("--angle", a->angle, "Angle of incidence: DEG, or FROM:TO:STEP [degrees]")->capture_default_str();
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
