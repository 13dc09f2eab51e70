#include "app/gui/views/participant_screen_dialog.h"

#include <cstddef>

#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {

ParticipantScreenResult draw_participant_screen_dialog(Ui& ui, const ScreenChoice& choice,
                                                       const std::vector<Monitor>& monitors,
                                                       const std::string& problem) {
  constexpr float kWidth = 600;
  constexpr float kInside = kWidth - 2 * 28;
  constexpr float kRow = 44;
  constexpr float kBetween = 6;
  const std::vector<ScreenOption> options = screen_options(choice, monitors);
  const std::string meaning = monitors.size() < 2
                                  ? tr("Only one monitor is plugged in. A window can stand "
                                       "beside this one; where there "
                                       "is no room beside, it stands behind.")
                                  : tr("What the participant is to see fills the monitor. It "
                                       "is remembered for the next "
                                       "sessions on this machine.");
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const TextStyle red{.colour = Colour::kRed, .wrap = true};
  const float meaning_height = ui.text_height(kInside, meaning, soft);
  const float problem_height =
      problem.empty() ? 0 : ui.text_height(kInside, problem, red) + kGap;
  Rect inside =
      ui.begin_dialog("participant_screen", kWidth,
                      2 * 28 + 34 + 8 + meaning_height + kGap + problem_height +
                          static_cast<float>(options.size()) * (kRow + kBetween) + kGap + 44);
  ui.text(inside.take_top(34, 8), tr("The participant's screen"), {.font = Font::kLarge});
  ui.text(inside.take_top(meaning_height, kGap), meaning, soft);
  if (!problem.empty()) {
    ui.text(inside.take_top(problem_height - kGap, kGap), problem, red);
  }
  ParticipantScreenResult result;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const ScreenOption& option = options[i];
    if (draw_choice(ui, "screen_" + std::to_string(i), inside.take_top(kRow, kBetween),
                    option.label, option.kind, key_of_choice(i), option.choice == choice)) {
      result.chosen = option.choice;
    }
  }
  Rect row = inside.take_bottom(44);
  const ButtonStyle close{.tone = Tone::kPrimary, .key = {Key::kF9}};
  const Rect place = row.take_right(ui.button_width(tr("Close"), close));
  result.is_closed = ui.button("screen_close", place, tr("Close"), close);
  result.is_closed |= ui.pressed({Key::kF2});
  ui.end_dialog();
  return result;
}

}  // namespace jnd::app::gui
