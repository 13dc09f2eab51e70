#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "analysis/data/magnitude_means.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/study_results.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

/// The estimation and production of the same participants in one order, so that a draw takes
/// both parts of a person.
struct BothParts {
  MagnitudeBlock estimated, produced;
};

/// The curves of a draw. If a curve has no optimum, its reason replaces a combination.
struct BothCurves {
  PowerFit estimation, production;
  [[nodiscard]] bool exist() const { return estimation.k && production.k; }
  [[nodiscard]] core::PowerFunction first() const { return {*estimation.k, *estimation.a}; }
  [[nodiscard]] core::PowerFunction second() const { return {*production.k, *production.a}; }
  [[nodiscard]] PowerFit missing() const {
    return {.status = FitStatus::kDegenerate,
            .reason = !estimation.k ? said("the estimation has none: {}", estimation.reason)
                                    : said("the production has none: {}", production.reason)};
  }
};

BothCurves curves_of(const BothParts& parts, const std::vector<std::size_t>& drawn,
                     Solver solver) {
  return {fit_estimation(group_means(parts.estimated.means, drawn), PowerMethod::kNonlinear,
                         solver),
          fit_production(group_means(parts.produced.means, drawn), PowerMethod::kNonlinear,
                         solver)};
}

/// The curves of every draw. Each is computed once, however many combinations use it.
class DrawnCurves {
 public:
  explicit DrawnCurves(const BothParts& parts) : parts_(parts) {}

  const BothCurves& of(const std::vector<std::size_t>& drawn, Solver solver) {
    const auto [place, is_new] = known_.try_emplace({drawn, solver});
    if (is_new) place->second = curves_of(parts_, drawn, solver);
    return place->second;
  }

 private:
  const BothParts& parts_;
  std::map<std::pair<std::vector<std::size_t>, Solver>, BothCurves> known_;
};

/// The intensities that both parts cover: presented in the estimation, and set on average in
/// the production.
struct SharedRange {
  double low = 0.0, high = 0.0;
};

std::optional<SharedRange> shared_range(const BothParts& parts,
                                        const std::vector<std::size_t>& drawn) {
  SharedRange range{.low = 0.0, .high = std::numeric_limits<double>::infinity()};
  for (const bool production : {false, true}) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const auto& [x, mean] :
         group_means(production ? parts.produced.means : parts.estimated.means, drawn)) {
      const double intensity = production ? mean : x;
      if (!(intensity > 0.0)) continue;
      low = std::min(low, intensity);
      high = std::max(high, intensity);
    }
    range = {std::max(range.low, low), std::min(range.high, high)};
  }
  return range.low < range.high ? std::optional(range) : std::nullopt;
}

std::vector<double> within(const std::vector<double>& intensities, const SharedRange& range) {
  std::vector<double> inside;
  for (const double intensity : intensities) {
    if (intensity >= range.low && intensity <= range.high) inside.push_back(intensity);
  }
  return inside;
}

PowerFit between(const BothCurves& curves, const std::vector<double>& intensities,
                 Solver solver) {
  if (!curves.exist()) return curves.missing();
  return power_between(curves.first(), curves.second(), intensities, solver);
}

PowerFit geometric_mean(const BothCurves& curves) {
  if (!curves.exist()) return curves.missing();
  const core::PowerFunction mean = geometric_mean_of(curves.first(), curves.second());
  return {.status = FitStatus::kOk, .k = mean.k, .a = mean.a};
}

/// Adds how much of the combined curve rests on one part only.
void add_extrapolation(ResultsSection& section, const BothParts& parts, DrawnCurves& curves,
                       const std::vector<double>& intensities, const std::string& unit,
                       const ResultsOptions& options) {
  const auto num = static_cast<int>(parts.estimated.size());
  const auto range = shared_range(parts, everyone(parts.estimated.size()));
  const auto add = [&](const char* name, std::optional<double> value, const char* meaning,
                       const std::string& of) {
    section.estimates.push_back({.name = std::string("combined.") + name,
                                 .value = value,
                                 .unit = of,
                                 .meaning = meaning,
                                 .n = num});
  };
  add("shared_range_low", range ? std::optional(range->low) : std::nullopt,
      said("lowest intensity that estimation and, on average, production reached: below it one "
           "of the curves is extrapolated"),
      unit);
  add("shared_range_high", range ? std::optional(range->high) : std::nullopt,
      said("highest intensity that both reached: above it one of the curves is extrapolated"),
      unit);
  if (!range) {
    section.excluded.push_back(
        {"everyone",
         said("combined: no intensity that both estimation and production reached")});
    return;
  }
  const std::vector<double> inside = within(intensities, *range);
  const auto num_positive =
      std::ranges::count_if(intensities, [](double intensity) { return intensity > 0.0; });
  add("num_extrapolated",
      static_cast<double>(num_positive) - static_cast<double>(inside.size()),
      said("intensities above 0 that the combined curve rests on outside the shared range"),
      "1");
  (void)add_power_law(
      section, "combined.within_shared_range",
      said("power law between estimation and production, at intensities that both reached"),
      parts.estimated.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return between(curves.of(drawn, solver), inside, solver);
      },
      options);
}

/// The exponents of participants who have both.
struct OwnExponents {
  std::vector<double> estimation, production;

  void add(const PowerFit& estimated, const PowerFit& produced) {
    if (!estimated.a || !produced.a) return;
    estimation.push_back(*estimated.a);
    production.push_back(*produced.a);
  }
};

void compare_exponents(ResultsSection& section, const OwnExponents& own,
                       const std::string& regression, bool is_primary) {
  const std::string words = said("production as {}{}", regression,
                                 (is_primary ? said(" (primary)") : said(" (secondary)")));
  const std::string pair = said("own exponents, estimation - production, {}: ", words);
  section.comparisons.push_back(
      {said("{}paired t", pair), paired_t_test(own.estimation, own.production)});
  section.comparisons.push_back(
      {said("{}Wilcoxon, sensitivity", pair), wilcoxon_test(own.estimation, own.production)});
  section.comparisons.push_back(
      {said("own exponents, estimation and production, {}: Spearman's r", words),
       spearman_correlation(own.estimation, own.production)});
}

/// Compares the exponents of estimation and production, and tests whether they correlate. A
/// production answers with an intensity, so its primary exponent is from the regression of I on
/// S. The regression of S on I treats the target as the answer, and the spread of the answers
/// then changes its exponent.
void compare_exponents(ResultsSection& section, const BothParts& parts) {
  OwnExponents primary, secondary;
  for (std::size_t i = 0; i < parts.estimated.size(); ++i) {
    const BothCurves own = curves_of(parts, {i}, Solver::kCeres);
    const PowerFit turned = fit_own_intensity_on_magnitude(parts.produced.answers[i]);
    primary.add(own.estimation, turned);
    secondary.add(own.estimation, own.production);
    if (own.estimation.a && turned.a) continue;
    section.excluded.push_back(
        {parts.estimated.names[i],
         own.estimation.a
             ? said("own exponents: none of the production, {}", turned.reason)
             : said("own exponents: none of the estimation, {}", own.estimation.reason)});
  }
  compare_exponents(section, primary, said("I on S"), /*is_primary=*/true);
  compare_exponents(section, secondary, said("S on I"), /*is_primary=*/false);
}

void name_missing(ResultsSection& section, const StudyData& data, const MagnitudeBlock& has,
                  const MagnitudeBlock& lacks, const std::string& block) {
  for (const ParticipantData& participant : data.participants) {
    const auto is_in = [&](const MagnitudeBlock& one) {
      return std::ranges::find(one.names, participant.participant) != one.names.end();
    };
    if (is_in(has) && !is_in(lacks)) {
      name_without_answers(section.excluded, participant, block);
    }
  }
}

}  // namespace

ResultsSection combined_results(const StudyData& data, const BlockDesign& estimation,
                                const BlockDesign& production, const ResultsOptions& options) {
  ResultsSection section{.name = "combined"};
  BothParts parts{estimation_block(data, estimation), production_block(data, production)};
  name_missing(section, data, parts.estimated, parts.produced, production.block);
  name_missing(section, data, parts.produced, parts.estimated, estimation.block);
  keep_common(parts.estimated, parts.produced);
  const std::size_t num = parts.estimated.size();
  if (num == 0) return section;
  DrawnCurves curves(parts);
  std::vector<double> intensities;
  for (const auto& [intensity, mean] : group_means(parts.estimated.means, everyone(num))) {
    intensities.push_back(intensity);
  }
  (void)add_power_law(
      section, "combined", said("power law between estimation and production"), num,
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return between(curves.of(drawn, solver), intensities, solver);
      },
      options);
  (void)add_power_law(
      section, "combined.geometric_mean",
      said("geometric mean of the magnitudes of both curves at each intensity"), num,
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return geometric_mean(curves.of(drawn, solver));
      },
      options);
  add_extrapolation(section, parts, curves, intensities,
                    experiments::unit_of_quantity(estimation.quantity), options);
  add_own_power_laws(section, "combined", parts.estimated.names, [&](std::size_t i) {
    PowerFit own = between(curves_of(parts, {i}, Solver::kCeres), intensities, Solver::kCeres);
    // Residuals between two curves do not show the spread of the answers.
    own.k_ci95 = own.a_ci95 = {};
    own.is_exact = false;
    return own;
  });
  compare_exponents(section, parts);
  return section;
}

}  // namespace jnd::analysis
