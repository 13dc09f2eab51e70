#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <cctype>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "app/gui/input_queue.h"
#include "app/gui/theme.h"
#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Makes frames of the window without a display and without pixels. Presses, letters and clicks
/// wait in a queue until `frame` draws as many frames as they take.
class HeadlessUi {
 public:
  explicit HeadlessUi(float width = 1600, float height = 1000, float scale = 1.0f,
                      bool dark = false)
      : theme_(scale, dark), context_(make_context(theme_, width, height)), ui_(theme_) {}
  ~HeadlessUi() { ImGui::DestroyContext(context_); }
  HeadlessUi(const HeadlessUi&) = delete;
  HeadlessUi& operator=(const HeadlessUi&) = delete;

  using Draw = std::function<void(Ui&)>;

  /// Draws one frame, and more while input waits. Returns what the last one drew.
  const Drawn& frame(const Draw& draw) {
    int num_frames = 0;
    do {
      one_frame(draw);
    } while ((!queue_.empty() || ui_.wants_another_frame()) && ++num_frames < 200);
    return drawn_;
  }

  const Drawn& one_frame(const Draw& draw) {
    ImGui::SetCurrentContext(context_);
    ImGui::GetIO().DeltaTime = frame_s;
    ui_.begin_frame(queue_);
    draw(ui_);
    drawn_ = ui_.end_frame();
    std::set<std::string> names;
    for (const Drawn::Widget& widget : drawn_.widgets) {
      EXPECT_TRUE(names.insert(widget.name).second) << "drawn twice: " << widget.name;
    }
    for (const std::string& key : drawn_.shared_keys) {
      if (may_share_keys) break;
      ADD_FAILURE() << "more than one control of " << drawn_.view << " has the key " << key;
    }
    return drawn_;
  }

  void press(const Chord& chord) {
    hold(chord, 0);
    release(chord);
  }
  void press(Key key) { press(Chord{.key = key}); }
  /// Presses and repeats the key, without releasing it.
  void hold(const Chord& chord, int num_repeats) {
    queue_.key({.chord = chord, .action = KeyEvent::Action::kPress});
    write(chord);
    for (int i = 0; i < num_repeats; ++i) {
      queue_.key({.chord = chord, .action = KeyEvent::Action::kRepeat});
      write(chord);
    }
  }
  void release(const Chord& chord) {
    queue_.key({.chord = chord, .action = KeyEvent::Action::kRelease});
  }
  /// The text is ASCII.
  void type(std::string_view text) {
    for (const char c : text) {
      const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
      const Chord chord = {
          .key = letter(static_cast<char>(std::toupper(static_cast<unsigned char>(c)))),
          .shift = is_letter && std::isupper(static_cast<unsigned char>(c)) != 0};
      queue_.key({.chord = chord, .action = KeyEvent::Action::kPress});
      queue_.character(static_cast<std::uint32_t>(c));
      queue_.key({.chord = chord, .action = KeyEvent::Action::kRelease});
    }
  }

  /// Positions are in logical pixels, like everything that a test sees.
  void move(float x, float y) { queue_.mouse_moved(x * theme_.scale(), y * theme_.scale()); }
  void mouse_down() { queue_.mouse_button(true); }
  void mouse_up() { queue_.mouse_button(false); }
  void wheel(float steps) { queue_.wheel(steps); }
  void click(float x, float y) {
    move(x, y);
    mouse_down();
    mouse_up();
  }
  /// Clicks in the middle of what the last frame drew by this name. It takes effect with the
  /// next `frame`.
  void click(std::string_view name) {
    const Drawn::Widget* widget = drawn_.find(name);
    if (widget == nullptr) {
      ADD_FAILURE() << "no widget is called " << name;
      return;
    }
    EXPECT_TRUE(widget->enabled) << name;
    EXPECT_GT(widget->place.width * widget->place.height, 0) << name << " cannot be seen";
    click(widget->place.x + widget->place.width / 2,
          widget->place.y + widget->place.height / 2);
  }

  [[nodiscard]] const Drawn& drawn() const noexcept { return drawn_; }
  [[nodiscard]] Ui& ui() noexcept { return ui_; }
  [[nodiscard]] Theme& theme() noexcept { return theme_; }
  [[nodiscard]] InputQueue& queue() noexcept { return queue_; }

  bool may_share_keys = false;  ///< Two controls of a screen may use the same key.
  float frame_s = 1.0f / 60;    ///< Time between two frames.

 private:
  static ImGuiContext* make_context(Theme& theme, float width, float height) {
    ImGuiContext* context = ImGui::CreateContext();
    ImGui::SetCurrentContext(context);
    ImGuiIO& io = ImGui::GetIO();
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.DisplaySize = ImVec2(width * theme.scale(), height * theme.scale());
    theme.load_fonts();
    return context;
  }

  void write(const Chord& chord) {
    if (!is_printing(chord.key) || chord.control) return;
    const auto code = static_cast<int>(chord.key);
    queue_.character(static_cast<std::uint32_t>(chord.shift ? code : std::tolower(code)));
  }

  Theme theme_;
  ImGuiContext* context_;
  InputQueue queue_;
  Ui ui_;
  Drawn drawn_;
};

}  // namespace jnd::app::gui
