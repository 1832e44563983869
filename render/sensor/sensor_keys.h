// The keys of a sensor file: one row per key with its range and one line for render/sensor/SENSOR.md. Keys that code
// reads (sensor_file.cpp) are rows of kSensorSpecialKeys.
#pragma once

#include "bake/pack/field.h"
#include "bake/scene_file/special_keys.h"
#include "render/sensor/sensor.h"

namespace malus::render {

inline constexpr double kMostElectrons = 1e9;

inline constexpr bake::SpecialKey kSensorSpecialKeys[] = {
    {"malus", "`1`", "required", "version of the schema"},
    {"preset", "name of a preset", "none",
     "values of all keys that the file does not have; the keys below are then optional"},
    {"pattern", "`mono` or `quad-bayer`", "required",
     "2 x 2 micro-polarizers, without or with quad Bayer colour filters"},
    {"bits", "8, 10, 12 or 16", "required", "of a digital number; 10 and 12 are stored in 16, unshifted"},
};

template <class Visitor, class... Sensors>
void visitSensorKeys(Visitor&& visit, Sensors&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "name", .text = "name of the sensor", .key = Key::optional}, s.name...);
  visit(Field{.name = "source", .text = "origin of the figures", .key = Key::optional}, s.source...);
  visit(Field{.name = "response",
              .high = 1e3,
              .text =
                  "`mono`: weights of R, G and B in the light that it measures; `quad-bayer`: sensitivity of the R, G "
                  "and B pixels, none of them 0",
              .key = Key::required},
        s.response...);
  visit(Field{.name = "transmission",
              .high = 1,
              .text = "transmittance of a micro-polarizer for light along its axis, per channel; over 0",
              .key = Key::optional,
              .shape = pack::Shape::numberOrVector},
        s.transmission...);
  visit(Field{.name = "extinctionRatio",
              .low = 1.01,
              .high = 1e9,
              .text = "transmittance along the axis over that across it, per channel",
              .key = Key::required,
              .shape = pack::Shape::numberOrVector},
        s.extinctionRatio...);
  visit(Field{.name = "fullWell",
              .low = 1,
              .high = kMostElectrons,
              .unit = "e-",
              .text = "largest charge of a pixel",
              .key = Key::required},
        s.fullWell...);
  visit(Field{.name = "readNoise",
              .high = 1e6,
              .unit = "e-",
              .text = "standard deviation of the temporal noise in darkness",
              .key = Key::required},
        s.readNoise...);
  visit(Field{.name = "darkSignal",
              .high = kMostElectrons,
              .unit = "e-",
              .text = "mean electrons per frame without light: dark current times exposure time",
              .key = Key::optional},
        s.darkSignal...);
  visit(Field{.name = "shotNoise", .text = "charges have the distribution of Poisson", .key = Key::optional},
        s.shotNoise...);
  visit(Field{.name = "blackLevel",
              .high = 65534,
              .unit = "DN",
              .text = "number of a pixel without charge",
              .key = Key::optional},
        s.blackLevel...);
  visit(Field{.name = "gain",
              .high = kMostElectrons,
              .unit = "e- per DN",
              .text = "charge of a step of one; by default the full well is the largest number",
              .key = Key::optional,
              .excludesLow = true},
        s.gain...);
  visit(Field{.name = "electronsPerRadiance",
              .high = 1e15,
              .unit = "e-",
              .text =
                  "charge by unpolarized light of radiance 1 in a pixel of response 1 without a polarizer; by default "
                  "fullWell * 2^exposure, with the exposure of the pack or of `--exposure`",
              .key = Key::optional,
              .excludesLow = true},
        s.electronsPerRadiance...);
}

}  // namespace malus::render
