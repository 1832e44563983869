#include "render/viewer/script.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/error.h"
#include "meshprep/number_option.h"
#include "render/scene/methods.h"
#include "render/viewer/fly_camera.h"
#include "render/viewer/orbit_camera.h"

namespace malus::viewer {

namespace {

// The arguments of a line, read in order.
class Arguments {
 public:
  explicit Arguments(const ScriptLine& line) : line_(line) {}

  std::string text() {
    if (next_ >= line_.words.size()) fail("an argument is missing", "more arguments");
    return line_.words[next_++];
  }
  double number() {
    const std::string word = text();
    const std::optional<double> value = parseNumber(word);
    if (!value) fail(fmt::format("'{}' is not a number", word), "a number");
    return *value;
  }
  std::uint32_t count(std::uint32_t least, std::uint32_t most) {
    const double value = number();
    if (value < least || value > most || value != static_cast<std::uint32_t>(value))
      fail(fmt::format("{} is out of range", value), fmt::format("{} to {}", least, most));
    return static_cast<std::uint32_t>(value);
  }
  bool isEnd() const { return next_ >= line_.words.size(); }
  void finish() const {
    if (!isEnd()) fail(fmt::format("unexpected argument '{}'", line_.words[next_]), "fewer arguments");
  }
  [[noreturn]] void fail(const std::string& problem, const std::string& expected) const {
    throw Error(line_.where, fmt::format("{}: {}", line_.words.front(), problem), expected);
  }

 private:
  const ScriptLine& line_;
  std::size_t next_ = 1;
};

struct Target {
  ViewState& state;
  const std::vector<pack::Effect>& needed;
};
using Apply = std::function<void(Arguments&, Target&)>;

// Side A, or B if the next argument is "b".
SideSettings& side(Arguments& a, Target& t, std::string& first) {
  first = a.text();
  if (first != "a" && first != "b") return t.state.sides[0];
  const std::size_t index = first == "b" ? 1 : 0;
  first = a.text();
  return t.state.sides[index];
}

void setMethod(Arguments& a, Target& t) {
  std::string name;
  SideSettings& s = side(a, t, name);
  s.method = render::methodNamed(name).name;
}
void setBackend(Arguments& a, Target& t) {
  std::string name;
  SideSettings& s = side(a, t, name);
  s.backend = render::backendNamed(name);
}
void setEffects(Arguments& a, Target& t) {
  std::string option;
  SideSettings& s = side(a, t, option);
  s.effects = effectSwitches(option, t.needed);
}

void setSplit(Arguments& a, Target& t) {
  const std::string word = a.text();
  t.state.isSplit = word != "off";
  if (!t.state.isSplit) return;
  const std::optional<double> at = parseNumber(word);
  if (!at || *at < 0 || *at > 1) a.fail("expected a share of the width or off", "0 to 1, or off");
  t.state.divider = *at;
}

void setPolarizer(Arguments& a, Target& t) {
  const std::string word = a.text();
  t.state.filter.kind = word == "off" ? FilterKind::none : FilterKind::linear;
  if (word == "off") return;
  const std::optional<double> degrees = parseNumber(word);
  if (!degrees) a.fail(fmt::format("'{}' is not an angle", word), "degrees, or off");
  t.state.filter.polarizerDegrees = *degrees;
}
void setAnalyser(Arguments& a, Target& t) {
  const std::string word = a.text();
  if (word != "right" && word != "left" && word != "off") a.fail("unknown analyser", "right, left or off");
  t.state.filter.kind = word == "right" ? FilterKind::right : word == "left" ? FilterKind::left : FilterKind::none;
}
void setWavePlate(Arguments& a, Target& t) {
  const std::string word = a.text();
  t.state.filter.hasPlate = word != "off";
  if (word == "off") return;
  const std::optional<double> axis = parseNumber(word);
  if (!axis) a.fail(fmt::format("'{}' is not an angle", word), "AXIS [RETARDANCE] in degrees, or off");
  t.state.filter.plate = {*axis, a.isEnd() ? render::WavePlate{}.retardanceDegrees : a.number()};
}

void setShown(Arguments& a, Target& t) {
  const std::string name = a.text();
  const std::optional<Quantity> quantity = quantityNamed(name);
  if (!quantity) a.fail(fmt::format("unknown quantity '{}'", name), fmt::format("{}", fmt::join(kQuantityNames, ", ")));
  t.state.shown = *quantity;
}
void setAgainst(Arguments& a, Target& t) {
  const std::string word = a.text();
  if (word != "reference" && word != "other") a.fail("unknown image to compare with", "reference or other");
  t.state.against = word == "other" ? Against::otherSide : Against::reference;
}
void setReference(Arguments& a, Target& t) {
  const std::string word = a.text();
  if (word != "on" && word != "off") a.fail("unknown value", "on or off");
  t.state.usesReference = word == "on";
}

const std::map<std::string, Apply>& commands() {
  static const std::map<std::string, Apply> kCommands = {
      {"orbit",
       [](Arguments& a, Target& t) {
         const double yaw = a.number();
         orbit(t.state.camera, t.state.pivot, yaw, a.number());
       }},
      {"pan",
       [](Arguments& a, Target& t) {
         const double right = a.number();
         pan(t.state.camera, t.state.pivot, right, a.number());
       }},
      {"zoom",
       [](Arguments& a, Target& t) {
         const double factor = a.number();
         if (!(factor > 0)) a.fail("is not positive", "a factor over 0");
         zoom(t.state.camera, t.state.pivot, factor);
       }},
      {"fly",
       [](Arguments& a, Target& t) {
         const double forward = a.number(), right = a.number();
         fly(t.state.camera, forward, right, a.number());
       }},
      {"look",
       [](Arguments& a, Target& t) {
         const double yaw = a.number();
         look(t.state.camera, yaw, a.number());
       }},
      {"method", setMethod},
      {"backend", setBackend},
      {"effects", setEffects},
      {"split", setSplit},
      {"polarizer", setPolarizer},
      {"turn",
       [](Arguments& a, Target& t) {
         t.state.filter.kind = FilterKind::linear;
         t.state.filter.polarizerDegrees += a.number();
       }},
      {"analyser", setAnalyser},
      {"wave-plate", setWavePlate},
      {"show", setShown},
      {"against", setAgainst},
      {"reference", setReference},
      {"exposure", [](Arguments& a, Target& t) { t.state.exposureEv = a.number(); }},
      {"difference-scale", [](Arguments& a, Target& t) { t.state.differenceScale = a.number(); }},
      {"depth", [](Arguments& a, Target& t) { t.state.depth = a.count(0, pack::kMaxDepth); }},
      {"samples", [](Arguments& a, Target& t) { t.state.samples = a.count(1, 64); }},
  };
  return kCommands;
}

const std::map<std::string, ScriptAction> kActions = {{"wait", ScriptAction::wait},
                                                      {"wait-reference", ScriptAction::waitReference},
                                                      {"save", ScriptAction::save},
                                                      {"command", ScriptAction::command}};

// FRAME or FIRST-LAST.
bool readFrames(const std::string& word, ScriptLine& line) {
  const std::size_t dash = word.find('-');
  const std::optional<std::int64_t> first = parseWholeNumber(word.substr(0, dash));
  const std::optional<std::int64_t> last = dash == std::string::npos ? first : parseWholeNumber(word.substr(dash + 1));
  constexpr std::int64_t kMost = 1000000;
  if (!first || !last || *first < 0 || *last < *first || *last > kMost) return false;
  line.first = static_cast<std::uint32_t>(*first);
  line.last = static_cast<std::uint32_t>(*last);
  return true;
}

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const auto& [name, apply] : commands()) names.push_back(name);
  for (const auto& [name, action] : kActions) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<ScriptLine> parseScript(const std::string& text, const std::string& name) {
  std::vector<ScriptLine> lines;
  std::istringstream in(text);
  int number = 0;
  for (std::string row; std::getline(in, row);) {
    ScriptLine line;
    line.where = fmt::format("{}:{}", name, ++number);
    std::istringstream words(row.substr(0, row.find('#')));
    std::string frames;
    if (!(words >> frames)) continue;
    if (!readFrames(frames, line)) throw Error(line.where, "is not a frame", "FRAME or FIRST-LAST", frames);
    for (std::string word; words >> word;) line.words.push_back(word);
    if (line.words.empty()) throw Error(line.where, "has no command", "FRAME COMMAND ARGUMENTS");
    const std::string& command = line.words.front();
    if (!commands().contains(command) && !kActions.contains(command))
      throw Error(line.where, fmt::format("unknown command '{}'", command),
                  fmt::format("one of {}", fmt::join(commandNames(), ", ")));
    lines.push_back(line);
  }
  return lines;
}

std::vector<ScriptLine> readScript(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw Error(file, "cannot open", "a script of `malus view` (render/viewer/VIEW.md)");
  std::ostringstream text;
  text << in.rdbuf();
  return parseScript(text.str(), file);
}

ScriptAction applyLine(const ScriptLine& line, ViewState& state, const std::vector<pack::Effect>& needed) {
  Arguments arguments(line);
  if (const auto action = kActions.find(line.words.front()); action != kActions.end()) {
    if (action->second == ScriptAction::save || action->second == ScriptAction::command) arguments.text();
    arguments.finish();
    return action->second;
  }
  Target target{state, needed};
  try {
    commands().at(line.words.front())(arguments, target);
  } catch (const Error& error) {
    const std::string text = error.what();
    if (text.starts_with(line.where)) throw;
    throw Error(line.where, text);
  }
  arguments.finish();
  return ScriptAction::none;
}

void checkScript(const std::vector<ScriptLine>& lines, ViewState state, const std::vector<pack::Effect>& needed) {
  for (const ScriptLine& line : lines) {
    if (applyLine(line, state, needed) != ScriptAction::save) continue;
    const std::filesystem::path file = line.words[1];
    const std::string extension = file.extension().string();
    if (extension != ".exr" && extension != ".png")
      throw Error(line.where, fmt::format("'{}' has an unknown image format", file.string()), ".exr or .png");
    std::error_code ignored;
    if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), ignored))
      throw Error(line.where, fmt::format("'{}' is not a folder", file.parent_path().string()), "an existing folder");
  }
}

}  // namespace malus::viewer
