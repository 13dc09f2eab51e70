#include "analysis/results/magnitude_section.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "analysis/data/magnitude_means.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The fits of one set of resamples. Each is computed once, although several of its numbers are
/// used. The same seed draws the same participants in the same order.
class Resamples {
 public:
  Resamples(const GroupFit& fit, std::size_t num_participants, const ResultsOptions& options)
      : fit_(fit), num_participants_(num_participants), options_(options) {}

  Interval of(std::optional<double> PowerFit::*value) {
    std::size_t resample = 0;
    return resample_participants(num_participants_, options_.num_resamples, options_.seed,
                                 [&](const std::vector<std::size_t>& drawn) {
                                   if (resample == fits_.size()) {
                                     fits_.push_back(fit_(drawn, Solver::kNewton));
                                   }
                                   return fits_[resample++].*value;
                                 })
        .ci95;
  }

 private:
  const GroupFit& fit_;
  std::size_t num_participants_;
  const ResultsOptions& options_;
  std::vector<PowerFit> fits_;
};

void add_reason(ResultsSection& section, const std::string& prefix, const std::string& reason) {
  const bool known = std::ranges::any_of(section.excluded, [&](const auto& one) {
    return one.participant == "everyone" && one.reason.ends_with(reason);
  });
  if (known || reason.empty()) return;
  section.excluded.push_back({"everyone", said("{}: no power law, {}", prefix, reason)});
}

/// For example ", 1 at intensity 0 left out". It counts the means or points of a fit.
std::string at_zero_words(const PowerFit& fit) {
  if (fit.num_at_zero == 0) return "";
  return said(", {} at intensity 0 left out", std::to_string(fit.num_at_zero));
}

/// Whether both ends equal the value, apart from rounding.
bool has_no_width(const Interval& ci95) {
  constexpr double kRounding = 1e-9;
  return ci95.low && ci95.high &&
         std::fabs(*ci95.high - *ci95.low) <=
             kRounding * std::max(std::fabs(*ci95.low), std::fabs(*ci95.high));
}

}  // namespace

PowerFit add_power_law(ResultsSection& section, const std::string& prefix,
                       const std::string& meaning, std::size_t num_participants,
                       const GroupFit& fit, const ResultsOptions& options) {
  PowerFit whole = fit(everyone(num_participants), Solver::kCeres);
  if (whole.status != FitStatus::kOk) add_reason(section, prefix, whole.reason);
  Resamples resamples(fit, num_participants, options);
  for (const auto& [letter, value] : {std::pair{"k", &PowerFit::k}, {"a", &PowerFit::a}}) {
    Estimate estimate{.name = prefix + "." + letter,
                      .value = whole.*value,
                      .unit = "1",
                      .meaning = meaning + at_zero_words(whole) +
                                 (*letter == 'k' ? said(": factor") : said(": exponent")),
                      .n = static_cast<int>(num_participants),
                      .reason = whole.reason};
    if (estimate.value && num_participants > 1) estimate.ci95 = resamples.of(value);
    if (has_no_width(estimate.ci95)) {
      estimate.ci95 = {};
      estimate.cautions.emplace_back(said("no interval: it is the same whoever is drawn"));
    }
    section.estimates.push_back(std::move(estimate));
  }
  return whole;
}

void add_r_squared(ResultsSection& section, const std::string& prefix, const PowerFit& fit,
                   int num_participants) {
  if (!fit.r_squared) return;
  section.estimates.push_back(
      {.name = prefix + ".r_squared",
       .value = fit.r_squared,
       .unit = "1",
       .meaning = said("share of the spread of the {} means that the power law explains{}",
                       std::to_string(fit.num_rows), at_zero_words(fit)),
       .n = num_participants});
}

void add_mean(ResultsSection& section, const std::string& name, const std::string& meaning,
              const std::vector<double>& values, const std::string& unit) {
  const Summary summary = summary_of(values);
  section.estimates.push_back({.name = name,
                               .value = summary.mean,
                               .ci95 = summary.mean_ci95,
                               .unit = unit,
                               .meaning = meaning,
                               .n = summary.num_values});
}

void add_geometric_mean(ResultsSection& section, const std::string& name,
                        const std::string& meaning, const std::vector<double>& logarithms,
                        const std::string& unit) {
  const Summary summary = summary_of(logarithms);
  const auto back = [](const std::optional<double>& value) {
    return value ? std::optional(std::exp(*value)) : std::nullopt;
  };
  section.estimates.push_back(
      {.name = name,
       .value = back(summary.mean),
       .ci95 = {back(summary.mean_ci95.low), back(summary.mean_ci95.high)},
       .unit = unit,
       .meaning = meaning,
       .n = summary.num_values});
}

void add_spread(ResultsSection& section, const std::string& name, const std::string& meaning,
                const std::vector<double>& values, const ResultsOptions& options) {
  const Summary summary = summary_of(values);
  if (!summary.standard_deviation) return;
  section.estimates.push_back(
      {.name = name,
       .value = summary.standard_deviation,
       .ci95 = resampled(values, options,
                         [](const Summary& sample) { return sample.standard_deviation; }),
       .unit = "1",
       .meaning = meaning,
       .n = summary.num_values});
}

Interval resampled(const std::vector<double>& values, const ResultsOptions& options,
                   const std::function<std::optional<double>(const Summary&)>& statistic) {
  if (values.empty()) return {};
  return resample_participants(values.size(), options.num_resamples, options.seed,
                               [&](const std::vector<std::size_t>& drawn) {
                                 std::vector<double> sample;
                                 for (const std::size_t i : drawn) sample.push_back(values[i]);
                                 return statistic(summary_of(sample));
                               })
      .ci95;
}

void add_own_power_laws(ResultsSection& section, const std::string& prefix,
                        const std::vector<std::string>& names,
                        const std::function<PowerFit(std::size_t)>& fit) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PowerFit own = fit(i);
    const std::vector<std::string> cautions =
        own.is_exact ? std::vector{said("no interval: {}", own.no_interval)}
                     : std::vector<std::string>{};
    section.participants.push_back(
        {names[i], prefix + ".k", own.k, own.k_ci95, own.reason, cautions});
    section.participants.push_back(
        {names[i], prefix + ".a", own.a, own.a_ci95, own.reason, cautions});
  }
}

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

}  // namespace jnd::analysis
