#include "bake/pack/table.h"

#include <cstring>
#include <string>

#include <fmt/format.h>

#include "bake/pack/bytes.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/texture_section.h"
#include "meshprep/base/error.h"

namespace malus::pack {

namespace {

std::string idText(std::span<const std::byte> bytes) {
  std::string id(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (char& c : id)
    if (c < ' ' || c > '~') c = '?';
  return id;
}

// Newest version of a known section that this malus reads.
std::uint32_t newestVersion(std::string_view id) {
  if (id == kSurfaces) return newestSurfaceVersion();
  NewestVersion newest;
  const Environment environment;
  const MeshEntry mesh;
  const MeshEncoding encoding;
  if (id == kEnvironment) visitEnvironment(newest, environment);
  if (id == kCamera) return kNewestCamera;
  if (id == kLights) return kNewestLights;
  if (id == kTextures) return kNewestTextures;
  if (id == kMeshes) visitMeshEntry(newest, mesh);
  if (id == kEncodings) visitMeshEncoding(newest, encoding);
  return newest.version;
}

void requireKnown(std::span<const Section> sections, std::string_view where) {
  for (const Section& section : sections) {
    if (findSectionInfo(section.id) == nullptr) {
      if ((section.flags & kOptional) == 0)
        throw Error(where, fmt::format("section {} is required and unknown to this malus", section.id),
                    "a newer malus");
      continue;
    }
    const std::uint32_t newest = newestVersion(section.id);
    if (section.version == 0 || section.version > newest)
      throw Error(where, fmt::format("section {} has an unknown version", section.id), fmt::format("1 to {}", newest),
                  fmt::format("{}", section.version));
  }
}

// Reads one entry and checks its place in the file. end: that of the section before, or of the table.
Section readEntry(ByteReader& reader, std::span<const std::byte> bytes, std::uint64_t end) {
  Section section;
  section.id = idText(reader.raw(4));
  section.version = reader.u32();
  section.flags = reader.u32();
  reader.u32();
  section.offset = reader.u64();
  section.sizeBytes = reader.u64();
  section.hash = reader.u64();
  if (section.offset % kAlignment != 0 || section.offset < end || section.offset > bytes.size() ||
      section.sizeBytes > bytes.size() - section.offset)
    reader.fail(fmt::format("section {} is outside the file or overlaps another", section.id),
                fmt::format("a multiple of {} from {} on, within {} bytes", kAlignment, end, bytes.size()),
                fmt::format("offset {}, size {}", section.offset, section.sizeBytes));
  return section;
}

// Checks the padding before a section, which is zero, so that every bit of the file has a meaning, and its hash.
void checkBytes(std::span<const std::byte> bytes, const Section& section, std::uint64_t end, std::string_view where) {
  for (std::uint64_t at = end; at < section.offset; ++at)
    if (bytes[static_cast<std::size_t>(at)] != std::byte{0})
      throw Error(fmt::format("{}, byte {}", where, at), "padding is damaged", "zero");
  if (section.hash !=
      hashBytes(bytes.subspan(static_cast<std::size_t>(section.offset), static_cast<std::size_t>(section.sizeBytes))))
    throw Error(fmt::format("{}, byte {}", where, section.offset), fmt::format("section {} is damaged", section.id),
                "a matching hash", "another");
}

}  // namespace

void readTable(std::span<const std::byte> bytes, std::string_view where, Pack& pack) {
  if (bytes.size() < kMagic.size() || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    throw Error(where, "is not a scene pack", "a file that starts with MALUSPAK");
  ByteReader header(bytes, 0, where);
  header.raw(kMagic.size());
  pack.formatVersion = header.u32();
  if (pack.formatVersion < kOldestFormatVersion || pack.formatVersion > kFormatVersion)
    throw Error(where,
                pack.formatVersion > kFormatVersion ? "scene pack is newer than this malus"
                                                    : "scene pack is older than this malus reads",
                fmt::format("format version {} to {}", kOldestFormatVersion, kFormatVersion),
                fmt::format("{}", pack.formatVersion));
  const std::uint32_t count = header.u32AtMost(kMaxSections, "number of sections");
  const std::uint64_t fileBytes = header.u64();
  const std::uint64_t tableHash = header.u64();
  const std::uint64_t headerHash = header.u64();
  if (headerHash != hashBytes(bytes.first(kHeaderBytes - 8)))
    header.fail("header is damaged", "a matching hash", "another");
  if (fileBytes != bytes.size())
    throw Error(where, bytes.size() < fileBytes ? "file is truncated" : "file is longer than its pack",
                fmt::format("{} bytes", fileBytes), fmt::format("{}", bytes.size()));
  const std::uint64_t tableBytes = std::uint64_t{count} * kEntryBytes;
  const std::span<const std::byte> table = header.raw(tableBytes);
  if (tableHash != hashBytes(table)) header.fail("table of sections is damaged", "a matching hash", "another");
  pack.hash = hashBytes(bytes.first(kHeaderBytes + static_cast<std::size_t>(tableBytes)));
  ByteReader reader(table, kHeaderBytes, where);
  std::uint64_t end = kHeaderBytes + tableBytes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Section section = readEntry(reader, bytes, end);
    checkBytes(bytes, section, end, where);
    end = section.offset + section.sizeBytes;
    pack.sections.push_back(section);
  }
  if (end != bytes.size())
    throw Error(where, "bytes after the last section", fmt::format("{} bytes", end), fmt::format("{}", bytes.size()));
  requireKnown(pack.sections, where);
}

const Section* findSection(std::span<const Section> sections, std::string_view id, std::string_view where) {
  const Section* found = nullptr;
  for (const Section& section : sections) {
    if (section.id != id) continue;
    if (found != nullptr) throw Error(where, fmt::format("section {} occurs twice", id), "each section once");
    found = &section;
  }
  if (found == nullptr && findSectionInfo(id)->isRequired)
    throw Error(where, fmt::format("section {} is missing", id), "a complete pack");
  return found;
}

}  // namespace malus::pack
