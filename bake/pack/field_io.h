// Visitors of the descriptions of records (bake/pack/field.h) that read, write and measure bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/bytes.h"
#include "bake/pack/field.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// The fields of a record that are in one version of a section. section: of a material, which several sections describe.
struct FieldFilter {
  const char* section = nullptr;
  std::uint32_t version = 1;
  bool takes(const Field& field) const {
    return (section == nullptr || field.section == section) && field.since <= version;
  }
};

// Reads each field and checks it against its bounds. Throws Error that names the section, the field, its bounds and the
// value found.
class FieldReader {
 public:
  explicit FieldReader(ByteReader& reader, FieldFilter filter = {}) : r_(reader), filter_(filter) {}
  // kind: that of the material whose fields follow; textures: number of textures that it may name.
  void ofMaterial(MaterialKind kind, std::uint32_t textures) { kind_ = kind, textures_ = textures; }

  template <class T>
  void operator()(const Field& field, T& value) {
    if (filter_.takes(field)) read(field, value);
  }

 private:
  double number(const Field& field, int component = -1);
  std::uint32_t integer(const Field& field);

  void read(const Field& field, double& value) { value = number(field); }
  void read(const Field& field, float& value) { value = static_cast<float>(number(field)); }
  void read(const Field& field, glm::dvec3& value);
  void read(const Field& field, glm::vec3& value);
  void read(const Field& field, std::array<glm::dvec3, 9>& values);
  void read(const Field& field, std::uint32_t& value) { value = integer(field); }
  void read(const Field& field, std::uint64_t& value);
  void read(const Field& field, bool& value);
  void read(const Field& field, MaterialKind& value) { value = static_cast<MaterialKind>(integer(field)); }
  void read(const Field& field, LightKind& value) { value = static_cast<LightKind>(integer(field)); }
  void read(const Field& field, Wrap& value) { value = static_cast<Wrap>(integer(field)); }
  void read(const Field& field, std::string& value);
  void read(const Field& field, std::int32_t& value);  // a number, or the index of a texture

  ByteReader& r_;
  FieldFilter filter_;
  MaterialKind kind_ = MaterialKind::lambert;
  std::uint32_t textures_ = 0;
};

// Writes each field. The value of a field is not checked: the reader does that before a file is replaced.
class FieldWriter {
 public:
  explicit FieldWriter(ByteWriter& writer, FieldFilter filter = {}) : w_(writer), filter_(filter) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (!filter_.takes(field)) return;
    if constexpr (std::is_same_v<T, std::int32_t>)
      w_.u32(static_cast<std::uint32_t>(field.isTexture ? value + 1 : value));
    else
      write(value);
  }

 private:
  void write(double value) { w_.f64(value); }
  void write(float value) { w_.f64(static_cast<double>(value)); }
  void write(const glm::dvec3& value) { w_.dvec3(value); }
  void write(const glm::vec3& value) { w_.dvec3(glm::dvec3(value)); }
  void write(const std::array<glm::dvec3, 9>& values) {
    for (const glm::dvec3& value : values) w_.dvec3(value);
  }
  void write(std::uint32_t value) { w_.u32(value); }
  void write(std::uint64_t value) { w_.u64(value); }
  void write(bool value) { w_.u32(value ? 1 : 0); }
  void write(MaterialKind value) { w_.u32(static_cast<std::uint32_t>(value)); }
  void write(LightKind value) { w_.u32(static_cast<std::uint32_t>(value)); }
  void write(Wrap value) { w_.u32(static_cast<std::uint32_t>(value)); }
  void write(const std::string& value) { w_.text(value); }

  ByteWriter& w_;
  FieldFilter filter_;
};

// Type of a field in bake/FORMAT.md, and its bytes; of a text, those of its length.
struct FieldType {
  const char* name;
  std::size_t bytes;
};
template <class T>
constexpr FieldType fieldType(const T&) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, float>)
    return {"f64", 8};
  else if constexpr (std::is_same_v<T, glm::dvec3> || std::is_same_v<T, glm::vec3>)
    return {"vec3", 24};
  else if constexpr (std::is_same_v<T, std::array<glm::dvec3, 9>>)
    return {"9 vec3", 216};
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return {"u64", 8};
  else if constexpr (std::is_same_v<T, std::string>)
    return {"text", 4};
  else
    return {"u32", 4};
}

// Adds up the fewest bytes that a record has.
class FieldSizes {
 public:
  explicit FieldSizes(FieldFilter filter = {}) : filter_(filter) {}
  template <class T>
  void operator()(const Field& field, const T& value) {
    if (filter_.takes(field)) bytes_ += fieldType(value).bytes;
  }
  std::size_t bytes() const { return bytes_; }

 private:
  FieldFilter filter_;
  std::size_t bytes_ = 0;
};

}  // namespace malus::pack
