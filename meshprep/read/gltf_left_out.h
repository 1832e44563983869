// Record of the content of a glTF file that is left out because of an error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshprep/base/error.h"

namespace malus::prep {

// A limit of the whole file is exceeded: nothing is left out instead.
class GltfLimitError : public Error {
 public:
  using Error::Error;
};

class GltfLeftOut {
 public:
  // where: the file, which notes do not repeat. Each error becomes a note; with `strict` it is thrown.
  GltfLeftOut(bool strict, std::string where, std::vector<std::string>& notes);

  bool isStrict() const { return strict_; }
  std::vector<std::string>& notes() { return notes_; }  // of the file: also those of other content

  // Part of the scene: a node, a mesh, a primitive, or what these need.
  void addPart(const Error& error);
  // Value that has a default.
  void addValue(const Error& error);

  // Throws the first error of a part, if there is one: for a scene without anything left.
  void rethrowFirst() const;

  // Returns the text of an error without the file.
  std::string shortText(const Error& error) const;

 private:
  bool strict_;
  std::string where_;
  std::vector<std::string>& notes_;
  std::optional<Error> first_;
};

}  // namespace malus::prep
