#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

/// True if a text that is being edited needs this key.
bool edits_text(const Chord& chord) {
  if (chord.control) {
    switch (static_cast<int>(chord.key)) {
      case 'A':
      case 'C':
      case 'V':
      case 'X':
      case 'Y':
      case 'Z':
      case static_cast<int>(Key::kBackspace):
      case static_cast<int>(Key::kDelete):
      case static_cast<int>(Key::kLeft):
      case static_cast<int>(Key::kRight):
      case static_cast<int>(Key::kHome):
      case static_cast<int>(Key::kEnd):
        return true;
      default:
        return false;
    }
  }
  if (is_printing(chord.key)) return true;
  return (chord.key >= Key::kBackspace && chord.key <= Key::kDown) || chord.key == Key::kHome ||
         chord.key == Key::kEnd;
}

}  // namespace

// Escape is not mapped, because it is the emergency stop and ImGui would undo what was written.
// Tab is not mapped, because we handle it ourselves.
void Ui::Implementation::map_keys(ImGuiIO& io) {
  const auto map = [&](ImGuiKey theirs, Key ours) {
    io.KeyMap[theirs] = static_cast<int>(ours);
  };
  map(ImGuiKey_LeftArrow, Key::kLeft);
  map(ImGuiKey_RightArrow, Key::kRight);
  map(ImGuiKey_UpArrow, Key::kUp);
  map(ImGuiKey_DownArrow, Key::kDown);
  map(ImGuiKey_PageUp, Key::kPageUp);
  map(ImGuiKey_PageDown, Key::kPageDown);
  map(ImGuiKey_Home, Key::kHome);
  map(ImGuiKey_End, Key::kEnd);
  map(ImGuiKey_Delete, Key::kDelete);
  map(ImGuiKey_Backspace, Key::kBackspace);
  map(ImGuiKey_Space, Key::kSpace);
  map(ImGuiKey_Enter, Key::kEnter);
  map(ImGuiKey_A, letter('A'));
  map(ImGuiKey_C, letter('C'));
  map(ImGuiKey_V, letter('V'));
  map(ImGuiKey_X, letter('X'));
  map(ImGuiKey_Y, letter('Y'));
  map(ImGuiKey_Z, letter('Z'));
}

/// Passes the input to ImGui, which edits texts. The keys of its undo are left out in a text
/// area, because the undo of ImGui 1.86 does not know the line ends that we move about.
void Ui::Implementation::feed(ImGuiIO& io) const {
  if (!input.keys.empty() || !input.characters.empty()) io.KeyCtrl = io.KeyShift = false;
  for (const KeyEvent& event : input.keys) {
    const bool goes_down = event.action != KeyEvent::Action::kRelease;
    // The previous key may be released while this key's Control is still held.
    io.KeyCtrl |= goes_down && event.chord.control;
    io.KeyShift |= goes_down && event.chord.shift;
    const Key key = event.chord.key;
    if (goes_down && area_is_active && (key == letter('Z') || key == letter('Y'))) continue;
    io.KeysDown[static_cast<int>(key)] = goes_down;
  }
  for (const std::uint32_t character : input.characters) io.AddInputCharacter(character);
  io.MousePos = ImVec2(input.mouse.x, input.mouse.y);
  io.MouseDown[0] = input.mouse.down;
  io.MouseWheel = input.wheel;
}

void Ui::Implementation::note_asked_for(const Chord& chord) {
  if (is_blocked() || chord.key == Key::kNone) return;
  // A control that opens a dialog and a control in the dialog may have the same key.
  std::string key = words(chord);
  std::string asked = dialog + "\n" + key;
  if (std::ranges::find(asked_for, asked) == asked_for.end()) {
    asked_for.push_back(std::move(asked));
  } else if (std::ranges::find(drawn.shared_keys, key) == drawn.shared_keys.end()) {
    drawn.shared_keys.push_back(std::move(key));
  }
}

bool Ui::Implementation::is_fresh(Key key) const {
  constexpr double kLetGo_s = 0.12;
  const auto released = released_s.find(key);
  return released == released_s.end() || ImGui::GetTime() - released->second >= kLetGo_s;
}

bool Ui::Implementation::take_key(const Chord& chord, bool with_repeats) {
  if (is_blocked()) return false;
  const auto found = std::ranges::find_if(keys, [&](const KeyEvent& event) {
    return answers(event.chord, chord) &&
           (with_repeats || event.action == KeyEvent::Action::kPress);
  });
  if (found == keys.end()) return false;
  was_held = found->action == KeyEvent::Action::kRepeat;
  keys.erase(found);
  // A frame has one press, so this key wrote the frame's characters.
  characters.clear();
  // A held key changes a value and opens nothing, so the next frame need not wait.
  if (!with_repeats) was_used = true;
  return true;
}

void Ui::Implementation::give_keys_to_field() {
  enter_for_field = false;
  tab_steps = 0;
  std::erase_if(keys, [&](const KeyEvent& event) {
    if (event.chord.key == Key::kTab && !event.chord.control) {
      tab_steps = event.chord.shift ? -1 : 1;
      return true;
    }
    if (active_before.empty()) return false;
    if (event.chord.key == Key::kEnter && !event.chord.control) {
      enter_for_field = true;
      return true;
    }
    const Key key = event.chord.key;
    const bool is_vertical = key == Key::kUp || key == Key::kDown;
    return edits_text(event.chord) && (area_is_active || !is_vertical);
  });
}

bool Ui::pressed(const Chord& key, bool with_repeats) {
  my_->note_asked_for(key);
  return my_->take_key(key, with_repeats);
}

std::string Ui::typed_digits() {
  Implementation& my = *my_;
  if (my.is_blocked() || is_editing()) return "";
  const bool repeats = std::ranges::any_of(
      my.keys, [](const KeyEvent& event) { return event.action == KeyEvent::Action::kRepeat; });
  // A person who holds a digit too long does not mean it several times.
  if (repeats) return "";
  const auto is_digit = [](std::uint32_t code) { return code >= '0' && code <= '9'; };
  std::string digits;
  for (const std::uint32_t character : my.characters) {
    if (is_digit(character)) digits += static_cast<char>(character);
    if (character == '.' || character == ',') digits += '.';
  }
  // Digits of the keypad count as digits, whatever Num Lock says.
  for (const KeyEvent& event : my.keys) {
    const auto code = static_cast<std::uint32_t>(event.chord.key);
    if (my.characters.empty() && !event.chord.control && is_digit(code)) {
      digits += static_cast<char>(code);
    }
  }
  if (digits.empty()) return "";
  my.characters.clear();
  std::erase_if(my.keys, [](const KeyEvent& event) {
    return is_printing(event.chord.key) && !event.chord.control;
  });
  return digits;
}

bool Ui::typed_backspace() { return my_->take_key({.key = Key::kBackspace}, true); }

}  // namespace jnd::app::gui
