// Means of the textures of imported materials: roles, files and bytes, images that cannot be read.
#include "bake/materials/texture_means.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <span>

#include "meshprep/base/image.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using prep::SourceImage;
using prep::SourceMaterial;
using prep::SourceScene;
using test::errorMessage;

// A PNG of 2 x 1 pixels.
std::filesystem::path writePixels(const test::TemporaryFolder& folder, const char* name,
                                  const std::vector<std::uint8_t>& pixels) {
  const std::filesystem::path file = folder.path() / name;
  image::writePng(file, 2, 1, 3, pixels);
  return file;
}

// A scene of one material, white and metallic, that uses the file in each role.
SourceScene makeScene(const SourceImage& image) {
  SourceScene scene;
  scene.images = {image};
  SourceMaterial& m = scene.materials.emplace_back();
  m.name = "painted";
  m.baseColourImage = m.metallicRoughnessImage = m.emissiveImage = 0;
  m.baseColour = {1, 0.5, 1};
  m.emissive = {2, 2, 2};
  return scene;
}

bool hasNote(const SourceScene& scene, std::string_view text) {
  for (const std::string& note : scene.notes)
    if (test::contains(note, text)) return true;
  return false;
}

TEST(TextureMeans, ColoursAreDecodedAndNumbersAreNot) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = writePixels(folder, "a.png", {0, 51, 102, 255, 51, 204});
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto* const data = reinterpret_cast<const std::byte*>(text.data());
  const auto bytes = std::make_shared<const std::vector<std::byte>>(data, data + text.size());
  for (const SourceImage& image : {SourceImage{"a", file, nullptr}, SourceImage{"a", {}, bytes}}) {
    SourceScene scene = makeScene(image);
    applyTextureMeans(scene, true);
    const SourceMaterial& m = scene.materials[0];
    const auto linear = [](double byte) { return std::pow((byte / 255 + 0.055) / 1.055, 2.4); };  // IEC 61966-2-1
    EXPECT_NEAR(m.baseColour.x, 0.5, 1e-6);
    EXPECT_NEAR(m.baseColour.y, 0.5 * linear(51), 1e-6);
    EXPECT_NEAR(m.baseColour.z, (linear(102) + linear(204)) / 2, 1e-6);
    EXPECT_NEAR(m.emissive.x, 1, 1e-6);
    EXPECT_NEAR(m.roughness, 0.2, 1e-6);  // green, as stored
    EXPECT_NEAR(m.metallic, 0.6, 1e-6);   // blue
    EXPECT_TRUE(m.baseColourImage && m.metallicRoughnessImage && m.emissiveImage) << "they become maps";
    EXPECT_FALSE(hasNote(scene, "means are used"));
  }
}

TEST(TextureMeans, TransparentTexelsDoNotTint) {
  const test::TemporaryFolder folder;
  image::Image image;
  image.width = 2;
  image.height = 1;
  image.channels = {"R", "G", "B", "A"};
  image.pixels = {1, 0, 1, 0.5f, 0, 1, 0, 0};  // the second texel cannot be seen
  const std::filesystem::path file = folder.path() / "a.exr";
  image::writeExr(file, image);
  SourceScene scene;
  scene.images = {{"a", file, nullptr}};
  SourceMaterial& m = scene.materials.emplace_back();
  m.baseColourImage = 0;
  m.alphaMode = prep::AlphaMode::blend;
  applyTextureMeans(scene, true);
  EXPECT_EQ(m.baseColour, glm::dvec3(1, 0, 1));
  EXPECT_EQ(m.alpha, 0.25);
}

TEST(TextureMeans, BytesOfEveryFormatAreRead) {
  const std::filesystem::path folder = std::filesystem::path(MALUS_SOURCE_DIR) / "tests/meshprep/base/other-images";
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    image::Image file;
    try {
      file = image::read(entry.path());
    } catch (const Error&) {
      continue;
    }
    EXPECT_EQ(image::readBytes(std::as_bytes(std::span(text)), "x").pixels, file.pixels) << entry.path();
    ++read;
  }
  EXPECT_GT(read, 2u);
}

TEST(TextureMeans, SpecularGlossiness) {
  const test::TemporaryFolder folder;
  SourceScene scene;
  scene.images = {{"a", writePixels(folder, "a.png", {255, 0, 0, 255, 0, 0}), nullptr}};
  SourceMaterial& m = scene.materials.emplace_back();
  m.specularColour = {0.5, 0.5, 0.5};
  m.roughness = 0.25;
  m.specularGlossinessImage = 0;
  applyTextureMeans(scene, true);
  EXPECT_EQ(m.specularColour, glm::dvec3(0.5, 0, 0));
  EXPECT_TRUE(m.specularGlossinessImage) << "it becomes maps";
  EXPECT_EQ(m.roughness, 0.25);  // without alpha the glossiness is that of the factor
}

TEST(TextureMeans, ImagesThatCannotBeReadKeepTheFactors) {
  const test::TemporaryFolder folder;
  const auto damaged = std::make_shared<const std::vector<std::byte>>(100, std::byte{7});
  for (const SourceImage& image : {SourceImage{"absent", folder.path() / "absent.png", nullptr},
                                   SourceImage{"bad", {}, damaged}, SourceImage{"nowhere", {}, nullptr}}) {
    SourceScene scene = makeScene(image);
    applyTextureMeans(scene, false);
    EXPECT_EQ(scene.materials[0].baseColour, glm::dvec3(1, 0.5, 1));
    EXPECT_EQ(scene.materials[0].metallic, 1);
    EXPECT_EQ(scene.materials[0].emissive, glm::dvec3(0)) << "a mask of emission is mostly black";
    EXPECT_TRUE(hasNote(scene, "the emission of material 'painted'"));
    EXPECT_FALSE(scene.materials[0].baseColourImage) << "it cannot become a map";
  }
  SourceScene scene = makeScene({"bad image", {}, damaged});
  EXPECT_CONTAINS(errorMessage([&] { applyTextureMeans(scene, true); }), "bad image");
}

}  // namespace
}  // namespace malus::bake
