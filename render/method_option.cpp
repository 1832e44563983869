#include "render/method_option.h"

#include <string>
#include <string_view>

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
              // CLI11 puts the option in front of the message, as Error does.
              const std::string_view message = error.what(), option = "--method: ";
              return std::string(message.starts_with(option) ? message.substr(option.size()) : message);
            }
            return {};
          },
          fmt::format("{{{}}}", fmt::join(methodNames(), ","))};
}

}  // namespace malus::render
