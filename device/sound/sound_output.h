#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/sound/sound_source.h"

namespace jnd::device {

/// The state of an output, as far as it knows.
struct SoundOutputState {
  std::int64_t num_underruns = 0;  ///< Gaps: the output had nothing left to play.
  /// The longest time so far from a sample's computation until it is heard, based on the
  /// buffers that the library reports.
  double max_latency_s = 0.0;
  bool realtime_scheduler = false;  ///< Its thread has SCHED_FIFO.
  std::string scheduler;            ///< Of its thread: "SCHED_FIFO 20"; "" before it runs.
  /// A sentence that says why it plays no more; "" while it plays.
  std::string problem;
};

/// An output of sound. A thread of the output's own asks a source for samples. Neither the
/// haptic loop nor anything for which it waits does this work.
class SoundOutput {
 public:
  virtual ~SoundOutput() = default;  ///< Stops the output.
  [[nodiscard]] virtual double rate_hz() const noexcept = 0;
  /// Returns the longest time that a sample may wait between its computation and its being
  /// heard: the whole buffer and one period.
  [[nodiscard]] virtual double longest_latency_s() const noexcept = 0;
  /// Returns words that are stored: "ALSA 1.2.8, default, 48000 Hz, 2 channels, S32_LE".
  [[nodiscard]] virtual std::string words() const = 0;
  /// Plays from now on. The source must outlive the output, or `stop`. Call it once. Throws
  /// `Error`.
  virtual void start(core::SoundSource& source) = 0;
  /// When it returns, the output no longer uses the source. Not real time.
  virtual void stop() noexcept = 0;
  [[nodiscard]] virtual SoundOutputState state() const = 0;
};

/// A function that opens an output by its name. Throws `Error`.
using OpenSoundOutput = std::function<std::unique_ptr<SoundOutput>(const std::string& name)>;

/// An output that can be chosen.
struct SoundOutputEntry {
  std::string name;         ///< "default", "plughw:CARD=PCH,DEV=0"
  std::string description;  ///< One line from the system; may be empty.
};

}  // namespace jnd::device
