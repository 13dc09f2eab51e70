#include "analysis/fits/calibrated_drop.h"

#include <algorithm>
#include <vector>

#include "analysis/fits/normal_tail.h"
#include "analysis/fits/probit_regression.h"
#include "analysis/fits/psychometric_redraw.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

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
  std::vector<double> of_slope, of_pse;
  Eigen::VectorXd redrawn(design.rows());
  for (int redraw = 0; redraw < num_redraws; ++redraw) {
    for (Eigen::Index row = 0; row < design.rows(); ++row) {
      redrawn(row) = answers[static_cast<std::size_t>(row)].draw(random);
    }
    const ProbitRegression free = fit_probit(design, redrawn, num_trials);
    if (!(free.coefficients.size() > 0 && free.coefficients(0) > 0.0)) continue;
    const ProbitRegression at_slope = fit_probit(without_slope, redrawn, num_trials, by_slope);
    of_slope.push_back(2.0 * (free.log_likelihood - at_slope.log_likelihood));
    if (!free_pse) continue;
    const ProbitRegression at_pse = fit_probit(without_pse, redrawn, num_trials);
    of_pse.push_back(2.0 * (free.log_likelihood - at_pse.log_likelihood));
  }
  return {drop_of(std::move(of_slope)), drop_of(std::move(of_pse))};
}

}  // namespace jnd::analysis
