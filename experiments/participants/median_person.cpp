#include "experiments/participants/median_person.h"

#include "core/error.h"
#include "experiments/participants/calculated_stroke.h"
#include "experiments/session/stimulus.h"

namespace jnd::experiments {

Laboratory without_noise(Laboratory laboratory) {
  Laboratory::Perceiver& p = laboratory.perceiver;
  p.weber_fraction = 1e-9;
  p.free_modulus_sd_ln = 0.0;
  if (laboratory.pressing) {
    laboratory.pressing->weber_fraction = 1e-9;
    laboratory.pressing->weber_fraction_sd_ln = 0.0;
  }
  p.weber_fraction_sd_ln = p.criterion_sd_ln = p.exponent_sd = p.unit_sd_ln = p.shrink_sd_ln =
      0.0;
  p.criterion_drift_per_trial_ln = p.lapse_rate = p.learning_ratio = 0.0;
  p.fatigue_ratio_per_trial = p.look_again_probability = 0.0;
  laboratory.movement.max_speed_sd_ln = laboratory.movement.stroke_speed_sd_ratio = 0.0;
  for (auto& [procedure, strokes] : laboratory.strokes) strokes.amplitude_sd_ln = 0.0;
  return laboratory;
}

double median_weber_fraction(const Laboratory& laboratory, const Block& block,
                             const core::ForceMap* map) {
  if (!block.reference_intensity || !(*block.reference_intensity > 0.0)) {
    throw core::Error("block: expected a reference > 0 for a Weber fraction, found none");
  }
  if (block.is_solid()) return laboratory.pressing.value().weber_fraction;
  const double amplitude_m = laboratory.strokes_for(block.procedure).amplitude_m;
  const auto felt = [&](double intensity) {
    return laboratory.device.mechanical_viscosity_n_s_per_m +
           calculated_stroke(laboratory, amplitude_m, laboratory.movement.max_speed_m_per_s,
                             amounts_of(setting_of(block, "test", intensity)), map)
               .delivered_damping_n_s_per_m;
  };
  const double reference = *block.reference_intensity;
  const double wanted = (1.0 + laboratory.perceiver.weber_fraction) * felt(reference);
  double low = reference, high = 2.0 * reference;
  while (felt(high) < wanted && high < 1e9 * reference) high *= 2.0;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = 0.5 * (low + high);
    (felt(middle) < wanted ? low : high) = middle;
  }
  return low / reference - 1.0;
}

}  // namespace jnd::experiments
