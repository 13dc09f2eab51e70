#pragma once

#include <cstdint>
#include <span>

namespace jnd::core {

/// A source of the sound that an output plays. It has one channel, which all channels of the
/// output repeat.
class SoundSource {
 public:
  virtual ~SoundSource() = default;
  /// Fills the samples, each in [-1, 1]. `heard_ns` is when the first of them will be heard by
  /// the monotonic clock, as far as the output knows. One thread calls it. Real time.
  virtual void render(std::span<float> samples, std::int64_t heard_ns) noexcept = 0;
};

}  // namespace jnd::core
