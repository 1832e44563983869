#include "meshprep/base/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "meshprep/base/atomic_file.h"

namespace malus {

namespace {

volatile std::sig_atomic_t gDeferred = 0;  // an InterruptScope exists
volatile std::sig_atomic_t gInterrupted = 0;

void onSignal(int) {
  if (gDeferred != 0 && gInterrupted == 0) {
    gInterrupted = 1;
    return;
  }
  removeUnfinished();
  ::_exit(130);
}

}  // namespace

void handleInterrupts() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

InterruptScope::InterruptScope() {
  gInterrupted = 0;
  gDeferred = 1;
}
InterruptScope::~InterruptScope() { gDeferred = 0; }

bool interrupted() { return gInterrupted != 0; }

}  // namespace malus
