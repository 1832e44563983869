#include "bake/pack/table.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "bake/pack/bytes.h"
#include "meshprep/base/error.h"

namespace malus::pack {

namespace {

std::string idText(std::span<const std::byte> bytes) {
  std::string id(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (char& c : id)
    if (c < ' ' || c > '~') c = '?';
  return id;
}

void requireKnown(std::span<const Section> sections, std::string_view where) {
  static const char* const kKnown[] = {kMeta, kCamera, kEnvironment, kLights,    kMaterials, kSurfaces, kTextures,
                                       kSky,  kMeshes, kGeometry,    kEncodings, kSourceMap, kEffects,  kProvenance};
  for (const Section& section : sections) {
    const bool known =
        std::any_of(std::begin(kKnown), std::end(kKnown), [&](const char* id) { return section.id == id; });
    if (!known && (section.flags & kOptional) == 0)
      throw Error(where, fmt::format("section {} is required and unknown to this malus", section.id), "a newer malus");
    if (known && section.version != 1)
      throw Error(where, fmt::format("section {} has an unknown version", section.id), "1",
                  fmt::format("{}", section.version));
  }
}

}  // namespace

void readTable(std::span<const std::byte> bytes, std::string_view where, Pack& pack) {
  if (bytes.size() < kMagic.size() || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    throw Error(where, "is not a scene pack", "a file that starts with MALUSPAK");
  ByteReader header(bytes, 0, where);
  header.raw(kMagic.size());
  pack.formatVersion = header.u32();
  if (pack.formatVersion != kFormatVersion)
    throw Error(where,
                pack.formatVersion > kFormatVersion ? "scene pack is newer than this malus"
                                                    : "scene pack is older than this malus reads",
                fmt::format("format version {}", kFormatVersion), fmt::format("{}", pack.formatVersion));
  const std::uint32_t count = header.u32AtMost(kMaxSections, "number of sections");
  const std::uint64_t fileBytes = header.u64();
  const std::uint64_t tableHash = header.u64();
  const std::uint64_t headerHash = header.u64();
  if (headerHash != hashOf(bytes.first(kHeaderBytes - 8)))
    header.fail("header is damaged", "a matching hash", "another");
  if (fileBytes != bytes.size())
    throw Error(where, bytes.size() < fileBytes ? "file is truncated" : "file is longer than its pack",
                fmt::format("{} bytes", fileBytes), fmt::format("{}", bytes.size()));
  const std::uint64_t tableBytes = std::uint64_t{count} * kEntryBytes;
  const std::span<const std::byte> table = header.raw(tableBytes);
  if (tableHash != hashOf(table)) header.fail("table of sections is damaged", "a matching hash", "another");
  pack.hash = hashOf(bytes.first(kHeaderBytes + static_cast<std::size_t>(tableBytes)));
  ByteReader reader(table, kHeaderBytes, where);
  std::uint64_t end = kHeaderBytes + tableBytes;
  for (std::uint32_t i = 0; i < count; ++i) {
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
      reader.fail(fmt::format("section {} lies outside the file or over another", section.id),
                  "an offset past the last section",
                  fmt::format("offset {}, size {}", section.offset, section.sizeBytes));
    // Padding is zero, so that no bit of the file is without meaning.
    for (std::uint64_t at = end; at < section.offset; ++at)
      if (bytes[static_cast<std::size_t>(at)] != std::byte{0})
        throw Error(fmt::format("{}, byte {}", where, at), "padding is damaged", "zero");
    end = section.offset + section.sizeBytes;
    if (section.hash !=
        hashOf(bytes.subspan(static_cast<std::size_t>(section.offset), static_cast<std::size_t>(section.sizeBytes))))
      throw Error(fmt::format("{}, byte {}", where, section.offset), fmt::format("section {} is damaged", section.id),
                  "a matching hash", "another");
    pack.sections.push_back(section);
  }
  if (end != bytes.size())
    throw Error(where, "bytes after the last section", fmt::format("{} bytes", end), fmt::format("{}", bytes.size()));
  requireKnown(pack.sections, where);
}

std::optional<std::size_t> findSection(std::span<const Section> sections, std::string_view id, bool required,
                                       std::string_view where) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (sections[i].id == id) {
      if (found) throw Error(where, fmt::format("section {} is there twice", id));
      found = i;
    }
  if (!found && required) throw Error(where, fmt::format("section {} is missing", id));
  return found;
}

}  // namespace malus::pack
