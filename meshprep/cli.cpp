#include "meshprep/cli.h"

#include <features.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/certify/rounded_contacts.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/mesh_file.h"
#include "meshprep/compress/rounding.h"
#include "meshprep/deprecated_option.h"
#include "meshprep/json_text.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "meshprep/prepare.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

namespace {

const std::map<std::string, Normals> kNormals = {
    {"authored", Normals::authored}, {"crease", Normals::crease}, {"smoothing", Normals::smoothing}};

// Steps of --skip besides those of cleaning.
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

void printReport(const Arguments& arguments, const Report& report) {
  const std::string json = jsonText(toJson(report)) + "\n";
  if (!arguments.reportFile.empty()) writeFile(arguments.reportFile, std::string_view(json));
  console::printText(arguments.json ? json : toText(report));
}

// Prints the report and throws Error if a requested certificate is refused.
void requireCertificate(const Arguments& arguments, const Report& report) {
  if (!report.certificate.checked || report.certificate.isGranted()) return;
  printReport(arguments, report);
  const Problem& first = report.certificate.problems.front();
  throw Error(
      arguments.input,
      fmt::format("mesh is not certified as glass: component {}: {}, {}", first.component, first.what, first.where),
      fmt::format("a repair: {}", first.repair));
}

// Returns the source vertex and face of each compressed vertex and triangle, as JSON. vertices, faces: sources of the
// mesh that was encoded.
std::string mapJson(const std::vector<std::uint32_t>& vertices, const std::vector<std::uint32_t>& faces,
                    const compress::Encoded& encoded) {
  const auto mapIndices = [](const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& source) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::uint32_t i : order) list.push_back(source.empty() ? i : source[i]);
    return list;
  };
  return nlohmann::json{{"vertices", mapIndices(encoded.sourceVertices, vertices)},
                        {"triangles", mapIndices(encoded.sourceTriangles, faces)}}
             .dump() +
         "\n";
}

bool skips(const Arguments& arguments, std::string_view step) {
  return std::find(arguments.skipped.begin(), arguments.skipped.end(), step) != arguments.skipped.end();
}

// Refuses to write over the mesh, over a file that it refers to, or two results to one file.
void checkFiles(const Arguments& arguments) {
  OutputFiles files;
  files.addInput(arguments.input);
  for (const std::filesystem::path& file : referencedFiles(arguments.input)) files.addInput(file);
  files.addOutput(arguments.output, "--output");
  files.addOutput(arguments.reportFile, "--report");
  files.addOutput(arguments.mapFile, "--source-map");
  files.check();
}

void setErrors(const compress::Deviation& deviation, Report& report) {
  report.errors.positionMax = deviation.positionMax;
  report.errors.normalMaxDegrees = deviation.normalMaxDegrees;
  report.errors.tiltMaxDegrees = deviation.tiltMaxDegrees;
  report.errors.tilted = deviation.tilted;
  report.errors.tiltedArea = deviation.tiltedArea;
  report.errors.flipped = deviation.flipped;
  report.errors.degenerate = deviation.newDegenerate;
}

// Inspects the rounded mesh if a certificate of a closed body is requested: rounding must not make faces touch.
compress::Inspection certificateInspection(const Arguments& arguments, const Mesh& mesh) {
  if (arguments.certify != "glass" || arguments.options.openSurface) return {};
  const auto search = std::make_shared<RoundedContacts>(mesh);
  const auto contacts = [&mesh, search](const compress::RoundedMesh& rounded) {
    Mesh delivered;
    const std::vector<Intersections::Pair> pairs = search->find(rounded.positions);
    if (pairs.empty()) return Findings{};
    delivered.positions = rounded.positions;
    delivered.triangles = mesh.triangles;
    delivered.sourceFaces = mesh.sourceFaces;
    return describePairs(delivered, pairs);
  };
  compress::Inspection inspection;
  inspection.find = [contacts](std::span<const compress::RoundedMesh> rounded) {
    return std::vector<std::size_t>(contacts(rounded.front()).count > 0 ? 1 : 0, 0);
  };
  inspection.refuse = [contacts, &arguments](std::span<const compress::RoundedMesh> rounded) {
    const Findings found = contacts(rounded.front());
    const compress::Grid& grid = rounded.front().grid;
    throw Error(arguments.input,
                fmt::format("mesh is not certified as glass after rounding: {} touch or cross with {} position bits, "
                            "first {}",
                            found.count == 1 ? "1 pair of faces" : fmt::format("{} pairs of faces", found.count),
                            grid.positionBits, describe(found.first.front())),
                fmt::format("faces at least {:.2g} m apart, or a smaller mesh{}", 2 * grid.step,
                            grid.positionBits < compress::kMaxPositionBits ? ", or more bits (--position-bits)" : ""));
  };
  return inspection;
}

// Rounds the texture attributes of a mesh, checks their errors and adds them to the report.
compress::RoundedTextures roundTextures(const Arguments& arguments, const Mesh& mesh, Report& report,
                                        std::vector<std::string>& warnings) {
  const compress::TextureView view{{mesh.textureCoordinates[0], mesh.textureCoordinates[1]}, mesh.tangents};
  compress::RoundedTextures rounded =
      compress::roundTextures(view, compress::kDefaultTexels, arguments.bounds, arguments.input);
  const compress::TextureDeviation deviation = compress::measureTextures(view, rounded, compress::kDefaultTexels);
  warnings = compress::checkTextures(deviation, rounded.grids, arguments.bounds, arguments.input);
  report.errors.uvMaxTexels = deviation.uvTexels;
  report.errors.tangentMaxDegrees = deviation.tangentDegrees;
  return rounded;
}

// Keeps freed memory for later allocations. Compression allocates and frees arrays of tens of megabytes in turn; new
// pages for each of them take an eighth of its time.
void keepFreedMemory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

// Cleans and certifies the mesh of the file.
Mesh prepareInput(const Arguments& arguments, Report& report) {
  Options options = arguments.options;
  for (const auto& [name, step] : kCleaningSteps)
    if (skips(arguments, name)) options.steps.*step = false;
  options.findJunctions = !skips(arguments, kJunctions);
  options.findIntersections = !skips(arguments, kIntersections);
  options.certifyGlass = arguments.certify == "glass";
  options.keepTextures = arguments.bounds.uvErrorTexels.has_value();
  Mesh mesh = prepare(arguments.input, options, report);
  requireCertificate(arguments, report);
  return mesh;
}

// Rounds the mesh, measures the error and copies what the encoder needs.
std::unique_ptr<compress::Encoder> makeEncoder(const Arguments& arguments, const Mesh& mesh, Report& report,
                                               compress::Settings& settings, compress::TextureGrids& textureGrids) {
  const compress::MeshView view(mesh.positions, mesh.normals, mesh.triangles);
  const compress::RoundedMesh rounded =
      std::move(compress::roundMeshes({&view, 1}, arguments.bounds, compress::Precision::doubles,
                                      certificateInspection(arguments, mesh))
                    .front());
  settings = {rounded.grid, rounded.normalBits};
  std::vector<std::string> textureWarnings;
  const compress::RoundedTextures textures = roundTextures(arguments, mesh, report, textureWarnings);
  textureGrids = textures.grids;
  auto encoder = std::make_unique<compress::Encoder>(view, rounded.positions, settings, textures);
  const bool glass = arguments.certify == "glass";
  report.compression.warnings =
      compress::checkBounds(encoder->deviation(), settings, arguments.bounds, glass, arguments.input);
  report.compression.warnings.insert(report.compression.warnings.end(), textureWarnings.begin(), textureWarnings.end());
  setErrors(encoder->deviation(), report);
  return encoder;
}

void runPrep(const Arguments& arguments) {
  checkFiles(arguments);
  keepFreedMemory();
  Report report;
  Mesh mesh = prepareInput(arguments, report);
  const bool hasNormals = !mesh.normals.empty();

  // Compress on a grid around the mesh, which is freed first.
  compress::Settings settings;
  compress::TextureGrids textureGrids;
  const std::unique_ptr<compress::Encoder> encoder = makeEncoder(arguments, mesh, report, settings, textureGrids);
  std::vector<std::uint32_t> sourceVertices, sourceFaces;
  if (!arguments.mapFile.empty())
    sourceVertices = std::move(mesh.sourceVertices), sourceFaces = std::move(mesh.sourceFaces);
  mesh = {};
  const compress::Encoded encoded = encoder->encode();
  report.compression.method = encoded.method;
  const std::vector<std::byte> file = compress::meshFileBytes(encoded.bytes, settings.grid, textureGrids);
  report.compression.bytes = file.size();
  report.compression.sequentialReason = encoded.sequentialReason;
  report.compression.positionBits = settings.grid.positionBits;
  report.compression.normalBits = hasNormals ? settings.normalBits : 0;
  report.compression.origin = settings.grid.origin;
  report.compression.step = settings.grid.step;
  report.compression.encodeMs = encoded.encodeMs;
  report.compression.decodeMs = encoded.decodeMs;

  // Write the files, then print the report.
  writeFile(arguments.output, file);
  if (!arguments.mapFile.empty())
    writeFile(arguments.mapFile, std::string_view(mapJson(sourceVertices, sourceFaces, encoded)));
  printReport(arguments, report);
}

void addCleaningOptions(CLI::App& prep, Arguments& arguments) {
  std::vector<std::string> steps;
  steps.reserve(kCleaningSteps.size() + 2);
  for (const auto& [name, step] : kCleaningSteps) steps.emplace_back(name);
  steps.emplace_back(kJunctions);
  steps.emplace_back(kIntersections);
  Options& options = arguments.options;
  prep.add_flag("--strict", options.strict,
                "Fail if a part of a file is invalid or has no area, instead of leaving it out with a warning");
  prep.add_flag("--open-surface", options.openSurface, "Declare an open surface: its orientation is kept");
  prep.add_option("--weld", options.steps.weldTolerance, "Join vertices within this distance [m]")
      ->transform(nonNegativeNumber())
      ->type_name("METRES")
      ->capture_default_str();
  prep.add_option("--weld-relative", options.weldRelative,
                  "Join vertices within this fraction of the bounding box diagonal, if larger than --weld")
      ->transform(numberBetween(0, 1))
      ->type_name("FRACTION")
      ->capture_default_str();
  prep.add_flag("--drop-opposite", options.steps.dropOpposite, "Drop the later one of two faces back to back");
  prep.add_option("--fill-holes", options.steps.fillHoles, "Fill holes of at most this number of edges")
      ->transform(wholeNumberBetween(3, 1000000))
      ->type_name("EDGES");
  prep.add_option("--skip", arguments.skipped, "Skip these steps; fans requires degenerate")
      ->delimiter(',')
      ->check(CLI::IsMember(steps))
      ->type_name("STEP,...");
  prep.add_option("--certify", arguments.certify,
                  "Fail unless the mesh is a closed solid of glass, or with --open-surface a pair of interfaces")
      ->check(CLI::IsMember({"glass"}))
      ->type_name("glass");
}

void addNormalOptions(CLI::App& prep, Options& options) {
  prep.add_option_function<std::string>(
          "--normals", [&options](const std::string& name) { options.normals = kNormals.at(name); },
          "Source of normals: crease (smooth except at sharp edges), smoothing (groups of the file) or authored "
          "(normals of the file)")
      ->check(CLI::IsMember(&kNormals))
      ->default_str("crease");
  prep.add_option("--crease", options.creaseDegrees, "Smallest angle of a sharp edge [degrees]")
      ->transform(numberBetween(0, 180))
      ->type_name("DEGREES")
      ->capture_default_str();
  prep.add_flag("--flat", options.flat, "Use the normals of the faces: none are stored, and no vertex is split");
}

void addCompressionOptions(CLI::App& prep, compress::Bounds& bounds) {
  prep.add_option("--position-error", bounds.positionError, "Largest distance of a vertex from its source [m]")
      ->transform(positiveNumber())
      ->type_name("METRES");
  prep.add_option("--normal-error", bounds.normalErrorDegrees,
                  "Largest angle of a normal from its source [degrees]; without it 0.05 is a goal")
      ->transform(positiveNumber())
      ->type_name("DEGREES");
  prep.add_option("--max-uv-error", bounds.uvErrorTexels,
                  "Largest error of a texture coordinate [texels of the largest image, or of 4096]")
      ->transform(positiveNumber())
      ->type_name("TEXELS");
  prep.add_option("--position-bits", bounds.positionBits, "Exact number of bits per coordinate")
      ->transform(wholeNumberBetween(1, compress::kMaxPositionBits))
      ->type_name("N");
  prep.add_option("--normal-bits", bounds.normalBits, "Exact number of bits per coordinate of a normal")
      ->transform(wholeNumberBetween(compress::kMinNormalBits, compress::kMaxNormalBits))
      ->type_name("N");
}

}  // namespace

void addPrepCommand(CLI::App& app) {
  CLI::App& prep = *app.add_subcommand("prep", "Clean and compress a mesh");
  const auto arguments = std::make_shared<Arguments>();
  prep.add_option("input", arguments->input, "Mesh in metres: OBJ, PLY, STL, OFF or glTF")
      ->required()
      ->type_name("FILE");
  prep.add_option("-o,--output", arguments->output, "Draco file to write (NAME.mesh.drc)")
      ->required()
      ->check(outputName())
      ->type_name("FILE");
  prep.add_option("--report", arguments->reportFile, "JSON file for the report")
      ->check(outputName())
      ->type_name("FILE");
  prep.add_option("--source-map", arguments->mapFile,
                  "JSON file for the source vertex and face of every compressed vertex and triangle")
      ->check(outputName())
      ->type_name("FILE");
  prep.add_flag("--json", arguments->json, "Print the report as JSON");
  addCleaningOptions(prep, *arguments);
  prep.add_option("--simplify-error", arguments->options.simplify.maxError,
                  "Collapse edges while the surface stays within this distance")
      ->transform(positiveNumber())
      ->type_name("METRES");
  prep.add_option("--simplify-triangles", arguments->options.simplify.triangles,
                  "Collapse edges until so many triangles are left")
      ->transform(wholeNumberBetween(1))
      ->type_name("N");
  prep.add_option("--simplify-normal", arguments->options.simplify.maxNormalErrorDegrees,
                  "Collapse edges only while the normals of the surface stay within this angle")
      ->transform(numberBetween(0, 180))
      ->type_name("DEGREES");
  addNormalOptions(prep, arguments->options);
  addCompressionOptions(prep, arguments->bounds);
  addFormerFlag(prep, "--sheet", "--open-surface");
  addFormerOption(prep, "--max-normal-error", "--normal-error");
  addRemovedOption(prep, "--max-error", "--position-error");  // `render`: relative RMS error
  addRemovedOption(prep, "--keep-map", "--source-map");       // `bake`: a flag
  prep.callback([arguments] { runPrep(*arguments); });
}

}  // namespace malus::prep
