// Layout of a scene pack: header, table of sections, sections. Byte by byte in bake/FORMAT.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/compress/texture_rounding.h"

namespace malus::pack {

inline constexpr std::array<char, 8> kMagic = {'M', 'A', 'L', 'U', 'S', 'P', 'A', 'K'};
inline constexpr std::uint32_t kFormatVersion = 2;        // written
inline constexpr std::uint32_t kOldestFormatVersion = 1;  // read
inline constexpr std::size_t kHeaderBytes = 40;
inline constexpr std::size_t kEntryBytes = 40;
inline constexpr std::size_t kAlignment = 16;
inline constexpr std::uint32_t kMaxSections = 64;
inline constexpr std::uint32_t kOptional = 1;  // flag: a reader that does not know the section skips it

// Bounds of the schema. Geometry beyond them does not fit the renderers' 32-bit indices; squares of larger lengths and
// radiances overflow a float.
inline constexpr double kMaxLength = 1e15;          // metres
inline constexpr double kMaxLight = 1e15;           // radiance, intensity
inline constexpr double kMaxIrradiance = 4e15;      // of an environment of kMaxLight: pi times that
inline constexpr double kMaxImageShift = 100;       // of the middle of an image from the axis, in its heights
inline constexpr double kMaxUnitComponent = 1.001;  // of a unit vector before its length is checked
inline constexpr std::uint32_t kMaxMeshes = 65536;
inline constexpr std::uint32_t kMaxInstances = 1u << 20;
inline constexpr double kMaxInstanceScale = 1e9;       // of the components of a transform
inline constexpr double kMaxInstanceCondition = 1000;  // largest over smallest factor by which it scales lengths
inline constexpr std::uint32_t kMaxMaterials = 4096;
inline constexpr std::uint32_t kMaxLights = 4096;
inline constexpr std::uint32_t kMaxEffects = 4096;
inline constexpr std::uint32_t kMaxVertices = 1u << 28;
inline constexpr std::uint32_t kMaxTriangles = 1u << 28;
inline constexpr double kMaxCoordinate = 1e9;  // metres; the squared area of a face still fits a float
inline constexpr double kMaxTextureCoordinate = compress::kMaxTextureCoordinate;
inline constexpr std::uint32_t kMaxDepth = 255;
inline constexpr std::uint32_t kMaxResolution = 16384;
inline constexpr std::uint32_t kMaxEnvironmentSize = 8192;
inline constexpr std::uint32_t kMaxTextures = 4096;
inline constexpr std::uint32_t kMaxTextureSide = 8192;
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 28;  // of all textures
inline constexpr double kMaxAbsorption = 1e9;                        // 1/m
inline constexpr double kMaxThicknessNm = 1e5;
inline constexpr double kMaxRetardanceDegrees = 1e5;
inline constexpr std::uint32_t kMaxProvenanceBytes = 1u << 24;

struct Section {
  std::string id;  // four letters
  std::uint32_t version = 1;
  std::uint32_t flags = 0;
  std::uint64_t offset = 0;
  std::uint64_t sizeBytes = 0;
  std::uint64_t hash = 0;  // XXH3, 64 bits, of the section's bytes
};

std::uint64_t hashBytes(std::span<const std::byte> bytes);

// Section ids.
inline constexpr const char* kMeta = "META";
inline constexpr const char* kCamera = "CAMR";
inline constexpr const char* kEnvironment = "ENVR";
inline constexpr const char* kLights = "LGHT";
inline constexpr const char* kMaterials = "MATL";
inline constexpr const char* kSurfaces = "SRFX";
inline constexpr const char* kTextures = "TEXR";
inline constexpr const char* kMeshMaps = "MAPS";
inline constexpr const char* kSky = "SKYP";
inline constexpr const char* kWavelengths = "WAVE";
inline constexpr const char* kMeshes = "MESH";
inline constexpr const char* kGeometry = "GEOM";
inline constexpr const char* kTextureCoordinates = "TCRD";
inline constexpr const char* kInstances = "INST";
inline constexpr const char* kEncodings = "ENCD";
inline constexpr const char* kSourceMap = "SMAP";
inline constexpr const char* kEffects = "EFCT";
inline constexpr const char* kBeyond = "BYND";
inline constexpr const char* kProvenance = "PROV";

struct SectionInfo {
  const char* id;
  bool isRequired;       // every pack has it
  std::uint32_t flags;   // of its entry in the table
  const char* contents;  // one line for bake/FORMAT.md
};

// All sections that this malus knows, in the order of a written pack.
inline constexpr auto kKnownSections = std::to_array<SectionInfo>({
    {kMeta, true, 0, "names, image size, depth, exposure"},
    {kCamera, true, 0, "camera"},
    {kEnvironment, true, 0, "light from infinity"},
    {kLights, true, 0, "point, spot and directional lights"},
    {kMaterials, true, 0, "materials"},
    {kSurfaces, false, 0, "properties that few materials have; written if a material has one"},
    {kTextures, false, 0, "textures; written if a material has one"},
    {kMeshMaps, false, 0, "maps by texture coordinates; written if a material has one"},
    {kSky, false, 0, "polarization of the sky; written if it is polarized"},
    {kWavelengths, false, 0, "wavelengths of the colours; written unless they are 630, 532 and 465 nm"},
    {kMeshes, true, 0, "table of meshes"},
    {kGeometry, true, 0, "geometry of the meshes"},
    {kTextureCoordinates, false, 0, "texture coordinates and tangents of meshes; written if a mesh has any"},
    {kInstances, false, 0, "further places of meshes; written if there are any"},
    {kEncodings, false, kOptional, "bits and errors of the encoded meshes"},
    {kSourceMap, false, kOptional, "map to the source files; written on request"},
    {kEffects, false, kOptional, "effects that the scene needs"},
    {kBeyond, false, kOptional, "light beyond each depth; written if it was measured and there is any"},
    {kProvenance, false, kOptional, "versions, settings and hashes of the sources, as JSON"},
});

// nullptr: unknown.
constexpr const SectionInfo* findSectionInfo(std::string_view id) {
  for (const SectionInfo& info : kKnownSections)
    if (id == info.id) return &info;
  return nullptr;
}

}  // namespace malus::pack
