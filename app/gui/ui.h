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

/// In logical pixels: what a pixel is on a plain monitor; the theme's scale makes real ones.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] float right() const noexcept { return x + width; }
  [[nodiscard]] float bottom() const noexcept { return y + height; }
  [[nodiscard]] Rect inset(float by) const noexcept {
    return {x + by, y + by, width - 2 * by, height - 2 * by};
  }
  /// Cuts a strip off this rectangle and returns it; `gap` is left free after it.
  Rect take_top(float strip, float gap = 0) noexcept;
  Rect take_bottom(float strip, float gap = 0) noexcept;
  Rect take_left(float strip, float gap = 0) noexcept;
  Rect take_right(float strip, float gap = 0) noexcept;
  /// A rectangle of this size in the middle.
  [[nodiscard]] Rect middle(float its_width, float its_height) const noexcept;
  /// What both cover; of no size where they do not meet.
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
  /// Broken into lines from the top of its place; centred lines are of about equal length. Else
  /// one line in the middle of the place's height. Where that has no room, the words stand on
  /// as many lines as the place is high for, or in smaller letters; what then still has no room
  /// is cut with an ellipsis, and shows whole when it is pointed at.
  bool wrap = false;
  /// Words that somebody wrote, or a value: they may be so long that no place would do, so that
  /// they may be cut. The program's own words are to have room.
  bool any_length = false;
};

enum class Tone {
  kPlain,    ///< Bordered.
  kPrimary,  ///< Filled: what is usually done next.
  kDanger,   ///< Red.
  kQuiet,    ///< Words alone, as in the header.
};

struct ButtonStyle {
  Tone tone = Tone::kPlain;
  Chord key;  ///< Printed on it, and it answers to it; none by default.
  bool enabled = true;
  bool repeats = false;   ///< A held key or button goes on.
  bool large = false;     ///< The answers: larger letters.
  bool at_once = false;   ///< Answers when the mouse goes down: the emergency stop.
  bool selected = false;  ///< One of several, and the one that holds: tabs, steps of a scale.
  /// Drawn small below the label, where there is room: the pedal that does the same.
  std::string_view note{};
  /// Its key counts once it has been let go for a moment: a key that is held is one press, also
  /// where the system tells it as many.
  bool fresh = false;
  /// Its key is not printed, for want of room; it answers to it all the same.
  bool hides_key = false;
};

/// What was drawn in one frame, so that a test can read the screen and click on it.
struct Drawn {
  struct Widget {
    std::string name;  ///< "answer_yes", as given to the call that drew it.
    std::string label;
    std::string key;          ///< "Y", "Ctrl Z", in every language.
    std::string key_cap;      ///< The same as it is printed: "Strg Z".
    Rect place;               ///< Logical pixels; what can be seen of it, so maybe nothing.
    bool enabled = true;      ///< False also below a dialog.
    bool is_covered = false;  ///< Below a dialog.

    friend bool operator==(const Widget&, const Widget&) = default;
  };
  /// A line of letters, labels and keys included, where any of it can be seen.
  struct Line {
    std::string words;  ///< As they stand there: with an ellipsis where they were cut.
    Rect place;         ///< What of its letters can be seen, as high as a line of their font.
    Rect box;  ///< Where it was to be drawn; lower than its lines where they spill over.
    bool is_cut = false;  ///< For want of width: with an ellipsis, within a word, or clipped.
    /// It is of any length, and what of it is cut shows whole when it is pointed at.
    bool shows_whole = false;
    bool is_covered = false;  ///< Below a dialog.
  };
  std::string view;         ///< As the application calls what is on screen.
  std::uint64_t frame = 0;  ///< Counts up.
  std::vector<Widget> widgets;
  std::vector<std::string> texts;  ///< Every text, labels included, in order.
  std::vector<Line> lines;         ///< The same as they came to stand.
  /// Keys that more than one control of the screen, or of its dialog, asked for: only the first
  /// of them gets the key, so that what the other one says is not what the key does.
  std::vector<std::string> shared_keys;

  [[nodiscard]] const Widget* find(std::string_view name) const;
  [[nodiscard]] bool shows(std::string_view part) const;  ///< Some text contains it.
};

/// One frame of the window: draws, lays keys and clicks at the widgets, and remembers what was
/// drawn. Everything on screen goes through here. Immediate mode: what a call draws exists in
/// this frame alone; a control returns true in the frame in which it was used.
///
/// A key belongs to the first control that asks for it in a frame, and no two should
/// (`Drawn::shared_keys`); while a dialog is open
/// (`begin_dialog`), controls drawn before it get neither keys nor clicks, those drawn after it
/// do: the emergency stop. While a text field is edited, keys that write a letter or edit go to
/// it alone. What is typed while a control's work, a dialog or a field is still opening waits
/// for it: the frame after one in which something was used sees no input.
class Ui {
 public:
  /// For the current ImGui context, which is this one's from now on and has fonts (`Theme`).
  explicit Ui(Theme& theme);
  ~Ui();
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;

  /// Takes this frame's share of the queue, if it is ready for any. ImGui knows the size of the
  /// display and the time that has passed. The screen is `Colour::kGround` already.
  void begin_frame(InputQueue& queue);
  /// What was drawn; ImGui's draw data are ready.
  const Drawn& end_frame();
  /// The next frame should be drawn at once, not only after an event.
  [[nodiscard]] bool wants_another_frame() const noexcept;

  /// What is typed and clicked waits for a frame after one in which this was not called: what
  /// it is meant for is on its way.
  void hold_input() noexcept;

  /// Of the frames' own clock; goes forward with each of them.
  [[nodiscard]] double time_s() const;

  /// Names what is on screen, for tests.
  void set_view(std::string_view name);
  /// What was drawn in this frame so far.
  [[nodiscard]] const Drawn& drawn() const noexcept;
  [[nodiscard]] Rect screen() const;
  [[nodiscard]] Theme& theme() noexcept { return theme_; }
  [[nodiscard]] const Theme& theme() const noexcept { return theme_; }
  [[nodiscard]] ImDrawList& draw_list();
  /// To ImGui's own pixels.
  [[nodiscard]] float px(float logical) const noexcept;
  [[nodiscard]] std::uint32_t rgba(Colour colour, float alpha = 1.0f) const;
  /// Of the mouse, logical pixels; outside of everything where there is none.
  [[nodiscard]] float mouse_x() const;
  [[nodiscard]] float mouse_y() const;
  /// The mouse is over it, and a click would be for what is drawn now.
  [[nodiscard]] bool hovered(const Rect& place) const;

  // Shapes.
  void fill(const Rect& place, Colour colour, float rounding = 0, float alpha = 1.0f);
  void outline(const Rect& place, Colour colour, float rounding = 0, float thickness = 1);
  void card(const Rect& place);
  void line(float x0, float y0, float x1, float y1, Colour colour, float thickness = 1);
  void dot(float x, float y, float radius, Colour colour);
  void ring(float x, float y, float radius, Colour colour, float thickness = 1.5f);
  /// A check mark within a square of this size around the point.
  void check(float x, float y, float size, Colour colour);
  void progress(const Rect& place, double ratio);
  /// A texture of the window's renderer, its first row the lowest one; 0 draws nothing.
  /// `what`: for the log, as `note_drawn`.
  void image(const Rect& place, std::uintptr_t texture, std::string_view what);

  // Words. `text` returns the height it took.
  float text(const Rect& place, std::string_view words, const TextStyle& style = {});
  [[nodiscard]] float text_height(float width, std::string_view words,
                                  const TextStyle& style) const;
  [[nodiscard]] float text_width(std::string_view words, Font font) const;
  [[nodiscard]] float line_height(Font font) const;
  /// Small capitals over a card: "SESSION". `unit` stays as it is written, for M/S is none.
  /// Where capitals have no room it is in small letters. `any_length`: as of a `TextStyle`.
  void heading(const Rect& place, std::string_view words, std::string_view unit = "",
               Align align = Align::kLeft, bool any_length = false);
  /// 26 high. Returns its width.
  float chip(float x, float y, std::string_view words, Colour colour);
  [[nodiscard]] float chip_width(std::string_view words) const;
  static constexpr float kKeyCapHeight = 20;
  /// Draws the cap of a key in the colour of its letters. Returns its width.
  float key_cap(float x, float y, const Chord& key, Colour colour = Colour::kSoft);
  [[nodiscard]] float key_cap_width(const Chord& key) const;

  // Controls. `name` is unique in the frame; tests find the control by it.
  bool button(std::string_view name, const Rect& place, std::string_view label,
              const ButtonStyle& style = {});
  /// How wide a button of this label wants to be.
  [[nodiscard]] float button_width(std::string_view label, const ButtonStyle& style) const;
  /// A row of a list that can be clicked; draws nothing but its hover.
  bool row(std::string_view name, const Rect& place, std::string_view label,
           const Chord& key = {});
  /// True when Enter ended it; that Enter is nobody else's. `focus`: takes the keyboard. The
  /// first field of a dialog does so when it opens; Tab goes from one to the next.
  bool text_field(std::string_view name, const Rect& place, std::string& value,
                  std::string_view hint = "", bool focus = false);
  /// What the mouse does with something that is turned and moved by it, since the last frame.
  struct Drag {
    float x = 0, y = 0;  ///< Logical pixels, while the button that went down on it is held.
    float wheel = 0;     ///< Steps, up is positive.
  };
  [[nodiscard]] Drag dragged(std::string_view name, const Rect& place);
  /// Several lines, wrapped; Enter writes a line end. True when the text was changed.
  bool text_area(std::string_view name, const Rect& place, std::string& value,
                 std::string_view hint = "", bool focus = false);
  /// Puts it on the clipboard.
  void copy_text(const std::string& words);
  /// Some text field has the keyboard.
  [[nodiscard]] bool is_editing() const noexcept;
  /// A key without a control of its own. True in the frame it is pressed in; `with_repeats`
  /// also while it is held. It then belongs to nobody else.
  bool pressed(const Chord& key, bool with_repeats = false);
  /// The control or key that returned true last did so because it is held down.
  [[nodiscard]] bool was_held() const noexcept;
  /// Digits and a point, as a keypad writes them outside of any text field; a comma is a point.
  /// They then belong to nobody else.
  [[nodiscard]] std::string typed_digits();
  bool typed_backspace();

  /// What is drawn until `end_scroll` moves with wheel, drag and Page keys, clipped to `place`.
  /// Returns where the content's top left is; `content_height` as measured in the frame before.
  Rect begin_scroll(std::string_view name, const Rect& place, float content_height);
  void end_scroll();
  /// What lies so far below the top of its content can be seen from the next frame on, as a row
  /// that arrow keys have come to.
  void scroll_into_view(std::string_view name, float below_top, float height);

  /// Darkens everything drawn so far and takes its keys and clicks away; returns the dialog's
  /// inner rectangle. One at a time.
  Rect begin_dialog(std::string_view name, float width, float height);
  void end_dialog();

  /// Over everything drawn in this frame, beside the point: the value under the mouse. Long
  /// words are wrapped; of several in a frame the last one is shown.
  void tooltip(float x, float y, std::string_view words);
  /// A word for the log of what is drawn, where a test wants to know something that is a
  /// picture: "hand sign fist". With a place it is a widget of this name, to be pointed at.
  void note_drawn(std::string_view what, const Rect& place = {});

 private:
  struct Implementation;
  struct Press;
  struct ButtonWords;
  [[nodiscard]] Press press_on(const Rect& place, const ButtonStyle& style);
  void log_widget(std::string_view name, std::string_view label, const Chord& key,
                  const Rect& place, bool enabled);
  void log_text(std::string_view words);
  /// `line`: its words, the box that it belongs in, and whether they were cut.
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
