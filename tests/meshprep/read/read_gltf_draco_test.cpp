// Primitives compressed by Draco: valid ones with unused attributes, and ones with wrong counts.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/geometric.hpp>

#include "meshprep/read/read_gltf.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;
using test::GltfFile;
using test::TemporaryFile;

struct Encoded {
  std::string bytes;
  std::size_t points = 0, faces = 0;
  int position = 0, normal = 0;
};

// Quantized sphere with normals, colours and texture coordinates that have a seam.
Encoded encodedSphere(bool sequential, const std::string& metadata = {}) {
  const Mesh sphere = test::sphere(8, 12);
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(sphere.triangles.size()));
  const int texture = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int colour = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
    glm::vec3 p[3];
    float uv[3][2];
    for (int c = 0; c < 3; ++c) {
      p[c] = sphere.positions[sphere.triangles[t][c]];
      uv[c][0] = p[c].x + (t < 20 ? 1.0f : 0.0f);
      uv[c][1] = p[c].y;
    }
    const std::uint8_t white[4] = {255, 255, 255, 255};
    builder.SetAttributeValuesForFace(texture, draco::FaceIndex(t), uv[0], uv[1], uv[2]);
    builder.SetAttributeValuesForFace(normal, draco::FaceIndex(t), &p[0], &p[1], &p[2]);
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(t), &p[0], &p[1], &p[2]);
    builder.SetAttributeValuesForFace(colour, draco::FaceIndex(t), white, white, white);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  if (!metadata.empty()) {
    auto entries = std::make_unique<draco::GeometryMetadata>();
    entries->AddEntryString("name", metadata);
    mesh->AddMetadata(std::move(entries));
  }
  draco::ExpertEncoder encoder(*mesh);
  encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(position, 16);
  encoder.SetAttributeQuantization(normal, 12);
  encoder.SetAttributeQuantization(texture, 10);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  return {{buffer.data(), buffer.size()},
          encoder.num_encoded_points(),
          encoder.num_encoded_faces(),
          static_cast<int>(mesh->attribute(position)->unique_id()),
          static_cast<int>(mesh->attribute(normal)->unique_id())};
}

GltfFile makeFile(const Encoded& encoded) {
  GltfFile gltf;
  const int view = gltf.addView(encoded.bytes);
  gltf.add("accessors", {{"componentType", 5126}, {"count", encoded.points}, {"type", "VEC3"}});
  gltf.add("accessors", {{"componentType", 5126}, {"count", encoded.points}, {"type", "VEC3"}});
  gltf.add("accessors", {{"componentType", 5123}, {"count", 3 * encoded.faces}, {"type", "SCALAR"}});
  const json extension = {{"bufferView", view},
                          {"attributes", {{"POSITION", encoded.position}, {"NORMAL", encoded.normal}, {"COLOR_0", 3}}}};
  gltf.add("meshes", {{"primitives",
                       {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                         {"indices", 2},
                         {"extensions", {{"KHR_draco_mesh_compression", extension}}}}}}});
  gltf.document["extensionsUsed"] = gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  gltf.addNode({{"mesh", 0}});
  return gltf;
}

SourceScene read(const GltfFile& gltf) {
  const TemporaryFile file(".glb", gltf.glb());
  return readGltf(file.path());
}
std::string errorIn(const GltfFile& gltf) {
  return errorMessage([&] { read(gltf); });
}

TEST(ReadGltfDraco, SkipsOtherAttributesAndSeams) {
  for (const bool sequential : {false, true}) {
    const SourceScene scene = read(makeFile(encodedSphere(sequential)));
    const Polygons& polygons = scene.parts.at(0).polygons;
    EXPECT_EQ(polygons.faceCount(), 192u);      // 2 * 12 at the poles, 2 * 7 * 12 between
    EXPECT_GT(polygons.positions.size(), 98u);  // the seam splits some of 2 + 8 * 12
    ASSERT_EQ(polygons.normals.size(), polygons.positions.size());
    double volume = 0;
    for (std::size_t i = 0; i < polygons.positions.size(); ++i) {
      EXPECT_NEAR(glm::length(polygons.positions[i]), 1, 1e-4);
      EXPECT_LT(glm::distance(polygons.positions[i], glm::dvec3(polygons.normals[i])), 5e-3);
    }
    for (std::size_t f = 0; f < polygons.faceCount(); ++f) {
      const auto face = polygons.face(f);
      volume +=
          glm::dot(polygons.positions[face[0]], glm::cross(polygons.positions[face[1]], polygons.positions[face[2]])) /
          6;
    }
    EXPECT_NEAR(volume, 3.6, 0.3);  // outward: 4.19 less what is cut off
  }
}

// Texture coordinates of the corners are those of their positions, moved by 1 at the seam.
TEST(ReadGltfDraco, ReadsTextureCoordinates) {
  for (const bool sequential : {false, true}) {
    GltfFile gltf = makeFile(encodedSphere(sequential));
    json& primitive = gltf.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = 0;
    primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["TEXCOORD_0"] = 0;
    const TemporaryFile file(".glb", gltf.glb());
    const SourceScene scene = readGltf(file.path(), false, false, KeepTextures::all);
    const Polygons& polygons = scene.parts.at(0).polygons;
    ASSERT_EQ(polygons.textureCoordinates[0].size(), polygons.corners.size());
    std::size_t moved = 0;
    for (std::size_t corner = 0; corner < polygons.corners.size(); ++corner) {
      const glm::vec2 uv = polygons.textureCoordinates[0][corner];
      const glm::vec2 expected(polygons.positions[polygons.corners[corner]]);
      const bool isMoved = uv.x - expected.x > 0.5f;
      moved += isMoved ? 1 : 0;
      EXPECT_LT(glm::distance(uv, expected + glm::vec2(isMoved ? 1 : 0, 0)), 5e-3f) << corner;
    }
    EXPECT_EQ(moved, 60u);
    primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["TEXCOORD_0"] = 77;
    const TemporaryFile bad(".glb", gltf.glb());
    EXPECT_CONTAINS(errorMessage([&] { readGltf(bad.path(), false, false, KeepTextures::all); }),
                    "missing texture coordinate");
  }
}

TEST(ReadGltfDraco, RequiresTheCountsOfTheAccessors) {
  for (const bool sequential : {false, true}) {
    const GltfFile good = makeFile(encodedSphere(sequential));
    for (const int change : {-3, 3}) {
      GltfFile bad = good;
      bad.document["accessors"][2]["count"] = bad.document["accessors"][2]["count"].get<int>() + change;
      EXPECT_CONTAINS(errorIn(bad), "meshes[0].primitives[0]", "Draco", "counts");
      bad = good;
      bad.document["accessors"][0]["count"] = bad.document["accessors"][0]["count"].get<int>() + change;
      EXPECT_CONTAINS(errorIn(bad), "meshes[0].primitives[0]", "Draco", "counts");
    }
    GltfFile bad = good;
    bad.document["accessors"][2]["count"] = 100;
    EXPECT_CONTAINS(errorIn(bad), "incomplete triangle");
    bad.document["accessors"][2]["count"] = 3'000'000'000;
    EXPECT_CONTAINS(errorIn(bad), "too many triangles");
  }
}

TEST(ReadGltfDraco, RefusesMissingAttributes) {
  const GltfFile good = makeFile(encodedSphere(false));
  const json::json_pointer extension("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression");
  GltfFile bad = good;
  bad.document[extension]["attributes"]["POSITION"] = 77;
  EXPECT_CONTAINS(errorIn(bad), "missing position attribute");
  bad.document[extension]["attributes"].erase("POSITION");
  EXPECT_CONTAINS(errorIn(bad), "KHR_draco_mesh_compression", "positions");
  bad = good;
  bad.document[extension]["attributes"]["NORMAL"] = 0;  // texture coordinates
  EXPECT_CONTAINS(errorIn(bad), "missing normal attribute");
  bad = good;
  bad.document[extension]["bufferView"] = 5;
  EXPECT_CONTAINS(errorIn(bad), "bufferViews[5]: does not exist");
  bad = good;
  bad.document["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_CONTAINS(errorIn(bad), "Draco data without indices");
}

TEST(ReadGltfDraco, RefusesHugeCounts) {
  // Sequential mesh of two billion faces and points, with accessors of these counts.
  Encoded huge;
  huge.bytes = std::string("DRACO\x02\x02\x01\x00\x00\x00", 11) + "\xff\xff\xff\xff\x07" + "\xff\xff\xff\xff\x07";
  huge.bytes += std::string(40, '\0');
  huge.points = huge.faces = 0x7fffffff;
  EXPECT_CONTAINS(errorIn(makeFile(huge)), "too many triangles");
  huge.faces = 1'000'000;
  EXPECT_CONTAINS(errorIn(makeFile(huge)), "too many vertices");
  huge.points = 1'000'000;
  EXPECT_CONTAINS(errorIn(makeFile(huge)), "Draco", "counts");
}

TEST(ReadGltfDraco, RefusesMetadata) {
  EXPECT_CONTAINS(errorIn(makeFile(encodedSphere(false, "a name"))), "Draco", "metadata");
}

TEST(ReadGltfDraco, SurvivesCorruptBytes) {
  for (const bool sequential : {false, true}) {
    const Encoded good = encodedSphere(sequential);
    for (std::size_t i = 0; i < good.bytes.size(); i += 3) {
      Encoded bad = good;
      bad.bytes[i] = static_cast<char>(bad.bytes[i] ^ 0x55);
      errorIn(makeFile(bad));  // anything but an Error would pass through
      bad.bytes.resize(i);
      EXPECT_NE(errorIn(makeFile(bad)), "") << i;
    }
  }
}

}  // namespace
}  // namespace malus::prep
