// Reader of glTF and GLB: containers, accessors, primitives, and the locations of errors.
#include "meshprep/read/read_gltf.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include <glm/geometric.hpp>

#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::errorIn;
using test::errorMessage;
using test::errorWith;
using test::GltfFile;
using test::hasNote;
using test::readGlb;
using test::readText;
using test::strictErrorWith;
using test::TemporaryFile;
using test::triangleFile;

using Points = std::vector<glm::dvec3>;
using Corners = std::vector<std::uint32_t>;

TEST(ReadGltf, ReadsAllContainers) {
  GltfFile gltf = triangleFile({{"name", "here"}});
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const TemporaryFile binary(".bin", gltf.bin);
  for (const std::string& text :
       {gltf.glb(), gltf.gltf(), "\xef\xbb\xbf" + gltf.gltf(), gltf.gltf(binary.path().filename().string())}) {
    const SourceScene scene = readText(text);  // recognized by its bytes, not its name
    ASSERT_EQ(scene.parts.size(), 1u);
    EXPECT_EQ(scene.parts[0].name, "triangle");
    EXPECT_EQ(scene.parts[0].polygons.positions, points);
    EXPECT_EQ(scene.parts[0].polygons.corners, (Corners{0, 1, 2}));
    EXPECT_FALSE(scene.parts[0].material.has_value());
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "here");
    EXPECT_EQ(scene.instances[0].worldFromObject, glm::dmat4(1));
    EXPECT_TRUE(scene.notes.empty());
  }
}

TEST(ReadGltf, ReadsFilesInTheFolderOnly) {
  const GltfFile gltf = triangleFile();
  const std::string name = "a b\xc3\xa4.bin";
  const TemporaryFile text(".gltf", gltf.gltf("a%20b%C3%A4.bin"));
  const std::filesystem::path bin = text.path().parent_path() / name;
  std::ofstream(bin, std::ios::binary) << gltf.bin;
  EXPECT_EQ(readGltf(text.path()).parts.size(), 1u);
  EXPECT_EQ(gltfFiles(text.path()), std::vector{bin});
  std::filesystem::remove(bin);
  EXPECT_CONTAINS(errorMessage([&] { readGltf(text.path()); }), name + ": cannot open");
  for (const char* uri : {"/etc/passwd", "../x.bin", "a/../../x.bin", "http://a.b/c.bin", "file:x.bin", "%2e%2e/x.bin"})
    EXPECT_CONTAINS(errorMessage([&] { readText(gltf.gltf(uri)); }), "buffers[0].uri: file reference");
  EXPECT_CONTAINS(errorMessage([&] { readText(gltf.gltf("a%2.bin")); }), "percent-encoding");
  EXPECT_CONTAINS(errorMessage([&] { readText(gltf.gltf("data:text/plain,abc")); }), "unsupported data URI");
  EXPECT_CONTAINS(errorMessage([&] { readText(gltf.gltf("data:;base64,AB-D")); }), "base64 at character 2");
  EXPECT_CONTAINS(errorMessage([&] { readText(gltf.gltf("data:;base64,AAAA")); }), "buffers[0]: buffer is shorter");
}

TEST(ReadGltf, ChecksGlbChunks) {
  const std::string glb = triangleFile().glb();
  const auto error = [&](std::size_t offset, std::string_view bytes) {
    std::string changed = glb;
    changed.replace(offset, bytes.size(), bytes);
    return errorMessage([&] { readText(changed); });
  };
  EXPECT_CONTAINS(error(4, test::littleEndian32(1)), "byte 4: unsupported version");
  EXPECT_CONTAINS(error(8, test::littleEndian32(77)), "byte 12", "chunk exceeds");
  EXPECT_CONTAINS(error(12, test::littleEndian32(1u << 30)), "byte 12", "chunk");
  EXPECT_CONTAINS(error(16, "ABCD"), "byte 16", "type", "chunk");
  for (std::size_t size = 0; size < glb.size(); ++size)
    EXPECT_NE(errorMessage([&] { readText(glb.substr(0, size)); }), "") << size;
}

TEST(ReadGltf, ReadsIndexTypesAndModes) {
  const std::vector<glm::vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const auto corners = [&](int mode, auto indices) {
    GltfFile gltf;
    json primitive = {{"attributes", {{"POSITION", gltf.addVectors(points)}}}, {"mode", mode}};
    if (!indices.empty()) primitive["indices"] = gltf.addIndices(indices);
    gltf.add("meshes", {{"primitives", {primitive}}});
    gltf.addNode({{"mesh", 0}});
    const SourceScene scene = readGlb(gltf);
    EXPECT_EQ(scene.parts[0].polygons.positions.size(), 5u);  // those of no face too
    return scene.parts[0].polygons.corners;
  };
  EXPECT_EQ(corners(4, std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3}), (Corners{0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(corners(4, std::vector<std::uint16_t>{0, 1, 2}), (Corners{0, 1, 2}));
  EXPECT_EQ(corners(4, std::vector<std::uint32_t>{4, 1, 2}), (Corners{4, 1, 2}));
  // Every triangle of the strip faces +z: (0,1,2), (1,3,2), (2,3,4).
  EXPECT_EQ(corners(5, std::vector<std::uint8_t>{}), (Corners{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(corners(6, std::vector<std::uint8_t>{0, 1, 3, 2}), (Corners{1, 3, 0, 3, 2, 0}));
}

TEST(ReadGltf, RefusesInvalidIndices) {
  const auto error = [](auto indices, int mode = 4) {
    GltfFile gltf;
    const int position = gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    gltf.add("meshes",
             {{"primitives",
               {{{"attributes", {{"POSITION", position}}}, {"indices", gltf.addIndices(indices)}, {"mode", mode}}}}});
    gltf.addNode({{"mesh", 0}});
    return errorIn(gltf);
  };
  EXPECT_CONTAINS(error(std::vector<std::uint8_t>{0, 1, 3}), "accessors[1]", "index at 2");
  EXPECT_CONTAINS(error(std::vector<std::uint8_t>{0, 1, 255}), "primitive restart at 2");
  EXPECT_CONTAINS(error(std::vector<std::uint32_t>{0, 0xffffffffu, 1}), "primitive restart at 1");
  EXPECT_CONTAINS(error(std::vector<std::uint16_t>{0, 1}), "meshes[0].primitives[0]", "triangle", "found 2");
  EXPECT_CONTAINS(error(std::vector<std::uint16_t>{0, 1}, 5), "3 corners", "found 2");
  EXPECT_EQ(error(std::vector<std::uint16_t>{0, 1, 2}), "");
}

TEST(ReadGltf, ReadsStridesOffsetsAndQuantizedVertices) {
  // Interleaved: position, normal and twelve unused bytes, after eight unused bytes.
  std::string bytes(8, '\x7f');
  const std::vector<glm::vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
  for (const glm::vec3& p : points) bytes += GltfFile::toBytes<glm::vec3>({p, {0, 0, 1}}) + std::string(12, '\x11');
  GltfFile gltf;
  const int view = gltf.addView(bytes);
  gltf.document["bufferViews"][0]["byteStride"] = 36;
  const int position = gltf.addAccessor(view, 5126, 3, "VEC3"), normal = gltf.addAccessor(view, 5126, 3, "VEC3");
  gltf.document["accessors"][0]["byteOffset"] = 8;
  gltf.document["accessors"][1]["byteOffset"] = 20;
  gltf.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}}}}});
  gltf.addNode({{"mesh", 0}});
  SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.parts[0].polygons.positions, (Points{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}));
  EXPECT_EQ(scene.parts[0].polygons.normals, (std::vector<glm::vec3>(3, {0, 0, 1})));
  gltf.document["bufferViews"][0]["byteStride"] = 8;
  EXPECT_CONTAINS(errorIn(gltf), "accessors[0]", "overlapping", "12");

  // Shorts, with and without normalization.
  GltfFile quantized;
  const std::vector<std::int16_t> numbers = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 16384, 0};
  const int shorts = quantized.addAccessor(quantized.addView(GltfFile::toBytes(numbers)), 5122, 3, "VEC3");
  quantized.document["bufferViews"][0]["byteStride"] = 8;
  quantized.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", shorts}}}}}}});
  quantized.addNode({{"mesh", 0}});
  EXPECT_CONTAINS(errorIn(quantized), "accessors[0]", "type", "VEC3", "5126");
  quantized.document["extensionsUsed"] = quantized.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(readGlb(quantized).parts[0].polygons.positions, (Points{{0, 0, 0}, {32767, 0, 0}, {0, -32768, 16384}}));
  quantized.document["accessors"][0]["normalized"] = true;
  EXPECT_EQ(readGlb(quantized).parts[0].polygons.positions, (Points{{0, 0, 0}, {1, 0, 0}, {0, -1, 16384.0 / 32767}}));
}

TEST(ReadGltf, ReadsSparseAccessors) {
  const auto make = [](bool dense, const std::vector<std::uint16_t>& at) {
    GltfFile gltf = triangleFile();
    json& accessor = gltf.document["accessors"][0];
    if (!dense) accessor.erase("bufferView");
    const int indices = gltf.addView(GltfFile::toBytes(at));
    const int values = gltf.addView(GltfFile::toBytes<glm::vec3>({{5, 0, 0}, {0, 6, 7}}));
    gltf.document["accessors"][0]["sparse"] = {{"count", at.size()},
                                               {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                               {"values", {{"bufferView", values}}}};
    return gltf;
  };
  EXPECT_EQ(readGlb(make(true, {0, 2})).parts[0].polygons.positions, (Points{{5, 0, 0}, {1, 0, 0}, {0, 6, 7}}));
  EXPECT_EQ(readGlb(make(false, {1, 2})).parts[0].polygons.positions, (Points{{0, 0, 0}, {5, 0, 0}, {0, 6, 7}}));
  EXPECT_CONTAINS(errorIn(make(true, {2, 1})), "accessors[0].sparse.indices", "index 1", "order");
  EXPECT_CONTAINS(errorIn(make(true, {1, 3})), "below 3", "found 3");
  EXPECT_CONTAINS(errorIn(make(true, {0, 1, 2})), "accessors[0].sparse.values", "buffer view");
  GltfFile indices = make(true, {0, 2});  // sparse indices of a primitive
  indices.document["accessors"][1].erase("bufferView");
  indices.document["accessors"][1]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices.addView(GltfFile::toBytes<std::uint8_t>({1, 2}))}, {"componentType", 5121}}},
      {"values", {{"bufferView", indices.addView(GltfFile::toBytes<std::uint16_t>({2, 1}))}}}};
  EXPECT_EQ(readGlb(indices).parts[0].polygons.corners, (Corners{0, 2, 1}));
}

TEST(ReadGltf, ChecksTheDocument) {
  EXPECT_EQ(errorWith("/asset/generator", "x"), "");
  EXPECT_CONTAINS(errorWith("/asset", nullptr), "asset: missing key");
  EXPECT_CONTAINS(errorWith("/asset/version", "1.0"), "asset.version: unsupported version");
  EXPECT_CONTAINS(errorWith("/asset/minVersion", "2.1"), "asset.minVersion");
  EXPECT_CONTAINS(errorWith("/buffers", {{{"byteLength", 1000}}}), "buffers[0]: buffer is shorter");
  EXPECT_CONTAINS(errorWith("/bufferViews/0/buffer", 1), "buffers[1]: does not exist");
  EXPECT_CONTAINS(errorWith("/bufferViews/0/byteLength", 1000), "bufferViews[0]", "exceeds");
  EXPECT_CONTAINS(errorWith("/bufferViews/0/byteOffset", 9007199254740992), "bufferViews[0]", "exceeds");
  EXPECT_CONTAINS(errorWith("/bufferViews/0/byteLength", nullptr), "bufferViews[0].byteLength: missing key");
  EXPECT_CONTAINS(errorWith("/accessors/0/bufferView", 7), "bufferViews[7]: does not exist");
  EXPECT_CONTAINS(errorWith("/accessors/0/count", 4), "accessors[0]", "exceed", "at most 3");
  EXPECT_CONTAINS(errorWith("/accessors/0/count", 5'000'000), "accessors[0]", "exceed");
  EXPECT_CONTAINS(errorWith("/accessors/0/count", 9007199254740992), "accessors[0]", "exceed");
  EXPECT_CONTAINS(errorWith("/accessors/1/count", 9007199254740990), "accessors[1]", "exceed");
  EXPECT_CONTAINS(errorWith("/accessors/0", {{"componentType", 5126}, {"count", 9007199254740992}, {"type", "VEC3"}}),
                  "too many vertices");
  EXPECT_CONTAINS(errorWith("/accessors/1", {{"componentType", 5125}, {"count", 9007199254740990}, {"type", "SCALAR"}}),
                  "too many triangles");
  EXPECT_CONTAINS(errorWith("/accessors/0/count", 0), "accessors[0]: no elements");
  EXPECT_CONTAINS(errorWith("/accessors/0/count", -1), "accessors[0].count: wrong type");
  EXPECT_CONTAINS(errorWith("/accessors/0/byteOffset", 4), "accessors[0]", "exceed");
  EXPECT_CONTAINS(errorWith("/accessors/0/componentType", 5124), "accessors[0].componentType: unknown component type");
  EXPECT_CONTAINS(errorWith("/accessors/0/type", "VEC2"), "accessors[0]: wrong type");
  EXPECT_CONTAINS(errorWith("/accessors/0/type", "VEC5"), "VEC5");
  EXPECT_CONTAINS(errorWith("/accessors/1/componentType", 5126), "accessors[1]");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/attributes/POSITION", 9), "accessors[9]: does not exist");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/attributes/POSITION", nullptr), "primitives[0]: no positions");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/attributes/NORMAL", 1), "accessors[1]: wrong type");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/indices", 9), "accessors[9]: does not exist");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/indices", 0), "accessors[0]", "type", "indices");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/material", 0), "primitives[0].material", "missing");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives/0/mode", 7), "primitives[0].mode: unknown mode");
  EXPECT_CONTAINS(errorWith("/meshes/0/primitives", 7), "meshes[0].primitives", "type", "list");
  EXPECT_CONTAINS(errorWith("/nodes/0/mesh", 1), "nodes[0].mesh", "missing");
  EXPECT_CONTAINS(errorWith("/nodes/0/mesh", "0"), "nodes[0].mesh", "type", "integer");
  EXPECT_CONTAINS(errorWith("/nodes/0/mesh", nullptr), "no mesh");
  EXPECT_CONTAINS(strictErrorWith("/scene", 1), "scene", "missing");
  EXPECT_CONTAINS(strictErrorWith("/scenes/0/nodes", {0, 0}), "scenes[0].nodes", "node 0", "duplicate");
  EXPECT_CONTAINS(errorWith("/scenes/0/nodes", {1}), "scenes[0].nodes", "missing");
}

TEST(ReadGltf, RefusesNumbersThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    GltfFile gltf = triangleFile();
    std::memcpy(gltf.bin.data() + 16, &bad, 4);
    EXPECT_CONTAINS(errorIn(gltf), "accessors[0]", "element 1", "finite");
  }
  EXPECT_CONTAINS(
      errorMessage([] { readText(R"({"asset": {"version": "2.0"}, "nodes": [{"scale": [1e999, 1, 1]}]})"); }), "range");
}

TEST(ReadGltf, RefusesInvalidJson) {
  const auto error = [](const std::string& text) { return errorMessage([&] { readText(text); }); };
  EXPECT_CONTAINS(error(""), "is empty");
  EXPECT_CONTAINS(error("[]"), "not glTF", "object");
  EXPECT_CONTAINS(error(R"({"asset": {"version": "2.0")"), "byte 27");
  EXPECT_CONTAINS(error(R"({"asset": {"version": "2.0"}, "nodes": [], "nodes": []})"), "duplicate key 'nodes'");
  for (const std::string& open : {std::string("["), std::string(R"({"a":)")}) {
    std::string deep = R"({"asset": {"version": "2.0", "extras": )";
    for (int i = 0; i < 1'000'000; ++i) deep += open;
    EXPECT_CONTAINS(error(deep), "nested", "64");
  }
  std::string many = R"({"asset": {"version": "2.0"}, "materials": [{})";
  for (int i = 0; i < 300'000; ++i) many += ",{}";
  EXPECT_CONTAINS(error(many + "]}"), "too many objects");
}

TEST(ReadGltf, ReadsUsedVerticesOfSharedAccessors) {
  GltfFile gltf;
  const int position = gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}});
  const json attributes = {{"POSITION", position}};
  gltf.add("meshes", {{"name", "m"},
                      {"primitives",
                       {{{"attributes", attributes}, {"indices", gltf.addIndices<std::uint8_t>({0, 1, 2})}},
                        {{"attributes", attributes}, {"indices", gltf.addIndices<std::uint8_t>({5, 3, 4})}}}}});
  gltf.addNode({{"mesh", 0}, {"name", "n"}});
  const SourceScene scene = readGlb(gltf);
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[1].name, "m.2");
  EXPECT_EQ(scene.instances[1].name, "n.2");
  EXPECT_EQ(scene.parts[1].polygons.positions, (Points{{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}));
  EXPECT_EQ(scene.parts[1].polygons.corners, (Corners{2, 0, 1}));
}

TEST(ReadGltf, LimitsUnusedVertices) {
  // A million zeros without bytes, with one triangle and many nodes.
  GltfFile gltf;
  const int position = gltf.add("accessors", {{"componentType", 5126}, {"count", 1'000'000}, {"type", "VEC3"}});
  const int indices = gltf.addIndices(std::vector<std::uint16_t>{0, 1, 2});
  gltf.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", indices}}}}});
  for (int i = 0; i < 12; ++i) gltf.addNode({{"mesh", 0}});
  EXPECT_EQ(errorIn(gltf), "");
  gltf.addNode({{"mesh", 0}});
  EXPECT_CONTAINS(errorIn(gltf), "too many instances");
}

TEST(ReadGltf, NotesIgnoredContent) {
  GltfFile gltf = triangleFile();
  gltf.document["animations"] = {{{"channels", json::array()}}};
  gltf.document["extensionsUsed"] = {"KHR_xmp", "KHR_materials_sheen"};
  json& primitive = gltf.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = 0;
  primitive["attributes"]["COLOR_0"] = 0;
  gltf.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
  gltf.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const SourceScene scene = readGlb(gltf);
  for (const char* note : {"animations", "extension KHR_xmp", "texture coordinates", "extension KHR_materials_sheen",
                           "colours of vertices", "points and lines", "meshes without a node"})
    EXPECT_TRUE(hasNote(scene, note)) << note;
  EXPECT_EQ(scene.notes.size(), 7u);  // each once
  gltf.document["extensionsRequired"] = {"KHR_xmp"};
  EXPECT_CONTAINS(errorIn(gltf), "extensionsRequired", "unknown");
  EXPECT_CONTAINS(errorIn(gltf), "found 'KHR_xmp'");
}

TEST(ReadGltf, LeavesOutIncompleteTriangles) {
  GltfFile gltf;
  const int position = gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const int indices = gltf.addIndices(std::vector<std::uint16_t>{0, 1, 2, 0, 1});
  gltf.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", indices}}}}});
  gltf.addNode({{"mesh", 0}});
  const TemporaryFile file(".glb", gltf.glb());
  const SourceScene scene = readGltf(file.path());
  EXPECT_EQ(scene.parts[0].polygons.corners, (Corners{0, 1, 2}));
  EXPECT_TRUE(hasNote(scene, "incomplete triangles"));
  EXPECT_CONTAINS(errorMessage([&] { readGltf(file.path(), true); }), "meshes[0].primitives[0]", "found 5");
}

TEST(ReadGltf, LeavesOutInvalidPartsAndInstances) {
  GltfFile gltf = triangleFile();
  const int position = gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const int invalid = gltf.addIndices(std::vector<std::uint16_t>{0, 1, 7});
  gltf.add("meshes", {{"name", "bad"},
                      {"primitives",
                       {{{"attributes", {{"POSITION", position}}}, {"indices", invalid}},
                        {{"attributes", {{"POSITION", 99}}}},
                        {{"attributes", {{"POSITION", position}}}, {"material", 5}},
                        {{"attributes", {{"POSITION", position}}}}}}});
  gltf.addNode({{"mesh", 1}});
  gltf.addNode({{"mesh", 0}, {"matrix", {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  gltf.addNode({{"mesh", 9}});
  const TemporaryFile file(".glb", gltf.glb());
  const SourceScene scene = readGltf(file.path());
  EXPECT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 2u);
  for (const char* note : {"accessors[3]: invalid vertex index", "accessors[99]", "meshes[1].primitives[2].material",
                           "nodes[2]: transform is singular", "nodes[3].mesh"})
    EXPECT_TRUE(hasNote(scene, note)) << note;
  EXPECT_FALSE(hasNote(scene, file.path().string()));  // readers of the notes know the file
  EXPECT_CONTAINS(errorMessage([&] { readGltf(file.path(), true); }), "nodes[2]", "singular");
  EXPECT_EQ(readMesh(file.path()).faceCount(), 2u);
  EXPECT_CONTAINS(errorMessage([&] { readMesh(file.path(), true); }), "singular");
}

TEST(ReadGltf, AcceptsBackslashesInFileNames) {
  const GltfFile gltf = triangleFile();
  const std::filesystem::path folder = test::temporaryPath("");
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder / "sub" / "a.bin", std::ios::binary) << gltf.bin;
  for (const char* uri : {"sub\\a.bin", "sub%5Ca.bin", ".\\sub\\a.bin"}) {
    std::ofstream(folder / "a.gltf") << gltf.gltf(uri);
    const SourceScene scene = readGltf(folder / "a.gltf");
    EXPECT_EQ(scene.parts.size(), 1u);
    EXPECT_EQ(std::count_if(scene.notes.begin(), scene.notes.end(),
                            [](const std::string& note) { return note.find("backslashes") != std::string::npos; }),
              1);
    EXPECT_EQ(gltfFiles(folder / "a.gltf").at(0).lexically_normal(), folder / "sub" / "a.bin");
  }
  std::ofstream(folder / "a.gltf") << gltf.gltf("..\\a.bin");
  EXPECT_CONTAINS(errorMessage([&] { readGltf(folder / "a.gltf"); }), "not allowed");
  std::filesystem::remove_all(folder);
}

TEST(ReadGltf, ReproducesASphere) {
  // Compare with the closed form of the vertices.
  const Mesh sphere = test::sphere(20, 30);
  GltfFile gltf;
  gltf.addMesh(sphere, "sphere");
  gltf.addNode({{"mesh", 0}, {"translation", {1, 2, 3}}});
  const TemporaryFile file(".glb", gltf.glb());
  const Polygons whole = readMesh(file.path());
  ASSERT_EQ(whole.positions.size(), sphere.positions.size());
  for (const glm::dvec3& p : whole.positions) EXPECT_NEAR(glm::distance(p, glm::dvec3(1, 2, 3)), 1, 1e-6);
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(whole.face(t)[static_cast<std::size_t>(c)], sphere.triangles[t][c]);
}

}  // namespace
}  // namespace malus::prep
