#pragma once

#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/preflight.h"

namespace jnd::app::gui {

/// What the participant of a session will hear, as the view before the session shows it.
struct SoundModel {
  bool is_wanted = false;  ///< The study has sound.
  struct Output {
    std::string name, description;
    bool is_calibrated = false;
  };
  std::vector<Output> outputs;  ///< The outputs, without "off".
  /// Levels in words, such as "Pink noise, 65 dB SPL, -36.5 dB re full scale."
  std::vector<std::string> levels;
  /// Why the sound cannot be heard from the chosen output; "" if it can.
  std::string problem;
  bool is_required = false;
  bool is_tested = false;  ///< A test sound is playing.
};

struct SoundCardResult {
  bool output_changed = false;
  bool test = false;  ///< Begins the test sound, or ends it if it is playing.
};

/// Draws the outputs to choose from and "off", how loud the sound will be, and a test. Takes
/// its room off the top of `inside`. Draws nothing if the study has no sound.
[[nodiscard]] SoundCardResult draw_sound_card(Ui& ui, Rect& inside, const SoundModel& model,
                                              std::string& output);

/// The sound as one of the lines that tell whether everything is ready.
[[nodiscard]] PreflightLine sound_line(const SoundModel& model, const std::string& output);

/// Why the sound keeps sessions of the study from beginning; "" if it does not.
[[nodiscard]] std::string sound_obstacle(const SoundModel& model);

}  // namespace jnd::app::gui
