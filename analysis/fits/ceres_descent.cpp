#include "analysis/fits/ceres_descent.h"

#include <ceres/cost_function.h>
#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <utility>

namespace jnd::analysis {
namespace {

constexpr int kMaxIterations = 100;
/// Relative change of the cost at which the search stops. The parameters are then accurate to
/// about its square root.
constexpr double kTolerance = 1e-14;

class SmoothFunction final : public ceres::FirstOrderFunction {
 public:
  SmoothFunction(const SmoothCost& cost, std::size_t num_parameters)
      : cost_(cost), gradient_(num_parameters) {}

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const std::span<double> to = gradient ? std::span(gradient, gradient_.size()) : gradient_;
    return cost_({parameters, gradient_.size()}, *cost, to);
  }
  int NumParameters() const override { return static_cast<int>(gradient_.size()); }

 private:
  const SmoothCost& cost_;
  /// Receives the gradient when Ceres asks only for the cost.
  mutable std::vector<double> gradient_;
};

class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const SquaresProblem& problem, std::size_t num_parameters)
      : problem_(problem), num_parameters_(num_parameters) {
    set_num_residuals(problem.num_residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(num_parameters));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const auto rows = static_cast<std::size_t>(num_residuals());
    std::span<double> jacobian;
    if (jacobians && jacobians[0]) jacobian = {jacobians[0], rows * num_parameters_};
    return problem_.evaluate({parameters[0], num_parameters_}, {residuals, rows}, jacobian);
  }

 private:
  const SquaresProblem& problem_;
  std::size_t num_parameters_;
};

/// Ceres logs warnings even if its options silence it. The caller sees the same facts in the
/// result, so the log is switched off.
void silence_log() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace

std::vector<double> ceres_minimum(const SmoothCost& cost, std::vector<double> start) {
  // The problem owns the function.
  ceres::GradientProblem problem(new SmoothFunction(cost, start.size()));
  silence_log();
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.max_num_iterations = kMaxIterations;
  options.function_tolerance = kTolerance;
  options.gradient_tolerance = kTolerance;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, start.data(), &summary);
  return start;
}

std::vector<double> ceres_minimum(const SquaresProblem& squares, std::vector<double> start) {
  ceres::Problem problem;
  problem.AddResidualBlock(new Residuals(squares, start.size()), nullptr, start.data());
  for (std::size_t place = 0; place < squares.bounds.size(); ++place) {
    const SquaresProblem::Bound& bound = squares.bounds[place];
    const auto index = static_cast<int>(place);
    problem.SetParameterLowerBound(start.data(), index, bound.low);
    problem.SetParameterUpperBound(start.data(), index, bound.high);
  }
  silence_log();
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = kMaxIterations;
  options.function_tolerance = kTolerance;
  options.gradient_tolerance = kTolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return start;
}

}  // namespace jnd::analysis
