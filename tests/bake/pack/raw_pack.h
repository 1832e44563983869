// Splits a scene pack into sections and joins them with matching hashes, by a second implementation of bake/FORMAT.md.
// Tests use it to damage packs whose hashes match.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/format.h"
#include "meshprep/base/error.h"

namespace malus::pack::test {

using Bytes = std::vector<std::byte>;

struct RawSection {
  std::string id;
  std::uint32_t version = 1;
  std::uint32_t flags = 0;
  Bytes bytes;
};

template <class T>
T numberAt(const Bytes& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);  // the tests run on little-endian machines
  return value;
}

template <class T>
void setNumber(Bytes& bytes, std::size_t at, T value) {
  if (at + sizeof value > bytes.size()) throw Error("test", "number outside of a section");
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

inline std::vector<RawSection> takenApart(const Bytes& pack) {
  std::vector<RawSection> sections(numberAt<std::uint32_t>(pack, 12));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::size_t entry = 40 + 40 * i;
    sections[i].id.assign(reinterpret_cast<const char*>(pack.data()) + entry, 4);
    sections[i].version = numberAt<std::uint32_t>(pack, entry + 4);
    sections[i].flags = numberAt<std::uint32_t>(pack, entry + 8);
    const auto offset = static_cast<std::ptrdiff_t>(numberAt<std::uint64_t>(pack, entry + 16));
    const auto size = static_cast<std::ptrdiff_t>(numberAt<std::uint64_t>(pack, entry + 24));
    sections[i].bytes.assign(pack.begin() + offset, pack.begin() + offset + size);
  }
  return sections;
}

// Updates both hashes of a pack whose header or table was changed.
inline void fixHashes(Bytes& pack) {
  const std::size_t tableBytes = 40 * std::size_t{numberAt<std::uint32_t>(pack, 12)};
  if (40 + tableBytes <= pack.size())
    setNumber(pack, 24, hashBytes(std::span<const std::byte>(pack).subspan(40, tableBytes)));
  setNumber(pack, 32, hashBytes(std::span<const std::byte>(pack).first(32)));
}

inline Bytes putTogether(const std::vector<RawSection>& sections, std::uint32_t formatVersion = kFormatVersion) {
  Bytes pack(40 + 40 * sections.size());
  std::memcpy(pack.data(), "MALUSPAK", 8);
  setNumber(pack, 8, formatVersion);
  setNumber(pack, 12, static_cast<std::uint32_t>(sections.size()));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    pack.resize((pack.size() + 15) / 16 * 16);
    const std::size_t entry = 40 + 40 * i;
    std::memcpy(pack.data() + entry, sections[i].id.data(), 4);
    setNumber(pack, entry + 4, sections[i].version);
    setNumber(pack, entry + 8, sections[i].flags);
    setNumber(pack, entry + 16, std::uint64_t{pack.size()});
    setNumber(pack, entry + 24, std::uint64_t{sections[i].bytes.size()});
    setNumber(pack, entry + 32, hashBytes(sections[i].bytes));
    pack.insert(pack.end(), sections[i].bytes.begin(), sections[i].bytes.end());
  }
  setNumber(pack, 16, std::uint64_t{pack.size()});
  fixHashes(pack);
  return pack;
}

inline RawSection& section(std::vector<RawSection>& sections, std::string_view id) {
  for (RawSection& s : sections)
    if (s.id == id) return s;
  throw Error("test", "no such section", id);
}

}  // namespace malus::pack::test
