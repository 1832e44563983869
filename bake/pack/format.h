// Layout of a scene pack: header, table of sections, sections. Byte by byte in bake/FORMAT.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace malus::pack {

inline constexpr std::array<char, 8> kMagic = {'M', 'A', 'L', 'U', 'S', 'P', 'A', 'K'};
inline constexpr std::uint32_t kFormatVersion = 1;
inline constexpr std::size_t kHeaderBytes = 40;
inline constexpr std::size_t kEntryBytes = 40;
inline constexpr std::size_t kAlignment = 16;
inline constexpr std::uint32_t kMaxSections = 64;
inline constexpr std::uint32_t kOptional = 1;  // flag: a reader that does not know the section skips it

// Bounds of the schema. Geometry beyond them does not fit the renderers' 32-bit indices.
inline constexpr std::uint32_t kMaxMeshes = 65536;
inline constexpr std::uint32_t kMaxMaterials = 4096;
inline constexpr std::uint32_t kMaxLights = 4096;
inline constexpr std::uint32_t kMaxVertices = 1u << 28;
inline constexpr std::uint32_t kMaxTriangles = 1u << 28;
inline constexpr double kMaxCoordinate = 1e9;  // metres; the squared area of a face still fits a float
inline constexpr std::uint32_t kMaxDepth = 64;
inline constexpr std::uint32_t kMaxResolution = 16384;
inline constexpr std::uint32_t kMaxEnvironmentSize = 8192;
inline constexpr std::uint32_t kMaxTextures = 256;
inline constexpr std::uint32_t kMaxTextureSide = 8192;
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 28;  // of all textures
inline constexpr double kMaxAbsorption = 1e9;                        // 1/m
inline constexpr double kMaxThicknessNm = 1e5;
inline constexpr double kMaxRetardanceDegrees = 1e5;

struct Section {
  std::string id;  // four letters
  std::uint32_t version = 1;
  std::uint32_t flags = 0;
  std::uint64_t offset = 0;
  std::uint64_t sizeBytes = 0;
  std::uint64_t hash = 0;  // XXH3, 64 bits, of the section's bytes
};

std::uint64_t hashOf(std::span<const std::byte> bytes);

// Section ids.
inline constexpr const char* kMeta = "META";
inline constexpr const char* kCamera = "CAMR";
inline constexpr const char* kEnvironment = "ENVR";
inline constexpr const char* kLights = "LGHT";
inline constexpr const char* kMaterials = "MATL";
inline constexpr const char* kSurfaces = "SRFX";  // there where a material is not plain
inline constexpr const char* kTextures = "TEXR";  // there where it has textures
inline constexpr const char* kSky = "SKYP";       // there where the sky is polarized
inline constexpr const char* kMeshes = "MESH";
inline constexpr const char* kGeometry = "GEOM";
inline constexpr const char* kEncodings = "ENCD";   // optional
inline constexpr const char* kSourceMap = "SMAP";   // optional; there where it was asked for
inline constexpr const char* kEffects = "EFCT";     // optional
inline constexpr const char* kProvenance = "PROV";  // optional

}  // namespace malus::pack
