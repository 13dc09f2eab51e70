#pragma once

#include <imgui.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// What `Ui` remembers from call to call and from frame to frame. Only the sources of `Ui` use
/// it.
struct Ui::Implementation {
  ImGuiContext* context = nullptr;
  Drawn drawn;

  // This frame's input, without what a control has taken.
  FrameInput input;
  std::vector<KeyEvent> keys;  ///< Keys that were pressed or repeat.
  std::vector<std::uint32_t> characters;
  /// Keys that a control of this frame asked for.
  std::vector<std::string> asked_for;
  std::optional<FrameInput> again;   ///< Input that nobody saw, for the next frame.
  bool was_held = false;             ///< The last control that answered is held down.
  bool was_used = false;             ///< A control answered in this frame.
  bool is_held = false;              ///< What was used has had no effect yet.
  bool has_more = false;             ///< The queue is not empty.
  std::map<Key, double> released_s;  ///< When each key was last released.

  // The mouse, in logical pixels.
  MouseState mouse;
  float moved_x = 0, moved_y = 0;  ///< The way since the frame before.
  bool went_down = false;
  bool went_up = false;
  float press_x = 0, press_y = 0;  ///< Where the button went down.
  std::string press_dialog;        ///< The dialog that was open then.
  double next_repeat_s = 0.0;      ///< When a button that is held down acts again.
  bool is_repeating = false;

  // The name of the dialog; "" for none.
  std::string dialog;
  std::string dialog_before;
  bool dialog_is_new = false;
  bool inside_dialog = false;
  /// How many text fields were drawn before the dialog, in the frame in which it opens.
  std::size_t num_fields_below = 0;

  // Text fields, by name.
  std::vector<std::string> fields;
  std::string active_field;
  std::string active_before;
  bool area_is_active = false;
  std::string wants_focus;
  int frames_of_waiting = 0;
  bool enter_for_field = false;
  int tab_steps = 0;
  Rect field_place;

  struct Scroll {
    float offset = 0;
    /// Where the mouse holds the thumb while it is dragged; otherwise -1.
    float grabbed_at = -1;
    Rect place;
    float content_height = 0;
    std::uint64_t last_frame = 0;
  };
  std::map<std::string, Scroll, std::less<>> scrolls;
  std::string open_scroll;
  struct Tooltip {
    float x = 0, y = 0;
    std::string words;
  };
  std::optional<Tooltip> tooltip;  ///< The tooltip of this frame.
  std::vector<Rect> clips;

  /// True while drawing below a dialog; nothing there gets keys or clicks.
  [[nodiscard]] bool is_blocked() const noexcept {
    return !dialog_before.empty() && dialog.empty();
  }
  [[nodiscard]] bool is_waiting_for_focus() const noexcept { return !wants_focus.empty(); }
  [[nodiscard]] Rect visible(const Rect& place) const noexcept {
    return clips.empty() ? place : place.common(clips.back());
  }
  [[nodiscard]] bool mouse_is_on(const Rect& place) const noexcept {
    return !is_blocked() && visible(place).contains(mouse.x, mouse.y);
  }
  [[nodiscard]] bool press_was_on(const Rect& place) const noexcept {
    return press_dialog == dialog && visible(place).contains(press_x, press_y);
  }
  /// True if the key has been up for longer than on a system that repeats a held key by
  /// releasing it.
  [[nodiscard]] bool is_fresh(Key key) const;
  /// Takes the first press of this chord for the caller.
  bool take_key(const Chord& chord, bool with_repeats);
  void note_asked_for(const Chord& chord);
  void give_keys_to_field();
  /// Tells ImGui which of our keys is which of its own.
  static void map_keys(ImGuiIO& io);
  void feed(ImGuiIO& io) const;
};

struct Ui::Press {
  bool answered = false;
  bool hovered = false;
  bool held = false;
};

}  // namespace jnd::app::gui
