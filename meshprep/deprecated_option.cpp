#include "meshprep/deprecated_option.h"

#include <vector>

#include <fmt/format.h>

#include "meshprep/base/console.h"

namespace malus {

namespace {
// Passes a value on to the current option, with its checks. CLI11's own exclusion would see the value passed on.
void forward(CLI::Option* option, const std::string& former, const std::string& name, const std::string& value) {
  if (option->count() > 0) throw CLI::ExcludesError(former, name);
  console::note(fmt::format("option {} is deprecated; use {}", former, name));
  option->add_result(value);
  option->run_callback();
}
}  // namespace

void addFormerOption(CLI::App& app, const std::string& former, const std::string& name) {
  CLI::Option* const option = app.get_option(name);
  app.add_option_function<std::string>(former, [=](const std::string& value) { forward(option, former, name, value); })
      ->group("");
}

void addFormerFlag(CLI::App& app, const std::string& former, const std::string& name) {
  CLI::Option* const option = app.get_option(name);
  app.add_flag_callback(former, [=] { forward(option, former, name, "true"); })->group("");
}

void addRemovedOption(CLI::App& app, const std::string& former, const std::string& name) {
  const auto refuse = [former, name](const std::vector<std::string>&) {
    throw CLI::ValidationError(
        former, fmt::format("was removed, because another command has it with another meaning; use {}", name));
  };
  app.add_option_function<std::vector<std::string>>(former, refuse)->expected(0, 1)->group("");
}

}  // namespace malus
