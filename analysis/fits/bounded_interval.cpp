#include "analysis/fits/bounded_interval.h"

namespace jnd::analysis {
namespace {

constexpr double kLargestFactor = 1000.0;

}  // namespace

Interval bounded_by_data(const Interval& ci95, const std::optional<double>& estimate) noexcept {
  const double least = ci95.low.value_or(0.0);
  if (!estimate || !(*estimate > 0.0) || !(least >= 0.0)) return ci95;
  Interval shown = ci95;
  if (least > 0.0 && least < *estimate / kLargestFactor) shown.low.reset();
  if (ci95.high && !(*ci95.high <= *estimate * kLargestFactor)) shown.high.reset();
  return shown;
}

Interval told_interval(const std::string& name, const Interval& ci95,
                       const std::optional<double>& estimate) noexcept {
  const bool has_its_unit = name.ends_with(".k") || name.ends_with(".modulus") ||
                            name.find("geometric_mean_at_") != std::string::npos;
  return has_its_unit ? ci95 : bounded_by_data(ci95, estimate);
}

}  // namespace jnd::analysis
