#include "analysis/fits/calibrated_drop.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/fits/normal_tail.h"
#include "analysis/fits/probit_regression.h"
#include "analysis/fits/psychometric_redraw.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The likelihood ratios of one set of redrawn answers.
struct Ratios {
  bool exist = false;  ///< The redrawn answers rise with the intensity.
  double of_slope = 0.0, of_pse = 0.0;
};

/// Half the 95 % quantile of chi-squared or of the given ratios, whichever is larger.
double drop_of(std::vector<double> ratios) {
  constexpr double kQuantile = 0.95;
  if (ratios.empty()) return kLikelihoodDrop;
  const auto place =
      static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(ratios.size()));
  std::ranges::nth_element(ratios, ratios.begin() + place);
  return std::max(kLikelihoodDrop, 0.5 * ratios[static_cast<std::size_t>(place)]);
}

/// Refits answers that were redrawn from a probit line. It does what `fit_probit` does, but
/// starts from that line, which is near the optimum, and uses vectors and matrices of a fixed
/// size. For separated answers it ends as near the limit of the likelihood as rounding permits.
template <int kColumns>
class ProbitRefit {
 public:
  struct Found {
    double log_likelihood = 0.0;
    double first = 0.0;  ///< The first coefficient of the refitted line.
  };

  /// The answers are redrawn from `line`. `offset` means the same as in `fit_probit`.
  ProbitRefit(const Eigen::MatrixXd& design, const Eigen::VectorXd& num_trials,
              Eigen::VectorXd line, Eigen::VectorXd offset = {})
      : design_(design),
        num_trials_(num_trials),
        offset_(std::move(offset)),
        num_all_(num_trials.sum()),
        rows_(design.transpose()),
        line_(std::move(line)) {}

  [[nodiscard]] Found find(const Eigen::VectorXd& num_yes) const {
    constexpr int kMaxSteps = 60;
    constexpr double kSmallStep = 1e-5, kSmallGain = 1e-13;
    // If all answers are alike, the sign of the slope depends on the start of the search.
    const double sum = num_yes.sum();
    Coefficients at = line_;
    double last_gain = core::kInfinity;
    for (int number = 0; sum > 0.0 && sum < num_all_ && number < kMaxSteps; ++number) {
      const Rise rise = rise_at(at, num_yes);
      const Eigen::LLT<Information> cholesky(rise.information);
      if (cholesky.info() != Eigen::Success) break;
      const Coefficients step = cholesky.solve(rise.gradient);
      // Newton's step gains half of this, apart from terms of third order.
      const double gain = step.dot(rise.gradient);
      if (!(gain < last_gain)) break;
      if (gain <= kSmallGain ||
          (step.transpose() * rows_).cwiseAbs().maxCoeff() <= kSmallStep) {
        return {log_likelihood_at(at, num_yes) + 0.5 * gain, at(0) + step(0)};
      }
      at += step;
      last_gain = gain;
    }
    const ProbitRegression fit = fit_probit(design_, num_yes, num_trials_, offset_);
    return {fit.log_likelihood, fit.coefficients(0)};
  }

 private:
  using Coefficients = Eigen::Matrix<double, kColumns, 1>;
  using Information = Eigen::Matrix<double, kColumns, kColumns>;
  /// The gradient of the log-likelihood, and minus its second derivatives.
  struct Rise {
    Coefficients gradient;
    Information information;
  };

  [[nodiscard]] double z_at(Eigen::Index row, const Coefficients& at) const {
    return (offset_.size() > 0 ? offset_(row) : 0.0) + rows_.col(row).dot(at);
  }

  [[nodiscard]] Rise rise_at(const Coefficients& at, const Eigen::VectorXd& num_yes) const {
    Rise here{Coefficients::Zero(at.size()), Information::Zero(at.size(), at.size())};
    for (Eigen::Index row = 0; row < rows_.cols(); ++row) {
      const auto x = rows_.col(row);
      const double z = z_at(row, at), yes = num_yes(row), no = num_trials_(row) - yes;
      const MillsRatios mills = mills_ratios(z);
      here.gradient += (yes * mills.lower - no * mills.upper) * x;
      here.information +=
          (yes * mills.lower * (z + mills.lower) + no * mills.upper * (mills.upper - z)) * x *
          x.transpose();
    }
    return here;
  }

  [[nodiscard]] double log_likelihood_at(const Coefficients& at,
                                         const Eigen::VectorXd& num_yes) const {
    double value = 0.0;
    for (Eigen::Index row = 0; row < rows_.cols(); ++row) {
      const double yes = num_yes(row), no = num_trials_(row) - yes;
      const LogNormalTails tails = log_normal_tails(z_at(row, at));
      if (yes > 0.0) value += yes * tails.log_lower;
      if (no > 0.0) value += no * tails.log_upper;
    }
    return value;
  }

  Eigen::MatrixXd design_;
  Eigen::VectorXd num_trials_, offset_;
  double num_all_ = 0.0;
  Eigen::Matrix<double, kColumns, Eigen::Dynamic> rows_;
  Coefficients line_;
};

/// Calibrates a line with `kColumns` columns, which may be `Eigen::Dynamic`.
template <int kColumns>
CalibratedDrops drops_of_columns(const Eigen::MatrixXd& design,
                                 const Eigen::VectorXd& num_trials,
                                 const Eigen::VectorXd& coefficients, bool free_pse,
                                 int num_redraws, std::uint64_t seed) {
  constexpr int kHeld = kColumns == Eigen::Dynamic ? Eigen::Dynamic : kColumns - 1;
  const Eigen::Index last = design.cols() - 1;
  const double slope = coefficients(0);
  Eigen::MatrixXd without_pse = design.leftCols(last);
  without_pse.col(0).array() += coefficients(last) / slope;
  const ProbitRefit<kColumns> free(design, num_trials, coefficients);
  const ProbitRefit<kHeld> at_slope(design.rightCols(last), num_trials, coefficients.tail(last),
                                    slope * design.col(0));
  const ProbitRefit<kHeld> at_pse(without_pse, num_trials, coefficients.head(last));
  std::vector<BinomialTable> answers;
  for (Eigen::Index row = 0; row < design.rows(); ++row) {
    answers.emplace_back(num_trials(row),
                         normal_tails(design.row(row).dot(coefficients)).lower);
  }
  core::RandomStream random(seed, "calibration of a likelihood ratio");
  const auto ratios_of = [&](const std::vector<double>& num_yes) {
    const Eigen::VectorXd redrawn =
        Eigen::Map<const Eigen::VectorXd>(num_yes.data(), design.rows());
    const auto freely = free.find(redrawn);
    Ratios ratios{.exist = freely.first > 0.0};
    if (!ratios.exist) return ratios;
    ratios.of_slope = 2.0 * (freely.log_likelihood - at_slope.find(redrawn).log_likelihood);
    if (free_pse) {
      ratios.of_pse = 2.0 * (freely.log_likelihood - at_pse.find(redrawn).log_likelihood);
    }
    return ratios;
  };
  const AnswerNumbering numbering({num_trials.begin(), num_trials.end()});
  std::unordered_map<std::uint64_t, Ratios> known;
  std::vector<double> of_slope, of_pse;
  std::vector<double> redrawn(answers.size());
  for (int redraw = 0; redraw < num_redraws; ++redraw) {
    for (std::size_t row = 0; row < answers.size(); ++row) {
      redrawn[row] = answers[row].draw(random);
    }
    Ratios ratios;
    if (const auto number = numbering.of(redrawn)) {
      const auto [found, is_new] = known.try_emplace(*number);
      if (is_new) found->second = ratios_of(redrawn);
      ratios = found->second;
    } else {
      ratios = ratios_of(redrawn);
    }
    if (!ratios.exist) continue;
    of_slope.push_back(ratios.of_slope);
    if (free_pse) of_pse.push_back(ratios.of_pse);
  }
  return {drop_of(std::move(of_slope)), drop_of(std::move(of_pse))};
}

}  // namespace

CalibratedDrops calibrated_drops(const Eigen::MatrixXd& design,
                                 const Eigen::VectorXd& num_trials,
                                 const Eigen::VectorXd& coefficients, bool free_pse,
                                 int num_redraws, std::uint64_t seed) {
  const Eigen::VectorXd half = 0.5 * num_trials;
  if (fit_probit(design, half, num_trials).coefficients.size() == 0) return {};
  const auto drops = [&]<int kColumns>() {
    return drops_of_columns<kColumns>(design, num_trials, coefficients, free_pse, num_redraws,
                                      seed);
  };
  if (design.cols() == 2) return drops.template operator()<2>();
  if (design.cols() == 3) return drops.template operator()<3>();
  return drops.template operator()<Eigen::Dynamic>();
}

}  // namespace jnd::analysis
