#pragma once

#include <map>
#include <optional>
#include <vector>

#include "analysis/fits/psychometric_refit.h"
#include "analysis/results/person_outcome.h"
#include "analysis/results/published.h"
#include "core/power_function.h"

namespace jnd::analysis {

/// Computes the statistics of a publication for a selection of these people. From the
/// publication it uses only the kind of statistic. Only one thread may use it at a time.
class PublishedStatistics {
 public:
  /// `people` must outlive the object.
  explicit PublishedStatistics(const std::vector<PersonOutcome>& people);

  /// The value for the people at these indices; absent if there is no such statistic. An own
  /// Weber fraction without an optimum counts as its limit: 0 for perfectly separated answers,
  /// and infinite for flat or falling ones. A mean may therefore be infinite.
  [[nodiscard]] std::optional<double> value(const PublishedStatistic& statistic,
                                            const std::vector<std::size_t>& drawn);

  /// The numbers, one for each person, of which a mean is taken; empty for a statistic that is
  /// not such a mean.
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
  /// The people to whom the laws below belong. Several statistics share them.
  Places laws_drawn_;
  std::map<std::string, Law> laws_;
};

}  // namespace jnd::analysis
