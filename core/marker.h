#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace jnd::core {

/// What another recorder is told of by a pulse. There is none for a level, an interval or an
/// answer: whoever sees the pulses of a session learns when something happened, never what.
enum class MarkerKind {
  kStage,         ///< A stage was entered.
  kTrial,         ///< An attempt at a trial began.
  kPresentation,  ///< The medium is about to be switched, to whatever it is.
  kAnswer,        ///< A trial was answered, however.
  kFault,         ///< The loop latched a fault.
  kEnd,           ///< The session ended, or its program left it.
};
inline constexpr std::size_t kNumMarkerKinds = 6;
/// As studies name them.
inline constexpr std::array<std::string_view, kNumMarkerKinds> kMarkerNames = {
    "stage", "trial", "presentation", "answer", "fault", "end"};

/// The code of each kind, 1 to 255; 0: it has no pulse. A bit each unless the study says
/// otherwise, so that a recorder with a line for each bit tells them apart as well.
struct MarkerCodes {
  std::array<int, kNumMarkerKinds> codes{1, 2, 4, 8, 16, 32};

  [[nodiscard]] int of(MarkerKind kind) const noexcept {
    return codes[static_cast<std::size_t>(kind)];
  }
};

/// A pulse that was written to a port.
struct MarkerPulse {
  std::int64_t event = 0;  ///< Sequence of the event that it tells of; 0: of the end.
  int code = 0;
  /// Of CLOCK_MONOTONIC when writing it began. It had left this program `uncertainty_s` later:
  /// the pulse began in between.
  double monotonic_s = 0.0, uncertainty_s = 0.0;
};

}  // namespace jnd::core
