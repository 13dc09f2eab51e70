#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sound/sound_settings.h"
#include "core/sound/sound_mixer.h"
#include "device/sound/sound_output.h"
#include "experiments/study/sound.h"

namespace jnd::app {

/// Noise and cues for a person who sets levels, without any session. The level rises from
/// silence over three seconds, so that nobody is startled by one that is too high, and it is
/// never higher than a study may ask for. Used by one thread; not real time.
class TriedSound {
 public:
  struct Parameters {
    std::string output;
    std::optional<SoundCalibration> calibration;  ///< The calibration of the output.
    experiments::Sound sound;
    device::OpenSoundOutput open{};  ///< If empty, ALSA opens the output.
  };
  static constexpr double kRise_s = 3.0;
  static constexpr double kFall_s = 0.3;

  /// Begins to play. Throws `Error` for a level that is not possible, and for an output that
  /// cannot be opened.
  explicit TriedSound(const Parameters& parameters);
  TriedSound(const TriedSound&) = delete;
  TriedSound& operator=(const TriedSound&) = delete;

  /// Plays the next of the sound's cues, in turn. Does nothing if there is none.
  void give_next_cue();
  /// Begins to fade out.
  void end();
  /// True if it was ended and has faded out.
  [[nodiscard]] bool is_over() const;

  /// The level of the noise; none if there is no noise.
  [[nodiscard]] std::optional<double> noise_level_dbfs() const noexcept { return level_dbfs_; }
  [[nodiscard]] std::string words() const { return output_->words(); }
  [[nodiscard]] device::SoundOutputState state() const { return output_->state(); }
  [[nodiscard]] std::int64_t num_frames() const noexcept { return mixer_->num_frames(); }
  [[nodiscard]] std::int64_t num_limited() const noexcept { return mixer_->num_limited(); }

 private:
  std::optional<double> level_dbfs_;
  std::size_t num_cues_ = 0;
  std::uint64_t num_given_ = 0;
  std::unique_ptr<core::SoundMixer> mixer_;
  /// Declared after the mixer, because it plays the mixer.
  std::unique_ptr<device::SoundOutput> output_;
  std::optional<std::chrono::steady_clock::time_point> over_at_;
};

}  // namespace jnd::app
