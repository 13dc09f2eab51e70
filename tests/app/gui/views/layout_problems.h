#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Finds the layout problems of a frame: words that are cut or leave their box, and things that
/// overlap. Each problem has one sentence. Whatever is below a dialog does not count.
class LayoutProblems {
 public:
  explicit LayoutProblems(const Drawn& drawn, const Rect& screen) : screen_(screen) {
    for (const Drawn::Line& line : drawn.lines) {
      if (!line.is_covered) lines_.push_back(line);
    }
    for (const Drawn::Widget& widget : drawn.widgets) {
      const bool is_seen = widget.place.width > 0 && widget.place.height > 0;
      if (is_seen && !widget.is_covered) widgets_.push_back(widget);
    }
    look_at_lines();
    look_at_widgets();
  }
  [[nodiscard]] const std::vector<std::string>& sentences() const noexcept {
    return sentences_;
  }

 private:
  // Rounding moves a place by up to a pixel, and letters do not fill the whole height of their
  // line.
  static constexpr float kRounding = 1.5f;
  static constexpr float kBetweenLines = 4.0f;

  static bool holds(const Rect& outer, const Rect& inner) {
    return inner.x >= outer.x - kRounding && inner.y >= outer.y - kBetweenLines &&
           inner.right() <= outer.right() + kRounding &&
           inner.bottom() <= outer.bottom() + kBetweenLines;
  }
  static bool meets(const Rect& one, const Rect& other, float least_height) {
    const Rect both = one.common(other);
    return both.width > kRounding && both.height > least_height;
  }
  void say(const std::string& what, const std::string& words) {
    sentences_.push_back(what + ": \"" + words + "\"");
  }

  void look_at_lines() {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Drawn::Line& line = lines_[i];
      // Values and people's own texts have any length. An ellipsis is right there, if the whole
      // text shows when the mouse is over it. The program's own words must have room.
      if (line.is_cut && !line.shows_whole) say("cut", line.words);
      if (!holds(screen_, line.place)) say("outside of the window", line.words);
      // A box without a height takes as many lines as the text needs.
      if (line.box.height > 0 && line.place.bottom() > line.box.bottom() + kBetweenLines) {
        say("lower than its box", line.words);
      }
      for (std::size_t k = 0; k < i; ++k) {
        if (!meets(line.place, lines_[k].place, kBetweenLines)) continue;
        say("on \"" + lines_[k].words + "\"", line.words);
      }
      for (const Drawn::Widget& widget : widgets_) {
        if (!meets(line.place, widget.place, kBetweenLines)) continue;
        if (holds(widget.place, line.place)) continue;
        say("over the edge of the widget " + widget.name, line.words);
      }
    }
  }
  void look_at_widgets() {
    for (std::size_t i = 0; i < widgets_.size(); ++i) {
      if (!holds(screen_, widgets_[i].place)) say("outside of the window", widgets_[i].name);
      for (std::size_t k = 0; k < i; ++k) {
        const Rect &one = widgets_[i].place, &other = widgets_[k].place;
        if (!meets(one, other, kRounding) || holds(one, other) || holds(other, one)) continue;
        say("a widget on the widget " + widgets_[k].name, widgets_[i].name);
      }
    }
  }

  Rect screen_;
  std::vector<Drawn::Line> lines_;
  std::vector<Drawn::Widget> widgets_;
  std::vector<std::string> sentences_;
};

}  // namespace jnd::app::gui
