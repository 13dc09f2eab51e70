#include "analysis/mixed/mixed_model.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <unordered_map>

namespace jnd::analysis {

int MixedGrouping::num_parameters() const noexcept {
  int num = 0;
  for (const int size : term_sizes) num += size * (size + 1) / 2;
  return num;
}

int MixedModel::num_parameters() const noexcept {
  int num = num_fixed();
  for (const MixedGrouping& grouping : groupings) num += grouping.num_parameters();
  return num;
}

double log_coefficients_of(const std::vector<double>& num_yes,
                           const std::vector<double>& num_trials) {
  double sum = 0.0;
  for (std::size_t i = 0; i < num_yes.size(); ++i) {
    if (num_trials[i] == 1.0) continue;
    sum += std::lgamma(num_trials[i] + 1.0) - std::lgamma(num_yes[i] + 1.0) -
           std::lgamma(num_trials[i] - num_yes[i] + 1.0);
  }
  return sum;
}

MixedModel collapsed(const MixedModel& model) {
  MixedModel result = model;
  std::vector<std::size_t> order(model.num_rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, {}, [&](std::size_t row) { return result.groupings.front().group[row]; });
  // The key holds the bytes of everything that distinguishes rows.
  std::unordered_map<std::string, std::size_t> places;
  std::vector<std::size_t> kept;
  std::string key;
  const auto add_numbers = [&key](const double* values, Eigen::Index num) {
    for (Eigen::Index i = 0; i < num; ++i) {
      const double value = values[i] + 0.0;  // Adding 0 turns -0 into 0.
      key.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  };
  result.num_yes.clear();
  result.num_trials.clear();
  for (const std::size_t row : order) {
    key.clear();
    const auto at = static_cast<Eigen::Index>(row);
    add_numbers(model.x.row(at).data(), model.x.cols());
    for (const MixedGrouping& grouping : result.groupings) {
      add_numbers(grouping.z.row(at).data(), grouping.z.cols());
      key.append(reinterpret_cast<const char*>(&grouping.group[row]), sizeof(std::uint32_t));
    }
    const auto [found, is_new] = places.try_emplace(key, kept.size());
    if (is_new) {
      kept.push_back(row);
      result.num_yes.push_back(0.0);
      result.num_trials.push_back(0.0);
    }
    result.num_yes[found->second] += model.num_yes[row];
    result.num_trials[found->second] += model.num_trials[row];
  }
  const auto taken = [&kept](const RowMatrix& from) {
    RowMatrix rows(static_cast<Eigen::Index>(kept.size()), from.cols());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = from.row(static_cast<Eigen::Index>(kept[i]));
    }
    return rows;
  };
  result.x = taken(model.x);
  for (MixedGrouping& grouping : result.groupings) {
    grouping.z = taken(grouping.z);
    std::vector<std::uint32_t> group(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) group[i] = grouping.group[kept[i]];
    grouping.group = std::move(group);
  }
  return result;
}

Eigen::MatrixXd loadings_of(const MixedGrouping& grouping, const double* theta) {
  const int num = grouping.num_effects();
  Eigen::MatrixXd loadings = Eigen::MatrixXd::Zero(num, num);
  int begin = 0;
  for (const int size : grouping.term_sizes) {
    for (int j = 0; j < size; ++j) {
      for (int i = j; i < size; ++i) loadings(begin + i, begin + j) = *theta++;
    }
    begin += size;
  }
  return loadings;
}

}  // namespace jnd::analysis
