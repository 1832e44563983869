// The image modules and a folder for their files, for tests.
#pragma once

#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/image_module.h"

namespace malus::image::test {

namespace fs = std::filesystem;

template <class Interface>
const Interface& load(const char* file, const char* entry) {
  void* library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(::dlerror());
  return *reinterpret_cast<const Interface* (*)()>(::dlsym(library, entry))();
}
inline const Module& exrPng() {
  static const Module& kModule = load<Module>(MALUS_IMAGE_MODULE, kModuleEntry);
  return kModule;
}
inline const FormatsModule& formats() {
  static const FormatsModule& kModule = load<FormatsModule>(MALUS_FORMATS_MODULE, kFormatsModuleEntry);
  return kModule;
}

class ImageModules : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("malus-modules-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::vector<unsigned char>& bytes) const {
    std::ofstream(file(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  fs::path folder_;
};

inline std::map<std::string, Image::Value> malusAttributes(const Image& image) {
  std::map<std::string, Image::Value> result;
  for (const auto& [name, value] : image.attributes)
    if (name.starts_with("malus:")) result.emplace(name, value);
  return result;
}

// NaN equals NaN of the same bits.
inline void expectEqual(const Image& a, const Image& b, const std::string& what) {
  EXPECT_EQ(a.width, b.width) << what;
  EXPECT_EQ(a.height, b.height) << what;
  EXPECT_EQ(a.channels, b.channels) << what;
  EXPECT_EQ(malusAttributes(a), malusAttributes(b)) << what;
  ASSERT_EQ(a.pixels.size(), b.pixels.size()) << what;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.pixels[i]), std::bit_cast<std::uint32_t>(b.pixels[i]))
        << what << ", value " << i << ": " << a.pixels[i] << " and " << b.pixels[i];
}

inline Image readImage(const std::string& path) {
  Image image;
  EXPECT_EQ(exrPng().read(path, image), "") << path;
  return image;
}

// By EXR's and PNG's module and by OpenImageIO, with the same values.
inline Image readBoth(const std::string& path) {
  const Image a = readImage(path);
  Image b;
  EXPECT_EQ(formats().read(path, b), "") << path;
  expectEqual(a, b, path);
  return a;
}

// Colours, Stokes channels and odd names; every class of floating-point value.
inline Image exampleImage() {
  Image image;
  image.width = 37;
  image.height = 23;
  image.channels = {"R", "G", "B", "S0.R", "S0.G", "S0.B", "S3.B", "Z", "A", "depth.Z", "zeta"};
  std::mt19937 random(14);
  const float special[] = {0.0f,
                           -0.0f,
                           std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::denorm_min(),
                           std::numeric_limits<float>::max()};
  const std::size_t count = image.channels.size() * 37 * 23;
  std::uniform_real_distribution<float> uniform(-4, 4);
  for (std::size_t i = 0; i < count; ++i)
    image.pixels.push_back(i % 7 == 0 ? special[i / 7 % std::size(special)] : std::exp2(4 * uniform(random)));
  image.attributes = {{"malus:scene", std::string("glass \"wall\"")},
                      {"malus:depth", 6.0},
                      {"malus:third", 1.0 / 3},
                      {"worldToCamera", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}};
  return image;
}

}  // namespace malus::image::test
