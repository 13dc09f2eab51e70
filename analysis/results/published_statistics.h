#pragma once

#include <map>
#include <optional>
#include <vector>

#include "analysis/fits/psychometric_refit.h"
#include "analysis/results/person_outcome.h"
#include "analysis/results/published.h"
#include "core/power_function.h"

namespace jnd::analysis {

/// What the statistics of a publication come to for some of these people. Nothing published
/// goes into them but which statistic it is. One thread a time.
class PublishedStatistics {
 public:
  /// `people` must outlive it.
  explicit PublishedStatistics(const std::vector<PersonOutcome>& people);

  /// Of the people at these places; nothing where there is no such statistic. An own Weber
  /// fraction without an optimum counts as its limit, 0 for perfectly separated answers and
  /// infinite for flat or falling ones, so a mean may be infinite.
  [[nodiscard]] std::optional<double> value(const PublishedStatistic& statistic,
                                            const std::vector<std::size_t>& drawn);

  /// One number a person of what a mean is of; empty for a statistic that is no mean of such.
  [[nodiscard]] std::vector<double> averaged(const PublishedStatistic& statistic,
                                             const std::vector<std::size_t>& drawn);

 private:
  using Places = std::vector<std::size_t>;
  using Law = std::optional<core::PowerFunction>;

  const std::vector<std::optional<double>>& own_fractions(const std::string& block);
  std::optional<double> pooled_fraction(const std::string& block, const Places& drawn);
  std::vector<double> numbers(const PublishedStatistic& statistic, const Places& drawn);
  Law law(const PublishedStatistic& statistic, const Places& drawn);
  Law group_law(const std::string& block, const Places& drawn, bool of_production);

  const std::vector<PersonOutcome>& people_;
  std::map<std::string, std::vector<std::optional<double>>> own_fractions_;
  LeastSquaresFractions fractions_;
  Places laws_drawn_;  ///< Whom the laws below are of: several statistics share them.
  std::map<std::string, Law> laws_;
};

}  // namespace jnd::analysis
