#include "render/compare_images_cli.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/base/image_colour.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/compare/image_difference.h"
#include "render/image/output.h"
#include "render/options.h"

namespace malus::render {

namespace {

struct CompareImagesArguments {
  std::string a, b, difference;
  std::vector<std::string> channels = {"R", "G", "B"};
  double threshold = 1e-3, gain = 10;
  std::optional<double> failOver;
  std::optional<std::uint64_t> maxOutliers;
  bool json = false;
};

void printDifference(const CompareImagesArguments& arguments, const ImageDifference& d) {
  if (!arguments.json) {
    console::printLine(
        "mean {:.6g}  rms {:.6g}  relative rms {:.6g}  max {:.6g}  99.9 % {:.6g}  outliers over {:g}: {} of {} "
        "pixels{}",
        d.mean, d.rms, d.relRms, d.max, d.p999, arguments.threshold, d.outliers, d.pixels,
        d.nonFinite > 0 ? fmt::format(", {} with NaN or infinity", d.nonFinite) : "");
    return;
  }
  // JSON has no infinity.
  const auto number = [](double v) { return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json(); };
  const nlohmann::json result = {
      {"mean", d.mean},           {"rms", d.rms},           {"relRms", number(d.relRms)},
      {"max", number(d.max)},     {"p999", number(d.p999)}, {"outliers", d.outliers},
      {"nonFinite", d.nonFinite}, {"pixels", d.pixels},     {"threshold", arguments.threshold}};
  console::printText(jsonText(result) + "\n");
}

image::Image readLinear(const std::string& file, const std::vector<std::string>& channels) {
  image::Image image = image::read(file);
  const bool comparesAlpha = std::find(channels.begin(), channels.end(), "A") != channels.end();
  for (const std::string& note : image::makeLinear(image, file, comparesAlpha)) console::warn(note);
  return image;
}

void runCompareImages(const CompareImagesArguments& arguments) {
  OutputFiles files;
  files.addInput(arguments.a);
  files.addInput(arguments.b);
  files.addOutput(arguments.difference, "--difference");
  files.check();
  const image::Image a = readLinear(arguments.a, arguments.channels), b = readLinear(arguments.b, arguments.channels);
  ImageDifference d;
  try {
    d = difference(a, b, arguments.channels, arguments.threshold);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}", arguments.a, arguments.b), error.what());
  }
  if (!arguments.difference.empty()) writeImage(arguments.difference, differenceImage(a, b, arguments.gain), 0);
  printDifference(arguments, d);
  if (arguments.failOver && !(d.max <= *arguments.failOver)) throw ImagesDiffer{};
  if (arguments.maxOutliers && d.outliers > *arguments.maxOutliers) throw ImagesDiffer{};
}

}  // namespace

void addCompareImagesCommand(CLI::App& app) {
  auto a = std::make_shared<CompareImagesArguments>();
  CLI::App* command = app.add_subcommand("compare-images", "Measure the difference of two images, in linear light");
  command->add_option("a", a->a, "First image")->required()->type_name("FILE");
  command->add_option("b", a->b, "Second image")->required()->type_name("FILE");
  command->add_option("--channels", a->channels, "Channels to compare")->delimiter(',')->capture_default_str();
  command->add_option("--threshold", a->threshold, "Difference above which a pixel is an outlier")
      ->transform(nonNegativeNumber())
      ->capture_default_str();
  command->add_option("--fail-over", a->failOver, "Exit with code 3 if the largest difference is above this")
      ->transform(nonNegativeNumber());
  command->add_option("--max-outliers", a->maxOutliers, "Exit with code 3 if more pixels are outliers")
      ->transform(wholeNumberBetween(0));
  command->add_option("--difference", a->difference, "Image to write: the absolute difference times --gain")
      ->check(outputName())
      ->type_name("FILE");
  command->add_option("--gain", a->gain, "Factor of the difference image")
      ->transform(positiveNumber())
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print the result as JSON");
  command->callback([a] { runCompareImages(*a); });
}

}  // namespace malus::render
