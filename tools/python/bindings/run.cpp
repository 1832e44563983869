#include "tools/python/bindings/run.h"

namespace malus::python {

namespace {
std::mutex gHandling;  // at most one InterruptScope may exist
}

Interrupts::Interrupts() : lock_(gHandling, std::try_to_lock) {
  if (!lock_) return;
  ::sigaction(SIGINT, nullptr, &interrupt_);
  ::sigaction(SIGTERM, nullptr, &terminate_);
  scope_.emplace();
  handleInterrupts();
}

Interrupts::~Interrupts() {
  if (!lock_) return;
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
}

}  // namespace malus::python
