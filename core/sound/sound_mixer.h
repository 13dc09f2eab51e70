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

/// A noise as it is to be heard.
struct LevelledNoise {
  NoiseShape shape;
  double level_dbfs = -60.0;  ///< At most `kLoudestNoise_dbfs`.
};

/// A cue that was heard, or that came too late or too many at once.
struct HeardCue {
  std::uint64_t id = 0;       ///< As it was asked for.
  std::int64_t asked_ns = 0;  ///< Monotonic clock.
  std::int64_t heard_ns = 0;  ///< When its first sample is heard, as the output says.
};

/// All that a session lets a participant hear, as one endless stream: noise that never stops
/// but by its ramp, and cues over it. What can be heard is computed ahead or takes the same
/// time for every sample; another thread asks for it through a queue without a lock. A noise
/// comes and goes by a quarter of a sine, so that where one takes the place of another the
/// power of both together stays the same. The limiter is last.
class SoundMixer final : public SoundSource {
 public:
  struct Parameters {
    double rate_hz = 48000.0;
    std::uint64_t seed = 0;
    std::vector<LevelledNoise> noises;  ///< At most `kMostNoises`.
    std::vector<Tone> cues;
    /// From when a cue is asked for until it is heard, >= 0: as long as the output's buffer
    /// takes at most, so that every cue takes as long.
    double cue_delay_s = 0.0;
  };
  static constexpr std::size_t kMostNoises = 64;
  static constexpr int kNoNoise = -1;

  /// Silent. Throws `Error` for what is out of range. Not real time.
  explicit SoundMixer(const Parameters& parameters);

  // The thread that asks. Real time.

  /// This noise, or none, within `ramp_s` > 0; what was heard before goes in the same time.
  /// False where the queue is full.
  bool play_noise(int noise, double ramp_s) noexcept;
  /// False where the queue is full.
  bool play_cue(std::size_t cue, std::uint64_t id, std::int64_t asked_ns) noexcept;
  /// The next cue that was heard, in their order; false where there is none.
  bool next_heard(HeardCue& heard) noexcept { return heard_.try_pop(heard); }

  // Any thread. Real time.

  [[nodiscard]] std::int64_t num_frames() const noexcept {
    return num_frames_.load(std::memory_order_relaxed);
  }
  /// Samples that the limiter turned down.
  [[nodiscard]] std::int64_t num_limited() const noexcept {
    return num_limited_.load(std::memory_order_relaxed);
  }

  // The output's thread. Real time.

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

  /// A noise and how far up it is.
  struct Voice {
    Voice(const LevelledNoise& levelled, double rate_hz, std::uint64_t seed);
    [[nodiscard]] double next() noexcept;
    [[nodiscard]] bool is_heard() const noexcept { return place > 0.0 || step > 0.0; }

    Noise noise;
    double rms;          ///< When it is all there.
    double place = 0.0;  ///< 0: silent, 1: all there.
    double step = 0.0;   ///< Of the place, for every sample.
  };

  /// A cue under way, or about to be.
  struct Sounding {
    const std::vector<float>* samples = nullptr;  ///< nullptr: none.
    std::size_t next = 0, wait = 0;               ///< Samples.
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
