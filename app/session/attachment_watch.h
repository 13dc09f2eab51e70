#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/exchange/telemetry.h"

namespace jnd::app {

/// Watches which points have to hold the hand: those that did when something began to be felt,
/// until somebody gives them up. Bits are as in `core::Sample::attached_bits`.
class AttachmentWatch {
 public:
  /// Something begins to be felt, with the points that hold now.
  void begin(const core::Telemetry& now) noexcept;
  /// The points that held and do not hold now.
  [[nodiscard]] std::uint8_t loose_bits(const core::Telemetry& now) const noexcept;
  /// Those points, together with points that came off since `begin` and hold again.
  [[nodiscard]] std::uint8_t came_off_bits(const core::Telemetry& now) const noexcept;
  /// The points that do not hold and never did: forgotten, or left out on purpose.
  [[nodiscard]] std::uint8_t absent_bits(const core::Telemetry& now) const noexcept;
  /// Stops waiting for these points, until they hold again when something begins.
  void give_up(std::uint8_t given_up) noexcept;

 private:
  std::uint8_t held_bits_ = 0, given_up_bits_ = 0;
  /// The value at `begin`.
  decltype(core::Telemetry::num_detachments) num_detachments_{};
};

/// The points in words for people: "the index finger", "the inner palm and the thumb"; "" for
/// no bits.
[[nodiscard]] std::string words_of_points(std::uint8_t bits);
/// The names of the points, one by one.
[[nodiscard]] std::vector<std::string> names_of_points(std::uint8_t bits);
/// Why a session paused, as events say it: "came off: index, thumb".
[[nodiscard]] std::string came_off_reason(std::uint8_t bits);

}  // namespace jnd::app
