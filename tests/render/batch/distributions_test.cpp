#include "render/batch/distributions.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"

namespace malus::render {
namespace {

using nlohmann::json;

json draw(const std::string& text, std::uint64_t seed, std::uint64_t frame) {
  return drawValues(json::parse(text), seed, frame, "jobs.jsonl:1");
}

// Of SplitMix64 with the constants of its paper, computed apart from this program.
TEST(Distributions, SeedsAreThoseOfSplitMix) {
  const std::uint64_t first = 0xe220a8397b1dcdaf;  // the first output from the state 0
  EXPECT_NE(frameSeed(0, 0), frameSeed(0, 1));
  // The seed of frame `first` is the output from the state first ^ first = 0.
  EXPECT_EQ(frameSeed(0, first), first);
}

TEST(Distributions, ValuesDependOnSeedFrameAndPathOnly) {
  const std::string alone = R"({"a": {"uniform": [0, 1]}})";
  const json first = draw(alone, 7, 3);
  EXPECT_EQ(draw(R"({"z": {"list": [1, 2]}, "a": {"uniform": [0, 1]}, "b": 5})", 7, 3).at("a"), first.at("a"));
  EXPECT_NE(draw(alone, 8, 3), first);
  EXPECT_NE(draw(alone, 7, 4), first);
  const json two = draw(R"({"a": {"uniform": [0, 1]}, "b": {"uniform": [0, 1]}})", 7, 3);
  EXPECT_NE(two.at("a"), two.at("b"));
  // Plain values stay.
  EXPECT_EQ(draw(R"({"a": [1, "b", null, {"c": true}]})", 7, 3), json::parse(R"({"a": [1, "b", null, {"c": true}]})"));
}

TEST(Distributions, MomentsAreThoseOfTheDistribution) {
  constexpr int kCount = 20000;
  double sum = 0, squares = 0, logs = 0;
  std::map<std::string, int> chosen;
  for (int i = 0; i < kCount; ++i) {
    const json value = draw(R"({"u": {"uniform": [2, 5]}, "l": {"logUniform": [0.01, 100]},
                                "c": {"list": ["a", "b", "c", "d"]}})",
                            1, static_cast<std::uint64_t>(i));
    const double u = value.at("u"), l = value.at("l");
    ASSERT_TRUE(u >= 2 && u <= 5 && l >= 0.01 && l <= 100);
    sum += u, squares += u * u, logs += std::log10(l);
    ++chosen[value.at("c")];
  }
  // Five standard deviations of the means: of a uniform variable of width w it is w / sqrt(12).
  const double error = 5 / std::sqrt(12.0 * kCount);
  EXPECT_NEAR(sum / kCount, 3.5, 3 * error);
  EXPECT_NEAR(squares / kCount - std::pow(sum / kCount, 2), 9.0 / 12, 0.03);
  EXPECT_NEAR(logs / kCount, 0, 4 * error);
  ASSERT_EQ(chosen.size(), 4u);
  for (const auto& [name, count] : chosen) EXPECT_NEAR(count, kCount / 4.0, 5 * std::sqrt(kCount * 3.0 / 16)) << name;
}

TEST(Distributions, VectorsDrawEachComponent) {
  double covariance = 0;
  constexpr int kCount = 10000;
  for (int i = 0; i < kCount; ++i) {
    const json v = draw(R"({"v": {"uniform": [[0, 10, -1], [1, 20, -1]]}})", 5, static_cast<std::uint64_t>(i)).at("v");
    ASSERT_EQ(v.size(), 3u);
    const double x = v[0], y = v[1];
    ASSERT_TRUE(x >= 0 && x <= 1 && y >= 10 && y <= 20);
    ASSERT_EQ(v[2], -1.0);
    covariance += (x - 0.5) * (y - 15) / kCount;
  }
  EXPECT_NEAR(covariance, 0, 5 * 10 / 12.0 / std::sqrt(kCount));
}

TEST(Distributions, RefusesBadOnes) {
  for (const char* text :
       {R"({"a": {"uniform": [1, 0]}})", R"({"a": {"uniform": [1]}})", R"({"a": {"uniform": 3}})",
        R"({"a": {"uniform": [0, "b"]}})", R"({"a": {"uniform": [[0, 1], [1]]}})", R"({"a": {"uniform": [0, [1]]}})",
        R"({"a": {"logUniform": [0, 1]}})", R"({"a": {"logUniform": [-1, 1]}})", R"({"a": {"list": []}})",
        R"({"a": {"list": 3}})", R"({"a": {"uniform": [0, 1], "list": [1]}})", R"({"a": {"uniform": [0, 1], "b": 1}})"})
    try {
      draw(text, 0, 0);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("jobs.jsonl:1: a")) << error.what();
    }
}

}  // namespace
}  // namespace malus::render
