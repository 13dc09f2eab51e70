#include "experiments/participants/counting.h"

#include <cmath>

#include "experiments/participants/calculated_stroke.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/stimulus.h"

namespace jnd::experiments {
namespace {

double remembered_ln(const Laboratory& laboratory, const SimulatedParticipant& participant,
                     const Block& block, const core::ForceMap* map) {
  const double standard = block.standards.at(0);
  if (block.is_pressed()) return std::log(standard);
  const StrokeIntent strokes = participant.strokes(block.procedure);
  const CalculatedStroke stroke =
      calculated_stroke(laboratory, strokes.amplitude_m, strokes.max_speed_m_per_s,
                        amounts_of(setting_of(block, "reference", standard)), map);
  return std::log(stroke.delivered_damping_n_s_per_m +
                  laboratory.device.mechanical_viscosity_n_s_per_m);
}

}  // namespace

Counting counting_of(const Laboratory& laboratory, const SimulatedParticipant& participant,
                     const Block& block, std::optional<double> felt_standard_ln,
                     const core::ForceMap* map) {
  switch (modulus_of(block)) {
    case Modulus::kFree:
      return {.number = participant.person().free_modulus, .in_round_numbers = false};
    case Modulus::kStandard:
      return {.number = block.settings.number("modulus_value"),
              .standard_ln = felt_standard_ln
                                 ? felt_standard_ln
                                 : remembered_ln(laboratory, participant, block, map)};
    case Modulus::kWater:
      break;
  }
  return {};
}

}  // namespace jnd::experiments
