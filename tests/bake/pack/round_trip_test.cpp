// A pack stores the complete scene, and equal scenes give equal files.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <glm/geometric.hpp>

#include "bake/pack/reader.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/texel_storage.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"

namespace malus::pack {
namespace {

using bake::test::contains;
using bake::test::errorMessage;
using bake::test::smallScene;
using bake::test::TemporaryFolder;

// Returns the vertex of the mesh nearest to p.
glm::dvec3 nearest(const Mesh& mesh, const glm::dvec3& p) {
  return *std::min_element(mesh.positions.begin(), mesh.positions.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, p) < glm::distance(b, p);
  });
}

TEST(PackRoundTrip, EveryField) {
  const Scene scene = smallScene();
  const Written written = serialize(scene, {});
  const Pack pack = parse(written.bytes, "test");
  EXPECT_EQ(pack.formatVersion, kFormatVersion);
  const Scene& s = pack.scene;
  EXPECT_EQ(s.name, scene.name);
  EXPECT_EQ(s.title, scene.title);
  EXPECT_EQ(s.origin, scene.origin);
  EXPECT_EQ(s.width, scene.width);
  EXPECT_EQ(s.height, scene.height);
  EXPECT_EQ(s.depth, scene.depth);
  EXPECT_EQ(s.exposureEv, scene.exposureEv);
  EXPECT_EQ(s.camera.position, scene.camera.position);
  EXPECT_EQ(s.camera.right, scene.camera.right);
  EXPECT_EQ(s.camera.up, scene.camera.up);
  EXPECT_EQ(s.camera.forward, scene.camera.forward);
  EXPECT_EQ(s.camera.verticalFovDegrees, scene.camera.verticalFovDegrees);
  EXPECT_EQ(s.camera.mediumEta, scene.camera.mediumEta);
  EXPECT_EQ(s.environment.radiance, scene.environment.radiance);
  EXPECT_EQ(s.environment.size, scene.environment.size);
  EXPECT_EQ(s.environment.texels, scene.environment.texels);
  EXPECT_EQ(s.environment.ambientIrradiance, scene.environment.ambientIrradiance);
  EXPECT_EQ(s.environment.irradiance, scene.environment.irradiance);
  ASSERT_EQ(s.lights.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.lights[i].position, scene.lights[i].position);
    EXPECT_EQ(s.lights[i].intensity, scene.lights[i].intensity);
  }
  ASSERT_EQ(s.materials.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(s.materials[i].name, scene.materials[i].name);
    EXPECT_EQ(s.materials[i].kind, scene.materials[i].kind);
    EXPECT_EQ(s.materials[i].eta, scene.materials[i].eta);
    EXPECT_EQ(s.materials[i].k, scene.materials[i].k);
    EXPECT_EQ(s.materials[i].outsideEta, scene.materials[i].outsideEta);
    EXPECT_EQ(s.materials[i].albedo, scene.materials[i].albedo);
    EXPECT_EQ(s.materials[i].radiance, scene.materials[i].radiance);
    EXPECT_EQ(s.materials[i].highlightStrength, scene.materials[i].highlightStrength);
    EXPECT_EQ(s.materials[i].highlightExponent, scene.materials[i].highlightExponent);
  }
  ASSERT_EQ(s.effects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.effects[i].name, scene.effects[i].name);
    EXPECT_EQ(s.effects[i].on, scene.effects[i].on);
    EXPECT_EQ(s.effects[i].reason, scene.effects[i].reason);
  }
  EXPECT_EQ(s.provenance, scene.provenance);
}

TEST(PackRoundTrip, LightsOfEveryKind) {
  Scene scene = smallScene();
  const auto version = [](const Scene& written, const char* id) {
    for (const Section& section : parse(serialize(written, {}).bytes, "test").sections)
      if (section.id == id) return section.version;
    return 0u;
  };
  EXPECT_EQ(version(scene, kLights), 1u);  // the bytes of earlier versions
  LightSource spot{{1, 2, 3}, {4, 5, 6}, LightKind::spot, {0, 0.6, -0.8}, 12.5, 33};
  LightSource sun{{0, 0, 0}, {7, 8, 9}, LightKind::directional, {0, -1, 0}};
  scene.lights.push_back(spot);
  scene.lights.push_back(sun);
  EXPECT_EQ(version(scene, kLights), kNewestLights);
  const Scene s = parse(serialize(scene, {}).bytes, "test").scene;
  ASSERT_EQ(s.lights.size(), 4u);
  EXPECT_EQ(s.lights[0].kind, LightKind::point);
  EXPECT_EQ(s.lights[2].kind, LightKind::spot);
  EXPECT_EQ(s.lights[2].direction, spot.direction);
  EXPECT_EQ(s.lights[2].innerConeDegrees, 12.5);
  EXPECT_EQ(s.lights[2].outerConeDegrees, 33);
  EXPECT_EQ(s.lights[3].kind, LightKind::directional);
  EXPECT_EQ(s.lights[3].intensity, sun.intensity);
  // Values that a renderer could not use.
  const auto errorWith = [&](const LightSource& light) {
    Scene wrong = smallScene();
    wrong.lights = {light};
    return malus::test::errorMessage([&] { parse(serialize(wrong, {}).bytes, "test"); });
  };
  spot.innerConeDegrees = 33;
  EXPECT_CONTAINS(errorWith(spot), "LGHT", "innerConeDegrees");
  sun.direction = {0, -0.5, 0};
  EXPECT_CONTAINS(errorWith(sun), "LGHT", "direction");
}

TEST(PackRoundTrip, CamerasOfEveryKind) {
  Scene scene = smallScene();
  const auto camera = [&] { return parse(serialize(scene, {}).bytes, "test").scene.camera; };
  EXPECT_TRUE(camera().isPlain());
  scene.camera.orthographicHeight = 2.5;
  EXPECT_EQ(camera().orthographicHeight, 2.5);
  scene.camera.orthographicHeight = 0;
  scene.camera.pixelAspect = 0.75;
  scene.camera.middleX = -0.25;
  scene.camera.middleY = 1.5;
  EXPECT_EQ(camera().pixelAspect, 0.75);
  EXPECT_EQ(camera().middleX, -0.25);
  EXPECT_EQ(camera().middleY, 1.5);
}

TEST(PackRoundTrip, OptionalSections) {
  const Scene scene = bake::test::unusualScene();
  const Scene s = parse(serialize(scene, {}).bytes, "test").scene;
  EXPECT_EQ(s.environment.sun, scene.environment.sun);
  EXPECT_EQ(s.environment.skyDegree, scene.environment.skyDegree);
  EXPECT_EQ(s.lightBeyond, scene.lightBeyond);
  ASSERT_EQ(s.textures.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.textures[i].name, scene.textures[i].name);
    EXPECT_EQ(s.textures[i].width, scene.textures[i].width);
    EXPECT_EQ(s.textures[i].height, scene.textures[i].height);
    EXPECT_EQ(s.textures[i].texels, scene.textures[i].texels);
  }
  ASSERT_EQ(s.materials.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const Material &m = s.materials[i], &truth = scene.materials[i];
    EXPECT_EQ(m.kind, truth.kind);
    EXPECT_EQ(m.absorption, truth.absorption);
    EXPECT_EQ(m.outsideAbsorption, truth.outsideAbsorption);
    EXPECT_EQ(m.coating.eta, truth.coating.eta);
    EXPECT_EQ(m.coating.thicknessNm, truth.coating.thicknessNm);
    EXPECT_EQ(m.roughness, truth.roughness);
    EXPECT_EQ(m.axis, truth.axis);
    EXPECT_EQ(m.polarization, truth.polarization);
    EXPECT_EQ(m.twoSided, truth.twoSided);
    EXPECT_EQ(m.transmittanceParallel, truth.transmittanceParallel);
    EXPECT_EQ(m.transmittanceCrossed, truth.transmittanceCrossed);
    EXPECT_EQ(m.retardanceDegrees, truth.retardanceDegrees);
    EXPECT_EQ(m.maps.albedo, truth.maps.albedo);
    EXPECT_EQ(m.maps.eta, truth.maps.eta);
    EXPECT_EQ(m.maps.k, truth.maps.k);
    EXPECT_EQ(m.maps.origin, truth.maps.origin);
    EXPECT_EQ(m.maps.u, truth.maps.u);
    EXPECT_EQ(m.maps.v, truth.maps.v);
  }
  ASSERT_EQ(s.instances.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.instances[i].name, scene.instances[i].name);
    EXPECT_EQ(s.instances[i].mesh, scene.instances[i].mesh);
    EXPECT_EQ(s.instances[i].linear, scene.instances[i].linear);
    EXPECT_EQ(s.instances[i].translation, scene.instances[i].translation);
  }
}

TEST(PackRoundTrip, MeshesWithInstancesKeepTheirBoundsAtEveryPlace) {
  Scene scene = bake::test::smallScene();
  scene.instances = {{"large", 0, glm::dmat3(1e3), {50, 0, 0}}};
  WriteSettings settings;
  settings.bounds.positionError = 1e-3;
  const Pack small = parse(serialize(scene, settings).bytes, "test");
  EXPECT_LE(small.encodings.meshes[0].deviation.positionMax * 1e3, 1e-3);
  // Relative to an origin among their vertices, so that transforms round little.
  EXPECT_EQ(small.scene.meshes[1].origin, glm::dvec3(0.0));
  scene.meshes[0].positions[0] = {1e-6, 0.5, 0};  // the median is not 0
  for (glm::dvec3& p : scene.meshes[0].positions) p.x += 3;
  EXPECT_NE(parse(serialize(scene, settings).bytes, "test").scene.meshes[0].origin, glm::dvec3(0.0));
}

TEST(PackRoundTrip, InstancesChangeTheHashOfTheGeometry) {
  const Scene scene = bake::test::unusualScene();
  Scene fewer = scene, moved = scene;
  fewer.instances.pop_back();
  moved.instances[0].linear[2].y = 0.25;
  EXPECT_NE(canonicalGeometryHash(scene), canonicalGeometryHash(fewer));
  EXPECT_NE(canonicalGeometryHash(scene), canonicalGeometryHash(moved));
}

TEST(PackRoundTrip, TexelsOfEveryStorage) {
  const std::vector<glm::vec3> bright(16, glm::vec3(3e5f, 2e5f, 0)), wide(16, glm::vec3(3e5f, 1e-6f, 1.0f / 3));
  for (const auto& [texels, version, isFloat] : {std::tuple(smallScene().environment.texels, 1u, false),
                                                 std::tuple(bright, 2u, false), std::tuple(wide, 2u, true)}) {
    Scene scene = smallScene();
    scene.environment.texels = texels;
    scene.environment.storage = chooseTexelStorage(texels);
    EXPECT_EQ(scene.environment.storage.isFloat, isFloat);
    roundTexels(scene.environment.storage, scene.environment.texels);
    const Pack pack = parse(serialize(scene, {}).bytes, "test");
    EXPECT_EQ(pack.scene.environment.texels, scene.environment.texels);
    EXPECT_EQ(pack.scene.environment.storage, scene.environment.storage);
    for (const Section& section : pack.sections)
      if (section.id == kEnvironment) {
        EXPECT_EQ(section.version, version);
      }
    for (std::size_t i = 0; i < texels.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_LE(std::abs(scene.environment.texels[i][c] - texels[i][c]), 5e-4f * texels[i][c]);
  }
}

// A pack written before the optional sections and their effects existed.
TEST(PackRoundTrip, OldPackStillOpens) {
  const Pack pack = read(std::filesystem::path(MALUS_TEST_PACKS) / "before-surfaces.pack");
  EXPECT_EQ(pack.scene.name, "paint-under-glass-in-brewster-mirror");
  EXPECT_EQ(pack.scene.meshes.size(), 3u);
  ASSERT_EQ(pack.scene.materials.size(), 2u);
  for (const Material& m : pack.scene.materials) EXPECT_TRUE(m.isPlain());
  EXPECT_EQ(pack.scene.effects.size(), 15u);
  EXPECT_EQ(canonicalGeometryHash(pack.scene), 0x486e021ecfc24adfu);  // as printed by the version that wrote it
}

// A pack of format version 1: one grid for all meshes, in Draco's quantization.
TEST(PackRoundTrip, Version1StillOpens) {
  const Pack pack = read(std::filesystem::path(MALUS_TEST_PACKS) / "version-1.pack");
  EXPECT_EQ(pack.formatVersion, 1u);
  EXPECT_EQ(pack.scene.name, "cornell-box");
  ASSERT_EQ(pack.scene.meshes.size(), 8u);
  EXPECT_EQ(pack.scene.triangleCount(), 38u);
  EXPECT_EQ(pack.scene.vertexCount(), 74u);
  EXPECT_EQ(canonicalGeometryHash(pack.scene), 0x57971f2885af534fu);  // as printed by the version that wrote it
}

// Optional sections are only written if they are needed.
TEST(PackRoundTrip, UnusedOptionalSectionsAreNotWritten) {
  const Pack pack = parse(serialize(smallScene(), {}).bytes, "test");
  for (const Section& section : pack.sections)
    EXPECT_TRUE(section.id != kSurfaces && section.id != kTextures && section.id != kSky &&
                section.id != kWavelengths && section.id != kBeyond)
        << section.id;
  for (const Material& m : pack.scene.materials) EXPECT_TRUE(m.isPlain()) << m.name;
}

TEST(PackRoundTrip, PositionErrorsAreWithinTheGridStep) {
  const Scene scene = smallScene();
  const Pack pack = parse(serialize(scene, {}).bytes, "test");
  ASSERT_EQ(pack.scene.meshes.size(), 2u);
  ASSERT_EQ(pack.compression.size(), 2u);
  const double step = 3.0 / 1048575;  // the scene is 3 m wide, 20 bits
  for (std::size_t i = 0; i < 2; ++i) {
    const Mesh &found = pack.scene.meshes[i], &source = scene.meshes[i];
    EXPECT_EQ(found.name, source.name);
    EXPECT_EQ(found.material, source.material);
    EXPECT_EQ(found.openSurface, source.openSurface);
    ASSERT_EQ(found.positions.size(), source.positions.size());
    ASSERT_EQ(found.normals.size(), source.normals.size());
    ASSERT_EQ(found.triangles.size(), source.triangles.size());
    for (std::size_t v = 0; v < source.positions.size(); ++v) {
      const glm::dvec3 decoded = nearest(found, source.positions[v]);
      EXPECT_LE(glm::distance(decoded, source.positions[v]), step) << source.name << ", vertex " << v;
      if (source.normals.empty()) continue;
      const auto at = static_cast<std::size_t>(std::find(found.positions.begin(), found.positions.end(), decoded) -
                                               found.positions.begin());
      EXPECT_LE(glm::distance(found.normals[at], source.normals[v]), 1.5e-3f) << source.name << ", vertex " << v;
    }
    // Orientation is preserved: each triangle's cross product is that of a source triangle.
    for (const glm::uvec3& t : found.triangles) {
      const auto cross = [](const Mesh& m, const glm::uvec3& f) {
        return glm::cross(m.positions[f.y] - m.positions[f.x], m.positions[f.z] - m.positions[f.x]);
      };
      EXPECT_TRUE(std::any_of(source.triangles.begin(), source.triangles.end(), [&](const glm::uvec3& f) {
        return glm::distance(cross(source, f), cross(found, t)) < 1e-4;
      }));
    }
  }
}

TEST(PackRoundTrip, WritingIsDeterministic) {
  const Written a = serialize(smallScene(), {}), b = serialize(smallScene(), {});
  EXPECT_TRUE(a.bytes == b.bytes);
  Scene other = smallScene();
  other.exposureEv += 1e-15;
  EXPECT_FALSE(a.bytes == serialize(other, {}).bytes);
}

TEST(PackRoundTrip, SecondImplementationWritesTheSameFile) {
  const Written written = serialize(smallScene(), {});
  EXPECT_TRUE(test::putTogether(test::takenApart(written.bytes)) == written.bytes);
}

TEST(PackRoundTrip, LayoutIsThatOfTheDocument) {
  const test::Bytes bytes = serialize(smallScene(), {}).bytes;
  const std::vector<test::RawSection> sections = test::takenApart(bytes);
  const char* const kIds[] = {"META", "CAMR", "ENVR", "LGHT", "MATL", "MESH", "GEOM", "ENCD", "EFCT", "PROV"};
  ASSERT_EQ(sections.size(), std::size(kIds));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    EXPECT_EQ(sections[i].id, kIds[i]);
    EXPECT_EQ(sections[i].version, i == 5 || i == 7 ? 2u : 1u);
    EXPECT_EQ(sections[i].flags, i >= 7 ? kOptional : 0u);
    EXPECT_EQ(test::numberAt<std::uint64_t>(bytes, 40 + 40 * i + 16) % 16, 0u);
  }
  EXPECT_EQ(sections[1].bytes.size(), 112u);
  EXPECT_EQ(sections[2].bytes.size(), 252u + 16 * 6);
  EXPECT_EQ(sections[3].bytes.size(), 4u + 2 * 48);
  EXPECT_EQ(sections[4].bytes.size(), 4u + 3 * 124 + 5 + 4 + 4);
  EXPECT_EQ(sections[5].bytes.size(), 4u + 2 * (40 + 56) + 11 + 5);
  const auto reasons = [&] {
    std::size_t letters = 0;
    for (const MeshEncoding& m : parse(bytes, "test").encodings.meshes) letters += m.sequentialReason.size();
    return letters;
  };
  EXPECT_EQ(sections[7].bytes.size(), 4u + 2 * (64 + 40) + reasons());
}

TEST(PackRoundTrip, Encodings) {
  const Written written = serialize(smallScene(), {});
  const Pack pack = parse(written.bytes, "test");
  ASSERT_TRUE(pack.encodings.known());
  EXPECT_EQ(static_cast<int>(pack.encodings.positionBits()), written.positionBits);
  ASSERT_EQ(pack.encodings.meshes.size(), 2u);
  ASSERT_EQ(pack.geometry.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const MeshEncoding& m = pack.encodings.meshes[i];
    EXPECT_EQ(static_cast<int>(m.positionBits), written.meshes[i].positionBits);
    EXPECT_EQ(static_cast<int>(m.normalBits), written.meshes[i].normalBits);
    EXPECT_EQ(m.deviation.positionMax, written.meshes[i].deviation.positionMax);
    EXPECT_EQ(m.deviation.normalMaxDegrees, written.meshes[i].deviation.normalMaxDegrees);
    EXPECT_EQ(m.deviation.tiltMaxDegrees, written.meshes[i].deviation.tiltMaxDegrees);
    EXPECT_EQ(m.sequentialReason, written.meshes[i].sequentialReason);
    EXPECT_EQ(pack.geometry[i].sizeBytes, written.meshes[i].sizeBytes);
    EXPECT_EQ(static_cast<char>(written.bytes[static_cast<std::size_t>(pack.geometry[i].offset)]), 'D');
  }
  EXPECT_EQ(pack.encodings.meshes[1].normalBits, 0u);  // the sheet has none
  EXPECT_FALSE(pack.hasSourceMap());
}

TEST(PackRoundTrip, SourceMapIsStoredOnRequest) {
  Scene scene = smallScene();
  WriteSettings settings;
  settings.keepMap = true;
  scene.meshes[0].sourceVertices = {10, 20, 30, 40};
  scene.meshes[0].sourceFaces = {7, 7, 8, 9};
  const Written written = serialize(scene, settings);
  const Pack pack = parse(written.bytes, "test");
  ASSERT_TRUE(pack.hasSourceMap());
  const Mesh &mesh = pack.scene.meshes[0], &sheet = pack.scene.meshes[1];
  ASSERT_EQ(mesh.sourceVertices.size(), 4u);
  ASSERT_EQ(mesh.sourceFaces.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t source = mesh.sourceVertices[i] / 10 - 1;
    EXPECT_LT(glm::distance(mesh.positions[i], scene.meshes[0].positions[source]), 1e-5);
  }
  // The vertices of a mesh without a source map are numbered in input order.
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT(glm::distance(sheet.positions[i], scene.meshes[1].positions[sheet.sourceVertices[i]]), 1e-5);
  // The section is optional; no other section depends on it.
  std::vector<test::RawSection> sections = test::takenApart(written.bytes);
  EXPECT_EQ(test::section(sections, "SMAP").flags, kOptional);
  EXPECT_EQ(test::section(sections, "SMAP").bytes.size(), 4u * (4 + 4 + 4 + 2));
  std::erase_if(sections, [](const test::RawSection& s) { return s.id == "SMAP"; });
  EXPECT_EQ(canonicalGeometryHash(parse(test::putTogether(sections), "test").scene), canonicalGeometryHash(pack.scene));
}

// Settings with this number of position bits.
WriteSettings withBits(int positionBits, int normalBits) {
  WriteSettings settings;
  settings.bounds.positionBits = positionBits;
  settings.bounds.normalBits = normalBits;
  return settings;
}

TEST(PackRoundTrip, ConstantEnvironmentHasNoTexels) {
  Scene scene = smallScene();
  scene.environment.size = 0;
  scene.environment.texels.clear();
  EXPECT_TRUE(parse(serialize(scene, {}).bytes, "test").scene.environment.texels.empty());
}

TEST(PackRoundTrip, EqualPositionsOfDifferentMeshesDecodeEqual) {
  // Two strips that touch along y = 0.1, at points that are on no grid.
  Scene scene = smallScene();
  scene.meshes.clear();
  constexpr std::uint32_t kPoints = 200;
  const auto x = [](std::uint32_t i) { return 0.1 + 0.0123457 * i; };
  for (int side = 0; side < 2; ++side) {
    Mesh mesh;
    mesh.name = side == 0 ? "left" : "right";
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      mesh.positions.emplace_back(x(i), 0.1, 1.0 / 3);
      mesh.positions.emplace_back(x(i), side == 0 ? -0.7 : 1.9, 0.01 * side);
    }
    for (std::uint32_t i = 0; i + 1 < kPoints; ++i) {
      mesh.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
      mesh.triangles.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    scene.meshes.push_back(mesh);
  }
  for (const int bits : {12, 20, 22, 26, 30}) {
    const Pack pack = parse(serialize(scene, withBits(bits, 12)).bytes, "test");
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const glm::dvec3 p(x(i), 0.1, 1.0 / 3);
      EXPECT_EQ(nearest(pack.scene.meshes[0], p), nearest(pack.scene.meshes[1], p)) << bits << " bits, point " << i;
    }
  }
}

TEST(PackRoundTrip, MoreBitsReduceTheError) {
  const Written coarse = serialize(smallScene(), withBits(8, 6)), fine = serialize(smallScene(), withBits(20, 12));
  EXPECT_GT(coarse.meshes[0].deviation.normalMaxDegrees, fine.meshes[0].deviation.normalMaxDegrees);
  EXPECT_LE(coarse.meshes[0].deviation.positionMax, 3.0 / 255 * 0.9);
  EXPECT_LE(fine.meshes[0].deviation.positionMax, 3.0 / 1048575);
  EXPECT_EQ(fine.meshes.size(), 2u);
}

TEST(PackRoundTrip, CanonicalGeometryHashDependsOnGeometryOnly) {
  const auto hash = [](const Scene& scene) {
    return canonicalGeometryHash(parse(serialize(scene, {}).bytes, "t").scene);
  };
  Scene scene = smallScene();
  const std::uint64_t before = hash(scene);
  scene.title = "another";
  scene.materials[0].eta = glm::dvec3(1.6);
  EXPECT_EQ(hash(scene), before);
  scene.meshes[1].positions[2].z = 0.01f;
  EXPECT_NE(hash(scene), before);
}

TEST(PackRoundTrip, WrittenFileIsReadBack) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "small.pack";
  const Written written = write(path, smallScene(), {});
  const Pack pack = read(path);
  EXPECT_EQ(pack.hash, parse(written.bytes, "test").hash);
  EXPECT_EQ(std::filesystem::file_size(path), written.bytes.size());
}

TEST(PackRoundTrip, InvalidScenesAreNotWritten) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "small.pack";
  const auto refuse = [&](const char* expected, auto change) {
    Scene scene = smallScene();
    change(scene);
    const std::string error = errorMessage([&] { write(path, scene, {}); });
    EXPECT_TRUE(contains(error, expected)) << expected << " / " << error;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << expected;
  };
  refuse("not finite", [](Scene& s) { s.origin.x = NAN; });
  refuse("radiance of 0 to", [](Scene& s) { s.environment.texels[3].y = NAN; });
  refuse("environment texel", [](Scene& s) { s.environment.texels[3].y = -1; });
  refuse("a position is not finite", [](Scene& s) { s.meshes[1].positions[0].x = INFINITY; });
  refuse("mesh 'sheet'", [](Scene& s) { s.meshes[1].triangles[0].x = 4; });
  refuse("material of mesh", [](Scene& s) { s.meshes[1].material = 3; });
  refuse("number of meshes", [](Scene& s) { s.meshes.clear(); });
  refuse("mesh 'sheet'", [](Scene& s) { s.meshes[1].positions[0].x = 1e12; });
  refuse("albedo", [](Scene& s) { s.materials[1].albedo.y = 1.5; });
  refuse("left-handed", [](Scene& s) { s.camera.right = -s.camera.right; });
  refuse("orthonormal", [](Scene& s) { s.camera.right.x = 0.5; });
}

TEST(PackRoundTrip, FailedWriteKeepsThePreviousFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("small.pack", "precious");
  Scene scene = smallScene();
  scene.depth = kMaxDepth + 1;
  EXPECT_NE(errorMessage([&] { write(path, scene, {}); }), "");
  std::ifstream stream(path);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, "precious");
}

}  // namespace
}  // namespace malus::pack
