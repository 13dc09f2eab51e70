#include "analysis/results/discrimination_own_values.h"

#include "analysis/fits/psychometric_warnings.h"

namespace jnd::analysis {
namespace {

/// The number of redraws. The smallest possible p value is 1 / (this number + 1).
constexpr int kOwnRedraws = 1000;

}  // namespace

void add_own_values(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                    const BlockDesign& block, const ResultsOptions& options) {
  std::size_t num_done = 0;
  for (const DiscriminationAnswers& answers : all) {
    core::tell(options.on_progress, num_done++, all.size());
    const auto add = [&](const std::string& name, const std::optional<double>& value,
                         const Interval& ci95, const std::string& reason) {
      section.participants.push_back(
          {answers.participant, block.block + "." + name, value, ci95, reason});
    };
    const auto fit_of = [&](bool free_pse) {
      return own_fit(answers, {.free_pse = free_pse,
                               .intervals = true,
                               .num_calibration = kOwnRedraws,
                               .num_goodness = kOwnRedraws,
                               .seed = options.seed});
    };
    const PsychometricFit fixed = fit_of(false);
    const PsychometricFit free = fit_of(true);
    add("weber_fraction", fixed.weber_fraction, fixed.weber_fraction_ci95, fixed.reason);
    section.participants.back().is_separated = fixed.is_separated;
    if (fixed.weber_fraction && all_alike(answers.rows())) {
      section.participants.back().cautions.emplace_back(kAllAlike);
    }
    add("weber_fraction_free_pse", free.weber_fraction, free.weber_fraction_ci95, free.reason);
    section.participants.back().is_separated = free.is_separated;
    // Charts that draw the curve of the first fit need this.
    if (fixed.order_effect_ln) {
      add("order_effect_ln_at_reference", fixed.order_effect_ln, {}, "");
    }
    add("pse", free.pse, free.pse_ci95.value_or(Interval{}), why_no_pse(free));
    if (fixed.goodness.p_value) add("goodness_p", fixed.goodness.p_value, {}, "");
    if (free.goodness.p_value) add("goodness_p_free_pse", free.goodness.p_value, {}, "");
  }
}

FitsBorne fits_borne(const ResultsSection& section, const std::string& block) {
  FitsBorne borne;
  for (const ParticipantEstimate& own : section.participants) {
    if (own.name != block + ".goodness_p" || !own.value) continue;
    ++borne.num_fits;
    borne.num_rejected += *own.value < kRejectedBelow ? 1 : 0;
  }
  return borne;
}

}  // namespace jnd::analysis
