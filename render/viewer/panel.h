// The panel of the viewer, by Dear ImGui. Each function draws one group and changes the state that it shows.
#pragma once

#include "render/viewer/session.h"
#include "render/viewer/ui_state.h"

namespace malus::viewer {

inline constexpr float kPanelWidth = 300;  // at scale 1, if the window is as wide [pixels]

// Draws the panel, the labels of the sides, the divider and the legend for a window of the session's size.
void drawPanel(Session& session, UiState& ui, const Published& published, const BackgroundState& background);

// The groups of the panel.
void drawMethods(Session& session, UiState& ui, const Published& published);
void drawFilter(ViewState& state, UiState& ui);
void drawShown(Session& session, UiState& ui);
void drawEffects(Session& session, UiState& ui);
void drawTimes(const UiState& ui, const Published& published);
void drawProbe(const Session& session, const UiState& ui, const Published& published,
               const BackgroundState& background);
void drawFiles(Session& session, UiState& ui);

// A dial for an angle in degrees that turns by dragging; a half turn is the whole range, because 0 and 180 degrees are
// the same polarizer. Returns whether the angle has changed.
bool drawDial(const char* name, double& degrees, double radius);

// Drawn over the image: legend of the quantity, divider and labels of the sides.
void drawLegend(const Session& session, const UiState& ui, const BackgroundState& background);
void drawSides(const Session& session, const UiState& ui, const Published& published,
               const BackgroundState& background);

}  // namespace malus::viewer
