#pragma once

#include <functional>

#include "analysis/fits/power_fit.h"
#include "analysis/results/study_results.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {

/// Fits a power law to the drawn participants, which are given by their indices.
using GroupFit = std::function<PowerFit(const std::vector<std::size_t>&, Solver)>;

/// Adds PREFIX.k and PREFIX.a with their intervals over resampled participants, and returns the
/// fit of everyone. If there is no fit it excludes "everyone" with the reason, unless the
/// section states that reason already. If every resample has the same value, as for people who
/// all answer alike, there is no interval, and a sentence says so.
PowerFit add_power_law(ResultsSection& section, const std::string& prefix,
                       const std::string& meaning, std::size_t num_participants,
                       const GroupFit& fit, const ResultsOptions& options);

/// Adds PREFIX.r_squared if the fit has one.
void add_r_squared(ResultsSection& section, const std::string& prefix, const PowerFit& fit,
                   int num_participants);

/// Adds the mean of the values with Student's interval.
void add_mean(ResultsSection& section, const std::string& name, const std::string& meaning,
              const std::vector<double>& values, const std::string& unit = "1");

/// Adds the geometric mean of numbers whose logarithms are given, with Student's interval of
/// the logarithms.
void add_geometric_mean(ResultsSection& section, const std::string& name,
                        const std::string& meaning, const std::vector<double>& logarithms,
                        const std::string& unit = "1");

/// Adds the standard deviation between participants, with its interval over resampled
/// participants. It adds nothing for fewer than two values.
void add_spread(ResultsSection& section, const std::string& name, const std::string& meaning,
                const std::vector<double>& values, const ResultsOptions& options);

/// The interval of a statistic of one value per participant, over resampled participants.
[[nodiscard]] Interval resampled(
    const std::vector<double>& values, const ResultsOptions& options,
    const std::function<std::optional<double>(const Summary&)>& statistic);

/// Adds every participant's own k and a. A law that passes through every mean has no interval,
/// because nothing shows the scatter; a sentence says so.
void add_own_power_laws(ResultsSection& section, const std::string& prefix,
                        const std::vector<std::string>& names,
                        const std::function<PowerFit(std::size_t)>& fit);

/// The shortest text of a number, such as "0.5" or "2", for the name of an estimate.
[[nodiscard]] std::string number_text(double value);

}  // namespace jnd::analysis
