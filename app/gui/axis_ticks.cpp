#include "app/gui/axis_ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace jnd::app::gui {
namespace {

// These limits are far inside the range of a double, so that no difference overflows.
constexpr double kLargest = 1e150;
constexpr double kSmallestPositive = 1e-150;
// If the ends differ by less than this share of their size, ticks cannot tell them apart.
constexpr double kSmallestSpanRatio = 1e-9;
// A tick that rounding put just outside the range counts as inside.
constexpr double kSlack = 1e-9;

std::string superscript(int number) {
  static constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char digit : std::to_string(number)) {
    text += digit == '-' ? "⁻" : kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

std::string with_decimals(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, std::abs(value));
  const std::string digits = buffer.data();
  const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !is_zero ? "−" + digits : digits;
}

/// "2×10⁶", with as many digits as distinguish it from the next tick, one step away.
std::string scientific(double value, double step) {
  if (value == 0) return "0";
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  const int step_exponent = static_cast<int>(std::floor(std::log10(step) + 1e-12));
  const double mantissa = value / std::pow(10.0, exponent);
  const std::string digits =
      with_decimals(mantissa, std::clamp(exponent - step_exponent, 0, 9));
  std::string power = "10" + superscript(exponent);
  if (digits == "1") return power;
  return digits == "−1" ? "−" + power : digits + "×" + power;
}

std::string label_of(double value, double step, double largest) {
  if (value == 0) return "0";
  if (largest >= 1e6 || step < 1e-4) return scientific(value, step);
  const int decimals = static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  return with_decimals(value, std::clamp(decimals, 0, 9));
}

struct Multiples {
  double step = 1.0;
  /// The multiples are whole numbers, to be multiplied by the step.
  double first = 0.0, last = 0.0;

  [[nodiscard]] double count() const { return last - first + 1; }
};

Multiples multiples_within(const AxisRange& range, double step) {
  return {.step = step,
          .first = std::ceil(range.low / step - kSlack),
          .last = std::floor(range.high / step + kSlack)};
}

/// The smallest step that has no more multiples in the range than wanted.
Multiples best_multiples(const AxisRange& range, int max_count) {
  const double rough = (range.high - range.low) / std::max(2, max_count);
  double power = std::pow(10.0, std::floor(std::log10(rough)));
  while (true) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const Multiples found = multiples_within(range, digit * power);
      if (found.count() <= std::max(2, max_count)) return found;
    }
    power *= 10;
  }
}

/// The numbers that may divide a decade, from the finest division to the coarsest.
constexpr std::array<double, 8> kEighths = {1, 1.5, 2, 3, 4, 5, 6, 8};
constexpr std::array<double, 6> kSixths = {1, 1.5, 2, 3, 4, 6};
constexpr std::array<double, 5> kFifths = {1, 1.5, 2, 3, 5};
constexpr std::array<double, 3> kThirds = {1, 2, 5};
constexpr std::array<double, 2> kHalves = {1, 3};
constexpr std::array<double, 1> kWhole = {1};

std::vector<AxisTick> decade_parts(const AxisRange& range, std::span<const double> parts,
                                   int every) {
  std::vector<AxisTick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(range.low)));
  const int last = static_cast<int>(std::ceil(std::log10(range.high)));
  for (int exponent = first; exponent <= last; ++exponent) {
    if (((exponent % every) + every) % every != 0) continue;
    const double power = std::pow(10.0, exponent);
    for (const double part : parts) {
      const double value = part * power;
      if (value < range.low * (1 - kSlack) || value > range.high * (1 + kSlack)) continue;
      const bool is_plain = exponent >= -4 && exponent < 6;
      const bool is_whole = part == std::floor(part);
      const int decimals = std::max(0, -exponent + (is_whole ? 0 : 1));
      ticks.push_back({value, is_plain ? with_decimals(value, decimals)
                                       : scientific(value, is_whole ? power : power / 10)});
    }
  }
  return ticks;
}

}  // namespace

AxisRange sound_range(double low, double high, bool logarithmic) {
  const double smallest = logarithmic ? kSmallestPositive : -kLargest;
  const auto is_usable = [&](double end) {
    return std::isfinite(end) && (!logarithmic || end > 0);
  };
  if (!is_usable(low)) low = is_usable(high) ? high : (logarithmic ? 1.0 : 0.0);
  if (!is_usable(high)) high = low;
  AxisRange range = {std::clamp(std::min(low, high), smallest, kLargest),
                     std::clamp(std::max(low, high), smallest, kLargest)};
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low > kSmallestSpanRatio * size) return range;
  if (logarithmic) return {range.low / 2, range.high * 2};
  const double apart = size > 0 ? 0.1 * size : 0.5;
  // If both ends are zero, the axis goes up from there.
  return size > 0 ? AxisRange{range.low - apart, range.high + apart} : AxisRange{0.0, 1.0};
}

std::vector<AxisTick> linear_ticks(const AxisRange& range, int max_count) {
  const Multiples found = best_multiples(range, max_count);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  std::vector<AxisTick> ticks;
  for (double multiple = found.first; multiple <= found.last; multiple += 1) {
    const double value = multiple * found.step + 0.0;
    ticks.push_back({value, label_of(value, found.step, largest)});
  }
  return ticks;
}

AxisRange widened_to_ticks(const AxisRange& range, int max_count) {
  AxisRange widened = range;
  // A wider range may need a coarser step, which widens the range again.
  for (int i = 0; i < 3; ++i) {
    const double step = best_multiples(widened, max_count).step;
    widened = {std::floor(range.low / step + kSlack) * step,
               std::ceil(range.high / step - kSlack) * step};
  }
  return widened;
}

std::vector<AxisTick> logarithmic_ticks(const AxisRange& range, int max_count) {
  const std::array<std::span<const double>, 6> divisions = {kEighths, kSixths, kFifths,
                                                            kThirds,  kHalves, kWhole};
  const auto most = static_cast<std::size_t>(std::max(2, max_count));
  std::vector<AxisTick> ticks;
  for (const auto parts : divisions) {
    ticks = decade_parts(range, parts, 1);
    if (ticks.size() <= most) break;
  }
  for (int every = 2; ticks.size() > most; ++every) ticks = decade_parts(range, kWhole, every);
  if (ticks.size() >= 3 || range.high / range.low > 10) return ticks;
  return linear_ticks(range, max_count);
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const double exponent = std::floor(std::log10(std::abs(value)) + 1e-12);
  if (exponent >= 6 || exponent < -4) return scientific(value, std::pow(10.0, exponent - 2));
  return with_decimals(value, std::clamp(2 - static_cast<int>(exponent), 0, 6));
}

}  // namespace jnd::app::gui
