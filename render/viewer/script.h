// The script of `malus view --script`: a camera path and changes of the view, by frame. VIEW.md describes the format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/viewer/view_state.h"

namespace malus::viewer {

struct ScriptLine {
  std::uint32_t first = 0, last = 0;  // frames, inclusive
  std::vector<std::string> words;     // command and arguments
  std::string where;                  // FILE:LINE
};

// Actions that are not changes of the view.
enum class ScriptAction { none, wait, waitReference, save, command };

// Throws Error: a line that is not FRAME[-FRAME] COMMAND ARGUMENTS, an unknown command.
std::vector<ScriptLine> readScript(const std::string& file);
std::vector<ScriptLine> parseScript(const std::string& text, const std::string& name);

// Applies the line to the view once. needed: effects of the scene. Throws Error for wrong arguments.
ScriptAction applyLine(const ScriptLine& line, ViewState& state, const std::vector<pack::Effect>& needed);

// Applies every line to a copy of the view, so that a wrong one is found before the first image. Throws Error as
// applyLine(), and for a file to save with another extension than .exr and .png or in no folder.
void checkScript(const std::vector<ScriptLine>& lines, ViewState state, const std::vector<pack::Effect>& needed);

}  // namespace malus::viewer
