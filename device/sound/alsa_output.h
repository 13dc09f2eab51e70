#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/sound/sound_output.h"

namespace jnd::device {

/// Opens an output of ALSA by its ALSA name: a card, or a sound server (PipeWire, PulseAudio)
/// behind `default`. Its thread asks for SCHED_FIFO below the haptic loop's priority, and
/// continues without it. Throws `Error` naming the output if it cannot be opened. Not real
/// time.
[[nodiscard]] std::unique_ptr<SoundOutput> open_alsa_output(const std::string& name);

/// Returns the outputs that ALSA offers, `default` first. Not real time.
[[nodiscard]] std::vector<SoundOutputEntry> alsa_outputs();

}  // namespace jnd::device
