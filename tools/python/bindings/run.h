// Calls into malus from Python: the interpreter's lock is released, Ctrl-C ends the work.
#pragma once

#include <csignal>
#include <mutex>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "meshprep/base/console.h"
#include "meshprep/base/interrupt.h"

namespace malus::python {

// Handles Ctrl-C and SIGTERM by malus::interrupted() while it exists, unless another thread does so already.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  struct sigaction interrupt_ = {}, terminate_ = {};  // Python's
  std::optional<InterruptScope> scope_;
};

// Returns work(), which must not touch Python objects. Throws KeyboardInterrupt (malus::Interrupted) after Ctrl-C.
template <class Work>
auto withoutLock(Work&& work) {
  const pybind11::gil_scoped_release release;
  const Interrupts interrupts;
  struct EndProgress {
    ~EndProgress() { console::progressDone(); }
  } const end;
  return std::forward<Work>(work)();
}

}  // namespace malus::python
