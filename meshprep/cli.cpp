#include "meshprep/cli.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/prepare.h"

namespace malus::prep {

namespace {

// Steps that --skip leaves out.
const std::vector<std::pair<std::string, bool Cleaning::*>> kSteps = {
    {"weld", &Cleaning::weld},
    {"degenerate", &Cleaning::degenerate},
    {"duplicates", &Cleaning::duplicates},
    {"unreferenced", &Cleaning::unreferenced},
    {"orient", &Cleaning::orient},
    {"fans", &Cleaning::fans},
};

const std::map<std::string, Normals> kNormals = {
    {"crease", Normals::crease}, {"smoothing", Normals::smoothing}, {"authored", Normals::authored}};

struct Arguments {
  std::string input;
  std::string output;
  std::string reportFile;
  std::vector<std::string> skipped;
  std::string certify;
  bool json = false;
  Options options;
  int positionBits = 20;
  int normalBits = 12;
};

// What compression takes: floats. Returns the largest distance that a position moves by that, in metres.
double toFloat(const Mesh& mesh, compress::TriangleMesh& result) {
  double moved = 0;
  result.positions.reserve(mesh.positions.size());
  for (const glm::dvec3& p : mesh.positions) {
    result.positions.emplace_back(p);
    moved = std::max(moved, glm::distance(p, glm::dvec3(result.positions.back())));
  }
  result.normals = mesh.normals;
  result.triangles = mesh.triangles;
  return moved;
}

void tell(const Arguments& arguments, const Report& report) {
  const std::string json = toJson(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (!arguments.reportFile.empty()) writeFile(arguments.reportFile, std::string_view(json));
  fmt::print("{}", arguments.json ? json : toText(report));
}

// What is no glass is told in full, and not delivered.
void requireCertificate(const Arguments& arguments, const Report& report) {
  if (!report.certificate.checked || report.certificate.holds()) return;
  tell(arguments, report);
  const Problem& first = report.certificate.problems.front();
  throw Error(arguments.input, fmt::format("is not certified as glass: component {}: {}", first.component, first.what),
              first.repair, first.where);
}

void runPrep(const Arguments& arguments) {
  // Step 1: clean.
  Report report;
  Options options = arguments.options;
  for (const auto& [name, step] : kSteps)
    if (std::find(arguments.skipped.begin(), arguments.skipped.end(), name) != arguments.skipped.end())
      options.steps.*step = false;
  options.certifyGlass = arguments.certify == "glass";
  const Mesh mesh = prepare(arguments.input, options, report);
  requireCertificate(arguments, report);

  // Step 2: compress, on a grid of the mesh's own.
  compress::TriangleMesh source;
  const double moved = toFloat(mesh, source);
  compress::Settings settings;
  settings.grid = compress::gridFor(source.positions, arguments.positionBits);
  settings.normalBits = arguments.normalBits;
  const compress::Encoded encoded = compress::encode(source, settings);
  report.errors.positionMax = moved + static_cast<double>(encoded.positionErrorMax);
  report.errors.normalMaxDegrees = static_cast<double>(encoded.normalErrorMaxDegrees);
  report.compression.method = encoded.method;
  report.compression.bytes = encoded.bytes.size();

  // Step 3: write, then tell.
  writeFile(arguments.output, encoded.bytes);
  tell(arguments, report);
}

}  // namespace

void addPrepCommand(CLI::App& app) {
  CLI::App* prep = app.add_subcommand("prep", "Clean and compress a mesh");
  const auto arguments = std::make_shared<Arguments>();
  prep->add_option("input", arguments->input, "Mesh: OBJ, PLY, STL or OFF, in metres")->required()->type_name("FILE");
  prep->add_option("-o,--output", arguments->output, "Result: a Draco file, NAME.mesh.drc")
      ->required()
      ->type_name("FILE");
  prep->add_option("--report", arguments->reportFile, "Also write the report as JSON")->type_name("FILE");
  prep->add_flag("--json", arguments->json, "Print the report as JSON");
  std::vector<std::string> steps;
  for (const auto& [name, step] : kSteps) steps.push_back(name);
  prep->add_option("--skip", arguments->skipped,
                   "Steps of cleaning to leave out: " + fmt::format("{}", fmt::join(steps, ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(steps))
      ->type_name("STEP,...");
  prep->add_option(
          "--certify", arguments->certify,
          "glass: fail, and say why and where, unless the mesh can be a body of glass (with --sheet: a pair of "
          "interfaces)")
      ->check(CLI::IsMember({"glass"}))
      ->type_name("glass");
  prep->add_flag("--intersections", arguments->options.findIntersections,
                 "Tell faces that cross, touch or lie on each other");
  prep->add_flag("--drop-opposite", arguments->options.steps.dropOpposite,
                 "Of two faces back to back, drop the later one");
  prep->add_option("--fill-holes", arguments->options.steps.fillHoles, "Fill holes of at most so many edges")
      ->check(CLI::Range(3, 1000000))
      ->type_name("EDGES");
  prep->add_option(
          "--normals", arguments->options.normals,
          "crease: smooth but for sharp edges; smoothing: by the file's smoothing groups; authored: the file's")
      ->transform(CLI::CheckedTransformer(kNormals))
      ->type_name("KIND")
      ->default_str("crease");
  prep->add_flag("--flat", arguments->options.flat, "Normals are those of the faces; no vertex is split");
  prep->add_flag("--sheet", arguments->options.sheet, "An open surface on purpose: its side is kept");
  prep->add_option("--crease", arguments->options.creaseDegrees, "Edges sharper than this get two normals")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEGREES")
      ->capture_default_str();
  prep->add_option("--weld", arguments->options.steps.weldTolerance, "Vertices no farther apart than this become one")
      ->check(CLI::NonNegativeNumber)
      ->type_name("METRES")
      ->capture_default_str();
  prep->add_option("--weld-relative", arguments->options.weldRelative,
                   "The same as a share of the diagonal of the mesh's box; the larger of the two holds")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("SHARE")
      ->capture_default_str();
  prep->add_option("--position-bits", arguments->positionBits, "Steps of the grid along an axis: 2^N - 1")
      ->check(CLI::Range(1, 22))
      ->type_name("N")
      ->capture_default_str();
  prep->add_option("--normal-bits", arguments->normalBits, "Precision of normals")
      ->check(CLI::Range(2, 16))
      ->type_name("N")
      ->capture_default_str();
  prep->callback([arguments] { runPrep(*arguments); });
}

}  // namespace malus::prep
