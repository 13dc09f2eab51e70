#include "analysis/fits/calibrated_drop.h"

#include <algorithm>
#include <map>
#include <vector>

#include "analysis/fits/normal_tail.h"
#include "analysis/fits/probit_regression.h"
#include "analysis/fits/psychometric_redraw.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// Likelihood ratios of answers that were drawn anew.
struct Ratios {
  bool exist = false;  ///< The redrawn answers rise.
  double of_slope = 0.0, of_pse = 0.0;
};

/// Half the 95 % quantile of chi-squared or of the values, whichever is larger.
double drop_of(std::vector<double> ratios) {
  constexpr double kQuantile = 0.95;
  if (ratios.empty()) return kLikelihoodDrop;
  const auto place =
      static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(ratios.size()));
  std::ranges::nth_element(ratios, ratios.begin() + place);
  return std::max(kLikelihoodDrop, 0.5 * ratios[static_cast<std::size_t>(place)]);
}

}  // namespace

CalibratedDrops calibrated_drops(const Eigen::MatrixXd& design,
                                 const Eigen::VectorXd& num_trials,
                                 const Eigen::VectorXd& coefficients, bool free_pse,
                                 int num_redraws, std::uint64_t seed) {
  const Eigen::Index last = design.cols() - 1;
  const double slope = coefficients(0);
  const Eigen::VectorXd by_slope = slope * design.col(0);
  const Eigen::MatrixXd without_slope = design.rightCols(last);
  Eigen::MatrixXd without_pse = design.leftCols(last);
  without_pse.col(0).array() += coefficients(last) / slope;
  std::vector<BinomialTable> answers;
  for (Eigen::Index row = 0; row < design.rows(); ++row) {
    answers.emplace_back(num_trials(row),
                         normal_tails(design.row(row).dot(coefficients)).lower);
  }
  core::RandomStream random(seed, "calibration of a likelihood ratio");
  const auto ratios_of = [&](const std::vector<double>& num_yes) {
    const Eigen::Map<const Eigen::VectorXd> mapped(num_yes.data(), design.rows());
    const Eigen::VectorXd redrawn = mapped;
    Ratios ratios;
    const ProbitRegression free = fit_probit(design, redrawn, num_trials);
    ratios.exist = free.coefficients.size() > 0 && free.coefficients(0) > 0.0;
    if (!ratios.exist) return ratios;
    const ProbitRegression at_slope = fit_probit(without_slope, redrawn, num_trials, by_slope);
    ratios.of_slope = 2.0 * (free.log_likelihood - at_slope.log_likelihood);
    if (!free_pse) return ratios;
    const ProbitRegression at_pse = fit_probit(without_pse, redrawn, num_trials);
    ratios.of_pse = 2.0 * (free.log_likelihood - at_pse.log_likelihood);
    return ratios;
  };
  // Few answers are often drawn alike; those of many rows never are, and are not kept.
  constexpr Eigen::Index kMostRowsKept = 32;
  std::map<std::vector<double>, Ratios> known;
  std::vector<double> of_slope, of_pse;
  std::vector<double> redrawn(answers.size());
  for (int redraw = 0; redraw < num_redraws; ++redraw) {
    for (std::size_t row = 0; row < answers.size(); ++row) {
      redrawn[row] = answers[row].draw(random);
    }
    Ratios ratios;
    if (design.rows() > kMostRowsKept) {
      ratios = ratios_of(redrawn);
    } else {
      const auto [found, is_new] = known.try_emplace(redrawn);
      if (is_new) found->second = ratios_of(redrawn);
      ratios = found->second;
    }
    if (!ratios.exist) continue;
    of_slope.push_back(ratios.of_slope);
    if (free_pse) of_pse.push_back(ratios.of_pse);
  }
  return {drop_of(std::move(of_slope)), drop_of(std::move(of_pse))};
}

}  // namespace jnd::analysis
