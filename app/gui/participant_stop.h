#pragma once

#include <optional>
#include <string_view>

#include "app/gui/input_queue.h"

namespace jnd::app::gui {

/// A stop in the participant's other hand or under a foot: a key, or a pedal or button that
/// counts as one. Pressed it stops, or, where the laboratory wants it, force is there only as
/// long as it is held: a dead-man switch. A window that loses the focus lets go of it; where
/// another program takes the keyboard for itself, as screen lockers do, nothing of it is seen.
class ParticipantStop {
 public:
  enum class Way {
    kPress,  ///< Pressing it is the emergency stop.
    kHold,   ///< Letting it go is.
  };

  /// None: there is no such key.
  ParticipantStop(std::optional<Key> key, Way way) noexcept : key_(key), way_(way) {}

  /// The key "F10", "F11" or "F12", which mean nothing else; none for any other word.
  [[nodiscard]] static std::optional<Key> key_named(std::string_view name) noexcept;

  /// Returns whether the emergency stop is to be pressed. The window's thread, at once.
  [[nodiscard]] bool key_changed(Key key, bool is_down) noexcept;
  /// Nobody holds what has to be held: there may be no force.
  [[nodiscard]] bool is_let_go() const noexcept {
    return key_ && way_ == Way::kHold && !is_down_;
  }

 private:
  std::optional<Key> key_;
  Way way_;
  bool is_down_ = false;
};

}  // namespace jnd::app::gui
