#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace jnd::app::gui {

/// Keys by what they mean to us, whatever the layout: a letter's key is the one that has it
/// printed on it. Letters and digits are their capital ASCII codes; digits of the keypad are
/// the digits.
enum class Key : std::uint16_t {
  kNone = 0,
  kSpace = ' ',
  kPlus = '+',
  kMinus = '-',
  kPeriod = '.',
  kEscape = 256,
  kEnter,  ///< Also the keypad's.
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

/// Without Control it writes into a text: letters, digits, signs, the space bar.
[[nodiscard]] constexpr bool is_printing(Key key) noexcept {
  return key != Key::kNone && key < Key::kEscape;
}

/// A key with its modifiers, as it is printed on a control.
struct Chord {
  Key key = Key::kNone;
  bool control = false;
  bool shift = false;

  friend bool operator==(const Chord&, const Chord&) = default;
};

/// "Ctrl Z", "Esc", "Y", "↑": the same in every language, for the log of tests.
[[nodiscard]] std::string words(const Chord& chord);
/// The same as it is printed on the keyboards of those who speak the window's language:
/// "Strg Z".
[[nodiscard]] std::string printed_words(const Chord& chord);

/// Whether `pressed` answers a control that asks for `wanted`. Shift makes no difference to a
/// printing key, for who holds it by chance still means the letter; it does beside Control.
[[nodiscard]] bool answers(const Chord& pressed, const Chord& wanted) noexcept;

struct KeyEvent {
  enum class Action { kPress, kRepeat, kRelease };
  Chord chord;
  Action action = Action::kPress;
};

/// In the window's pixels.
struct MouseState {
  float x = -1e6f;  ///< Outside of everything until it moved.
  float y = -1e6f;
  bool down = false;  ///< The left button.
};

/// What one frame gets to see.
struct FrameInput {
  std::vector<KeyEvent> keys;             ///< At most one transition of each key, one press.
  std::vector<std::uint32_t> characters;  ///< Unicode, typed in this frame.
  MouseState mouse;                       ///< At most one transition from the frame before.
  float wheel = 0.0f;                     ///< Steps, up is positive.
  bool has_more = false;                  ///< Draw another frame at once.
};

/// Every key, character and click from the backend's callbacks to the frames, in order. ImGui
/// 1.86 asks which keys and buttons are down in each frame, so that one pressed and released
/// between two would be lost; and of two keys in one frame the second might be meant for what
/// the first one opens. So a frame takes events up to the second press, the second transition
/// of any one key or of the mouse button, or a move of the mouse after it was clicked; the rest
/// is left to the next frame. A held key's repeats do not pile up: while one waits, more are
/// dropped.
class InputQueue {
 public:
  void key(const KeyEvent& event);
  void character(std::uint32_t code_point);
  void mouse_moved(float x, float y);
  void mouse_button(bool down);
  void wheel(float steps);
  /// `is_writing`: a text field has the keyboard, and keys that write are its characters alone.
  [[nodiscard]] FrameInput next_frame(bool is_writing = false);
  [[nodiscard]] bool empty() const noexcept { return events_.empty(); }
  [[nodiscard]] const MouseState& mouse() const noexcept { return mouse_; }  ///< Last frame's.
  /// The window lost the keyboard: whatever is held counts as released.
  void release_all();

 private:
  struct Entry {
    enum class Kind { kKey, kCharacter, kMove, kButton, kWheel };
    Kind kind = Kind::kKey;
    KeyEvent key;
    std::uint32_t code_point = 0;
    float x = 0, y = 0;  ///< Of the mouse; the wheel's steps in `y`.
    bool down = false;
  };
  struct Share;  ///< What the frame being made up has taken already.
  [[nodiscard]] bool fits(const Entry& entry, const Share& share) const;
  void take(const Entry& entry, Share& share);

  /// More than this waiting are no person's: they are dropped, so that what comes after is not
  /// minutes away.
  static constexpr int kMostPresses = 64;

  std::deque<Entry> events_;
  int presses_ = 0;  ///< Of keys among them.
  std::vector<Key> held_;
  MouseState mouse_;
};

}  // namespace jnd::app::gui
