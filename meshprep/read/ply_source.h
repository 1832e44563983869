// Values of a PLY file, with one interface for text and binary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "meshprep/read/ply_header.h"

namespace malus::prep::ply {

// In text, skipped values and results of real() are replaced by 0, because OpenMesh cannot read "nan". All functions
// throw Error at a line or byte if a value is missing or invalid.
class Source {
 public:
  virtual ~Source() = default;

  // Begins the next item; `what` ("vertex") and `index`, from 0, are for messages.
  virtual void beginItem(std::string_view what, std::size_t index) = 0;
  virtual void endItem() = 0;  // text: requires the end of the line
  virtual void endFile() = 0;  // requires the end of the file, or padding without which the file is complete
  virtual bool hasPadding() const = 0;
  virtual bool hasCrLineEnds() const = 0;  // of text

  virtual double coordinate(Type type) = 0;  // finite, within the range of float
  virtual double real(Type type) = 0;        // may be infinite or NaN
  virtual std::int64_t whole(Type type) = 0;
  virtual void skip(Type type, std::size_t count) = 0;

  virtual bool locationsAreBytes() const = 0;
  virtual std::uint64_t location() const = 0;  // of the current item
  // Throws Error at the current item.
  [[noreturn]] virtual void fail(std::string_view problem, std::string_view expected, std::string_view found) const = 0;
};

std::unique_ptr<Source> openSource(std::string& bytes, std::string_view where, const Header& header);

}  // namespace malus::prep::ply
