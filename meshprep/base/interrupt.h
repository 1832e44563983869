// Ctrl-C. By default it ends the process with exit code 130 and removes what is half written. Within an
// InterruptScope the first one only sets a flag, so that long work can keep what is finished.
#pragma once

namespace malus {

void handleInterrupts();  // installs the handlers of SIGINT and SIGTERM

class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

bool interrupted();  // whether the flag was set

// Thrown by work that was interrupted and has kept what it had: exit code 130.
struct Interrupted {};

}  // namespace malus
