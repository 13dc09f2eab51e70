#pragma once

#include <optional>
#include <string_view>

#include "app/gui/input_queue.h"

namespace jnd::app::gui {

/// A stop in the participant's other hand or under a foot: a key, or a pedal or button that
/// counts as one. Either pressing it stops, or, if the laboratory wants a dead-man switch,
/// there is force only while it is held. When the window loses the focus, the switch counts as
/// let go. While another program takes the keyboard for itself, as screen lockers do, the
/// window sees no key.
class ParticipantStop {
 public:
  enum class Way {
    kPress,  ///< Pressing it is the emergency stop.
    kHold,   ///< Letting it go is the emergency stop.
  };

  /// Without a key there is no such stop.
  ParticipantStop(std::optional<Key> key, Way way) noexcept : key_(key), way_(way) {}

  /// The key for "F10", "F11" or "F12", which have no other meaning; none for any other word.
  [[nodiscard]] static std::optional<Key> key_named(std::string_view name) noexcept;

  /// Returns true if the emergency stop is to be pressed. The window's thread calls it at once.
  [[nodiscard]] bool key_changed(Key key, bool is_down) noexcept;
  /// True while nobody holds what has to be held; then there may be no force.
  [[nodiscard]] bool is_let_go() const noexcept {
    return key_ && way_ == Way::kHold && !is_down_;
  }

 private:
  std::optional<Key> key_;
  Way way_;
  bool is_down_ = false;
};

}  // namespace jnd::app::gui
