#include "render/method_option.h"

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"

namespace malus::render {

CLI::Validator methodName() {
  return {[](std::string& text) -> std::string {
            try {
              const MethodInfo& method = methodNamed(text);
              if (method.name != text)
                console::note(fmt::format("method name '{}' is deprecated; use '{}'", text, method.name));
              text = method.name;
            } catch (const Error& error) {
              return error.what();
            }
            return {};
          },
          fmt::format("{{{}}}", fmt::join(methodNames(), ","))};
}

}  // namespace malus::render
