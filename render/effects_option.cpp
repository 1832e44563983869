#include "render/effects_option.h"

#include <string>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "shaders/effects.h"

namespace malus::render {

CLI::Validator effectList() {
  return {
      [](std::string& text) -> std::string {
        std::vector<std::string> names = CLI::detail::split(text, ',');
        for (std::string& name : names) {
          const auto effect = shaders::effectNamed(name);
          if (!effect || shaders::effectName(*effect) == name) continue;
          console::note(fmt::format("effect name '{}' is deprecated; use '{}'", name, shaders::effectName(*effect)));
          name = shaders::effectName(*effect);
        }
        text = fmt::format("{}", fmt::join(names, ","));
        return {};
      },
      ""};
}

void addEffects(CLI::App& command, std::string& effects) {
  command.add_option("--effects", effects, "Effects to render: auto, all, or names from --list-effects, with commas")
      ->transform(effectList())
      ->capture_default_str();
}

}  // namespace malus::render
