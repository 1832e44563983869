#include "meshprep/cli.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/prepare.h"

namespace malus::prep {

namespace {

const std::map<std::string, Normals> kNormals = {
    {"crease", Normals::crease}, {"smoothing", Normals::smoothing}, {"authored", Normals::authored}};

// What --skip leaves out besides the steps of cleaning.
constexpr std::string_view kJunctions = "junctions", kIntersections = "intersections";

struct Arguments {
  std::string input;
  std::string output;
  std::string reportFile;
  std::vector<std::string> skipped;
  std::string certify;
  bool json = false;
  Options options;
  compress::Bounds bounds;
  std::string mapFile;
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
  if (!report.certificate.checked || report.certificate.isGranted()) return;
  tell(arguments, report);
  const Problem& first = report.certificate.problems.front();
  throw Error(arguments.input, fmt::format("is not certified as glass: component {}: {}", first.component, first.what),
              first.repair, first.where);
}

// For each packed vertex and triangle, the vertex and face of the source file that it comes from.
std::string mapJson(const Mesh& mesh, const compress::Encoded& encoded) {
  const auto through = [](const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& source) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::uint32_t i : order) list.push_back(source.empty() ? i : source[i]);
    return list;
  };
  return nlohmann::json{{"vertices", through(encoded.sourceVertices, mesh.sourceVertices)},
                        {"triangles", through(encoded.sourceTriangles, mesh.sourceFaces)}}
             .dump() +
         "\n";
}

bool skips(const Arguments& arguments, std::string_view step) {
  return std::find(arguments.skipped.begin(), arguments.skipped.end(), step) != arguments.skipped.end();
}

void runPrep(const Arguments& arguments) {
  // Step 1: clean.
  Report report;
  Options options = arguments.options;
  for (const auto& [name, step] : kCleaningSteps)
    if (skips(arguments, name)) options.steps.*step = false;
  options.findJunctions = !skips(arguments, kJunctions);
  options.findIntersections = !skips(arguments, kIntersections);
  options.certifyGlass = arguments.certify == "glass";
  const Mesh mesh = prepare(arguments.input, options, report);
  requireCertificate(arguments, report);

  // Step 2: compress, on a grid of the mesh's own.
  compress::TriangleMesh source;
  const double moved = toFloat(mesh, source);
  const compress::MeshView view = source;
  const compress::Bits bits = compress::chooseBits({&view, 1}, arguments.bounds, moved);
  const compress::Settings settings{bits.grid, bits.normalBits.front()};
  const compress::Encoded encoded = compress::encode(source, settings);
  report.compression.warnings =
      compress::checkBounds(encoded.deviation, settings, arguments.bounds, arguments.input, moved);
  report.errors = {moved + encoded.deviation.positionMax, encoded.deviation.normalMaxDegrees,
                   encoded.deviation.tiltMaxDegrees, encoded.deviation.flipped, encoded.deviation.newDegenerate};
  report.compression.method = encoded.method;
  report.compression.bytes = encoded.bytes.size();
  report.compression.sequentialReason = encoded.sequentialReason;
  report.compression.positionBits = settings.grid.positionBits;
  report.compression.normalBits = source.normals.empty() ? 0 : settings.normalBits;
  report.compression.encodeMs = encoded.encodeMs;
  report.compression.decodeMs = encoded.decodeMs;

  // Step 3: write, then tell.
  writeFile(arguments.output, encoded.bytes);
  if (!arguments.mapFile.empty()) writeFile(arguments.mapFile, std::string_view(mapJson(mesh, encoded)));
  tell(arguments, report);
}

}  // namespace

void addPrepCommand(CLI::App& app) {
  CLI::App* prep = app.add_subcommand("prep", "Clean and compress a mesh");
  const auto arguments = std::make_shared<Arguments>();
  prep->add_option("input", arguments->input, "Mesh: OBJ, PLY, STL, OFF or glTF, in metres")
      ->required()
      ->type_name("FILE");
  prep->add_option("-o,--output", arguments->output, "Result: a Draco file, NAME.mesh.drc")
      ->required()
      ->type_name("FILE");
  prep->add_option("--report", arguments->reportFile, "Also write the report as JSON")->type_name("FILE");
  prep->add_flag("--json", arguments->json, "Print the report as JSON");
  std::vector<std::string> steps;
  steps.reserve(kCleaningSteps.size() + 2);
  for (const auto& [name, step] : kCleaningSteps) steps.emplace_back(name);
  steps.emplace_back(kJunctions);
  steps.emplace_back(kIntersections);
  prep->add_option("--skip", arguments->skipped,
                   fmt::format("Steps to leave out: {}; without degenerate there are no fans", fmt::join(steps, ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(steps))
      ->type_name("STEP,...");
  prep->add_option(
          "--certify", arguments->certify,
          "glass: fail, and say why and where, unless the mesh can be a body of glass (with --sheet: a pair of "
          "interfaces)")
      ->check(CLI::IsMember({"glass"}))
      ->type_name("glass");
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
  prep->add_flag("--sheet", arguments->options.openSurface, "An open surface on purpose: its side is kept");
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
  prep->add_option("--simplify-error", arguments->options.simplify.maxError,
                   "Collapse edges while the surface stays within this distance")
      ->check(CLI::PositiveNumber)
      ->type_name("METRES");
  prep->add_option("--simplify-triangles", arguments->options.simplify.triangles,
                   "Collapse edges until so many triangles are left")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  prep->add_option("--simplify-normal", arguments->options.simplify.maxNormalErrorDegrees,
                   "Collapse edges only while the normals of the surface stay within this angle")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEGREES");
  prep->add_option("--max-error", arguments->bounds.positionError, "No vertex is farther from its source than this")
      ->check(CLI::PositiveNumber)
      ->type_name("METRES");
  prep->add_option("--max-normal-error", arguments->bounds.normalErrorDegrees,
                   "No normal is farther from its source than this; 0.05 is tried unless asked")
      ->check(CLI::PositiveNumber)
      ->type_name("DEGREES");
  prep->add_option("--position-bits", arguments->bounds.positionBits,
                   "Just these steps of the grid along an axis, 2^N - 1, whatever error they bring")
      ->check(CLI::Range(1, compress::kMaxPositionBits))
      ->type_name("N");
  prep->add_option("--normal-bits", arguments->bounds.normalBits, "Just this precision of normals")
      ->check(CLI::Range(compress::kMinNormalBits, compress::kMaxNormalBits))
      ->type_name("N");
  prep->add_option("--keep-map", arguments->mapFile,
                   "Also write, as JSON, the source's vertex and face of every packed vertex and triangle")
      ->type_name("FILE");
  prep->callback([arguments] { runPrep(*arguments); });
}

}  // namespace malus::prep
