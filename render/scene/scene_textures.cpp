#include "render/scene/scene_textures.h"

#include <algorithm>
#include <utility>

#include "bake/pack/mesh_maps.h"

namespace malus::render {

namespace {

// The texels of a line that a texel of half the size covers, with their shares of it.
struct Cover {
  std::uint32_t first = 0;
  std::vector<double> shares;
};
std::vector<Cover> covers(std::uint32_t from, std::uint32_t to) {
  std::vector<Cover> result;
  const double step = static_cast<double>(from) / to;
  for (std::uint32_t i = 0; i < to; ++i) {
    const double begin = i * step, end = (i + 1) * step;
    Cover cover{static_cast<std::uint32_t>(begin), {}};
    for (std::uint32_t k = cover.first; k < from && k < end; ++k)
      cover.shares.push_back((std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) / step);
    result.push_back(std::move(cover));
  }
  return result;
}

void addLevel(const pack::Texture& t, RenderScene& result) {
  result.textures.push_back({static_cast<std::uint32_t>(result.textureTexels.size()), t.width, t.height});
  result.textureTexels.insert(result.textureTexels.end(), t.texels.begin(), t.texels.end());
}

}  // namespace

std::uint32_t countLevels(std::uint32_t width, std::uint32_t height) {
  std::uint32_t levels = 1;
  for (std::uint32_t side = std::max(width, height); side > 1; side /= 2) ++levels;
  return levels;
}

pack::Texture halfSize(const pack::Texture& t) {
  pack::Texture half;
  half.name = t.name;
  half.width = std::max(t.width / 2, 1u);
  half.height = std::max(t.height / 2, 1u);
  const std::vector<Cover> columns = covers(t.width, half.width), rows = covers(t.height, half.height);
  half.texels.reserve(std::size_t{half.width} * half.height);
  for (const Cover& row : rows)
    for (const Cover& column : columns) {
      glm::dvec3 sum(0.0);
      for (std::size_t j = 0; j < row.shares.size(); ++j)
        for (std::size_t i = 0; i < column.shares.size(); ++i)
          sum +=
              glm::dvec3(t.texels[(row.first + j) * t.width + column.first + i]) * (row.shares[j] * column.shares[i]);
      half.texels.emplace_back(sum);
    }
  return half;
}

void addTextures(const pack::Scene& scene, RenderScene& result) {
  std::vector<char> hasLevels(scene.textures.size(), 0);
  for (const pack::Material& m : scene.materials)
    pack::visitMeshMaps(
        [&](const pack::MapRule&, const pack::MeshMap& map) {
          if (map.isUsed()) hasLevels[static_cast<std::size_t>(map.texture)] = 1;
        },
        m.meshMaps);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    result.textureRows.push_back(static_cast<std::uint32_t>(result.textures.size()));
    addLevel(scene.textures[i], result);
    if (hasLevels[i] == 0) continue;
    pack::Texture level = scene.textures[i];
    while (level.width > 1 || level.height > 1) {
      level = halfSize(level);
      addLevel(level, result);
    }
  }
  if (result.textures.empty()) {
    result.textures.push_back({0, 1, 1});
    result.textureTexels.emplace_back(0.0f);
  }
}

void addMeshMaps(const pack::Scene& scene, RenderScene& result) {
  result.materialMaps.clear();
  result.textureMaps.clear();
  result.textureMaps.push_back({0, 1, 0, 0, 0, {1, 0, 0}, {0, 1, 0}});
  for (const pack::Material& m : scene.materials) {
    gpu::MeshMaps& rows = result.materialMaps.emplace_back(gpu::MeshMaps{});
    const auto addRow = [&](const pack::MapRule&, const pack::MeshMap& map, gpu::uint& row) {
      if (!map.isUsed()) return;
      row = static_cast<gpu::uint>(result.textureMaps.size());
      const auto texture = static_cast<std::size_t>(map.texture);
      const pack::Texture& t = scene.textures[texture];
      result.textureMaps.push_back({result.textureRows[texture], countLevels(t.width, t.height), map.set,
                                    static_cast<gpu::uint>(map.wrapU), static_cast<gpu::uint>(map.wrapV),
                                    glm::vec3(map.u), glm::vec3(map.v)});
    };
    pack::visitMeshMaps(addRow, m.meshMaps, rows);
    rows.normalScale = static_cast<float>(m.meshMaps.normalScale);
    rows.cutoff = static_cast<float>(m.meshMaps.cutoff);
  }
  result.hasMeshTextures = result.textureMaps.size() > 1;
  if (result.materialMaps.empty()) result.materialMaps.emplace_back(gpu::MeshMaps{});
}

void addTextureCoordinates(const pack::Scene& scene, RenderScene& result) {
  const bool hasNormalMaps = std::ranges::any_of(result.materialMaps, [](const auto& m) { return m.normal != 0; });
  for (std::size_t record = 0; record < result.meshes.size(); ++record) {
    if (!result.hasMeshTextures) break;
    if (sharesVertices(result, record)) continue;
    const pack::Mesh& mesh = scene.meshes[result.sourceMeshes[record]];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto set = [&](std::size_t k) {
        return mesh.textureCoordinates[k].empty() ? glm::vec2(0) : mesh.textureCoordinates[k][i];
      };
      const glm::vec2 first = set(0), second = set(1);
      result.textureCoordinates.emplace_back(first.x, first.y, second.x, second.y);
      if (hasNormalMaps) result.tangents.push_back(mesh.tangents.empty() ? glm::vec4(0) : mesh.tangents[i]);
    }
  }
  if (result.textureCoordinates.empty()) result.textureCoordinates.emplace_back(0.0f);
  if (result.tangents.empty()) result.tangents.emplace_back(0.0f);
}

}  // namespace malus::render
