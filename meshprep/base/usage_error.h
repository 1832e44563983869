// The exception for a wrong command line, such as an output that is an input. Commands exit with code 2.
#pragma once

#include "meshprep/base/error.h"

namespace malus {

class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace malus
