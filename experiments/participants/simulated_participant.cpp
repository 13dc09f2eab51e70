#include "experiments/participants/simulated_participant.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/participants/effects.h"

namespace jnd::experiments {
namespace {

/// Formats with two decimals, whatever the locale.
std::string two_decimals(double value) {
  char digits[32];
  char* const end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 2).ptr;
  return {digits, end};
}

}  // namespace

SimulatedParticipant::SimulatedParticipant(const Laboratory& laboratory,
                                           std::uint64_t session_seed)
    : laboratory_(laboratory),
      seed_(session_seed),
      person_(draw_person(laboratory, session_seed)),
      perceiver_(laboratory, person_, session_seed) {
  if (laboratory.pressing) {
    pressing_perceiver_.emplace(laboratory, person_, session_seed,
                                Perceiver::Feels::kStiffness);
  }
}

Perceiver SimulatedParticipant::perceiver(const Block& block, std::string_view interval) const {
  const bool is_pressed = block.is_pressed_in(interval);
  if (laboratory_.effects.empty()) {
    return is_pressed ? pressing_perceiver_.value() : perceiver_;
  }
  return {laboratory_, affected(laboratory_, person_, seed_, block.levels), seed_,
          is_pressed ? Perceiver::Feels::kStiffness : Perceiver::Feels::kDamping};
}

double SimulatedParticipant::standard_as_test_ln(const Block& block, double standard_ln) const {
  if (block.is_pressed_in("reference") == block.is_pressed()) return standard_ln;
  return perceiver(block).reading_of_magnitude_ln(
      perceiver(block, "reference").magnitude_of_reading_ln(standard_ln));
}

double SimulatedParticipant::home_height_m() const {
  // The fluid has no bottom, but the hand has to be in it.
  return std::min(person_.hand_height_m - laboratory_.movement.surface_height_m, -0.1);
}

StrokeIntent SimulatedParticipant::strokes(const std::string& procedure) const {
  const Laboratory::Strokes& habit = laboratory_.strokes_for(procedure);
  const double amplitude_m =
      habit.amplitude_m * std::exp(habit.amplitude_sd_ln * person_.amplitude_score);
  const double period_s = 2.0 * std::numbers::pi * amplitude_m / person_.max_speed_m_per_s;
  return {.amplitude_m = amplitude_m,
          .max_speed_m_per_s = person_.max_speed_m_per_s,
          .height_m = home_height_m(),
          .num_strokes = habit.strokes_per_presentation,
          .period_s = period_s};
}

StrokeIntent SimulatedParticipant::presses(const std::string& procedure,
                                           double surface_m) const {
  if (!laboratory_.pressing) {
    throw core::Error("laboratory " + laboratory_.name +
                      ": expected /pressing for a solid, found none");
  }
  const Laboratory::Pressing& habit = *laboratory_.pressing;
  // The way down and the way up are each half a stroke. Their midpoint is half way between the
  // upper and the lower end.
  return {.amplitude_m = habit.sideways_m,
          .max_speed_m_per_s = 2.0 * std::numbers::pi * habit.sideways_m / habit.period_s,
          .height_m = surface_m + 0.5 * (habit.lift_m - habit.depth_m),
          .num_strokes = laboratory_.strokes_for(procedure).strokes_per_presentation,
          .period_s = habit.period_s,
          .lift_m = 0.5 * (habit.lift_m + habit.depth_m)};
}

StrokeIntent SimulatedParticipant::hover(double surface_m) const {
  constexpr double kClearanceM = 0.05, kWidestM = 0.05;
  StrokeIntent intent = strokes("");
  intent.amplitude_m = std::min(intent.amplitude_m, kWidestM);
  intent.height_m = surface_m + kClearanceM;
  intent.lift_m = 0.0;
  return intent;
}

std::string SimulatedParticipant::answer(const QuestionnaireItem& item) const {
  core::RandomStream stream(seed_, "questionnaire/" + item.name);
  if (item.name == "body_height_m") return two_decimals(person_.body_height_m);
  if (item.name == "handedness") return person_.right_handed ? "right" : "left";
  const Laboratory::Answers& habit = laboratory_.answers;
  if (item.kind == "number") {
    double value = person_.age_years;
    if (item.minimum) value = std::max(value, *item.minimum);
    if (item.maximum) value = std::min(value, *item.maximum);
    return two_decimals(value);
  }
  if (item.kind == "choice") return item.options.at(stream.below(item.options.size())).value;
  if (item.kind == "yes_no")
    return stream.with_probability(habit.yes_probability) ? "yes" : "no";
  if (item.kind == "yes_no_which") {
    return stream.with_probability(habit.yes_probability) ? "yes: a simulated answer" : "no";
  }
  if (item.kind == "scale") {
    const double step = stream.normal(habit.scale_step_ratio, habit.scale_step_sd_ratio);
    const auto good = static_cast<int>(std::lround(1.0 + step * (item.num_steps - 1)));
    const int clamped = std::clamp(good, 1, item.num_steps);
    const bool goes_up = item.high_is_good.value_or(true);
    return std::to_string(goes_up ? clamped : item.num_steps + 1 - clamped);
  }
  return "a simulated answer";
}

std::string SimulatedParticipant::answer(const QuestionnaireItem& item,
                                         const TrialFeeling& feeling) const {
  core::RandomStream stream(seed_, "question/" + item.name,
                            {feeling.moment.trial, feeling.moment.attempt});
  double ratio = 0.0;
  const auto known = laboratory_.questions.find(item.name);
  if (known == laboratory_.questions.end()) {
    const Laboratory::Answers& habit = laboratory_.answers;
    ratio = stream.normal(habit.scale_step_ratio, habit.scale_step_sd_ratio);
  } else {
    const Laboratory::Question& habit = known->second;
    ratio = (habit.follows == "certainty" ? feeling.certainty_ratio : feeling.magnitude_ratio) +
            habit.noise_sd_ratio * stream.normal();
  }
  ratio = std::clamp(ratio, 0.0, 1.0);
  if (item.kind == "scale") {
    return std::to_string(1 + std::lround(ratio * (item.num_steps - 1)));
  }
  if (item.kind == "number") {
    const double least = item.minimum.value_or(std::min(0.0, item.maximum.value_or(0.0)));
    const double greatest = item.maximum.value_or(least + 100.0);
    return two_decimals(std::clamp(
        std::round(100.0 * (least + ratio * (greatest - least))) / 100.0, least, greatest));
  }
  if (item.kind == "choice") {
    const auto count = static_cast<double>(item.options.size());
    const auto place = static_cast<std::size_t>(std::min(ratio * count, count - 1.0));
    return item.options.at(place).value;
  }
  if (item.kind == "yes_no") return ratio >= 0.5 ? "yes" : "no";
  if (item.kind == "yes_no_which") return ratio >= 0.5 ? "yes: a simulated answer" : "no";
  return "a simulated answer";
}

std::string SimulatedParticipant::answer(const PostExperimentItem& item) const {
  core::RandomStream stream(seed_, "post_experiment/" + item.name);
  if (item.answer == "yes_no")
    return stream.with_probability(laboratory_.answers.solid_probability) ? "yes" : "no";
  std::string words = "simulated";
  for (int word = 1; word < item.num_words; ++word) words += ", simulated";
  return words;
}

}  // namespace jnd::experiments
