// The data of a PLY file, value by value, in text or in binary: the same calls for both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "meshprep/read/ply_header.h"

namespace malus::prep::ply {

// What is skipped in text, and real numbers that need not be finite, become 0: OpenMesh cannot read "nan".
// All throw Error that names a line or a byte where the value is missing or is none.
class Source {
 public:
  virtual ~Source() = default;

  // Goes to the next item (vertex, face ...) of those that follow; `what` and `index`, from 0, are for messages.
  virtual void beginItem(std::string_view what, std::size_t index) = 0;
  virtual void endItem() = 0;  // text: nothing more on the line
  virtual void endFile() = 0;  // nothing more at all

  virtual double coordinate(Type type) = 0;  // finite, and a float holds it
  virtual double real(Type type) = 0;        // perhaps not finite
  virtual std::int64_t whole(Type type) = 0;
  virtual void skip(Type type, std::size_t count) = 0;

  virtual bool locationsAreBytes() const = 0;
  virtual std::uint64_t place() const = 0;  // of the item
  // `problem` belongs to the item at hand.
  [[noreturn]] virtual void fail(std::string_view problem, std::string_view expected, std::string_view found) const = 0;
};

std::unique_ptr<Source> openSource(std::string& bytes, std::string_view where, const Header& header);

}  // namespace malus::prep::ply
