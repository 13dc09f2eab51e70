#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/exchange/spsc_queue.h"
#include "core/sound/noise.h"
#include "core/sound/sound_limiter.h"
#include "core/sound/sound_source.h"
#include "core/sound/tone.h"

namespace jnd::core {

/// A noise with its level.
struct LevelledNoise {
  NoiseShape shape;
  double level_dbfs = -60.0;  ///< At most `kLoudestNoise_dbfs`.
};

/// A cue that was heard.
struct HeardCue {
  std::uint64_t id = 0;       ///< The id that was passed to `play_cue`.
  std::int64_t asked_ns = 0;  ///< By the monotonic clock.
  std::int64_t heard_ns = 0;  ///< Time when its first sample is heard, according to the output.
};

/// All that a participant hears in a session, as one endless stream: noise, which stops only by
/// a ramp, and cues over it. Sounds are computed in advance or take the same time for every
/// sample. Another thread requests them through a lock-free queue. A noise comes and goes by a
/// quarter of a sine, so that the total power stays the same when one noise replaces another.
/// The limiter comes last.
class SoundMixer final : public SoundSource {
 public:
  struct Parameters {
    double rate_hz = 48000.0;
    std::uint64_t seed = 0;
    std::vector<LevelledNoise> noises;  ///< At most `kMostNoises`.
    std::vector<Tone> cues;
    /// Delay from the request of a cue until it is heard, >= 0. It is the longest time that the
    /// output's buffer takes, so that every cue has the same delay.
    double cue_delay_s = 0.0;
  };
  static constexpr std::size_t kMostNoises = 64;
  static constexpr int kNoNoise = -1;

  /// The mixer begins silent. Throws `Error` for what is out of range. Not real time.
  explicit SoundMixer(const Parameters& parameters);

  // For the thread that requests sounds. Real time.

  /// Changes to this noise, or to none, within `ramp_s`; the noise before fades out in the same
  /// time. A ramp of 0 changes at once. Returns false if the queue is full.
  bool play_noise(int noise, double ramp_s) noexcept;
  /// Returns false if the queue is full.
  bool play_cue(std::size_t cue, std::uint64_t id, std::int64_t asked_ns) noexcept;
  /// Takes the next cue that was heard, in order. Returns false if there is none.
  bool next_heard(HeardCue& heard) noexcept { return heard_.try_pop(heard); }

  // For any thread. Real time.

  [[nodiscard]] std::int64_t num_frames() const noexcept {
    return num_frames_.load(std::memory_order_relaxed);
  }
  /// Returns the number of samples that the limiter turned down.
  [[nodiscard]] std::int64_t num_limited() const noexcept {
    return num_limited_.load(std::memory_order_relaxed);
  }

  // For the output's thread. Real time.

  void render(std::span<float> samples, std::int64_t heard_ns) noexcept override;

 private:
  struct Request {
    enum class Kind { kNoise, kCue } kind = Kind::kNoise;
    int noise = kNoNoise;
    double ramp_s = 0.0;
    std::size_t cue = 0;
    std::uint64_t id = 0;
    std::int64_t asked_ns = 0;
  };

  /// A noise and the state of its ramp.
  struct Voice {
    Voice(const LevelledNoise& levelled, double rate_hz, std::uint64_t seed);
    [[nodiscard]] double next() noexcept;
    [[nodiscard]] bool is_heard() const noexcept { return place > 0.0 || step > 0.0; }

    Noise noise;
    double rms;          ///< Root mean square at full level.
    double place = 0.0;  ///< State of the ramp: 0 is silent, 1 is full level.
    double step = 0.0;   ///< Change of `place` in every sample.
  };

  /// A cue that sounds or is about to.
  struct Sounding {
    const std::vector<float>* samples = nullptr;  ///< nullptr means none.
    std::size_t next = 0, wait = 0;               ///< In samples.
  };
  static constexpr std::size_t kMostSounding = 8;

  void take_requests(std::int64_t heard_ns) noexcept;
  void turn_to(int noise, double ramp_s) noexcept;
  bool begin_cue(const Request& request, std::int64_t heard_ns) noexcept;
  [[nodiscard]] double cues_now() noexcept;

  double rate_hz_;
  std::int64_t cue_delay_ns_;
  std::vector<Voice> voices_;
  std::vector<std::vector<float>> cues_;
  std::array<Sounding, kMostSounding> sounding_{};
  SoundLimiter limiter_;
  SpscQueue<Request> requests_{64};
  SpscQueue<HeardCue> heard_{1024};
  std::atomic<std::int64_t> num_frames_{0}, num_limited_{0};
};

}  // namespace jnd::core
