#include "bake/pack/field_io.h"

#include <fmt/format.h>

namespace malus::pack {

namespace {

// "1 to 16384"
std::string boundsText(double low, double high) { return fmt::format("{:.9g} to {:.9g}", low, high); }

}  // namespace

double FieldReader::number(const Field& field, int component) {
  const bool mustBeZero = field.isZeroForOthers && !contains(field.kinds, kind_);
  const double low = mustBeZero ? 0 : field.low, high = mustBeZero ? 0 : field.high;
  const double value = r_.f64(field.name);
  if (value < low || value > high) {
    const std::string which = component < 0 ? std::string() : fmt::format("[{}]", component);
    r_.fail(fmt::format("{}{} is out of range", field.name, which),
            mustBeZero ? fmt::format("0 for the material type {}", materialKindName(kind_)) : boundsText(low, high),
            fmt::format("{:g}", value));
  }
  return value;
}

std::uint32_t FieldReader::integer(const Field& field) {
  const std::uint32_t value = r_.u32();
  if (field.high > 0 && (value < field.low || value > field.high))
    r_.fail(fmt::format("{} is out of range", field.name), fmt::format("{} to {}", field.low, field.high),
            fmt::format("{}", value));
  return value;
}

void FieldReader::read(const Field& field, bool& value) {
  const std::uint32_t number = r_.u32();
  if (number > 1) r_.fail(fmt::format("{} is out of range", field.name), boundsText(0, 1), fmt::format("{}", number));
  value = number == 1;
}

void FieldReader::read(const Field& field, glm::dvec3& value) {
  for (int i = 0; i < 3; ++i) value[i] = number(field, i);
}

void FieldReader::read(const Field& field, glm::vec3& value) {
  for (int i = 0; i < 3; ++i) value[i] = static_cast<float>(number(field, i));
}

void FieldReader::read(const Field& field, std::array<glm::dvec3, 9>& values) {
  for (glm::dvec3& value : values) read(field, value);
}

void FieldReader::read(const Field&, std::uint64_t& value) { value = r_.u64(); }

void FieldReader::read(const Field&, std::string& value) { value = r_.text(); }

void FieldReader::read(const Field& field, std::int32_t& value) {
  if (!field.isTexture) {
    value = static_cast<std::int32_t>(integer(field));
    return;
  }
  const std::uint32_t index = r_.u32();
  if (index > textures_)
    r_.fail(fmt::format("{} is out of range", field.name), fmt::format("0 to {}, the number of textures", textures_),
            fmt::format("{}", index));
  value = static_cast<std::int32_t>(index) - 1;
}

}  // namespace malus::pack
