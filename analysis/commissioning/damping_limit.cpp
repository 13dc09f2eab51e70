#include "analysis/commissioning/damping_limit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

constexpr int kFewestSweptWays = 4;

/// The Fourier sums of every row at one line of the sweep.
VectorXcd line_of(const Eigen::MatrixXd& rows, Eigen::Index line) {
  const Eigen::Index n = rows.cols();
  VectorXcd turning(n);
  for (Eigen::Index tick = 0; tick < n; ++tick) {
    turning[tick] = std::polar(2.0 / static_cast<double>(n),
                               -2.0 * std::numbers::pi * static_cast<double>(line * tick % n) /
                                   static_cast<double>(n));
  }
  return rows.cast<Complex>() * turning;
}

/// The lines of one way, at each of which the sweep has phase zero.
struct Lines {
  int input = 0;
  MatrixXcd force, velocity;  ///< Inputs x lines.
};

Lines lines_of(const SweptWay& way) {
  const Eigen::Index num_lines = way.commanded_n.cols() / 2;
  Lines lines{.input = way.input,
              .force = MatrixXcd(way.commanded_n.rows(), num_lines),
              .velocity = MatrixXcd(way.commanded_n.rows(), num_lines)};
  for (Eigen::Index line = 1; line <= num_lines; ++line) {
    const VectorXcd force = line_of(way.commanded_n, line);
    const Complex driven = force[way.input];
    const Complex back = std::conj(driven) / std::abs(driven);
    lines.force.col(line - 1) = back * force;
    lines.velocity.col(line - 1) = back * line_of(way.velocity_m_per_s, line);
  }
  return lines;
}

/// G at each line. If `left_out` is given, the way of that number is left out for each input.
std::vector<MatrixXcd> response_of(const std::vector<Lines>& all, Eigen::Index num_inputs,
                                   std::optional<int> left_out) {
  const Eigen::Index num_lines = all.front().force.cols();
  std::vector<MatrixXcd> response;
  for (Eigen::Index line = 0; line < num_lines; ++line) {
    MatrixXcd force = MatrixXcd::Zero(num_inputs, num_inputs), velocity = force;
    std::vector<int> num_ways(static_cast<std::size_t>(num_inputs), 0);
    for (const Lines& way : all) {
      if (num_ways[static_cast<std::size_t>(way.input)]++ == left_out) continue;
      force.col(way.input) += way.force.col(line);
      velocity.col(way.input) += way.velocity.col(line);
    }
    response.emplace_back(velocity * force.inverse());
  }
  return response;
}

/// Smooths the response as a ratio to a mass behind this delay, which changes slowly from line
/// to line.
void smooth(std::vector<MatrixXcd>& response, double angle_per_line, double delay_ticks) {
  constexpr std::ptrdiff_t kReach = 5;
  const auto expected = [&](std::size_t line) {
    const double angle = angle_per_line * static_cast<double>(line + 1);
    const Complex z = std::polar(1.0, angle);
    return std::polar(1.0, -angle * delay_ticks) / (z - 1.0);
  };
  const std::vector<MatrixXcd> rough = response;
  const auto num_lines = static_cast<std::ptrdiff_t>(rough.size());
  for (std::ptrdiff_t line = 0; line < num_lines; ++line) {
    const std::ptrdiff_t reach = std::min({kReach, line, num_lines - 1 - line});
    MatrixXcd sum = MatrixXcd::Zero(rough.front().rows(), rough.front().cols());
    double weights = 0.0;
    for (std::ptrdiff_t near = -reach; near <= reach; ++near) {
      const double part = static_cast<double>(near) / static_cast<double>(reach + 1);
      const double weight = 1.0 - part * part;
      sum += weight / expected(static_cast<std::size_t>(line + near)) *
             rough[static_cast<std::size_t>(line + near)];
      weights += weight;
    }
    response[static_cast<std::size_t>(line)] =
        expected(static_cast<std::size_t>(line)) / weights * sum;
  }
}

struct Crossing {
  double damping_n_s_per_m = std::numeric_limits<double>::infinity();
  double angle_per_tick = 0.0;
};

/// Finds where an eigenvalue that turns clockwise becomes real and negative, and takes the
/// largest one there. Eigenvalues of neighbouring lines are matched by their distance.
Crossing crossing_of(const std::vector<MatrixXcd>& response, const Eigen::VectorXd& share_ratio,
                     double angle_per_line) {
  Crossing first;
  VectorXcd last;
  for (std::size_t line = 0; line < response.size(); ++line) {
    const MatrixXcd loop = response[line] * share_ratio.cast<Complex>().asDiagonal();
    VectorXcd now = loop.eigenvalues();
    const double angle = angle_per_line * static_cast<double>(line + 1);
    const auto take = [&](double size, double at_angle) {
      if (1.0 / size < first.damping_n_s_per_m) first = {1.0 / size, at_angle};
    };
    for (Eigen::Index i = 0; i < last.size(); ++i) {
      Eigen::Index nearest = i;
      for (Eigen::Index j = i; j < now.size(); ++j) {
        if (std::abs(now[j] - last[i]) < std::abs(now[nearest] - last[i])) nearest = j;
      }
      std::swap(now[i], now[nearest]);
      const double before = last[i].imag(), after = now[i].imag();
      if (last[i].real() >= 0.0 || now[i].real() >= 0.0 || before * after > 0.0) continue;
      const double part = before == after ? 0.0 : before / (before - after);
      take(std::exp((1.0 - part) * std::log(std::abs(last[i])) +
                    part * std::log(std::abs(now[i]))),
           angle - (1.0 - part) * angle_per_line);
    }
    // At half the sampling rate everything is real.
    if (line + 1 == response.size()) {
      for (const Complex& value : now) {
        if (value.real() < 0.0) take(-value.real(), angle);
      }
    }
    last = now;
  }
  return first;
}

}  // namespace

DampingLimit damping_limit(const std::vector<SweptWay>& ways,
                           const Eigen::VectorXd& share_ratio, double period_s, double delay_s,
                           double largest_n_s_per_m) {
  const Eigen::Index num_inputs = share_ratio.size();
  std::vector<int> num_ways(static_cast<std::size_t>(num_inputs), 0);
  std::vector<Lines> lines;
  for (const SweptWay& way : ways) {
    ++num_ways.at(static_cast<std::size_t>(way.input));
    lines.push_back(lines_of(way));
  }
  const int fewest = *std::min_element(num_ways.begin(), num_ways.end());
  if (fewest < kFewestSweptWays) {
    throw core::Error("stability: expected at least 4 ways with sweeps of each input, found " +
                      std::to_string(fewest));
  }
  const double angle_per_line =
      2.0 * std::numbers::pi / static_cast<double>(ways.front().commanded_n.cols());
  const auto crossing = [&](std::optional<int> left_out) {
    std::vector<MatrixXcd> response = response_of(lines, num_inputs, left_out);
    smooth(response, angle_per_line, delay_s / period_s);
    return crossing_of(response, share_ratio, angle_per_line);
  };
  const Crossing whole = crossing(std::nullopt);
  // The inverse is what is measured, and its noise is about the same everywhere.
  std::vector<double> inverse;
  for (int way = 0; way < fewest; ++way) {
    inverse.push_back(1.0 / crossing(way).damping_n_s_per_m);
  }
  const auto n = static_cast<double>(fewest);
  double mean = 0.0, squares = 0.0;
  for (const double value : inverse) mean += value / n;
  for (const double value : inverse) squares += (value - mean) * (value - mean);
  const Measured inverse_fit =
      measured(1.0 / whole.damping_n_s_per_m, std::sqrt((n - 1.0) / n * squares), n - 1.0);
  DampingLimit limit{.frequency_hz = whole.angle_per_tick / (2.0 * std::numbers::pi * period_s),
                     .num_ways = fewest};
  const auto of = [&](double per_damping) {
    return per_damping > 0.0 ? 1.0 / per_damping : std::numeric_limits<double>::infinity();
  };
  limit.damping_n_s_per_m = {.value = of(inverse_fit.value),
                             .ci95_low = of(inverse_fit.ci95_high),
                             .ci95_high = of(inverse_fit.ci95_low)};
  if (limit.damping_n_s_per_m.ci95_low >= largest_n_s_per_m) {
    limit.damping_n_s_per_m = {largest_n_s_per_m, largest_n_s_per_m, largest_n_s_per_m};
    limit.is_beyond = true;
  }
  return limit;
}

}  // namespace jnd::analysis
