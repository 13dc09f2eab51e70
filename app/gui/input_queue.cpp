#include "app/gui/input_queue.h"

#include <algorithm>
#include <utility>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

bool is_press(const KeyEvent& event) { return event.action != KeyEvent::Action::kRelease; }

/// The words printed on the key; nullptr for a letter, a digit, or F and a number.
const char* key_name(Key key) {
  switch (key) {
    case Key::kNone:
      return "";
    case Key::kSpace:
      return tr_later("Space");
    case Key::kEscape:
      return tr_later("Esc");
    case Key::kEnter:
      return tr_later("Enter");
    case Key::kTab:
      return tr_later("Tab");
    case Key::kBackspace:
      return tr_later("Backspace");
    case Key::kDelete:
      return tr_later("Del");
    case Key::kLeft:
      return "←";
    case Key::kRight:
      return "→";
    case Key::kUp:
      return "↑";
    case Key::kDown:
      return "↓";
    case Key::kPageUp:
      return tr_later("Page ↑");
    case Key::kPageDown:
      return tr_later("Page ↓");
    case Key::kHome:
      return tr_later("Home");
    case Key::kEnd:
      return tr_later("End key");  // "End" alone is the word on a button.
    default:
      return nullptr;
  }
}

std::string letter_of(Key key) {
  if (key >= Key::kF1 && key <= Key::kF12) {
    return "F" + std::to_string(static_cast<int>(key) - static_cast<int>(Key::kF1) + 1);
  }
  return std::string(1, static_cast<char>(key));
}

template <typename Say>
std::string chord_words(const Chord& chord, const Say& say) {
  if (chord.key == Key::kNone) return "";
  std::string text;
  // Translators: keys, as they are printed on the keyboards of your country.
  if (chord.control) text += std::string(say(tr_later("Ctrl"))) + ' ';
  if (chord.shift) text += std::string(say(tr_later("Shift"))) + ' ';
  const char* name = key_name(chord.key);
  return text + (name == nullptr ? letter_of(chord.key) : say(name));
}

}  // namespace

std::string words(const Chord& chord) { return chord_words(chord, as_is); }

std::string printed_words(const Chord& chord) {
  return chord_words(chord, [](const char* name) { return tr(name); });
}

bool answers(const Chord& pressed, const Chord& wanted) noexcept {
  if (wanted.key == Key::kNone || pressed.key != wanted.key) return false;
  if (pressed.control != wanted.control) return false;
  if (pressed.shift == wanted.shift) return true;
  const bool shift_is_by_chance = is_printing(wanted.key) && !wanted.control && !wanted.shift;
  // On some keyboards, "+" needs Shift.
  return shift_is_by_chance || wanted.key == Key::kPlus;
}

struct InputQueue::Share {
  FrameInput input;
  bool is_writing = false;
  bool has_press = false;
  bool has_command = false;  ///< The press that was taken writes nothing.
  bool has_click = false;    ///< The mouse button went down or up.

  /// True if the key writes into a text, so that its character alone is enough.
  [[nodiscard]] bool is_letter_of_text(const KeyEvent& event) const {
    return is_writing && is_printing(event.chord.key) && !event.chord.control;
  }
  [[nodiscard]] bool has(Key key) const {
    return std::ranges::any_of(input.keys,
                               [&](const KeyEvent& taken) { return taken.chord.key == key; });
  }
};

void InputQueue::key(const KeyEvent& event) {
  const Key key = event.chord.key;
  if (key == Key::kNone) return;
  const auto held = std::ranges::find(held_, key);
  if (is_press(event)) {
    if (presses_ >= kMostPresses) return;
    if (held == held_.end()) held_.push_back(key);
  } else {
    // The key was pressed in another window, or counted as released when the window lost the
    // keyboard.
    if (held == held_.end()) return;
    held_.erase(held);
  }
  if (event.action == KeyEvent::Action::kRepeat) {
    const bool one_waits = std::ranges::any_of(events_, [&](const Entry& entry) {
      return entry.kind == Entry::Kind::kKey && entry.key.chord.key == key &&
             entry.key.action == KeyEvent::Action::kRepeat;
    });
    if (one_waits) return;
  }
  if (is_press(event)) ++presses_;
  events_.push_back({.kind = Entry::Kind::kKey, .key = event});
}

void InputQueue::character(std::uint32_t code_point) {
  events_.push_back({.kind = Entry::Kind::kCharacter, .code_point = code_point});
}

void InputQueue::mouse_moved(float x, float y) {
  // Of several moves in a row, only the last place matters.
  if (!events_.empty() && events_.back().kind == Entry::Kind::kMove) events_.pop_back();
  events_.push_back({.kind = Entry::Kind::kMove, .x = x, .y = y});
}

void InputQueue::mouse_button(bool down) {
  events_.push_back({.kind = Entry::Kind::kButton, .down = down});
}

void InputQueue::wheel(float steps) {
  events_.push_back({.kind = Entry::Kind::kWheel, .y = steps});
}

void InputQueue::release_all() {
  for (const Key key : std::exchange(held_, {})) {
    events_.push_back({.kind = Entry::Kind::kKey,
                       .key = {.chord = {.key = key}, .action = KeyEvent::Action::kRelease}});
  }
}

bool InputQueue::fits(const Entry& entry, const Share& share) const {
  switch (entry.kind) {
    case Entry::Kind::kKey: {
      if (share.is_letter_of_text(entry.key)) return !share.has_command && !share.has_click;
      const bool is_second = share.has(entry.key.chord.key);
      if (!is_press(entry.key)) return !is_second;
      // ImGui ignores characters in a frame with Control.
      const bool would_silence = entry.key.chord.control && !share.input.characters.empty();
      return !is_second && !share.has_press && !share.has_click && !would_silence;
    }
    case Entry::Kind::kCharacter:
      // ImGui writes a frame's characters before it obeys its keys, so this character must not
      // be in the frame of an earlier command.
      return !share.has_command;
    case Entry::Kind::kMove:
      return !share.has_click;
    case Entry::Kind::kButton:
      return !share.has_click && !share.has_press;
    case Entry::Kind::kWheel:
      return true;
  }
  return true;
}

void InputQueue::take(const Entry& entry, Share& share) {
  switch (entry.kind) {
    case Entry::Kind::kKey:
      if (is_press(entry.key)) --presses_;
      if (share.is_letter_of_text(entry.key)) {
        // This release may belong to a shortcut whose Control was let go first.
        if (is_press(entry.key) || share.has(entry.key.chord.key)) break;
      }
      share.input.keys.push_back(entry.key);
      if (is_press(entry.key)) {
        share.has_press = true;
        share.has_command = !is_printing(entry.key.chord.key) || entry.key.chord.control;
      }
      break;
    case Entry::Kind::kCharacter:
      share.input.characters.push_back(entry.code_point);
      break;
    case Entry::Kind::kMove:
      mouse_.x = entry.x;
      mouse_.y = entry.y;
      break;
    case Entry::Kind::kButton:
      mouse_.down = entry.down;
      share.has_click = true;
      break;
    case Entry::Kind::kWheel:
      share.input.wheel += entry.y;
      break;
  }
}

FrameInput InputQueue::next_frame(bool is_writing) {
  Share share;
  share.is_writing = is_writing;
  while (!events_.empty() && fits(events_.front(), share)) {
    take(events_.front(), share);
    events_.pop_front();
  }
  share.input.mouse = mouse_;
  share.input.has_more = !events_.empty();
  return std::move(share.input);
}

}  // namespace jnd::app::gui
