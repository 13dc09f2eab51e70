#include "experiments/participants/median_person.h"

#include <cmath>

#include "core/error.h"
#include "experiments/participants/calculated_stroke.h"
#include "experiments/participants/effects.h"
#include "experiments/procedures/stimulus.h"

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
  for (Laboratory::Effect& effect : laboratory.effects) {
    effect.weber_fraction_sd_ln = effect.pse_sd_ln = effect.exponent_sd = 0.0;
    effect.magnitude_sd_ln = 0.0;
  }
  return laboratory;
}

namespace {

/// Computes what the median person feels in a block of fluids.
class Felt {
 public:
  Felt(const Laboratory& laboratory, const Block& block, const core::ForceMap* map)
      : laboratory_(laboratory), block_(block), map_(map) {
    if (!block.reference_intensity || !(*block.reference_intensity > 0.0)) {
      throw core::Error("block: expected a reference > 0 for a Weber fraction, found none");
    }
  }

  /// Returns the felt damping in N s/m, including that of the device.
  double operator()(double intensity) const {
    return laboratory_.device.mechanical_viscosity_n_s_per_m +
           calculated_stroke(laboratory_, laboratory_.strokes_for(block_.procedure).amplitude_m,
                             laboratory_.movement.max_speed_m_per_s,
                             amounts_of(setting_of(block_, "test", intensity)), map_)
               .delivered_damping_n_s_per_m;
  }

  /// Returns the intensity between these two that feels like `wanted`. The first of them must
  /// feel weaker.
  [[nodiscard]] double intensity_at(double wanted, double low, double high) const {
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = 0.5 * (low + high);
      ((*this)(middle) < wanted ? low : high) = middle;
    }
    return low;
  }

 private:
  const Laboratory& laboratory_;
  const Block& block_;
  const core::ForceMap* map_;
};

}  // namespace

double median_weber_fraction(const Laboratory& laboratory, const Block& block,
                             const core::ForceMap* map) {
  const Felt felt(laboratory, block, map);
  const double factor = effects_on(laboratory, block.levels).weber_fraction_factor;
  if (block.is_pressed()) return factor * laboratory.pressing.value().weber_fraction;
  const double reference = *block.reference_intensity;
  const double wanted = (1.0 + factor * laboratory.perceiver.weber_fraction) * felt(reference);
  double high = 2.0 * reference;
  while (felt(high) < wanted && high < 1e9 * reference) high *= 2.0;
  return felt.intensity_at(wanted, reference, high) / reference - 1.0;
}

double median_curve_fraction(const Laboratory& laboratory, const Block& block,
                             const core::ForceMap* map) {
  const double up = median_weber_fraction(laboratory, block, map);
  if (block.is_pressed()) return up;
  const Felt felt(laboratory, block, map);
  const double reference = *block.reference_intensity;
  const double factor = effects_on(laboratory, block.levels).weber_fraction_factor;
  const double wanted = felt(reference) / (1.0 + factor * laboratory.perceiver.weber_fraction);
  const double least = 1e-9 * reference;
  if (!(felt(least) < wanted)) return up;
  const double down = reference / felt.intensity_at(wanted, least, reference);
  return std::sqrt((1.0 + up) * down) - 1.0;
}

}  // namespace jnd::experiments
