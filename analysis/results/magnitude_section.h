#pragma once

#include <functional>

#include "analysis/fits/power_fit.h"
#include "analysis/results/study_results.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {

/// A power law of the participants drawn, by their places.
using GroupFit = std::function<PowerFit(const std::vector<std::size_t>&, Solver)>;

/// Adds PREFIX.k and PREFIX.a, each with its interval over resampled participants, and returns
/// the fit of everyone. Where there is none, says of "everyone" why, unless the reason stands
/// in the section already. Where every resample has one and the same value, as of people who
/// all answer alike, there is no interval, and it is said.
PowerFit add_power_law(ResultsSection& section, const std::string& prefix,
                       const std::string& meaning, std::size_t num_participants,
                       const GroupFit& fit, const ResultsOptions& options);

/// Adds PREFIX.r_squared of a fit that has one.
void add_r_squared(ResultsSection& section, const std::string& prefix, const PowerFit& fit,
                   int num_participants);

/// Adds the mean of one number each, with Student's interval.
void add_mean(ResultsSection& section, const std::string& name, const std::string& meaning,
              const std::vector<double>& values, const std::string& unit = "1");

/// Adds the geometric mean of numbers whose logarithms are given, with Student's interval of
/// the logarithms.
void add_geometric_mean(ResultsSection& section, const std::string& name,
                        const std::string& meaning, const std::vector<double>& logarithms,
                        const std::string& unit = "1");

/// Adds the standard deviation between participants, with its interval over resampled ones;
/// nothing below two values.
void add_spread(ResultsSection& section, const std::string& name, const std::string& meaning,
                const std::vector<double>& values, const ResultsOptions& options);

/// Interval of something about one value a participant, over resampled participants.
[[nodiscard]] Interval resampled(
    const std::vector<double>& values, const ResultsOptions& options,
    const std::function<std::optional<double>(const Summary&)>& statistic);

/// Adds every participant's own k and a. One that passes through every mean has no interval,
/// for nothing tells its scatter, and says so.
void add_own_power_laws(ResultsSection& section, const std::string& prefix,
                        const std::vector<std::string>& names,
                        const std::function<PowerFit(std::size_t)>& fit);

/// "0.5", "2": the shortest text of a number, for the name of an estimate.
[[nodiscard]] std::string number_text(double value);

}  // namespace jnd::analysis
