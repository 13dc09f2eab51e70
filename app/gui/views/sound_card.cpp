#include "app/gui/views/sound_card.h"

#include <algorithm>
#include <cstddef>

#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/sound/sound_settings.h"

namespace jnd::app::gui {
namespace {

constexpr std::size_t kMostOutputs = 6;

/// Draws the outputs below each other. The key chooses the next one.
bool draw_outputs(Ui& ui, Rect& inside, const SoundModel& model, std::string& output) {
  std::vector<SoundModel::Output> all(
      model.outputs.begin(), model.outputs.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                         model.outputs.size(), kMostOutputs)));
  all.push_back({.name = kSoundOff, .description = tr("nothing is played")});
  const auto now = std::ranges::find(all, output, &SoundModel::Output::name);
  const auto current = static_cast<std::size_t>(now - all.begin());
  bool changed = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_next = i == (now == all.end() ? 0 : (current + 1) % all.size());
    std::string kind = all[i].description;
    if (all[i].name != kSoundOff && !all[i].is_calibrated) {
      kind += (kind.empty() ? "" : ", ") + std::string(tr("not calibrated"));
    }
    const std::string label = all[i].name == kSoundOff ? tr("Off") : all[i].name;
    if (draw_choice(ui, "sound_" + all[i].name, inside.take_top(40, 4), label, kind,
                    is_next ? Chord{letter('S')} : Chord{}, i == current,
                    /*any_length=*/all[i].name != kSoundOff) &&
        i != current) {
      output = all[i].name;
      changed = true;
    }
  }
  return changed;
}

}  // namespace

std::string sound_obstacle(const SoundModel& model) {
  return model.is_wanted && model.is_required ? model.problem : "";
}

PreflightLine sound_line(const SoundModel& model, const std::string& output) {
  using Status = PreflightLine::Status;
  if (model.problem.empty()) {
    return {.name = tr("Sound"), .status = Status::kOk, .found = output, .remedy = ""};
  }
  return {.name = tr("Sound"),
          .status = model.is_required ? Status::kFailed : Status::kWarning,
          .found = output == kSoundOff ? tr("off") : tr("cannot be heard"),
          .remedy = model.problem};
}

SoundCardResult draw_sound_card(Ui& ui, Rect& inside, const SoundModel& model,
                                std::string& output) {
  SoundCardResult result;
  if (!model.is_wanted) return result;
  Rect head = inside.take_top(42, 6);
  const ButtonStyle style{.key = {letter('T')}, .enabled = model.problem.empty()};
  const char* label = model.is_tested ? tr("End the test") : tr("Test the sound");
  if (ui.button("sound_test", head.take_right(ui.button_width(label, style), 16), label,
                style)) {
    result.test = true;
  }
  ui.heading(head.middle(head.width, 18), tr("Sound for the participant"));
  result.output_changed = draw_outputs(ui, inside, model, output);
  inside.take_top(4);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  TextStyle wrong = soft;
  wrong.colour = model.is_required ? Colour::kRed : Colour::kAmber;
  const auto say = [&](const std::string& words, const TextStyle& style_of_words) {
    ui.text(inside.take_top(ui.text_height(inside.width, words, style_of_words), 4), words,
            style_of_words);
  };
  if (!model.problem.empty()) say(model.problem, wrong);
  for (const std::string& level : model.levels) say(level, soft);
  say(model.is_tested ? tr("It comes up slowly, with a cue every second.")
                      : tr("Put the headphones on yourself first."),
      soft);
  inside.take_top(16);
  return result;
}

}  // namespace jnd::app::gui
