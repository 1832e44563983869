// Ground truth against closed forms: planes and spheres, by perspective, shifted and orthographic cameras.
#include "render/ground_truth/ground_truth.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "render/ground_truth/camera_matrices.h"
#include "render/ground_truth/truth_image.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

constexpr std::uint32_t kWidth = 20, kHeight = 14;

RenderParameters sized(const pack::Scene& scene) {
  RenderParameters parameters = defaultParameters(scene);
  parameters.width = kWidth;
  parameters.height = kHeight;
  parameters.region = {0, 0, kWidth, kHeight};
  return parameters;
}

struct CameraRay {
  glm::dvec3 origin, direction;  // direction: unit
};

// The ray through the centre of a pixel, from the intrinsics in pixels, without the code of the renderers.
CameraRay pixelRay(const pack::Camera& c, std::uint32_t x, std::uint32_t y) {
  const double px = x + 0.5, py = y + 0.5;
  if (c.isOrthographic()) {
    const double scale = c.orthographicHeight / kHeight;
    const double right = (px - kWidth / 2.0) * scale * c.pixelAspect + c.middleX * c.orthographicHeight,
                 up = (kHeight / 2.0 - py) * scale + c.middleY * c.orthographicHeight;
    return {c.position + right * c.right + up * c.up, c.forward};
  }
  const double fy = kHeight / (2 * std::tan(c.verticalFovDegrees * std::numbers::pi / 360)), fx = fy / c.pixelAspect;
  const double cx = kWidth / 2.0 - c.middleX * kHeight / c.pixelAspect, cy = kHeight / 2.0 + c.middleY * kHeight;
  return {c.position, glm::normalize(c.right * ((px - cx) / fx) + c.up * ((cy - py) / fy) + c.forward)};
}

// Perspective, by intrinsics, orthographic.
std::vector<pack::Scene> byEveryCamera(pack::Scene scene) {
  test::look(scene, {0.4, -0.3, 6}, {0.1, 0.2, 0});
  scene.camera.verticalFovDegrees = 50;
  scene.origin = {100, -20, 3};
  std::vector<pack::Scene> scenes(3, scene);
  scenes[1].camera.pixelAspect = 1.25;
  scenes[1].camera.middleX = 0.1;
  scenes[1].camera.middleY = -0.2;
  scenes[2].camera.orthographicHeight = 5;
  scenes[2].camera.middleX = 0.05;
  return scenes;
}

TEST(GroundTruth, PlaneHasTheDistancesOfItsEquation) {
  pack::Scene base = test::emptyScene(3);
  pack::Material plain;
  plain.albedo = glm::dvec3(0.5);
  const std::uint32_t unused = test::addMaterial(base, plain), material = test::addMaterial(base, plain);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.2, 1)), centre(0.2, 0, -0.5);
  test::addSquare(base, unused, {0, 0, 50}, {0, 0, -1}, 1);  // behind the camera
  test::addSquare(base, material, centre, normal, 40);
  for (const pack::Scene& scene : byEveryCamera(base)) {
    const std::vector<PixelTruth> pixels = GroundTruth(scene, 1).render(sized(scene));
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const PixelTruth& p = pixels[std::size_t{y} * kWidth + x];
        const CameraRay ray = pixelRay(scene.camera, x, y);
        const double distance = glm::dot(centre - ray.origin, normal) / glm::dot(ray.direction, normal);
        ASSERT_TRUE(p.isValid);
        EXPECT_NEAR(p.rayDistance, distance, 1e-11 * distance);
        EXPECT_NEAR(p.depth, distance * glm::dot(ray.direction, scene.camera.forward), 1e-11 * distance);
        EXPECT_LT(glm::length(p.position - (ray.origin + distance * ray.direction + scene.origin)), 1e-10);
        EXPECT_LT(glm::length(p.faceNormal - normal), 1e-12);
        EXPECT_LT(glm::length(p.shadingNormal - normal), 1e-12);
        EXPECT_NEAR(p.incidence, std::acos(-glm::dot(ray.direction, normal)), 1e-9);
        EXPECT_EQ(p.material, material);
        EXPECT_EQ(p.placement, 1u);
        EXPECT_EQ(p.interactions, 1u);
      }
  }
}

// A sphere of unit radius, with the exact normals at its vertices.
void addSphere(pack::Scene& scene, std::uint32_t material, int rows) {
  pack::Mesh mesh;
  mesh.name = "sphere";
  mesh.material = material;
  const int columns = 2 * rows;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double a = std::numbers::pi * j / rows, b = 2 * std::numbers::pi * i / columns;
      mesh.positions.emplace_back(std::sin(a) * std::cos(b), std::cos(a), -std::sin(a) * std::sin(b));
      mesh.normals.emplace_back(mesh.positions.back());
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      if (j > 0) mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
      if (j + 1 < rows) mesh.triangles.emplace_back(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  scene.meshes.push_back(std::move(mesh));
}

TEST(GroundTruth, SphereHasItsNormalsAndMisses) {
  pack::Scene base = test::emptyScene(1);
  addSphere(base, test::addMaterial(base, test::metal(glm::dvec3(0.2), glm::dvec3(3))), 200);
  // Triangles of an angle a sink by 1 - cos(a / 2) below the sphere.
  const double sag = 1 - std::cos(std::numbers::pi / 200 * std::sqrt(2.0) / 2);
  for (const pack::Scene& scene : byEveryCamera(base)) {
    const std::vector<PixelTruth> pixels = GroundTruth(scene, 1).render(sized(scene));
    int hits = 0, misses = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const PixelTruth& p = pixels[std::size_t{y} * kWidth + x];
        const CameraRay ray = pixelRay(scene.camera, x, y);
        const double along = -glm::dot(ray.origin, ray.direction),
                     closest = glm::length(ray.origin + along * ray.direction);
        if (std::abs(closest - 1) < 0.01) continue;  // the outline of the triangles
        EXPECT_EQ(p.isValid, closest < 1);
        if (!p.isValid) {
          ++misses;
          EXPECT_EQ(p.interactions, 0u);
          continue;
        }
        ++hits;
        const double distance = along - std::sqrt(1 - closest * closest);
        const glm::dvec3 normal = glm::normalize(ray.origin + distance * ray.direction);
        const double slope = -glm::dot(normal, ray.direction);
        EXPECT_NEAR(p.rayDistance, distance, 2 * sag / slope);
        EXPECT_LT(glm::length(p.shadingNormal - normal), 4 * sag / slope);
        EXPECT_LT(glm::length(p.faceNormal - normal), 0.03);
        EXPECT_NEAR(p.incidence, std::acos(slope), 10 * sag / slope / std::sqrt(1 - slope * slope + 1e-4));
        EXPECT_EQ(p.interactions, 1u);  // reflected into the environment
      }
    EXPECT_GT(hits, 5);
    EXPECT_GT(misses, 50);
  }
}

TEST(GroundTruth, NormalsPointAgainstTheRayOnBothSides) {
  pack::Scene scene = test::emptyScene(1);
  const std::uint32_t material = test::addMaterial(scene, pack::Material());
  test::addSquare(scene, material, {0, 0, 0}, {0, 0, -1}, 5);  // seen from its back
  test::look(scene, {0, 0, 4}, {0, 0, 0});
  const PixelTruth p = GroundTruth(scene, 1).render(sized(scene))[0];
  EXPECT_EQ(p.faceNormal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(p.shadingNormal, glm::dvec3(0, 0, 1));
}

// A pane, a mirror behind it and a wall that the mirror shows.
TEST(GroundTruth, InteractionsFollowThePrincipalPath) {
  pack::Scene scene = test::emptyScene(8);
  const std::uint32_t pane = test::addMaterial(scene, test::dielectric(pack::MaterialKind::thinGlass, 1.5)),
                      mirror = test::addMaterial(scene, test::metal(glm::dvec3(0.2), glm::dvec3(3))),
                      wall = test::addMaterial(scene, pack::Material());
  scene.materials[wall].albedo = glm::dvec3(0.5);
  test::addSquare(scene, pane, {0, 0, 2}, {0, 0, 1}, 1);
  test::addSquare(scene, mirror, {0, 0, 0}, {0, 0, 1}, 1);
  test::addSquare(scene, wall, {0, 0, 9}, {0, 0, -1}, 50);
  test::look(scene, {0, 0, 5}, {0, 0, 0});
  RenderParameters one = defaultParameters(scene);  // of one pixel
  const GroundTruth truth(scene, 1);
  // Pane, mirror, pane, wall.
  EXPECT_EQ(truth.render(one)[0].interactions, 4u);
  EXPECT_EQ(truth.render(one)[0].material, pane);
  one.depth = 1;  // the depth of the image ends the path
  EXPECT_EQ(truth.render(one)[0].interactions, 2u);
  one.depth = 0;
  EXPECT_EQ(truth.render(one)[0].interactions, 1u);
}

// A slab of glass between the camera and a wall: both of its faces and the wall.
TEST(GroundTruth, InteractionsPassBodiesOfGlass) {
  pack::Scene scene = test::emptyScene(8);
  const std::uint32_t glass = test::addMaterial(scene, test::dielectric(pack::MaterialKind::glass, 1.5)),
                      wall = test::addMaterial(scene, pack::Material());
  scene.materials[wall].albedo = glm::dvec3(0.5);
  test::addSquare(scene, glass, {0, 0, 1}, {0, 0, 1}, 9);
  test::addSquare(scene, glass, {0, 0, 0}, {0, 0, -1}, 9);
  test::addSquare(scene, wall, {0, 0, -3}, {0, 0, 1}, 50);
  test::look(scene, {1, 0.5, 5}, {0, 0, 0});
  EXPECT_EQ(GroundTruth(scene, 1).render(defaultParameters(scene))[0].interactions, 3u);
}

TEST(GroundTruth, RegionIsAPartOfTheImage) {
  pack::Scene scene = byEveryCamera(test::emptyScene(1))[1];
  test::addSquare(scene, test::addMaterial(scene, pack::Material()), {0, 0, 0}, {0.3, 0, 1}, 2);
  RenderParameters parameters = sized(scene);
  const GroundTruth truth(scene, 2);
  const std::vector<PixelTruth> whole = truth.render(parameters);
  parameters.region = {3, 5, 9, 4};
  const std::vector<PixelTruth> part = truth.render(parameters);
  ASSERT_EQ(part.size(), 36u);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const PixelTruth& expected = whole[(5 + i / 9) * kWidth + 3 + i % 9];
    EXPECT_EQ(part[i].isValid, expected.isValid);
    EXPECT_EQ(part[i].rayDistance, expected.rayDistance);
  }
}

// Every place of a mesh has an index, and its normals are those of the place.
TEST(GroundTruth, InstancesHaveTheirIndexAndNormal) {
  pack::Scene scene = test::emptyScene(1);
  test::addSquare(scene, test::addMaterial(scene, pack::Material()), {0, 0, 0}, {0, 0, 1}, 1);
  pack::Instance instance;
  instance.name = "second";
  const double s = std::sqrt(0.5);
  instance.linear = glm::dmat3({s, 0, -s}, {0, 1, 0}, {s, 0, s});  // 45 degrees about y
  instance.translation = {10, 0, 0};
  scene.instances = {instance};
  test::look(scene, {10, 0, 5}, {10, 0, 0});
  const PixelTruth p = GroundTruth(scene, 1).render(defaultParameters(scene))[0];
  ASSERT_TRUE(p.isValid);
  EXPECT_EQ(p.placement, 1u);
  EXPECT_LT(glm::length(p.faceNormal - glm::dvec3(s, 0, s)), 1e-12);
  EXPECT_NEAR(p.incidence, std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(p.rayDistance, 5, 1e-6);
  test::look(scene, {0, 0, 5}, {0, 0, 0});
  EXPECT_EQ(GroundTruth(scene, 1).render(defaultParameters(scene))[0].placement, 0u);
}

TEST(GroundTruth, ImageHasTheChannelsOfEachPixel) {
  pack::Pack pack;
  pack.scene = byEveryCamera(test::emptyScene(1))[0];
  pack.scene.materials.push_back({});
  pack.scene.materials[0].name = "plain";
  test::addSquare(pack.scene, 0, {0, 0, 0}, {0.3, 0, 1}, 1);
  const RenderParameters parameters = sized(pack.scene);
  const std::vector<PixelTruth> pixels = GroundTruth(pack.scene, 1).render(parameters);
  const image::Image image = truthImage(pixels, pack, parameters);
  ASSERT_EQ(image.pixels.size(), pixels.size() * image.channels.size());
  const auto value = [&](std::size_t pixel, const char* channel) {
    EXPECT_GE(image.channel(channel), 0) << channel;
    return image.pixels[pixel * image.channels.size() + static_cast<std::size_t>(image.channel(channel))];
  };
  const glm::dmat4 toCamera = worldToCamera(pack.scene);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelTruth& p = pixels[i];
    EXPECT_EQ(value(i, "Valid.V"), p.isValid ? 1 : 0);
    EXPECT_EQ(value(i, "IndexMA.X"), p.isValid ? 0 : -1);
    EXPECT_EQ(value(i, "IndexOB.X"), p.isValid ? 0 : -1);
    if (!p.isValid) continue;
    ++valid;
    const glm::dvec4 inCamera = toCamera * glm::dvec4(p.position, 1);
    EXPECT_NEAR(value(i, "Depth.Z"), -inCamera.z, 1e-5);
    EXPECT_NEAR(value(i, "Distance.Z"), glm::length(glm::dvec3(inCamera)), 1e-5);
    const glm::dvec4 normal = toCamera * glm::dvec4(p.shadingNormal, 0);
    EXPECT_NEAR(value(i, "NormalCamera.X"), normal.x, 1e-6);
    EXPECT_NEAR(value(i, "NormalCamera.Y"), normal.y, 1e-6);
    EXPECT_NEAR(value(i, "NormalCamera.Z"), normal.z, 1e-6);
    EXPECT_NEAR(value(i, "Normal.X"), p.shadingNormal.x, 1e-6);
    EXPECT_NEAR(value(i, "Position.X"), p.position.x, 1e-4);
    EXPECT_NEAR(value(i, "Incidence.V"), p.incidence, 1e-6);
  }
  EXPECT_GT(valid, 10u);
  EXPECT_LT(valid, pixels.size());
}

// The matrices project the position of each pixel back onto its centre.
TEST(CameraMatrices, ProjectPositionsOntoPixels) {
  pack::Scene base = test::emptyScene(1);
  test::addSquare(base, test::addMaterial(base, pack::Material()), {0, 0, 0}, {0.3, 0.1, 1}, 40);
  for (const pack::Scene& scene : byEveryCamera(base)) {
    const RenderParameters parameters = sized(scene);
    const std::vector<PixelTruth> pixels = GroundTruth(scene, 1).render(parameters);
    const nlohmann::json camera = cameraJson(scene, parameters);
    const bool isOrthographic = camera.at("type") == "orthographic";
    EXPECT_EQ(isOrthographic, scene.camera.isOrthographic());
    const PixelIntrinsics i = pixelIntrinsics(scene.camera, kWidth, kHeight);
    EXPECT_EQ(camera.at("intrinsics").is_null(), isOrthographic);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      glm::dvec4 p(0.0);
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          p[static_cast<int>(row)] += camera.at("worldToCamera").at(row).at(column).get<double>() *
                                      (column < 3 ? pixels[k].position[static_cast<int>(column)] : 1);
      const double scale = isOrthographic ? 1 : -p.z;
      EXPECT_NEAR(i.cx + i.fx * p.x / scale, static_cast<double>(k % kWidth) + 0.5, 1e-8);
      EXPECT_NEAR(i.cy - i.fy * p.y / scale, static_cast<double>(k / kWidth) + 0.5, 1e-8);
    }
    const glm::dmat4 product = cameraToWorld(scene) * worldToCamera(scene);
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) EXPECT_NEAR(product[c][r], c == r ? 1 : 0, 1e-12);
  }
}

}  // namespace
}  // namespace malus::render
