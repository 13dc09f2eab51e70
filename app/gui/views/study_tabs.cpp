#include "app/gui/views/study_tabs.h"

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

struct HeaderChip {
  const char* words;
  Colour colour;
};

std::vector<HeaderChip> chips_of(const StudyFolder& study) {
  std::vector<HeaderChip> chips;
  if (study.blinding == experiments::Blinding::kDouble) {
    chips.push_back({study.hides_levels ? tr("double-blind") : tr("unblinded"), Colour::kBlue});
  }
  if (study.is_backup) chips.push_back({tr("backup, read only"), Colour::kAmber});
  if (study.simulated) chips.push_back({tr("simulated data"), Colour::kAmber});
  return chips;
}

}  // namespace

StudyTab draw_tabs(Ui& ui, Rect& strip, const std::vector<StudyTabLook>& tabs, StudyTab current,
                   float kept) {
  const float room = std::max(1.0f, strip.width - kept);
  const auto style_of = [current](const StudyTabLook& tab, bool has_keys) {
    return ButtonStyle{.tone = Tone::kQuiet,
                       .key = {.key = letter(tab.digit), .control = true},
                       .selected = tab.tab == current,
                       .hides_key = !has_keys};
  };
  const auto wanted = [&](bool has_keys) {
    float width = 0;
    for (const StudyTabLook& tab : tabs) {
      width += ui.button_width(tr(tab.label), style_of(tab, has_keys));
    }
    return width;
  };
  const bool has_keys = wanted(true) <= room;
  const float shrink = std::min(1.0f, room / wanted(has_keys));
  StudyTab chosen = StudyTab::kNone;
  for (const StudyTabLook& tab : tabs) {
    const ButtonStyle style = style_of(tab, has_keys);
    const Rect its = strip.take_right(shrink * ui.button_width(tr(tab.label), style));
    if (ui.button(tab.name, its.middle(its.width, 36), tr(tab.label), style)) chosen = tab.tab;
  }
  return chosen;
}

StudyHeader draw_study_header(Ui& ui, const Rect& place, const StudyFolder& study,
                              StudyTab current, float own_width) {
  StudyHeader header;
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.bottom(), place.right(), place.bottom(), Colour::kLine);
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(20);
  if (own_width > 0) header.own_buttons = strip.take_right(own_width, 12);
  // The title keeps some room.
  constexpr float kLeastTitle = 150;
  const float name = ui.text_width("jnd", Font::kLarge) + 1 + 18;
  header.chosen = draw_tabs(ui, strip, study_tabs(), current, name + kLeastTitle + 12);
  ui.text(strip.take_left(ui.text_width("jnd", Font::kLarge) + 1, 18), "jnd",
          {.font = Font::kLarge});
  strip.take_right(12);
  const float title = ui.text_width(study.title, Font::kBody) + 2;
  float chips = 0;
  for (const HeaderChip& chip : chips_of(study)) chips += ui.chip_width(chip.words) + 10;
  // If there is no room for chips, the words in the middle of the view say the same.
  const bool has_chips = strip.width >= std::min(title, 180.0f) + 8 + chips;
  const float room = has_chips ? strip.width - chips - 8 : strip.width;
  const Rect words = strip.take_left(std::min(title, room), 18);
  ui.text(words, study.title, {.any_length = true});
  header.shows_marks = has_chips && study.simulated;
  if (!has_chips) return header;
  float x = strip.x;
  for (const HeaderChip& chip : chips_of(study)) {
    x += ui.chip(x, place.y + (place.height - 26) / 2, chip.words, chip.colour) + 10;
  }
  return header;
}

void draw_study_footer(Ui& ui, const Rect& place, const std::string& left,
                       const std::string& right, bool is_path) {
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.y, place.right(), place.y, Colour::kLine);
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(corner_look(ui).width, 20);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft};
  TextStyle at_right = soft;
  at_right.align = Align::kRight;
  at_right.any_length = is_path;
  const float gap = right.empty() ? 0.0f : 24.0f;
  const float of_left = ui.text_width(left, Font::kSmall) + 2;
  const float most = std::max(strip.width / 2, strip.width - of_left - gap);
  const float width = std::min(ui.text_width(right, Font::kSmall) + 2, most);
  if (!right.empty()) ui.text(strip.take_right(width, gap), right, at_right);
  TextStyle at_left = soft;
  at_left.any_length = true;
  ui.text(strip, left, at_left);
}

}  // namespace jnd::app::gui
