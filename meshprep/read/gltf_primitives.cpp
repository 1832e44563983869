#include "meshprep/read/gltf_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "meshprep/read/gltf_draco.h"
#include "meshprep/read/invalid_parts.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMinTriangles = 2'000'000;
constexpr std::size_t kDracoTrianglesPerByte = 2;  // Draco needs at least half a byte per triangle
constexpr std::size_t kMinVertices = 6'000'000;

constexpr auto kTriangles = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangles);
constexpr auto kTriangleStrip = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangleStrip);
constexpr auto kTriangleFan = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangleFan);

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Converts the corners of a strip or fan to three per triangle (glTF 2.0 Specification, section 3.7.2.1).
std::vector<std::uint32_t> toTriangles(const std::vector<std::uint32_t>& corners, bool isStrip) {
  std::vector<std::uint32_t> result;
  result.reserve(3 * (corners.size() - 2));
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = i % 2;
    const std::array<std::size_t, 3> at =
        isStrip ? std::array{i, i + 1 + odd, i + 2 - odd} : std::array{i + 1, i + 2, std::size_t{0}};
    for (const std::size_t corner : at) result.push_back(corners[corner]);
  }
  return result;
}

// Closes faces of three corners each.
void closeTriangles(Polygons& polygons) {
  polygons.firstCorner.reserve(polygons.corners.size() / 3 + 1);
  for (std::size_t i = 3; i <= polygons.corners.size(); i += 3) polygons.firstCorner.push_back(i);
}

}  // namespace

GltfPrimitiveReader::GltfPrimitiveReader(const gltf::Document& document, GltfBuffers& buffers, std::size_t fileBytes,
                                         std::string where, GltfLeftOut& leftOut)
    : document_(document), buffers_(buffers), fileBytes_(fileBytes), where_(std::move(where)), leftOut_(leftOut) {
  for (const gltf::Mesh& mesh : document.meshes)
    for (const gltf::Primitive& primitive : mesh.primitives)
      if (primitive.position) ++users_[*primitive.position];
}

Polygons GltfPrimitiveReader::read(const gltf::Primitive& primitive, const TextureNeeds& needs, const GltfPose& pose,
                                   const std::string& location) {
  if (primitive.mode < kTriangles) {
    addNote(leftOut_.notes(), "points and lines");
    return {};
  }
  if (primitive.mode > kTriangleFan)
    throw Error(location + ".mode", "unknown mode", "0 to 6", fmt::to_string(primitive.mode));
  if (!primitive.position) throw Error(location, "no positions", "an attribute POSITION");
  if (primitive.draco) return readDraco(primitive, needs, pose, location);

  // Check the accessors.
  const Vectors& positions = vectors(*primitive.position);
  const Vectors* normals = nullptr;
  if (primitive.normal) {
    normals = &vectors(*primitive.normal);
    if (normals->accessor.count() != positions.accessor.count())
      throw Error(location, "numbers of normals and positions differ", fmt::to_string(positions.accessor.count()),
                  fmt::to_string(normals->accessor.count()));
  }

  // Read the triangles.
  Polygons polygons;
  polygons.corners = readTriangles(primitive, positions, location);
  closeTriangles(polygons);

  // Read the vertices; only those of the faces if primitives share the accessor.
  std::vector<std::uint32_t> kept;
  const std::size_t passes = pose.passes(primitive);
  if (users_.at(*primitive.position) > 1 || passes > 0) {
    kept = polygons.corners;
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (std::uint32_t& corner : polygons.corners)
      corner = static_cast<std::uint32_t>(std::lower_bound(kept.begin(), kept.end(), corner) - kept.begin());
  } else {
    kept.resize(positions.accessor.count());
    std::iota(kept.begin(), kept.end(), 0u);
  }
  readVertices(kept, positions, normals, polygons);
  VertexTextures textures;
  readTextures(primitive, needs, positions.accessor.count(), kept, textures);
  if (passes > 0) {
    addVertices(passes * kept.size(), location);
    pose.apply(primitive, kept, location, polygons, textures.tangents);
  }
  textures.setCorners(polygons);
  return polygons;
}

void GltfPrimitiveReader::addTriangles(std::size_t count, std::size_t backed, const std::string& location) {
  const std::size_t most = std::max(kMinTriangles, backed);
  if (count > most || (triangles_ += count) > most)
    throw GltfLimitError(location, "too many triangles for the file size", fmt::format("at most {}", most),
                         fmt::to_string(std::max(count, triangles_)));
}

void GltfPrimitiveReader::addVertices(std::size_t count, const std::string& location) {
  const std::size_t most = std::max(kMinVertices, bytes());
  if (count > most || (vertices_ += count) > most)
    throw GltfLimitError(location, "too many vertices for the file size", fmt::format("at most {}", most),
                         fmt::to_string(std::max(count, vertices_)));
}

// Returns the declared count of an accessor.
std::size_t GltfPrimitiveReader::declaredCount(std::size_t index) const {
  const std::string location = fmt::format("{}: accessors[{}]", where_, index);
  if (index >= document_.accessors.size())
    throw Error(location, "does not exist", fmt::format("one of {} accessors", document_.accessors.size()));
  if (document_.accessors[index].isInvalid) throw Error(location, "is invalid", "a valid accessor");
  return document_.accessors[index].count;
}

// Returns a checked accessor of vectors.
const GltfPrimitiveReader::Vectors& GltfPrimitiveReader::vectors(std::size_t index) {
  const auto found = vectors_.find(index);
  if (found != vectors_.end()) return found->second;
  GltfAccessor accessor(document_, buffers_, index, where_);  // reads its buffer, whose size bounds the count
  addVertices(accessor.count(), accessor.location());
  accessor.requireVectors(document_.quantized);
  const std::optional<std::size_t> notFinite = accessor.findNotFinite();
  if (notFinite && leftOut_.isStrict()) throw accessor.notFinite(*notFinite);
  return vectors_.emplace(index, Vectors{std::move(accessor), !notFinite}).first->second;
}

// Returns three corners per valid triangle of a list, strip or fan.
std::vector<std::uint32_t> GltfPrimitiveReader::readTriangles(const gltf::Primitive& primitive,
                                                              const Vectors& positions, const std::string& location) {
  // Count corners and triangles.
  std::optional<GltfAccessor> accessor;
  if (primitive.indices) accessor.emplace(document_, buffers_, *primitive.indices, where_);
  const std::size_t vertices = positions.accessor.count();
  std::size_t count = accessor ? accessor->count() : vertices;
  const bool isList = primitive.mode == kTriangles;
  if (count < 3) throw Error(location, "no triangle", "3 corners or more", fmt::format("{} corners", count));
  if (isList && count % 3 != 0) {
    if (leftOut_.isStrict())
      throw Error(location, "incomplete triangle", "a multiple of 3 corners", fmt::format("{} corners", count));
    addNote(leftOut_.notes(), "incomplete triangles at the ends of lists");
    count -= count % 3;
  }
  addTriangles(isList ? count / 3 : count - 2, bytes() / 2, location);

  // Read the corners.
  std::optional<Error> first;
  std::vector<std::uint32_t> corners;
  if (accessor) {
    corners = readCorners(*accessor, count, vertices, first);
  } else {
    corners.resize(count);
    std::iota(corners.begin(), corners.end(), 0u);
  }
  if (!isList) corners = toTriangles(corners, primitive.mode == kTriangleStrip);
  if (first || !positions.isFinite) dropInvalid(corners, positions, std::move(first), location);
  return corners;
}

// Returns the corners. Invalid ones are kInvalidCorner; `first` is the error of the first one.
std::vector<std::uint32_t> GltfPrimitiveReader::readCorners(const GltfAccessor& accessor, std::size_t count,
                                                            std::size_t vertices, std::optional<Error>& first) const {
  accessor.requireIndices();
  std::vector<std::uint32_t> corners(count);
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = accessor.wholeNumber(i);
    const bool isRestart = corners[i] == accessor.restart();
    if (!isRestart && corners[i] < vertices) continue;
    if (!first)
      first = isRestart ? Error(accessor.location(), fmt::format("primitive restart at {} is not allowed", i),
                                fmt::format("below {}", accessor.restart()), fmt::to_string(corners[i]))
                        : Error(accessor.location(), fmt::format("invalid vertex index at {}", i),
                                fmt::format("below {}", vertices), fmt::to_string(corners[i]));
    if (leftOut_.isStrict()) throw Error(*first);
    corners[i] = kInvalidCorner;
  }
  return corners;
}

// Removes the triangles with a corner that is invalid or not finite. Throws the first error if none is left.
void GltfPrimitiveReader::dropInvalid(std::vector<std::uint32_t>& corners, const Vectors& positions,
                                      std::optional<Error> first, const std::string& location) {
  const auto isInvalid = [&](std::uint32_t corner) {
    if (corner == kInvalidCorner) return true;
    if (positions.isFinite || isFinite(positions.accessor.vector(corner))) return false;
    if (!first) first = positions.accessor.notFinite(corner);
    return true;
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (isInvalid(corners[i]) || isInvalid(corners[i + 1]) || isInvalid(corners[i + 2])) continue;
    for (std::size_t c = 0; c < 3; ++c) corners[kept++] = corners[i + c];
  }
  const std::size_t dropped = (corners.size() - kept) / 3;
  corners.resize(kept);
  if (dropped == 0) return;
  if (kept == 0) throw Error(*first);
  leftOut_.addPart(Error(location, fmt::format("{} invalid triangle{}, the first: {}", dropped, dropped == 1 ? "" : "s",
                                               leftOut_.shortText(*first))));
}

// Reads the vertices `kept`. Those that are not finite, which no face uses, are moved to a corner.
void GltfPrimitiveReader::readVertices(const std::vector<std::uint32_t>& kept, const Vectors& positions,
                                       const Vectors* normals, Polygons& polygons) {
  polygons.positions.reserve(kept.size());
  for (const std::uint32_t i : kept) polygons.positions.push_back(positions.accessor.vector(i));
  if (!positions.isFinite) {
    const glm::dvec3 corner = polygons.positions[polygons.corners.front()];
    for (glm::dvec3& p : polygons.positions)
      if (!isFinite(p)) p = corner;
  }
  if (normals == nullptr) return;
  polygons.normals.reserve(kept.size());
  for (const std::uint32_t i : kept) polygons.normals.emplace_back(normals->accessor.vector(i));
  if (normals->isFinite) return;
  leftOut_.addValue(normals->accessor.notFinite(*normals->accessor.findNotFinite()));
  for (glm::vec3& n : polygons.normals)
    if (!isFinite(n)) n = glm::vec3(0);
}

void GltfPrimitiveReader::readTextures(const gltf::Primitive& primitive, const TextureNeeds& needs,
                                       std::size_t vertices, const std::vector<std::uint32_t>& kept,
                                       VertexTextures& textures) {
  using gltf::ComponentType;
  const auto open = [&](std::size_t index) {
    GltfAccessor accessor(document_, buffers_, index, where_);
    addVertices(accessor.count(), accessor.location());
    if (accessor.count() != vertices)
      throw Error(accessor.location(), "numbers of values and positions differ", fmt::to_string(vertices),
                  fmt::to_string(accessor.count()));
    return accessor;
  };
  for (std::size_t set = 0; set < needs.coordinates.size(); ++set) {
    if (!needs.coordinates[set] || !primitive.texCoords[set]) continue;
    const GltfAccessor accessor = open(*primitive.texCoords[set]);
    accessor.requireTextureCoordinates(document_.quantized);
    std::optional<Error> first;
    for (const std::uint32_t i : kept) {
      const double u = accessor.number(i, 0), v = accessor.number(i, 1);
      const bool isValid = isAcceptedCoordinate(u) && isAcceptedCoordinate(v);
      if (!isValid && !first)
        first = Error(accessor.location(), fmt::format("texture coordinate {} is out of range", i),
                      fmt::format("-{0:g} to {0:g}", kMaxTextureCoordinate), fmt::format("({:g}, {:g})", u, v));
      textures.coordinates[set].push_back(isValid ? glm::vec2(u, v) : glm::vec2(0));
    }
    if (first) leftOut_.addValue(*first);
  }
  if (!needs.tangents || !primitive.tangent) return;
  const GltfAccessor accessor = open(*primitive.tangent);
  accessor.requireTangents(document_.quantized);
  std::optional<Error> first;
  for (const std::uint32_t i : kept) {
    const glm::dvec3 t(accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2));
    const double sign = accessor.number(i, 3);
    const bool isValid = isFinite(t) && std::abs(sign) == 1;
    if (!isValid && !first)
      first = Error(accessor.location(), fmt::format("invalid tangent {}", i), "finite numbers, and a w of 1 or -1",
                    fmt::format("({:g}, {:g}, {:g}, {:g})", t.x, t.y, t.z, sign));
    textures.tangents.push_back(isValid ? glm::vec4(glm::vec3(t), static_cast<float>(sign)) : glm::vec4(0, 0, 0, 1));
  }
  if (first) leftOut_.addValue(*first);
}

Polygons GltfPrimitiveReader::readDraco(const gltf::Primitive& primitive, const TextureNeeds& needs,
                                        const GltfPose& pose, const std::string& location) {
  if (pose.passes(primitive) > 0)
    throw Error(location, "a skin or morph target of Draco data is not read", "a file without Draco compression");
  // Take the counts of the accessors, whose bytes, if any, are for readers without Draco.
  if (!primitive.indices) throw Error(location, "Draco data without indices", "an accessor of indices");
  const std::size_t corners = declaredCount(*primitive.indices);
  GltfDracoCounts counts;
  counts.vertices = declaredCount(*primitive.position);
  counts.triangles = corners / 3;
  if (corners % 3 != 0 || corners == 0)
    throw Error(location, "incomplete triangle", "a multiple of 3 corners", fmt::format("{} corners", corners));
  const gltf::DracoExtension& draco = *primitive.draco;
  const std::span<const std::byte> data = gltfViewBytes(document_, buffers_, draco.bufferView, where_);
  addTriangles(counts.triangles, bytes() / 2 + kDracoTrianglesPerByte * data.size(), location);
  addVertices(counts.vertices, location);

  // Take the ids of the attributes.
  if (!draco.position)
    throw Error(location + ".extensions.KHR_draco_mesh_compression", "no positions", "an attribute POSITION");
  counts.positionId = *draco.position;
  if (primitive.normal) counts.normalId = draco.normal;
  if (primitive.normal && !draco.normal) addNote(leftOut_.notes(), "normals beside Draco data");

  const auto take = [](bool isNeeded, const auto& accessor, std::optional<std::uint32_t> id) {
    return isNeeded && accessor ? id : std::nullopt;
  };
  for (std::size_t set = 0; set < needs.coordinates.size(); ++set)
    counts.coordinateIds[set] = take(needs.coordinates[set], primitive.texCoords[set], draco.texCoords[set]);
  counts.tangentId = take(needs.tangents, primitive.tangent, draco.tangent);

  // Decode.
  GltfDracoMesh mesh = decodeGltfDraco(data, counts, location);
  Polygons polygons;
  polygons.positions = std::move(mesh.positions);
  polygons.normals = std::move(mesh.normals);
  polygons.corners = std::move(mesh.corners);
  closeTriangles(polygons);
  mesh.textures.setCorners(polygons);
  return polygons;
}

}  // namespace malus::prep
