#include "render/ground_truth/truth_image.h"

#include <array>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/pack/instances.h"
#include "meshprep/json_text.h"
#include "render/ground_truth/camera_matrices.h"

namespace malus::render {

namespace {

constexpr std::array kChannels = {"Depth.Z",
                                  "Distance.Z",
                                  "Position.X",
                                  "Position.Y",
                                  "Position.Z",
                                  "Normal.X",
                                  "Normal.Y",
                                  "Normal.Z",
                                  "NormalGeometric.X",
                                  "NormalGeometric.Y",
                                  "NormalGeometric.Z",
                                  "NormalCamera.X",
                                  "NormalCamera.Y",
                                  "NormalCamera.Z",
                                  "NormalGeometricCamera.X",
                                  "NormalGeometricCamera.Y",
                                  "NormalGeometricCamera.Z",
                                  "Incidence.V",
                                  "IndexMA.X",
                                  "IndexOB.X",
                                  "Interactions.V",
                                  "Valid.V"};

glm::dvec3 inCamera(const pack::Camera& camera, const glm::dvec3& v) {
  return {glm::dot(camera.right, v), glm::dot(camera.up, v), -glm::dot(camera.forward, v)};
}

// Appends the channels in the order of kChannels. Indices are below 2^24, which float represents.
void appendPixel(const PixelTruth& p, const pack::Camera& camera, std::vector<float>& out) {
  const auto add = [&](double value) { out.push_back(static_cast<float>(value)); };
  const auto addVector = [&](const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); };
  add(p.depth);
  add(p.rayDistance);
  addVector(p.position);
  addVector(p.shadingNormal);
  addVector(p.faceNormal);
  addVector(inCamera(camera, p.shadingNormal));
  addVector(inCamera(camera, p.faceNormal));
  add(p.incidence);
  add(p.isValid ? p.material : -1.0);
  add(p.isValid ? p.placement : -1.0);
  add(p.interactions);
  add(p.isValid ? 1 : 0);
}

std::string nameList(const std::vector<std::string>& names) { return jsonText(nlohmann::json(names), -1); }

}  // namespace

image::Image truthImage(std::span<const PixelTruth> pixels, const pack::Pack& pack, const RenderParameters& parameters,
                        std::optional<Region> tile) {
  const pack::Scene& scene = pack.scene;
  image::Image image;
  const Region region = tile.value_or(parameters.region);
  image.width = static_cast<int>(region.width);
  image.height = static_cast<int>(region.height);
  image.channels.assign(kChannels.begin(), kChannels.end());
  image.pixels.reserve(pixels.size() * kChannels.size());
  for (const PixelTruth& p : pixels) appendPixel(p, scene.camera, image.pixels);

  std::vector<std::string> materials, meshes;
  for (const pack::Material& m : scene.materials) materials.push_back(m.name);
  for (const pack::Placement& p : pack::placements(scene)) meshes.push_back(p.name());
  image.attributes = {{"worldToCamera", exrWorldToCamera(scene)},        {"malus:scene", scene.name},
                      {"malus:pack", fmt::format("{:016x}", pack.hash)}, {"malus:region", regionText(parameters)},
                      {"malus:materials", nameList(materials)},          {"malus:meshes", nameList(meshes)}};
  return image;
}

void writeTruth(const std::filesystem::path& path, const image::Image& truth, image::ExrCompression compression) {
  const bool isLossy = compression == image::ExrCompression::dwaa;
  image::writeExr(path, truth, isLossy ? image::ExrCompression::zip : compression);
}

}  // namespace malus::render
