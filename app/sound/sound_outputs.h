#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sound/sound_settings.h"

namespace jnd::app {

/// An output of this machine, and what is known about it.
struct KnownOutput {
  std::string name, description;
  std::optional<SoundCalibration> calibration;
  bool is_chosen = false;  ///< Sessions use it if nobody names another one.
};

/// The outputs that ALSA offers, together with the chosen one and `asked`, even if those are
/// not there. Throws `Error` if the settings cannot be read. Not real time.
[[nodiscard]] std::vector<KnownOutput> known_outputs(const SoundSettings& settings,
                                                     const std::string& asked = "");

}  // namespace jnd::app
