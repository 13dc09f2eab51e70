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

/// Fixed notation with two decimals, whatever the locale.
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

Perceiver SimulatedParticipant::perceiver(const Block& block) const {
  if (laboratory_.effects.empty()) {
    return block.is_pressed() ? pressing_perceiver_.value() : perceiver_;
  }
  return {laboratory_, affected(laboratory_, person_, seed_, block.levels), seed_,
          block.is_pressed() ? Perceiver::Feels::kStiffness : Perceiver::Feels::kDamping};
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
  // The way down and the way up are each half a stroke: mid-way between the two the hand is as
  // high as both.
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

std::string SimulatedParticipant::answer(const PostExperimentItem& item) const {
  core::RandomStream stream(seed_, "post_experiment/" + item.name);
  if (item.answer == "yes_no")
    return stream.with_probability(laboratory_.answers.solid_probability) ? "yes" : "no";
  std::string words = "simulated";
  for (int word = 1; word < item.num_words; ++word) words += ", simulated";
  return words;
}

}  // namespace jnd::experiments
