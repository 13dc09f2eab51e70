#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace jnd::core {

/// The kinds of pulses that tell another recorder about a session. No kind tells a level, an
/// interval or an answer, so pulses show when something happened, but never what.
enum class MarkerKind {
  kStage,         ///< A stage was entered.
  kTrial,         ///< An attempt at a trial began.
  kPresentation,  ///< The medium is about to change, whatever the new one is.
  kAnswer,        ///< A trial was answered, whatever the answer.
  kFault,         ///< The loop latched a fault.
  kEnd,           ///< The session ended, or the program left it.
};
inline constexpr std::size_t kNumMarkerKinds = 6;
/// Their names in study files.
inline constexpr std::array<std::string_view, kNumMarkerKinds> kMarkerNames = {
    "stage", "trial", "presentation", "answer", "fault", "end"};

/// The code of each kind, 1 to 255; 0 means no pulse. Unless the study says otherwise, each
/// code is one bit, so that a recorder with a line for each bit can tell them apart.
struct MarkerCodes {
  std::array<int, kNumMarkerKinds> codes{1, 2, 4, 8, 16, 32};

  [[nodiscard]] int of(MarkerKind kind) const noexcept {
    return codes[static_cast<std::size_t>(kind)];
  }
};

/// A pulse that was written to a port.
struct MarkerPulse {
  std::int64_t event = 0;  ///< Sequence number of the event that it reports; 0 for the end.
  int code = 0;
  /// Time by CLOCK_MONOTONIC when the writing began. The code had left this program
  /// `uncertainty_s` later, so the pulse began in between.
  double monotonic_s = 0.0, uncertainty_s = 0.0;
};

}  // namespace jnd::core
