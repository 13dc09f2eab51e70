#include "app/gui/views/participant_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "app/gui/hand_sign.h"
#include "app/gui/text_layout.h"
#include "app/gui/views/stack.h"

namespace jnd::app::gui {
namespace {

/// The size of everything on the screen. The first of the sizes in which everything fits is
/// used.
struct LetterSize {
  Font text, detail;
  float gap;
  float sign_share;  ///< A share of the screen's height.
};
constexpr LetterSize kLetterSizes[] = {{Font::kHuge, Font::kTitle, 30, 0.42f},
                                       {Font::kTitle, Font::kAnswer, 22, 0.36f},
                                       {Font::kAnswer, Font::kLarge, 16, 0.30f},
                                       {Font::kLarge, Font::kBody, 12, 0.24f},
                                       {Font::kBody, Font::kBody, 8, 0.18f}};

/// The margin as a share of the screen's width and height.
constexpr float kMargin = 0.06f;
constexpr float kFoot = 40;

TextStyle centred(Font font, Colour colour = Colour::kInk) {
  return {.font = font, .colour = colour, .align = Align::kCentre, .wrap = true};
}

float widest_word(const Ui& ui, std::string_view text, Font font) {
  float widest = 0;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of(" \n");
    widest = std::max(widest, ui.text_width(text.substr(0, end), font));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return widest;
}

/// The contents in one size, and whether they fit.
class ParticipantLayout {
 public:
  ParticipantLayout(Ui& ui, const ParticipantScreen& shown, const LetterSize& size,
                    const Rect& room)
      : ui_(ui), shown_(shown), size_(size), room_(room), stack_(ui) {
    add_sign();
    // The text above a consent is only its title.
    add_words(shown.text, shown.paragraphs.empty() ? size.text : size.detail, Colour::kInk);
    if (!shown.countdown.empty()) add_line(shown.countdown, Font::kHuge);
    add_consent();
    add_scale();
    add_words(shown.range, size.detail, Colour::kSoft);
    add_choices();
    add_words(shown.you_said, size.detail, Colour::kSoft, size.gap / 4);
    if (!shown.said.empty()) add_line(shown.said, Font::kHuge);
  }
  [[nodiscard]] bool fits() const { return !has_wide_word_ && stack_.height() <= room_.height; }
  void draw() { stack_.draw(room_); }

 private:
  void look_at_words(std::string_view words, Font font, float width) {
    has_wide_word_ |= widest_word(ui_, words, font) > width;
  }
  void add_words(std::string_view words, Font font, Colour colour, float gap = -1) {
    look_at_words(words, font, room_.width);
    stack_.add_text(words, font, colour, room_.width, gap < 0 ? size_.gap : gap);
  }
  void add_line(const std::string& words, Font font) {
    has_wide_word_ |= ui_.text_width(words, font) > room_.width;
    stack_.add(ui_.line_height(font), size_.gap, [this, words, font](const Rect& place) {
      ui_.text(place, words, {.font = font, .align = Align::kCentre});
    });
  }
  void add_sign() {
    if (shown_.sign == HandSign::kNone) return;
    const float side = std::min(420.0f, ui_.screen().height * size_.sign_share);
    stack_.add(side, size_.gap, [this, side](const Rect& place) {
      draw_hand_sign(ui_, place.middle(side, side), shown_.sign, Colour::kInk, Colour::kGround);
    });
  }
  void add_consent() {
    for (const std::string& paragraph : shown_.paragraphs) {
      const TextStyle style{.font = size_.text, .wrap = true};
      look_at_words(paragraph, size_.text, room_.width);
      stack_.add(
          ui_.text_height(room_.width, paragraph, style), size_.gap / 2,
          [this, paragraph, style](const Rect& place) { ui_.text(place, paragraph, style); });
    }
    if (shown_.agreement.empty()) return;
    add_words(shown_.agree, size_.detail, Colour::kSoft, size_.gap / 4);
    add_words(shown_.agreement, size_.text, Colour::kBlue);
  }

  /// Adds a row of numbers, with the words of its two ends below.
  void add_scale() {
    if (shown_.num_steps < 2) return;
    constexpr float kBetween = 8;
    constexpr float kLeastBox = 30;
    const int count = shown_.num_steps;
    const float box = std::min(84.0f, (room_.width - kBetween * static_cast<float>(count - 1)) /
                                          static_cast<float>(count));
    const bool has_boxes =
        box >= std::max(kLeastBox, ui_.text_width(std::to_string(count), size_.detail) + 10);
    const float whole =
        has_boxes ? box * static_cast<float>(count) + kBetween * static_cast<float>(count - 1)
                  : room_.width;
    const float height = has_boxes ? std::max(box * 0.8f, ui_.line_height(size_.detail) + 8)
                                   : ui_.line_height(size_.detail) + 14;
    stack_.add(height, size_.gap / 2, [=, this](const Rect& strip) {
      const Rect row = strip.middle(whole, height);
      if (!has_boxes) return draw_line_of_scale(row);
      for (int step = 1; step <= count; ++step) {
        const Rect its{row.x + static_cast<float>(step - 1) * (box + kBetween), row.y, box,
                       height};
        ui_.fill(its, Colour::kCard, 10);
        ui_.outline(its, Colour::kLine, 10, 1.5f);
        ui_.text(its, std::to_string(step), {.font = size_.detail, .align = Align::kCentre});
      }
    });
    // The words may be wider than a short scale.
    const float wide = std::max(whole, room_.width * 0.7f);
    const float half = wide / 2 - size_.gap;
    for (const std::string& label : {shown_.low_label, shown_.high_label}) {
      look_at_words(label, size_.detail, half);
    }
    const TextStyle left{.font = size_.detail, .colour = Colour::kSoft, .wrap = true};
    const float labels = std::max(ui_.text_height(half, shown_.low_label, left),
                                  ui_.text_height(half, shown_.high_label, left));
    stack_.add(labels, size_.gap, [=, this](const Rect& strip) {
      Rect row = strip.middle(wide, labels);
      ui_.text(row.take_left(half), shown_.low_label, left);
      TextStyle right = left;
      right.align = Align::kRight;
      ui_.text(row.take_right(half), shown_.high_label, right);
    });
  }
  /// Draws a scale that has too many steps for boxes, as a line with its two end numbers.
  void draw_line_of_scale(const Rect& row) {
    ui_.line(row.x, row.bottom() - 4, row.right(), row.bottom() - 4, Colour::kInk, 2);
    ui_.text(row, "1", {.font = size_.detail});
    ui_.text(row, std::to_string(shown_.num_steps),
             {.font = size_.detail, .align = Align::kRight});
  }

  /// Adds the choices as cards, as many in a row as have room. Below each label stands the
  /// control that answers it.
  void add_choices() {
    if (shown_.choices.empty()) return;
    constexpr float kPad = 14;
    constexpr float kBetween = 12;
    const Font small = size_.detail == Font::kTitle    ? Font::kAnswer
                       : size_.detail == Font::kAnswer ? Font::kLarge
                                                       : Font::kBody;
    float card = 0;
    for (const ParticipantScreen::Choice& choice : shown_.choices) {
      card = std::max({card, ui_.text_width(choice.label, size_.detail),
                       ui_.text_width(choice.control, small)});
    }
    card = std::min(card + 2 * kPad + 24, room_.width);
    const float inner = card - 2 * kPad;
    float labels = 0;
    float controls = 0;
    for (const ParticipantScreen::Choice& choice : shown_.choices) {
      look_at_words(choice.label, size_.detail, inner);
      look_at_words(choice.control, small, inner);
      labels = std::max(labels, ui_.text_height(inner, choice.label, centred(size_.detail)));
      if (choice.control.empty()) continue;
      controls = std::max(controls, ui_.text_height(inner, choice.control, centred(small)));
    }
    const float height = labels + controls + 2 * kPad;
    const std::size_t count = shown_.choices.size();
    const auto most = std::max<std::size_t>(
        1, static_cast<std::size_t>((room_.width + kBetween) / (card + kBetween)));
    const std::size_t rows = (count + most - 1) / most;
    const std::size_t columns = (count + rows - 1) / rows;
    for (std::size_t first = 0; first < count; first += columns) {
      const std::size_t in_row = std::min(columns, count - first);
      const bool is_last = first + columns >= count;
      stack_.add(height, is_last ? size_.gap : kBetween, [=, this](const Rect& strip) {
        const auto num = static_cast<float>(in_row);
        Rect row = strip.middle(num * card + (num - 1) * kBetween, height);
        for (std::size_t i = first; i < first + in_row; ++i) {
          const ParticipantScreen::Choice& choice = shown_.choices[i];
          const Rect place = row.take_left(card, kBetween);
          ui_.fill(place, Colour::kCard, 12);
          ui_.outline(place, Colour::kLine, 12, 1.5f);
          Rect inside = place.inset(kPad);
          ui_.text(inside.take_top(labels), choice.label, centred(size_.detail));
          ui_.text(inside, choice.control, centred(small, Colour::kBlue));
        }
      });
    }
  }

  Ui& ui_;
  const ParticipantScreen& shown_;
  const LetterSize& size_;
  Rect room_;
  Stack stack_;
  bool has_wide_word_ = false;
};

/// Shows a consent that is too long for one page in the smallest letters, page by page. What is
/// agreed to is on each page.
void draw_pages(Ui& ui, const ParticipantScreen& shown, Rect room,
                ParticipantViewState& state) {
  constexpr Font kText = Font::kLarge;
  constexpr double kLettersPerS = 12.0;  // About 140 words a minute, so that nobody is hurried.
  constexpr double kLeastOfPage_s = 8.0;
  const TextStyle head = centred(kText, Colour::kSoft);
  ui.text(room.take_top(ui.text_height(room.width, shown.text, head), 12), shown.text, head);
  const TextStyle agreed = centred(kText, Colour::kBlue);
  const float height = ui.text_height(room.width, shown.agreement, agreed);
  ui.text(room.take_bottom(height, 4), shown.agreement, agreed);
  const TextStyle soft{.font = Font::kBody, .colour = Colour::kSoft, .align = Align::kCentre};
  ui.text(room.take_bottom(ui.line_height(Font::kBody), 12), shown.agree, soft);
  const Rect number = room.take_bottom(ui.line_height(Font::kBody), 8);

  std::vector<std::string_view> lines;
  std::size_t num_letters = 0;
  const Measure measure = [&ui](std::string_view text) { return ui.text_width(text, kText); };
  for (const std::string& paragraph : shown.paragraphs) {
    if (!lines.empty()) lines.emplace_back();
    const auto its = break_lines(paragraph, room.width, measure, false);
    lines.insert(lines.end(), its.begin(), its.end());
    num_letters += paragraph.size();
  }
  const float line = ui.line_height(kText);
  const auto most = std::max<std::size_t>(1, static_cast<std::size_t>(room.height / line));
  const std::size_t num_pages = (lines.size() + most - 1) / most;
  const double page_s =
      std::max(kLeastOfPage_s, static_cast<double>(num_letters) / kLettersPerS /
                                   static_cast<double>(num_pages));
  const double read_s = ui.time_s() - state.since_s;
  const auto page = static_cast<std::size_t>(std::max(0.0, read_s) / page_s) % num_pages;
  for (std::size_t i = page * most; i < std::min(lines.size(), (page + 1) * most); ++i) {
    ui.text(room.take_top(line), lines[i], {.font = kText});
  }
  ui.text(number, fmt::format(fmt::runtime(shown.page), page + 1, num_pages), soft);
}

}  // namespace

void draw_participant_view(Ui& ui, const ParticipantScreen& shown,
                           ParticipantViewState& state) {
  std::string read = shown.agreement;
  for (const std::string& paragraph : shown.paragraphs) read += paragraph;
  if (state.read != read) state = {.read = read, .since_s = ui.time_s()};

  Rect room = ui.screen();
  const Rect foot = room.take_bottom(kFoot);
  ui.progress(foot.middle(foot.width * 0.6f, 10), shown.done_ratio);
  const Rect whole = ui.screen();
  room = {whole.width * kMargin, whole.height * kMargin / 2, whole.width * (1 - 2 * kMargin),
          room.height - whole.height * kMargin / 2};
  for (const LetterSize& size : kLetterSizes) {
    ParticipantLayout layout(ui, shown, size, room);
    if (layout.fits()) return layout.draw();
  }
  if (!shown.paragraphs.empty()) return draw_pages(ui, shown, room, state);
  ParticipantLayout(ui, shown, kLetterSizes[std::size(kLetterSizes) - 1], room).draw();
}

}  // namespace jnd::app::gui
