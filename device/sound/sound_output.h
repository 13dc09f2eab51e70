#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/sound/sound_source.h"

namespace jnd::device {

/// What an output does, as far as it knows by now.
struct SoundOutputState {
  std::int64_t num_underruns = 0;  ///< Gaps: it had nothing left to play.
  /// From a sample's computation to its being heard, the longest so far, as the library tells
  /// it: what lies in buffers that it knows of.
  double max_latency_s = 0.0;
  bool realtime_scheduler = false;  ///< SCHED_FIFO was given to its thread.
  std::string scheduler;            ///< Of its thread: "SCHED_FIFO 20"; "" before it runs.
  std::string problem;              ///< A sentence: it plays no more. "" while it does.
};

/// Where sound goes to. A source is asked for samples by a thread of the output's own, whose
/// work it is alone: neither the haptic loop nor anything that it waits for.
class SoundOutput {
 public:
  virtual ~SoundOutput() = default;  ///< Stops.
  [[nodiscard]] virtual double rate_hz() const noexcept = 0;
  /// The longest that a sample may wait between its computation and its being heard: all that
  /// the buffer holds and one period.
  [[nodiscard]] virtual double longest_latency_s() const noexcept = 0;
  /// In words, for keeping: "ALSA 1.2.8, default, 48000 Hz, 2 channels, S32_LE".
  [[nodiscard]] virtual std::string words() const = 0;
  /// Plays from now on. The source must outlive the output, or `stop`. Once. Throws `Error`.
  virtual void start(core::SoundSource& source) = 0;
  /// Asks the source for nothing any more when it returns. Not real time.
  virtual void stop() noexcept = 0;
  [[nodiscard]] virtual SoundOutputState state() const = 0;
};

/// A way to open an output by its name. Throws `Error`.
using OpenSoundOutput = std::function<std::unique_ptr<SoundOutput>(const std::string& name)>;

/// An output that can be chosen.
struct SoundOutputEntry {
  std::string name;         ///< "default", "plughw:CARD=PCH,DEV=0"
  std::string description;  ///< In one line, as the system has it; may be empty.
};

}  // namespace jnd::device
