#include "bake/scene_file/strict_object.h"

#include "meshprep/base/nearest_name.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;

// Returns the error of reading this object with `read`.
template <class Read>
std::string errorIn(const char* text, Read read) {
  const json value = json::parse(text);
  return errorMessage([&] {
    StrictObject object(value, "file.json", "camera");
    read(object);
  });
}

TEST(StrictObject, Values) {
  const json value = json::parse(R"({"t": "x", "f": true, "n": 2.5, "i": 7, "v": [1, 2, 3], "s": 4, "o": {"a": 1}})");
  StrictObject object(value, "file.json", "");
  EXPECT_EQ(object.text("t"), "x");
  EXPECT_TRUE(object.flag("f", false));
  EXPECT_EQ(object.number("n", 0, 3), 2.5);
  EXPECT_EQ(object.integer("i", 7, 7), 7u);
  EXPECT_EQ(object.vector("v", 1, 3), glm::dvec3(1, 2, 3));
  EXPECT_EQ(object.numberOrVector("s", 0, 9), glm::dvec3(4));
  EXPECT_EQ(object.numberOrVector("v", 0, 9), glm::dvec3(1, 2, 3));
  StrictObject inner = object.object("o");
  EXPECT_EQ(inner.integer("a", 0, 1), 1u);
  inner.finish();
  object.finish();
}

TEST(StrictObject, Fallbacks) {
  const json value = json::object();
  StrictObject object(value, "file.json", "");
  EXPECT_EQ(object.text("t", "y"), "y");
  EXPECT_TRUE(object.flag("f", true));
  EXPECT_EQ(object.number("n", 0, 3, 1.5), 1.5);
  EXPECT_EQ(object.integer("i", 0, 9, 4), 4u);
  EXPECT_EQ(object.vector("v", 0, 9, {1, 2, 3}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(object.numberOrVector("s", 0, 9, {3, 2, 1}), glm::dvec3(3, 2, 1));
  object.finish();
}

TEST(StrictObject, UnknownKeyNamesTheNearest) {
  const auto read = [](StrictObject& o) {
    o.number("position", 0, 1, 0);
    o.number("target", 0, 1, 0);
    o.finish();
  };
  EXPECT_CONTAINS(errorIn(R"({"positon": 1})", read), "file.json", "camera.positon", "unknown", "'position'");
  EXPECT_CONTAINS(errorIn(R"({"TARGET": 1})", read), "file.json", "camera.TARGET", "unknown", "'position'", "'target'");
}

TEST(StrictObject, MissingKeyNamesAMisspeltOne) {
  const auto read = [](StrictObject& o) { o.number("position", 0, 1); };
  EXPECT_CONTAINS(errorIn(R"({"posiiton": 1})", read), "file.json", "camera.position", "missing", "'posiiton'");
  const std::string none = errorIn("{}", read);
  EXPECT_CONTAINS(none, "camera.position", "missing");
  EXPECT_FALSE(contains(none, "found")) << none;
}

TEST(StrictObject, WrongTypes) {
  EXPECT_CONTAINS(errorIn("[1]", [](StrictObject&) {}), "file.json", "camera", "object", "found [1]");
  EXPECT_CONTAINS(errorIn(R"({"a": 1})", [](StrictObject& o) { o.text("a"); }), "camera.a", "text", "found 1");
  EXPECT_TRUE(contains(errorIn(R"({"a": 1})", [](StrictObject& o) { o.flag("a", true); }), "true or false", "found 1"));
  EXPECT_TRUE(contains(errorIn(R"({"a": "1"})", [](StrictObject& o) { o.number("a", 0, 9); }), "must be a number"));
  EXPECT_TRUE(contains(errorIn(R"({"a": 1.5})", [](StrictObject& o) { o.integer("a", 0, 9); }), "whole number"));
  EXPECT_TRUE(contains(errorIn(R"({"a": [1, 2]})", [](StrictObject& o) { o.vector("a", 0, 9); }), "must be a vector"));
  EXPECT_TRUE(
      contains(errorIn(R"({"a": [1, 2, "3"]})", [](StrictObject& o) { o.vector("a", 0, 9); }), "must be a number"));
  EXPECT_TRUE(
      contains(errorIn(R"({"a": "b"})", [](StrictObject& o) { o.numberOrVector("a", 0, 9); }), "must be a vector"));
}

TEST(StrictObject, Ranges) {
  const auto number = [](StrictObject& o) { o.number("a", -1, 2); };
  EXPECT_EQ(errorIn(R"({"a": -1})", number), "");
  EXPECT_EQ(errorIn(R"({"a": 2})", number), "");
  EXPECT_CONTAINS(errorIn(R"({"a": 2.001})", number), "camera.a", "range", "-1 to 2", "found 2.001");
  const auto integer = [](StrictObject& o) { o.integer("a", 1, 30); };
  EXPECT_TRUE(contains(errorIn(R"({"a": -1})", integer), "out of range"));
  EXPECT_TRUE(contains(errorIn(R"({"a": 4294967297})", integer), "out of range"));
  EXPECT_TRUE(contains(errorIn(R"({"a": 18446744073709551617})", integer), "found"));
  EXPECT_TRUE(contains(errorIn(R"({"a": [0, 0, 3]})", [](StrictObject& o) { o.vector("a", 0, 2); }), "out of range"));
}

TEST(StrictObject, DeprecatedNamesAreReadAndNoted) {
  const json value = json::parse(R"({"along": 1, "inner": {"across": 2}})");
  std::vector<std::string> notes;
  StrictObject object(value, "file.json", "", &notes);
  EXPECT_EQ(object.resolve("across", ""), "across");
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(object.resolve("parallel", "along"), "along");
  EXPECT_EQ(object.object("inner").resolve("crossed", "across"), "across");
  ASSERT_EQ(notes.size(), 2u);
  for (const char* part : {"file.json", "along", "deprecated", "parallel"}) EXPECT_TRUE(contains(notes[0], part));
  EXPECT_TRUE(contains(notes[1], "inner.across"));
  const std::string both =
      errorIn(R"({"along": 1, "parallel": 1})", [](StrictObject& o) { o.resolve("parallel", "along"); });
  EXPECT_TRUE(contains(both, "camera.along") && contains(both, "parallel")) << both;
}

TEST(StrictObject, Lists) {
  const json value = json::parse(R"({"list": [{"a": 1}, 2], "number": 3})");
  StrictObject object(value, "file.json", "camera");
  EXPECT_EQ(object.listSize("list", "objects"), 2u);
  EXPECT_EQ(object.element("list", 0).integer("a", 1, 1), 1u);
  EXPECT_TRUE(contains(errorMessage([&] { object.element("list", 1); }), "camera.list[1]; expected an object"));
  EXPECT_TRUE(contains(errorMessage([&] { object.listSize("number", "objects"); }), "camera.number", "list"));
}

TEST(StrictObject, LongValuesAreShortened) {
  const std::string error =
      errorIn(R"({"a": "0123456789012345678901234567890123456789012345678901234567890123456789"})",
              [](StrictObject& o) { o.number("a", 0, 1); });
  EXPECT_LT(error.size(), 120u) << error;
}

TEST(NearestName, ByEditDistance) {
  const std::vector<std::string> names = {"position", "target", "up", "verticalFovDegrees"};
  EXPECT_EQ(nearestName("positions", names), "position");
  EXPECT_EQ(nearestName("tarrget", names), "target");
  EXPECT_EQ(nearestName("verticalFOVdegrees", names), "verticalFovDegrees");
  EXPECT_EQ(nearestName("completelyElse", names), "");
  EXPECT_EQ(nearestName("x", {}), "");
}

}  // namespace
}  // namespace malus::bake
