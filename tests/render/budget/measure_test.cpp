// Measurements of choices are of one view.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render/budget/measure.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

class MeasuredChoices : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("XDG_CACHE_HOME", cache_.c_str(), 1);
    // A white square that a lamp lights, before a black environment.
    pack_.hash = 1;
    pack_.scene = test::emptyScene(1);
    pack_.scene.width = pack_.scene.height = 32;
    pack_.scene.camera.verticalFovDegrees = 50;
    test::addMaterial(pack_.scene, test::dielectric(pack::MaterialKind::lambert, 1, 0.5));
    test::addSquare(pack_.scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
    pack_.scene.lights.resize(1);
    pack_.scene.lights[0].position = {0, 2, 0};
    pack_.scene.lights[0].intensity = glm::dvec3(3);
    test::look(pack_.scene, {0, 3, 1}, {0, 0, 0});
  }
  void TearDown() override {
    ::unsetenv("XDG_CACHE_HOME");
    std::filesystem::remove_all(cache_);
  }
  // Error of the image without point lights.
  double errorWithoutLights() const {
    RendererPool pool(pack_.scene, Backend::embree, {"", 1});
    const Measurements m =
        measureChoices(pack_, defaultParameters(pack_.scene), pool, 1, true, [](std::string_view) {});
    const MeasuredChoice* choice = m.find(MeasuredChoice::Kind::effect, "point-lights");
    return choice != nullptr ? choice->error : -1;
  }

  const std::filesystem::path cache_ =
      std::filesystem::temp_directory_path() / fmt::format("malus-measured-choices-{}", ::getpid());
  pack::Pack pack_;
};

TEST_F(MeasuredChoices, AreNotThoseOfAnotherCamera) {
  EXPECT_NEAR(errorWithoutLights(), 1, 1e-6) << "all the light";
  test::look(pack_.scene, {0, 3, 1}, {0, 6, 0});
  EXPECT_EQ(errorWithoutLights(), 0) << "the camera sees the black environment";
}

// The method comes before the effects.
TEST_F(MeasuredChoices, EndWithTheTime) {
  RendererPool pool(pack_.scene, Backend::embree, {"", 1});
  const auto measured = [&](double minutes) {
    return measureChoices(
        pack_, defaultParameters(pack_.scene), pool, 1, true, [](std::string_view) {}, minutes);
  };
  const Measurements some = measured(1e-9);
  EXPECT_NE(some.find(MeasuredChoice::Kind::method, "stokes"), nullptr);
  EXPECT_EQ(some.find(MeasuredChoice::Kind::effect, "point-lights"), nullptr);
  const Measurements all = measured(0);
  EXPECT_EQ(all.leftOut, 0u) << "incomplete measurements were cached";
  EXPECT_EQ(all.choices.size(), some.choices.size() + some.leftOut);
}

// Radiance above the display's white counts as white.
TEST_F(MeasuredChoices, AreNotThoseOfAnotherExposure) {
  pack_.scene.environment.radiance = glm::dvec3(0.01);
  const double dark = errorWithoutLights();
  EXPECT_GT(dark, 0.9);
  pack_.scene.exposureEv = 20;
  EXPECT_LT(errorWithoutLights(), 0.9 * dark) << "the environment is white";
}

}  // namespace
}  // namespace malus::render
