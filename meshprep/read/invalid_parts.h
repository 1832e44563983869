// Invalid parts of a file that are left out: faces, vertices, values of materials. With `strict` they are errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/base/error.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

class InvalidParts {
 public:
  explicit InvalidParts(bool strict) : strict_(strict) {}

  // Counts parts of a kind ("faces") that are left out because of an error. Throws the error if strict. Throws Error if
  // kMostErrors are exceeded: the file is not what its name states.
  static constexpr std::size_t kMostErrors = 10'000;
  void add(std::string_view kind, const Error& error, std::size_t count = 1);

  // The same without a limit, for values that are replaced.
  void addReplaced(std::string_view kind, const Error& error);

  bool any() const { return first_.has_value(); }
  const std::optional<Error>& first() const { return first_; }

  // Adds a note per kind: "invalid faces: 2, the first: model.obj:7: ..."
  void addNotes(std::vector<std::string>& notes) const;

 private:
  void count(std::string_view kind, const Error& error, std::size_t count);

  struct Kind {
    std::string name;
    std::size_t count = 0;
    std::string first;  // error
  };
  bool strict_;
  std::optional<Error> first_;
  std::size_t errors_ = 0;
  std::vector<Kind> kinds_;
};

// Position of a vertex that is left out, and index of a corner without a vertex.
extern const glm::dvec3 kInvalidPosition;
inline constexpr std::uint32_t kInvalidCorner = 0xffffffffu;

// Removes the faces that have an invalid vertex or corner, with their attributes, and moves invalid vertices to the
// first valid one. The vertices keep their numbers. `where` is the path for messages.
void dropInvalidFaces(Polygons& polygons, InvalidParts& invalid, std::string_view where);

}  // namespace malus::prep
