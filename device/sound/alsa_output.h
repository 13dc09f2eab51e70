#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/sound/sound_output.h"

namespace jnd::device {

/// An output of ALSA, by its name there: a card, or a sound server (PipeWire, PulseAudio)
/// behind `default`. Its thread asks for SCHED_FIFO below the haptic loop's priority, and goes
/// on without. Throws `Error` naming the output where it cannot be opened. Not real time.
[[nodiscard]] std::unique_ptr<SoundOutput> open_alsa_output(const std::string& name);

/// The outputs that ALSA offers, `default` first. Not real time.
[[nodiscard]] std::vector<SoundOutputEntry> alsa_outputs();

}  // namespace jnd::device
