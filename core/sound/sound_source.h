#pragma once

#include <cstdint>
#include <span>

namespace jnd::core {

/// What an output plays, through one channel that all of its channels repeat.
class SoundSource {
 public:
  virtual ~SoundSource() = default;
  /// Fills the samples, each in [-1, 1]. `heard_ns`: of the monotonic clock, when the first of
  /// them will be heard, as far as the output knows. Called by one thread. Real time.
  virtual void render(std::span<float> samples, std::int64_t heard_ns) noexcept = 0;
};

}  // namespace jnd::core
