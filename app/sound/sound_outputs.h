#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sound/sound_settings.h"

namespace jnd::app {

/// An output of this machine, and what is known of it.
struct KnownOutput {
  std::string name, description;
  std::optional<SoundCalibration> calibration;
  bool is_chosen = false;  ///< Sessions use it where nobody names one.
};

/// Those that ALSA offers, and the chosen and `asked` ones besides, whether they are there or
/// not. Throws `Error` for settings that cannot be read. Not real time.
[[nodiscard]] std::vector<KnownOutput> known_outputs(const SoundSettings& settings,
                                                     const std::string& asked = "");

}  // namespace jnd::app
