#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/gui/input_queue.h"
#include "app/gui/theme.h"

struct ImDrawList;

namespace jnd::app::gui {

/// A rectangle in logical pixels, the pixels of an ordinary monitor. The theme's scale turns
/// them into real ones.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] float right() const noexcept { return x + width; }
  [[nodiscard]] float bottom() const noexcept { return y + height; }
  [[nodiscard]] Rect inset(float by) const noexcept {
    return {x + by, y + by, width - 2 * by, height - 2 * by};
  }
  /// Cuts a strip off this rectangle and returns it; `gap` is left free beside the strip.
  Rect take_top(float strip, float gap = 0) noexcept;
  Rect take_bottom(float strip, float gap = 0) noexcept;
  Rect take_left(float strip, float gap = 0) noexcept;
  Rect take_right(float strip, float gap = 0) noexcept;
  /// A rectangle of this size in the middle of this one.
  [[nodiscard]] Rect middle(float its_width, float its_height) const noexcept;
  /// The rectangle that both cover; of no size if they do not overlap.
  [[nodiscard]] Rect common(const Rect& other) const noexcept;
  [[nodiscard]] bool contains(float px, float py) const noexcept {
    return px >= x && px < right() && py >= y && py < bottom();
  }
  friend bool operator==(const Rect&, const Rect&) = default;
};

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  Font font = Font::kBody;
  Colour colour = Colour::kInk;
  Align align = Align::kLeft;
  /// If true, the text is broken into lines from the top of its place, and centred lines are of
  /// about equal length. If false, it is one line at middle height; without room for that, it
  /// takes as many lines as the place is high for, or smaller letters. What still has no room
  /// is cut with an ellipsis, and is shown in whole while the mouse points at it.
  bool wrap = false;
  /// The words are a value or were written by somebody, so they may be too long for any place
  /// and may be cut. The program's own words have to fit.
  bool any_length = false;
};

enum class Tone {
  kPlain,    ///< With a border.
  kPrimary,  ///< Filled, for what is usually done next.
  kDanger,   ///< Red.
  kQuiet,    ///< Words alone, as in the header.
};

struct ButtonStyle {
  Tone tone = Tone::kPlain;
  /// The key that presses the button, shown on it; none by default.
  Chord key;
  bool enabled = true;
  bool repeats = false;  ///< A held key or mouse button presses it again and again.
  bool large = false;    ///< Larger letters, for answers.
  /// Answers when the mouse button goes down, as the emergency stop does.
  bool at_once = false;
  /// The chosen one of several, such as tabs or the steps of a scale.
  bool selected = false;
  /// Small words below the label if there is room, such as the pedal that does the same.
  std::string_view note{};
  /// The key counts only after it has been up for a moment. So a held key is one press, even
  /// where the system reports several.
  bool fresh = false;
  /// The key works but is not shown, because there is no room.
  bool hides_key = false;
};

/// What one frame drew, so that a test can read the screen and click on it.
struct Drawn {
  struct Widget {
    std::string name;  ///< The name given to the call that drew it, such as "answer_yes".
    std::string label;
    std::string key;      ///< The key, the same in every language: "Y", "Ctrl Z".
    std::string key_cap;  ///< The key as it is printed: "Strg Z".
    Rect place;           ///< The visible part in logical pixels; empty if nothing is visible.
    bool enabled = true;  ///< False also for a widget below a dialog.
    bool is_covered = false;  ///< The widget is below a dialog.

    friend bool operator==(const Widget&, const Widget&) = default;
  };
  /// A line of letters of which some part can be seen, including labels and keys.
  struct Line {
    std::string words;  ///< The words as drawn, with an ellipsis where they were cut.
    Rect place;         ///< The visible part of its letters, as high as a line of their font.
    /// Where the text had to be drawn. Lines that spill over leave this box.
    Rect box;
    /// The line is cut because there was too little width: by an ellipsis, within a word, or by
    /// clipping.
    bool is_cut = false;
    /// The text may have any length, and the mouse shows in whole what is cut.
    bool shows_whole = false;
    bool is_covered = false;  ///< The line is below a dialog.
  };
  std::string view;         ///< The application's name for what is on the screen.
  std::uint64_t frame = 0;  ///< Increases with each frame.
  std::vector<Widget> widgets;
  std::vector<std::string> texts;  ///< Every text in order, labels included.
  /// The same texts, line by line as they were drawn.
  std::vector<Line> lines;
  /// Keys that more than one control of the screen, or of its dialog, asked for. Only the first
  /// control gets the key, so what the other one shows would be wrong.
  std::vector<std::string> shared_keys;

  [[nodiscard]] const Widget* find(std::string_view name) const;
  /// Whether some text contains `part`.
  [[nodiscard]] bool shows(std::string_view part) const;
};

/// One frame of the window: draws, passes keys and clicks to the widgets, and logs what was
/// drawn. Everything on the screen goes through this class. It works in immediate mode: what a
/// call draws exists in this frame alone, and a control returns true in the frame in which it
/// was used.
///
/// A key belongs to the first control that asks for it in a frame, and no two controls should
/// ask for the same one (`Drawn::shared_keys`). While a dialog is open (`begin_dialog`),
/// controls drawn before it get neither keys nor clicks; those drawn after it do, such as the
/// emergency stop. While a text field is edited, keys that write or edit go to the field alone.
/// After a frame in which something was used, the next frame sees no input: what was typed
/// waits for the dialog, field or work that is just beginning.
class Ui {
 public:
  /// Uses the current ImGui context, which belongs to this object from now on and has fonts
  /// (`Theme`).
  explicit Ui(Theme& theme);
  ~Ui();
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;

  /// Begins a frame and takes its share of the queue, unless input is held. ImGui has to know
  /// the display's size and the time that has passed, and the screen has to be
  /// `Colour::kGround` already.
  void begin_frame(InputQueue& queue);
  /// Returns what was drawn; ImGui's draw data are ready then.
  const Drawn& end_frame();
  /// True if the next frame should be drawn at once, not only after an event.
  [[nodiscard]] bool wants_another_frame() const noexcept;

  /// Makes input wait until a frame passes in which this is not called, because what the input
  /// is meant for is still on its way.
  void hold_input() noexcept;

  /// The time of the frames' own clock, which goes forward with each frame.
  [[nodiscard]] double time_s() const;

  /// Names what is on the screen, for tests.
  void set_view(std::string_view name);
  /// What this frame has drawn so far.
  [[nodiscard]] const Drawn& drawn() const noexcept;
  [[nodiscard]] Rect screen() const;
  [[nodiscard]] Theme& theme() noexcept { return theme_; }
  [[nodiscard]] const Theme& theme() const noexcept { return theme_; }
  [[nodiscard]] ImDrawList& draw_list();
  /// Converts logical pixels to ImGui's pixels.
  [[nodiscard]] float px(float logical) const noexcept;
  [[nodiscard]] std::uint32_t rgba(Colour colour, float alpha = 1.0f) const;
  /// The mouse's place in logical pixels; outside of everything if there is no mouse.
  [[nodiscard]] float mouse_x() const;
  [[nodiscard]] float mouse_y() const;
  /// True if the mouse is over the place and a click would go to what is being drawn now.
  [[nodiscard]] bool hovered(const Rect& place) const;

  // Shapes.
  void fill(const Rect& place, Colour colour, float rounding = 0, float alpha = 1.0f);
  void outline(const Rect& place, Colour colour, float rounding = 0, float thickness = 1);
  void card(const Rect& place);
  void line(float x0, float y0, float x1, float y1, Colour colour, float thickness = 1);
  void dot(float x, float y, float radius, Colour colour);
  void ring(float x, float y, float radius, Colour colour, float thickness = 1.5f);
  /// Draws a check mark in a square of this size around the point.
  void check(float x, float y, float size, Colour colour);
  void progress(const Rect& place, double ratio);
  /// Draws a texture of the window's renderer whose first row is the lowest one; 0 draws
  /// nothing. `what` is noted in the log, as by `note_drawn`.
  void image(const Rect& place, std::uintptr_t texture, std::string_view what);

  // Words. `text` returns the height that it took.
  float text(const Rect& place, std::string_view words, const TextStyle& style = {});
  [[nodiscard]] float text_height(float width, std::string_view words,
                                  const TextStyle& style) const;
  [[nodiscard]] float text_width(std::string_view words, Font font) const;
  [[nodiscard]] float line_height(Font font) const;
  /// Draws a heading in small capitals, such as "SESSION" over a card. `unit` keeps its
  /// letters, because M/S is no unit. If capitals have no room, the heading is in small
  /// letters. `any_length` is as in `TextStyle`.
  void heading(const Rect& place, std::string_view words, std::string_view unit = "",
               Align align = Align::kLeft, bool any_length = false);
  /// Draws a chip 26 logical pixels high and returns its width.
  float chip(float x, float y, std::string_view words, Colour colour);
  [[nodiscard]] float chip_width(std::string_view words) const;
  static constexpr float kKeyCapHeight = 20;
  /// Draws the cap of a key with letters and border in this colour. Returns its width.
  float key_cap(float x, float y, const Chord& key, Colour colour = Colour::kSoft);
  [[nodiscard]] float key_cap_width(const Chord& key) const;

  // Controls. `name` is unique in the frame; tests find the control by it.
  bool button(std::string_view name, const Rect& place, std::string_view label,
              const ButtonStyle& style = {});
  /// The width that a button with this label needs.
  [[nodiscard]] float button_width(std::string_view label, const ButtonStyle& style) const;
  /// A row of a list that can be clicked. It draws nothing but a highlight under the mouse.
  bool row(std::string_view name, const Rect& place, std::string_view label,
           const Chord& key = {});
  /// A field of one line. Returns true when Enter ended it; nothing else sees that Enter.
  /// `focus` gives it the keyboard, as the first field of a dialog gets it when the dialog
  /// opens. Tab goes from one field to the next.
  bool text_field(std::string_view name, const Rect& place, std::string& value,
                  std::string_view hint = "", bool focus = false);
  /// How the mouse turned or moved something since the last frame.
  struct Drag {
    /// The way in logical pixels while the button that went down here is held.
    float x = 0, y = 0;
    float wheel = 0;  ///< The wheel's steps; up is positive.
  };
  [[nodiscard]] Drag dragged(std::string_view name, const Rect& place);
  /// A field of several wrapped lines, in which Enter writes a line end. Returns true when the
  /// text was changed.
  bool text_area(std::string_view name, const Rect& place, std::string& value,
                 std::string_view hint = "", bool focus = false);
  /// Puts the words on the clipboard.
  void copy_text(const std::string& words);
  /// True while some text field has the keyboard.
  [[nodiscard]] bool is_editing() const noexcept;
  /// A key without a control. Returns true in the frame in which it is pressed, and with
  /// `with_repeats` also while it is held. Nothing else then sees the key.
  bool pressed(const Chord& key, bool with_repeats = false);
  /// True if the control or key that returned true last did so because it is held down.
  [[nodiscard]] bool was_held() const noexcept;
  /// Digits and points typed outside of any text field, as on a keypad; a comma counts as a
  /// point. Nothing else then sees them.
  [[nodiscard]] std::string typed_digits();
  bool typed_backspace();

  /// What is drawn until `end_scroll` is clipped to `place` and moves with the wheel, the mouse
  /// and the Page keys. Returns the rectangle of the content; `content_height` is its height in
  /// the frame before.
  Rect begin_scroll(std::string_view name, const Rect& place, float content_height);
  void end_scroll();
  /// Scrolls so that this part of the content can be seen from the next frame on, such as a row
  /// that the arrow keys have reached. `below_top` is its distance from the content's top.
  void scroll_into_view(std::string_view name, float below_top, float height);

  /// Darkens everything drawn so far and takes its keys and clicks away. Returns the inner
  /// rectangle of the dialog. Only one dialog can be open at a time.
  Rect begin_dialog(std::string_view name, float width, float height);
  void end_dialog();

  /// Draws words beside the point, over everything else in this frame, such as the value under
  /// the mouse. Long words are wrapped. A frame shows the last of its tooltips only.
  void tooltip(float x, float y, std::string_view words);
  /// Adds words to the log of what was drawn, for tests that want to know about a picture:
  /// "hand sign fist". With a place, it is a widget of this name that can be pointed at.
  void note_drawn(std::string_view what, const Rect& place = {});

 private:
  struct Implementation;
  struct Press;
  struct ButtonWords;
  [[nodiscard]] Press press_on(const Rect& place, const ButtonStyle& style);
  void log_widget(std::string_view name, std::string_view label, const Chord& key,
                  const Rect& place, bool enabled);
  void log_text(std::string_view words);
  /// `line` holds the words, their box, and whether they were cut.
  void draw_line_of_text(float x, float y, const Drawn::Line& line, Font font,
                         std::uint32_t colour);
  void log_line(const Rect& letters, Drawn::Line line);
  void draw_tooltip();
  [[nodiscard]] ButtonWords words_on_button(const Rect& place, std::string_view label,
                                            const ButtonStyle& style) const;
  void draw_button(const Rect& place, std::string_view label, const ButtonStyle& style,
                   const Press& press);
  bool begin_field(std::string_view name, const Rect& place, const std::string& value,
                   bool focus);
  void end_field(std::string_view name, bool is_area);

  Theme& theme_;
  std::unique_ptr<Implementation> my_;
};

}  // namespace jnd::app::gui
