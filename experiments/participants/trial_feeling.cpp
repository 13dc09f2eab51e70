#include "experiments/participants/trial_feeling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/participants/calculated_stroke.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"

namespace jnd::experiments {
namespace {

/// Sums the readings of one stimulus in a trial.
struct MeanReading {
  double sum_ln = 0.0;
  int num = 0;

  void add(double reading_ln) {
    sum_ln += reading_ln;
    ++num;
  }
  [[nodiscard]] double ln() const { return sum_ln / std::max(num, 1); }
};

class TrialSenses {
 public:
  TrialSenses(const Laboratory& laboratory, const SimulatedParticipant& participant,
              const Block& block, const core::ForceMap* map)
      : laboratory_(laboratory), participant_(participant), block_(block), map_(map) {}

  /// Returns what a stimulus feels like without noise: a damping in N s/m, or for a solid a
  /// stiffness in N/m.
  [[nodiscard]] double felt(const std::string& interval, double intensity,
                            const std::optional<double>& delivered) const {
    if (block_.is_pressed()) return intensity;
    return delivered.value_or(calculated(interval, intensity)) +
           laboratory_.device.mechanical_viscosity_n_s_per_m;
  }

  /// Returns the remembered reading of a stimulus in the block's range.
  [[nodiscard]] double remembered_ln(double intensity) const {
    return std::log(std::max(felt("test", intensity, std::nullopt), 1e-6));
  }

 private:
  [[nodiscard]] double calculated(const std::string& interval, double intensity) const {
    const core::MediumAmounts medium = amounts_of(setting_of(block_, interval, intensity));
    if (medium.is_plain_damping()) return medium.damping_n_s_per_m;
    const StrokeIntent strokes = participant_.strokes(block_.procedure);
    return calculated_stroke(laboratory_, strokes.amplitude_m, strokes.max_speed_m_per_s,
                             medium, map_)
        .delivered_damping_n_s_per_m;
  }

  const Laboratory& laboratory_;
  const SimulatedParticipant& participant_;
  const Block& block_;
  const core::ForceMap* map_;
};

double certainty(const Perceiver& person, const Block& block, const MeanReading& test,
                 const MeanReading& reference, const Moment& moment) {
  if (test.num == 0) return 0.0;
  switch (procedure_named(block.procedure).measures(block)) {
    case Measure::kComparison:
      return person.certainty_of_thicker(test.ln(), reference.ln(), test.num, moment);
    case Measure::kDifference:
      return person.certainty_of_different(test.ln(), reference.ln(), test.num, moment);
    case Measure::kDetection:
      return person.certainty_of_present(test.ln(), person.free_space_ln(), test.num, moment);
    case Measure::kMagnitude:
    case Measure::kProducedMagnitude:
    case Measure::kMatch:
    case Measure::kRating:
    case Measure::kIdentification:
      break;
  }
  return 0.0;
}

}  // namespace

std::int64_t trial_in_block(const Block& block, const PlannedTrial& trial) {
  const std::size_t num_pairs =
      block.intensities.size() * std::max<std::size_t>(1, block.standards.size());
  const auto per_repetition = static_cast<std::int64_t>(num_pairs) + num_catch_trials(block);
  return (trial.repetition - 1) * per_repetition + trial.position;
}

TrialFeeling feeling_of(const Laboratory& laboratory, const SimulatedParticipant& participant,
                        const Block& block, std::int64_t number, const TrialState& trial,
                        const core::ForceMap* map) {
  const TrialSenses senses(laboratory, participant, block, map);
  const Perceiver& person = participant.perceiver(block);
  TrialFeeling feeling{.moment = {.trial = number,
                                  .attempt = trial.attempt,
                                  .presentation = 0,
                                  .trial_in_block = trial_in_block(block, trial.planned)}};
  const bool adjusts = procedure_named(block.procedure).form(block).adjustable;
  MeanReading test, reference;
  std::array<MeanReading, 3> intervals;
  for (const PresentationState& presented : trial.presentations) {
    ++feeling.moment.presentation;
    if (presented.interval == "free_space") continue;
    const double reading_ln =
        person.reading_ln(senses.felt(presented.interval, presented.intensity,
                                      presented.delivered_damping_n_s_per_m),
                          feeling.moment);
    if (presented.place > 0)
      intervals.at(static_cast<std::size_t>(presented.place) - 1).add(reading_ln);
    if (presented.interval == "reference") {
      reference.add(reading_ln);
    } else {
      if (adjusts) test = {};
      test.add(reading_ln);
    }
  }
  feeling.certainty_ratio = certainty(person, block, test, reference, feeling.moment);
  if (intervals.front().num > 0) {
    const std::array readings = {intervals[0].ln(), intervals[1].ln(), intervals[2].ln()};
    feeling.certainty_ratio = person.certainty_of_choice(task_of(block), readings,
                                                         intervals.front().num, feeling.moment);
  }
  if (test.num > 0) {
    feeling.magnitude_ratio = magnitude_ratio(laboratory, participant, block, test.ln(), map);
  }
  return feeling;
}

double magnitude_ratio(const Laboratory& laboratory, const SimulatedParticipant& participant,
                       const Block& block, double reading_ln, const core::ForceMap* map) {
  const TrialSenses senses(laboratory, participant, block, map);
  const std::vector<double> possible =
      procedure_named(block.procedure).possible_intensities(block);
  if (possible.empty()) return 0.0;
  const auto [weakest, strongest] = std::ranges::minmax(possible);
  const double least_ln = senses.remembered_ln(weakest);
  const double range_ln = senses.remembered_ln(strongest) - least_ln;
  return range_ln > 0.0 ? (reading_ln - least_ln) / range_ln : 0.0;
}

}  // namespace jnd::experiments
