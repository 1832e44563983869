// SIGINT (Ctrl-C) and SIGTERM. By default they end the process with exit code 130, and the file being written is
// removed. Within an InterruptScope the first signal only sets a flag, so that long work can save what it has finished;
// the second signal ends the process.
#pragma once

namespace malus {

// Installs the handlers of SIGINT and SIGTERM. Call it once, before any thread starts.
void handleInterrupts();

// Defers the first signal while it exists. Clears the flag when constructed. At most one may exist at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

// Returns true if a signal arrived within the current or the last InterruptScope.
bool interrupted();

// Thrown after an interrupt by work that has saved what it had finished. The program exits with code 130.
struct Interrupted {};

}  // namespace malus
