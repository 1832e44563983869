// `malus material`: table, CSV, JSON, plot, wrong arguments.
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

TEST(Material, OneAngleIsOneObject) {
  const Finished finished = malus({"material", "gold", "--angle", "45", "--json"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json gold = json::parse(finished.out);
  for (const char* key : {"angleDegrees", "rs", "rp", "ts", "tp", "diattenuation", "phaseDegrees", "reflection",
                          "transmission", "material", "eta", "k", "outside", "wavelengthNm", "precision"})
    EXPECT_TRUE(gold.contains(key)) << key;
  EXPECT_TRUE(gold.at("ts").is_null());
  EXPECT_TRUE(gold.at("transmission").is_null());
  EXPECT_EQ(gold.at("eta"), 0.5439);
  EXPECT_EQ(gold.at("reflection").size(), 16u);
  // At 45 degrees r_p = r_s^2 (Fresnel's equations), so R_p = R_s^2.
  EXPECT_NEAR(gold.at("rp").get<double>(), std::pow(gold.at("rs").get<double>(), 2), 1e-14);
  EXPECT_NEAR(gold.at("reflection")[0].get<double>(), (gold.at("rs").get<double>() + gold.at("rp").get<double>()) / 2,
              1e-15);
  const json red = json::parse(malus({"material", "gold", "--angle", "45", "--wavelength", "630", "--json"}).out);
  EXPECT_GT(red.at("rs"), gold.at("rs"));
}

TEST(Material, SeveralAnglesAreAList) {
  const json list =
      json::parse(malus({"material", "--eta", "1", "--outside", "1.5", "--angle", "0:90:7", "--json"}).out);
  ASSERT_EQ(list.size(), 14u);
  EXPECT_EQ(list.front().at("angleDegrees"), 0);
  EXPECT_EQ(list.back().at("angleDegrees"), 90);
  EXPECT_TRUE(list.front().at("material").is_null());
  EXPECT_EQ(list[7].at("rs"), 1) << "total reflection at 49 degrees";
  EXPECT_EQ(list[7].at("ts"), 0);
  EXPECT_GT(list[7].at("phaseDegrees"), 30);
}

TEST(Material, FloatPrecisionIsThatOfTheRenderers) {
  const auto at = [](const char* precision) {
    return json::parse(malus({"material", "bk7", "--angle", "30", "--precision", precision, "--json"}).out);
  };
  const double one = at("float").at("rs"), two = at("double").at("rs");
  EXPECT_EQ(one, static_cast<double>(static_cast<float>(one)));
  EXPECT_NE(one, two);
  EXPECT_NEAR(one / two, 1, 1e-6);
}

TEST(Material, TableCsvAndPlot) {
  const Finished table = malus({"material", "bk7", "--angle", "0:90:10"});
  EXPECT_EQ(table.exitCode, 0);
  EXPECT_TRUE(contains(table.out, "R_s")) << table.out;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 12);
  EXPECT_TRUE(contains(malus({"material", "bk7", "--angle", "60"}).out, "Mueller"));
  const Finished csv = malus({"material", "bk7", "--angle", "0:90:10", "--csv"});
  EXPECT_TRUE(csv.out.starts_with("angleDegrees,rs,rp,ts,tp,diattenuation,phaseDegrees,reflection00,")) << csv.out;
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 11);
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.begin() + static_cast<long>(csv.out.find('\n')), ','), 41);
  const Folder folder;
  const Finished plot = malus({"material", "gold", "--plot", folder / "gold.svg"});
  ASSERT_EQ(plot.exitCode, 0) << plot.err;
  EXPECT_TRUE(contains(readText(folder / "gold.svg"), "angle of incidence"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"gold.svg"});
}

TEST(Material, AFileOverWavelengths) {
  const Folder folder;
  std::ofstream(folder / "a.csv") << "wl,n,k\n0.4,1.5,0\n0.6,1.7,0\n";
  const json list = json::parse(malus({"material", folder / "a.csv", "--wavelength", "400:600:50", "--json"}).out);
  ASSERT_EQ(list.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const double n = 1.5 + 0.05 * static_cast<double>(i);
    EXPECT_EQ(list[i].at("wavelengthNm"), 400 + 50 * i);
    EXPECT_EQ(list[i].at("angleDegrees"), 0);
    EXPECT_NEAR(list[i].at("eta").get<double>(), n, 1e-12);
    EXPECT_NEAR(list[i].at("rs").get<double>(), std::pow((n - 1) / (n + 1), 2), 1e-12);
  }
  const Finished table = malus({"material", folder / "a.csv", "--wavelength", "400:600:50", "--angle", "0:60:30"});
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 17) << table.out;
  const Finished plot = malus({"material", "gold", "--wavelength", "400:700:5", "--plot", folder / "gold.svg"});
  ASSERT_EQ(plot.exitCode, 0) << plot.err;
  EXPECT_TRUE(contains(readText(folder / "gold.svg"), "wavelength in vacuum"));
  expectRefusal(malus({"material", folder / "a.csv", "--wavelength", "700"}), "400 to 600 nm");
}

TEST(Material, WrongArguments) {
  const std::vector<std::vector<std::string>> kWrong = {{"material"},
                                                        {"material", "gold", "--eta", "1.5"},
                                                        {"material", "gold", "--k", "1"},
                                                        {"material", "--eta", "2000"},
                                                        {"material", "gold", "--angle", "91"},
                                                        {"material", "gold", "--angle", "0:90"},
                                                        {"material", "gold", "--angle", "0:90:0"},
                                                        {"material", "gold", "--angle", "50:40:1"},
                                                        {"material", "gold", "--angle", "0:90:1e-9"},
                                                        {"material", "gold", "--angle", "nan"},
                                                        {"material", "gold", "--wavelength", "0"},
                                                        {"material", "gold", "--wavelength", "green"},
                                                        {"material", "gold", "--wavelength", "600:500:10"},
                                                        {"material", "--eta", "1.5", "--wavelength", "500:600:10"},
                                                        {"material", "gold", "--precision", "half"},
                                                        {"material", "gold", "--csv", "--json"}};
  for (const auto& arguments : kWrong) {
    const Finished finished = malus(arguments);
    EXPECT_EQ(finished.exitCode, 2) << finished.err;
    EXPECT_EQ(finished.out, "");
  }
  expectRefusal(malus({"material", "golde"}), "'gold'");
  expectRefusal(malus({"material", "gold", "--wavelength", "100"}), "100 nm");
  expectRefusal(malus({"material", "missing.yml"}), "missing.yml");
  expectRefusal(malus({"material", "--eta", "0"}), "--eta");
  expectRefusal(malus({"material", "gold", "--plot", "gold.txt"}), "gold.txt");
  EXPECT_EQ(malus({"material", "gold", "--plot", "/no/such/folder/gold.png"}).exitCode, 1);
}

}  // namespace
}  // namespace malus::test
