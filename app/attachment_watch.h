#pragma once

#include <cstdint>
#include <string>

namespace jnd::app {

/// Which points have to hold the hand: those that did when something began to be felt. Bits as
/// in `core::Sample::attached_bits`.
class AttachmentWatch {
 public:
  /// Something begins to be felt with these points on the hand.
  void begin(std::uint8_t attached_bits) noexcept {
    held_bits_ = static_cast<std::uint8_t>(held_bits_ | attached_bits);
  }
  /// The points that held and do not any more.
  [[nodiscard]] std::uint8_t loose_bits(std::uint8_t attached_bits) const noexcept {
    return static_cast<std::uint8_t>(held_bits_ & ~attached_bits);
  }

 private:
  std::uint8_t held_bits_ = 0;
};

/// "the index finger", "the inner palm and the thumb": for people. "" for no bits.
[[nodiscard]] std::string words_of_points(std::uint8_t bits);
/// "came off: index, thumb": as events say why a session paused.
[[nodiscard]] std::string came_off_reason(std::uint8_t bits);

}  // namespace jnd::app
