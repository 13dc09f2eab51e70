#include "app/gui/participant_stop.h"

namespace jnd::app::gui {

std::optional<Key> ParticipantStop::key_named(std::string_view name) noexcept {
  if (name == "F10") return Key::kF10;
  if (name == "F11") return Key::kF11;
  if (name == "F12") return Key::kF12;
  return std::nullopt;
}

bool ParticipantStop::key_changed(Key key, bool is_down) noexcept {
  if (!key_ || key != *key_) return false;
  is_down_ = is_down;
  return way_ == Way::kPress ? is_down : !is_down;
}

}  // namespace jnd::app::gui
