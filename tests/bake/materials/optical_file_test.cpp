// Optical constants from YAML and CSV: values, habits of files, errors.
#include <string>

#include "bake/materials/optical_file.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using test::contains;
using test::errorMessage;
using Quantity = OpticalData::Quantity;

constexpr std::string_view kTable =
    "# a comment\nREFERENCES: |\n    somebody: a title\nCOMMENTS: 'none'\nDATA:\n  - type: tabulated nk\n    data: |\n"
    "        0.400 1.50 2.00\n        0.500 1.00 2.50\n\n        6.0E-01 0.50 3.00 \n";

std::string yamlError(const std::string& text) {
  return errorMessage([&] { parseOpticalYaml(text, "x.yml"); });
}
std::string csvError(const std::string& text) {
  return errorMessage([&] { parseOpticalCsv(text, "x.csv"); });
}
std::string entry(const std::string& keys) { return "DATA:\n  - " + keys + "\n"; }

TEST(OpticalFile, TablesAreInterpolated) {
  const OpticalData data = parseOpticalYaml(std::string(kTable), "x.yml");
  EXPECT_DOUBLE_EQ(data.at(Quantity::n, 400), 1.5);
  EXPECT_DOUBLE_EQ(data.at(Quantity::n, 425), 1.375);
  EXPECT_DOUBLE_EQ(data.at(Quantity::k, 590), 2.95);
  EXPECT_DOUBLE_EQ(data.at(Quantity::k, 600), 3);
  const OpticalConstants constants = data.at({600, 500, 400});
  EXPECT_EQ(constants.eta, glm::dvec3(0.5, 1, 1.5));
  EXPECT_EQ(constants.k, glm::dvec3(3, 2.5, 2));
}

TEST(OpticalFile, NothingIsExtrapolated) {
  const OpticalData data = parseOpticalYaml(std::string(kTable), "x.yml");
  for (const double nm : {399.9, 600.1, 5000.0})
    EXPECT_TRUE(contains(errorMessage([&] { data.at(Quantity::n, nm); }), "400 to 600 nm")) << nm;
  const OpticalData formula =
      parseOpticalYaml(entry("type: formula 1\n    wavelength_range: 0.3 2.0\n    coefficients: 0 1.0 0.1"), "x.yml");
  EXPECT_NEAR(formula.at(Quantity::n, 589), 1.424669, 5e-7);
  EXPECT_EQ(formula.at(Quantity::k, 589), 0);  // no k in the file
  for (const double nm : {299.0, 2001.0}) EXPECT_THROW(formula.at(Quantity::n, nm), Error) << nm;
  EXPECT_NO_THROW(formula.at(Quantity::n, 300));
  EXPECT_NO_THROW(formula.at(Quantity::n, 2000));
}

TEST(OpticalFile, FormulaAndTableOfKTogether) {
  const OpticalData data = parseOpticalYaml(
      "DATA:\n  - type: formula 5\n    range: 0.3 2.0\n    coefficients: 1.5\n"
      "  - type: tabulated k\n    data: |\n        0.6 2e-8\n        0.4 1e-8\n",
      "x.yml");
  EXPECT_DOUBLE_EQ(data.at(Quantity::n, 500), 1.5);
  EXPECT_DOUBLE_EQ(data.at(Quantity::k, 500), 1.5e-8);
  EXPECT_THROW(data.at(Quantity::k, 700), Error);  // the file has k, but not there
}

TEST(OpticalFile, CsvWithTablesTogetherOrApart) {
  for (const std::string text :
       {"wl,n\n0.4,1.5\n0.5,1.0\n\nwl,k\n0.4,2.0\n0.5,2.5\n", "wl,n,k\r\n0.4,1.5,2\r\n0.5,1,2.5\r\n",
        "\xef\xbb\xbfwavelength_nm;k;n\n400;2;1.5\n500;2.5;1\n", "Wavelength (um)\tn\tk\n0.5\t1\t2.5\n0.4\t1.5\t2\n"}) {
    const OpticalData data = parseOpticalCsv(text, "x.csv");
    EXPECT_NEAR(data.at(Quantity::n, 450), 1.25, 1e-12) << text;
    EXPECT_NEAR(data.at(Quantity::k, 450), 2.25, 1e-12) << text;
  }
}

TEST(OpticalFile, ErrorsNameLineAndReason) {
  EXPECT_TRUE(
      contains(yamlError(entry("type: tabulated nk\n    data: |\n        0.4 1.5 2\n        0.5 1.5")), "x.yml:5"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n\n    data: |\n        0.4 big")), "'big'"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n\n    data: |\n        0.4 nan")), "'nan'"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n\n    data: |\n        0.4 -1")), "-1"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n\n    data: |\n        0 1.5")), "not positive"));
  EXPECT_TRUE(
      contains(yamlError(entry("type: tabulated n\n    data: |\n        0.4 1.5\n        0.4 1.6")), "two values"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n\n    data: ''")), "no rows"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n")), "'data'"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated n2\n    data: '0.4 1.5'")), "tabulated n2"));
  EXPECT_TRUE(
      contains(yamlError(entry("type: formula 10\n    wavelength_range: 1 2\n    coefficients: 1")), "formula 10"));
  EXPECT_TRUE(contains(yamlError(entry("type: formula 8\n    wavelength_range: 1 2\n    coefficients: 1 1 1 1 1")),
                       "coefficients"));
  EXPECT_TRUE(contains(yamlError(entry("type: formula 1\n    wavelength_range: 2 1\n    coefficients: 1")), "2 to 1"));
  EXPECT_TRUE(contains(yamlError(entry("type: formula 1\n    coefficients: 1")), "range"));
  EXPECT_TRUE(contains(yamlError(entry("type: tabulated k\n    data: '0.4 1.5'")), "no index"));
  EXPECT_TRUE(contains(yamlError("DATA: 5\n"), "DATA"));
  EXPECT_TRUE(contains(yamlError("a: [1, 2\n"), "x.yml:2"));
  EXPECT_TRUE(contains(yamlError("just text"), "DATA"));
  EXPECT_TRUE(contains(csvError("0.4,1.5\n"), "x.csv:1"));
  EXPECT_TRUE(contains(csvError("wl,n\n0.4,1.5\n0.5\n"), "x.csv:3"));
  EXPECT_TRUE(contains(csvError(""), "no index"));
  EXPECT_TRUE(contains(csvError("wl,n\n"), "no rows"));
}

TEST(OpticalFile, AFormulaWithoutAValueIsAnError) {
  const OpticalData data =
      parseOpticalYaml(entry("type: formula 3\n    wavelength_range: 0.3 2\n    coefficients: -1"), "x.yml");
  EXPECT_TRUE(contains(errorMessage([&] { data.at(Quantity::n, 500); }), "formula 3"));
}

TEST(OpticalFile, ExtensionsChooseTheReader) {
  for (const char* name : {"a.yml", "b.YAML", "folder/c.csv"}) EXPECT_TRUE(isOpticalFile(name)) << name;
  for (const char* name : {"gold", "a.txt", "csv", ""}) EXPECT_FALSE(isOpticalFile(name)) << name;
  const test::TemporaryFolder folder;
  EXPECT_EQ(readOpticalFile(folder.write("a.yml", kTable)).at(Quantity::n, 500), 1);
  EXPECT_EQ(readOpticalFile(folder.write("a.CSV", "wl,n\n0.5,1.25\n")).at(Quantity::n, 500), 1.25);
  EXPECT_THROW(readOpticalFile(folder.path() / "missing.yml"), Error);
}

}  // namespace
}  // namespace malus::bake
