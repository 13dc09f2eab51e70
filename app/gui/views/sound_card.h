#pragma once

#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/preflight.h"

namespace jnd::app::gui {

/// What stands before a session of what its participant will hear.
struct SoundModel {
  bool is_wanted = false;  ///< The study has sound.
  struct Output {
    std::string name, description;
    bool is_calibrated = false;
  };
  std::vector<Output> outputs;      ///< Without "off".
  std::vector<std::string> levels;  ///< "Pink noise, 65 dB SPL, -36.5 dB re full scale."
  std::string problem;  ///< Why it cannot be heard from the chosen output; "" if it can.
  bool is_required = false;
  bool is_tested = false;  ///< A test plays.
};

struct SoundCardResult {
  bool output_changed = false;
  bool test = false;  ///< Play, or end what plays.
};

/// Outputs to choose from and "off", how loud it will be, and a test. Nothing where the study
/// has no sound. Takes what it needs off the top of `inside`.
[[nodiscard]] SoundCardResult draw_sound_card(Ui& ui, Rect& inside, const SoundModel& model,
                                              std::string& output);

/// The same as one of the lines that tell whether everything is ready.
[[nodiscard]] PreflightLine sound_line(const SoundModel& model, const std::string& output);

/// Why no session of the study begins, as far as sound is concerned; "" if one may.
[[nodiscard]] std::string sound_obstacle(const SoundModel& model);

}  // namespace jnd::app::gui
