#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace jnd::app::gui {

/// A key by its meaning, whatever the keyboard's layout: a letter's key is the one on which it
/// is printed. Letters and digits have the codes of their ASCII capitals. Digits of the keypad
/// count as digits.
enum class Key : std::uint16_t {
  kNone = 0,
  kSpace = ' ',
  kPlus = '+',
  kMinus = '-',
  kPeriod = '.',
  kEscape = 256,
  kEnter,  ///< Enter, also that of the keypad.
  kTab,
  kBackspace,
  kDelete,
  kLeft,
  kRight,
  kUp,
  kDown,
  kPageUp,
  kPageDown,
  kHome,
  kEnd,
  kF1,
  kF2,
  kF3,
  kF4,
  kF5,
  kF6,
  kF7,
  kF8,
  kF9,
  kF10,
  kF11,
  kF12,
};

[[nodiscard]] constexpr Key letter(char capital) noexcept { return static_cast<Key>(capital); }

/// True if the key without Control writes into a text: letters, digits, signs, the space bar.
[[nodiscard]] constexpr bool is_printing(Key key) noexcept {
  return key != Key::kNone && key < Key::kEscape;
}

/// A key with its modifiers, as a control shows it.
struct Chord {
  Key key = Key::kNone;
  bool control = false;
  bool shift = false;

  friend bool operator==(const Chord&, const Chord&) = default;
};

/// The chord in words that are the same in every language, for the log of tests: "Ctrl Z",
/// "Esc", "Y", "↑".
[[nodiscard]] std::string words(const Chord& chord);
/// The chord as it is printed on keyboards of those who speak the window's language: "Strg Z".
[[nodiscard]] std::string printed_words(const Chord& chord);

/// Whether `pressed` triggers a control that asks for `wanted`. Shift makes no difference to a
/// printing key, because who holds it by chance still means the letter. Beside Control it does
/// make a difference.
[[nodiscard]] bool answers(const Chord& pressed, const Chord& wanted) noexcept;

struct KeyEvent {
  enum class Action { kPress, kRepeat, kRelease };
  Chord chord;
  Action action = Action::kPress;
};

/// The place is in the window's pixels.
struct MouseState {
  float x = -1e6f;  ///< Outside of everything until the mouse first moves.
  float y = -1e6f;
  bool down = false;  ///< True while the left button is down.
};

/// The input that one frame sees.
struct FrameInput {
  std::vector<KeyEvent> keys;  ///< At most one transition of each key, and one press in all.
  std::vector<std::uint32_t> characters;  ///< What was typed in this frame, in Unicode.
  MouseState mouse;                       ///< At most one transition since the frame before.
  float wheel = 0.0f;                     ///< The wheel's steps; up is positive.
  bool has_more = false;                  ///< True if another frame has to be drawn at once.
};

/// Passes every key, character and click from the backend's callbacks to the frames, in order.
/// ImGui 1.86 asks in each frame which keys and buttons are down, so it would miss one that is
/// pressed and released between two frames. And if one frame had two keys, the second might be
/// meant for what the first one opens. So a frame takes events up to the second press, the
/// second transition of one key or of the mouse button, or a mouse move after a click. The rest
/// waits for the next frame. Repeats of a held key do not pile up: while one waits, more are
/// dropped.
class InputQueue {
 public:
  void key(const KeyEvent& event);
  void character(std::uint32_t code_point);
  void mouse_moved(float x, float y);
  void mouse_button(bool down);
  void wheel(float steps);
  /// If `is_writing`, a text field has the keyboard, and keys that write count as its
  /// characters only.
  [[nodiscard]] FrameInput next_frame(bool is_writing = false);
  [[nodiscard]] bool empty() const noexcept { return events_.empty(); }
  /// The mouse as the last frame saw it.
  [[nodiscard]] const MouseState& mouse() const noexcept { return mouse_; }
  /// The window lost the keyboard: every held key counts as released.
  void release_all();

 private:
  struct Entry {
    enum class Kind { kKey, kCharacter, kMove, kButton, kWheel };
    Kind kind = Kind::kKey;
    KeyEvent key;
    std::uint32_t code_point = 0;
    float x = 0, y = 0;  ///< The mouse's place; a wheel event has its steps in `y`.
    bool down = false;
  };
  /// What the frame that is being put together has taken already.
  struct Share;
  [[nodiscard]] bool fits(const Entry& entry, const Share& share) const;
  void take(const Entry& entry, Share& share);

  /// More waiting presses than this come from no person. They are dropped, so that the next
  /// real press does not wait for minutes.
  static constexpr int kMostPresses = 64;

  std::deque<Entry> events_;
  int presses_ = 0;  ///< How many presses of keys wait in `events_`.
  std::vector<Key> held_;
  MouseState mouse_;
};

}  // namespace jnd::app::gui
