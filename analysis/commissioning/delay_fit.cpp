#include "analysis/commissioning/delay_fit.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFewestWays = 5;

/// Position and force at one frequency.
struct Line {
  Complex position, force;
  int way = 0;
};

/// The Fourier sum under a von Hann window. The straight line through the ends is subtracted
/// first, because the device keeps moving.
Complex fourier(const std::vector<double>& values, double angle_per_tick) {
  const auto n = static_cast<double>(values.size());
  const double slope = (values.back() - values.front()) / (n - 1.0);
  Complex sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto tick = static_cast<double>(i);
    const double weight = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (tick + 0.5) / n);
    const double value = values[i] - values.front() - slope * tick;
    sum += weight * value * std::polar(1.0, -angle_per_tick * tick);
  }
  return sum;
}

struct Estimate {
  double delay_s = 0.0, mass_kg = 0.0;
};

/// Position divided by force for a mass of 1 kg. Each force holds for one tick, which begins
/// `delay_ticks` after its write: the modified z-transform of 1 / s^2 behind a zero-order hold
/// (Jury 1964).
Complex mass_response(double angle_per_tick, double delay_ticks, double period_s) {
  const double whole = std::floor(delay_ticks);
  const double part = delay_ticks - whole;
  const Complex z = std::polar(1.0, angle_per_tick);
  const Complex held = (1.0 - part) * (1.0 - part) * z * z +
                       (1.0 + 2.0 * part - 2.0 * part * part) * z + part * part;
  return 0.5 * period_s * period_s * held / (z * (z - 1.0) * (z - 1.0)) *
         std::polar(1.0, -angle_per_tick * whole);
}

/// The estimate from all lines that count.
template <typename Counts>
Estimate estimate_of(const std::vector<Line>& lines, const Counts& counts, double period_s,
                     double angle_per_tick, double damping) {
  Complex across = 0.0;
  double force = 0.0;
  for (const Line& line : lines) {
    if (!counts(line.way)) continue;
    across += line.position * std::conj(line.force);
    force += std::norm(line.force);
  }
  const double w = angle_per_tick / period_s;
  const Complex response = across / force;
  // It starts from a mass without damping and delay. Each round leaves a thousandth of the
  // error.
  Estimate estimate{.mass_kg =
                        std::abs(mass_response(angle_per_tick, 0.0, period_s) / response)};
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    const Complex damped = 1.0 / Complex(1.0, -damping / (w * estimate.mass_kg));
    const Complex model = mass_response(angle_per_tick, estimate.delay_s / period_s, period_s) *
                          damped / estimate.mass_kg;
    estimate.mass_kg *= std::abs(model / response);
    estimate.delay_s += std::arg(model / response) / w;
  }
  // A force cannot act before it was written, so it acted one push later.
  const double push_s = 2.0 * std::numbers::pi / w;
  if (estimate.delay_s < -0.1 * push_s) estimate.delay_s += push_s;
  return estimate;
}

Measured jackknifed(const std::vector<double>& without_one, double whole) {
  const auto n = static_cast<double>(without_one.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : without_one) mean += value / n;
  for (const double value : without_one) squares += (value - mean) * (value - mean);
  return measured(whole, std::sqrt((n - 1.0) / n * squares), n - 1.0);
}

}  // namespace

DelayFit fit_delay(const std::vector<PushedWindow>& windows, double period_s, int push_ticks,
                   double damping_per_gain_n_s_per_m) {
  std::set<int> ways;
  for (const PushedWindow& window : windows) ways.insert(window.way);
  if (ways.size() < kFewestWays) {
    throw core::Error("delay: expected at least 5 ways with pushes, found " +
                      std::to_string(ways.size()));
  }
  const double angle_per_tick = 2.0 * std::numbers::pi / push_ticks;
  std::vector<Line> lines;
  for (const PushedWindow& window : windows) {
    const std::size_t num_ticks = window.position_m.size();
    if (num_ticks == 0 || window.commanded_n.size() != num_ticks ||
        num_ticks % static_cast<std::size_t>(push_ticks) != 0) {
      throw core::Error("delay: expected windows of whole pushes of " +
                        std::to_string(push_ticks) + " ticks, found one of " +
                        std::to_string(num_ticks));
    }
    lines.push_back({.position = fourier(window.position_m, angle_per_tick),
                     .force = fourier(window.commanded_n, angle_per_tick),
                     .way = window.way});
  }
  const auto estimate = [&](const auto& counts) {
    return estimate_of(lines, counts, period_s, angle_per_tick, damping_per_gain_n_s_per_m);
  };
  const Estimate whole = estimate([](int) { return true; });
  std::vector<double> delays_s, masses_kg;
  std::vector<PushedWay> by_themselves;
  for (const int way : ways) {
    const Estimate others = estimate([way](int one) { return one != way; });
    delays_s.push_back(others.delay_s);
    masses_kg.push_back(others.mass_kg);
    const Estimate alone = estimate([way](int one) { return one == way; });
    by_themselves.push_back({.delay_s = alone.delay_s, .mass_per_gain_kg = alone.mass_kg});
  }
  DelayFit fit{.delay_s = jackknifed(delays_s, whole.delay_s),
               .mass_per_gain_kg = jackknifed(masses_kg, whole.mass_kg),
               .num_ways = static_cast<int>(ways.size()),
               .ways = std::move(by_themselves)};
  const double half_width_kg =
      0.5 * (fit.mass_per_gain_kg.ci95_high - fit.mass_per_gain_kg.ci95_low);
  if (!std::isfinite(whole.mass_kg) || !(whole.mass_kg > half_width_kg)) {
    throw core::Error(
        "delay: expected a device that moves along with a push, found none that can be told "
        "from "
        "its noise; check that it is armed and free to move");
  }
  return fit;
}

}  // namespace jnd::analysis
