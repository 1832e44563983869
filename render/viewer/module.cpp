#include "render/viewer/module.h"

#include "render/viewer/headless.h"
#include "render/viewer/window.h"

namespace malus::viewer {

namespace {

void run(const Request& request, const Host& host) {
  if (request.frames > 0)
    runHeadless(request, host);
  else
    runWindow(request, host);
}

constexpr Module kModule = {MALUS_VERSION, run};

}  // namespace

}  // namespace malus::viewer

extern "C" [[gnu::visibility("default")]] const malus::viewer::Module* malusViewerModule();
const malus::viewer::Module* malusViewerModule() { return &malus::viewer::kModule; }
