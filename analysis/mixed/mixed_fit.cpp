#include "analysis/mixed/mixed_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/fits/normal_tail.h"
#include "analysis/mixed/mixed_search.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// A column is a linear combination of the ones before it if less than this share of its length
/// is left.
constexpr double kDependent = 1e-9;
/// A smaller standard deviation of an effect, in units of eta over the rows, counts as none.
constexpr double kNoSpread = 1e-4;
constexpr double kStartLoading = 0.5;

/// The matrix S for which the columns of x S are uncorrelated and have mean square 1. x S is x
/// with each column made orthogonal to those before it. `dependent` is a column that is a
/// linear combination of those before it, or -1.
Eigen::MatrixXd standardising(const Eigen::MatrixXd& x, Eigen::Index& dependent) {
  const Eigen::Index num = x.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(x);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(std::min(num, x.rows()));
  dependent = -1;
  for (Eigen::Index j = 0; j < num && dependent < 0; ++j) {
    if (j >= x.rows() || std::fabs(r(j, j)) <= kDependent * x.col(j).norm()) dependent = j;
  }
  if (dependent >= 0) return {};
  return r.triangularView<Eigen::Upper>().solve(std::sqrt(static_cast<double>(x.rows())) *
                                                Eigen::MatrixXd::Identity(num, num));
}

/// Scales each column to mean square 1.
Eigen::MatrixXd scaling(const Eigen::MatrixXd& x) {
  Eigen::VectorXd scale(x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double length = x.col(j).norm();
    scale[j] = length > 0.0 ? std::sqrt(static_cast<double>(x.rows())) / length : 1.0;
  }
  return scale.asDiagonal();
}

std::int64_t drawn_yes(double probability, double num_trials, core::RandomStream& stream) {
  std::int64_t num_yes = 0;
  for (auto left = static_cast<std::int64_t>(num_trials); left > 0; --left) {
    num_yes += stream.with_probability(probability) ? 1 : 0;
  }
  return num_yes;
}

std::string unbounded_reason(const std::string& name) {
  return "the answers are separated: " + name +
         " has no most likely value, for ever larger ones are likelier; leave its term out, or "
         "add answers near the threshold";
}

}  // namespace

Eigen::VectorXd MixedFit::estimates() const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(fixed.size()));
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = fixed[i].estimate;
  }
  return all;
}

MixedFit fit_mixed(const MixedData& data, const MixedOptions& options) {
  return MixedRefit(data, options).fit_;
}

MixedRefit::MixedRefit(const MixedData& data, const MixedOptions& options) : options_(options) {
  build_model(data);
  fit_.num_rows = data.num_yes.size();
  fit_.num_parameters = model_.num_parameters();
  Eigen::VectorXd start = Eigen::VectorXd::Zero(model_.num_parameters());
  start.head(model_.num_fixed()) = fixed_start(model_);
  spread_at_least(kStartLoading, start);
  MixedLikelihood laplace(model_, 1);
  MixedOptimum optimum = most_likely(laplace, start, model_.num_fixed());
  if (options.num_nodes > 1) {
    MixedLikelihood quadrature(model_, options.num_nodes);
    if (optimum.status == FitStatus::kOk) {
      optimum = most_likely(quadrature, optimum.parameters, model_.num_fixed());
    }
  }
  fit_.status = optimum.status;
  fit_.reason = optimum.reason;
  if (optimum.unbounded >= 0) {
    // Expresses the unbounded direction in the requested effects.
    Eigen::Index most = 0;
    (fixed_scale_.col(optimum.unbounded).array().abs() *
     data.x.colwise().norm().transpose().array())
        .maxCoeff(&most);
    fit_.reason = unbounded_reason(data.names[static_cast<std::size_t>(most)]);
  }
  if (fit_.status != FitStatus::kOk) return;
  parameters_ = optimum.parameters;
  covariance_ = optimum.covariance;
  fit_.log_likelihood = optimum.log_likelihood;
  fit_.aic = 2.0 * fit_.num_parameters - 2.0 * fit_.log_likelihood;
  fit_.bic = std::log(static_cast<double>(fit_.num_rows)) * fit_.num_parameters -
             2.0 * fit_.log_likelihood;
  tell_effects(data, parameters_, covariance_);
}

/// The likelihood is even in a loading, so a search would not leave 0.
void MixedRefit::spread_at_least(double loading, Eigen::VectorXd& parameters) const {
  for (const TermPlace& place : places_) {
    Eigen::Index at = place.first_theta;
    for (Eigen::Index size = place.scale.rows(); size > 0; --size) {
      if (std::fabs(parameters[at]) < loading) parameters[at] = loading;
      at += size;
    }
  }
}

void MixedRefit::build_model(const MixedData& data) {
  model_.curve = options_.curve;
  model_.x = data.x;
  model_.num_yes = data.num_yes;
  model_.num_trials = data.num_trials;
  model_.log_coefficients = log_coefficients_of(data.num_yes, data.num_trials);
  Eigen::Index dependent = -1;
  fixed_scale_ = standardising(data.x, dependent);
  if (dependent >= 0) {
    throw core::Error("expected fixed effects of which none is a sum of others, found " +
                      data.names[static_cast<std::size_t>(dependent)] +
                      ", which is one in these rows; leave a term out");
  }
  // Terms with the same groups stand together. The grouping with the most columns comes first.
  std::vector<std::size_t> order(data.terms.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto num_columns = [&data](const std::string& group) {
    std::size_t num = 0;
    for (const MixedTerm& term : data.terms) {
      if (term.group == group) num += term.num_groups * term.names.size();
    }
    return num;
  };
  std::ranges::stable_sort(order, [&](std::size_t one, std::size_t other) {
    const std::string &a = data.terms[one].group, &b = data.terms[other].group;
    return num_columns(a) != num_columns(b) ? num_columns(a) > num_columns(b) : a < b;
  });
  places_.resize(data.terms.size());
  Eigen::Index theta = model_.num_fixed();
  for (const std::size_t at : order) {
    const MixedTerm& term = data.terms[at];
    if (term.num_groups < 2) {
      throw core::Error("expected two groups or more of " + term.group +
                        " for a random effect, found one alone");
    }
    if (model_.groupings.empty() || model_.groupings.back().name != term.group) {
      model_.groupings.push_back({.name = term.group,
                                  .z = RowMatrix(data.x.rows(), 0),
                                  .group = term.place,
                                  .num_groups = term.num_groups,
                                  .term_sizes = {}});
    }
    MixedGrouping& grouping = model_.groupings.back();
    const Eigen::Index before = grouping.z.cols();
    grouping.z.conservativeResize(Eigen::NoChange, before + term.z.cols());
    grouping.z.rightCols(term.z.cols()) = term.z;
    grouping.term_sizes.push_back(static_cast<int>(term.z.cols()));
    Eigen::Index of_term = -1;
    TermPlace& place = places_[at];
    place.grouping = model_.groupings.size() - 1;
    place.first_theta = theta;
    place.scale = standardising(term.z, of_term);
    if (of_term >= 0) place.scale = scaling(term.z);
    theta += term.z.cols() * (term.z.cols() + 1) / 2;
  }
  // Equal rows are pooled before rounding can make them differ.
  model_ = collapsed(model_);
  model_.x = (model_.x * fixed_scale_).eval();
  std::vector<Eigen::Index> begin(model_.groupings.size(), 0);
  for (const std::size_t at : order) {
    const TermPlace& place = places_[at];
    RowMatrix& z = model_.groupings[place.grouping].z;
    auto columns = z.middleCols(begin[place.grouping], place.scale.cols());
    columns = (columns * place.scale).eval();
    begin[place.grouping] += place.scale.cols();
  }
}

void MixedRefit::tell_effects(const MixedData& data, const Eigen::VectorXd& parameters,
                              const Eigen::MatrixXd& covariance) {
  const Eigen::Index num = model_.num_fixed();
  const Eigen::VectorXd beta = fixed_scale_ * parameters.head(num);
  fit_.fixed_covariance =
      fixed_scale_ * covariance.topLeftCorner(num, num) * fixed_scale_.transpose();
  for (Eigen::Index i = 0; i < num; ++i) {
    FixedEffect effect{.name = data.names[static_cast<std::size_t>(i)], .estimate = beta[i]};
    effect.standard_error = std::sqrt(fit_.fixed_covariance(i, i));
    effect.z = effect.estimate / effect.standard_error;
    effect.p = 2.0 * normal_tails(std::fabs(effect.z)).upper;
    fit_.fixed.push_back(std::move(effect));
  }
  for (std::size_t t = 0; t < places_.size(); ++t) {
    const TermPlace& place = places_[t];
    const MixedTerm& term = data.terms[t];
    const int size = static_cast<int>(place.scale.rows());
    MixedGrouping alone{.name = {}, .z = RowMatrix(0, size), .group = {}, .term_sizes = {size}};
    const Eigen::MatrixXd loadings = loadings_of(alone, parameters.data() + place.first_theta);
    const Eigen::MatrixXd scaled = place.scale * loadings;
    const Eigen::MatrixXd spread = scaled * scaled.transpose();
    const Eigen::VectorXd smallest =
        (loadings * loadings.transpose()).selfadjointView<Eigen::Lower>().eigenvalues();
    for (int i = 0; i < size; ++i) {
      RandomEffect effect{.group = term.group,
                          .name = term.names[static_cast<std::size_t>(i)],
                          .sd = std::sqrt(spread(i, i)),
                          .correlations = {}};
      for (int j = 0; j < i; ++j) {
        const double product = std::sqrt(spread(i, i) * spread(j, j));
        effect.correlations.push_back(
            product > 0.0 ? std::clamp(spread(i, j) / product, -1.0, 1.0) : 0.0);
      }
      fit_.random.push_back(std::move(effect));
    }
    if (smallest.minCoeff() < kNoSpread * kNoSpread) {
      fit_.notes.push_back(
          size == 1
              ? "the spread of " + term.names[0] + " between groups of " + term.group +
                    " is at its bound 0, so that standard errors take none for granted"
              : "the spread of the effects between groups of " + term.group +
                    " is at its bound: one of them is 0 or correlates perfectly with others; "
                    "a simpler random term says the same");
    }
  }
}

Eigen::VectorXd MixedRefit::redrawn(std::uint64_t seed, std::int64_t index) const {
  core::RandomStream stream(seed, "mixed bootstrap", {index});
  MixedModel drawn = model_;
  Eigen::VectorXd eta = model_.x * parameters_.head(model_.num_fixed());
  const double* theta = parameters_.data() + model_.num_fixed();
  for (const MixedGrouping& grouping : model_.groupings) {
    const Eigen::MatrixXd loadings = loadings_of(grouping, theta);
    theta += grouping.num_parameters();
    Eigen::MatrixXd effects(grouping.num_effects(),
                            static_cast<Eigen::Index>(grouping.num_groups));
    for (double& one : effects.reshaped()) one = stream.normal();
    effects = (loadings * effects).eval();
    for (std::size_t row = 0; row < model_.num_rows(); ++row) {
      const auto at = static_cast<Eigen::Index>(row);
      eta[at] += grouping.z.row(at).dot(effects.col(grouping.group[row]));
    }
  }
  for (std::size_t row = 0; row < drawn.num_rows(); ++row) {
    const double probability =
        curve_probability(drawn.curve, eta[static_cast<Eigen::Index>(row)]);
    drawn.num_yes[row] =
        static_cast<double>(drawn_yes(probability, drawn.num_trials[row], stream));
  }
  MixedLikelihood likelihood(drawn, options_.num_nodes);
  Eigen::VectorXd parameters = parameters_;
  constexpr double kLeastLoading = 0.05;
  spread_at_least(kLeastLoading, parameters);
  Eigen::MatrixXd inverse = covariance_;
  inverse.diagonal().array() += 1e-6;
  double log_likelihood = 0.0;
  if (!climb(likelihood, parameters, inverse, log_likelihood)) return {};
  // A climb among separated answers stops wherever the likelihood hardly rises any more.
  if (unbounded_effect(likelihood, parameters, model_.num_fixed()) != -1) return {};
  return fixed_scale_ * parameters.head(model_.num_fixed());
}

}  // namespace jnd::analysis
