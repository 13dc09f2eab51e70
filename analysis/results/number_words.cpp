#include "analysis/results/number_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "analysis/fits/bounded_interval.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr char kNothing[] = "\u2013";

/// Uses a minus sign that is as wide as a plus sign.
std::string typeset(std::string digits) {
  digits = with_decimal_sign(std::move(digits));
  if (!digits.starts_with('-')) return digits;
  // Minus zero is written as zero.
  if (digits.find_first_of("123456789") == std::string::npos) return digits.substr(1);
  return "\u2212" + digits.substr(1);
}

template <typename... Format>
std::string digits_of(double value, Format... format) {
  std::array<char, 400> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...).ptr;
  return {buffer.data(), end};
}

}  // namespace

int decimals_of(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(size) || size >= 1000.0) return 0;
  if (size >= 100.0) return 1;
  if (size >= 10.0) return 2;
  return size >= 1.0 ? 3 : 4;
}

std::string number_words(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return kNothing;
  const double size = std::abs(*value);
  // A whole number is a count.
  if (size < 1e15 && std::trunc(size) == size) return number_words(value, 0);
  if (size < 0.001) {
    return typeset(digits_of(*value, std::chars_format::general, 3));
  }
  return number_words(value, decimals_of(*value));
}

std::string number_words(const std::optional<double>& value, int num_decimals) {
  if (!value || !std::isfinite(*value)) return kNothing;
  return typeset(digits_of(*value, std::chars_format::fixed, num_decimals));
}

std::string shortest_words(double value) {
  return std::isfinite(value) ? typeset(digits_of(value)) : kNothing;
}

namespace {

std::string words_of(const Interval& ci95, const std::optional<double>& value) {
  if (!ci95.low && !ci95.high) return kNothing;
  // The ends have as many decimals as the value, but a large end has fewer.
  const auto end = [&value](const std::optional<double>& number) {
    int num_decimals = decimals_of(*number);
    if (value && *value != 0.0) num_decimals = std::min(num_decimals, decimals_of(*value));
    return number_words(number, num_decimals);
  };
  // No-break spaces keep the interval on one line.
  if (!ci95.low) return said("up\u00a0to\u00a0{}", end(ci95.high));
  if (!ci95.high) return said("from\u00a0{}", end(ci95.low));
  return said("{}\u00a0to\u00a0{}", end(ci95.low), end(ci95.high));
}

std::string value_with(const std::optional<double>& value, const Interval& ci95,
                       const std::string& interval) {
  std::string words = number_words(value);
  if (!value || (!ci95.low && !ci95.high)) return words;
  return words + " (" + interval + ")";
}

}  // namespace

std::string interval_words(const Interval& whole, const std::optional<double>& value) {
  return words_of(bounded_by_data(whole, value), value);
}

std::string interval_words(const std::string& name, const Interval& whole,
                           const std::optional<double>& value) {
  return words_of(told_interval(name, whole, value), value);
}

std::string with_interval(const std::optional<double>& value, const Interval& ci95) {
  return value_with(value, ci95, interval_words(ci95, value));
}

std::string with_interval(const std::string& name, const std::optional<double>& value,
                          const Interval& ci95) {
  return value_with(value, ci95, interval_words(name, ci95, value));
}

std::string p_words(const std::optional<double>& p_value) {
  if (!p_value) return kNothing;
  return *p_value < 0.001 ? with_decimal_sign("< 0.001") : number_words(p_value, 3);
}

std::string counted_words(std::int64_t count, const std::string& one) {
  return std::to_string(count) + " " + said_of(one + (count == 1 ? "" : "s"));
}

std::string duration_words(double duration_s) {
  if (!std::isfinite(duration_s) || duration_s < 0.0) return kNothing;
  const auto seconds = static_cast<std::int64_t>(std::llround(duration_s));
  if (seconds < 60) return std::to_string(seconds) + " s";
  const std::int64_t minutes = (seconds + 30) / 60;
  if (minutes < 60) return std::to_string(minutes) + " min";
  const std::int64_t rest = minutes % 60;
  return std::to_string(minutes / 60) + (rest < 10 ? " h 0" : " h ") + std::to_string(rest) +
         " min";
}

std::string cell_words(const std::string& cells) {
  std::string words;
  for (const char letter : cells) {
    if (letter == '_') {
      words += ' ';
    } else {
      words += letter;
      if (letter == ';' || letter == ',') words += ' ';
      if (letter == '=') words.replace(words.size() - 1, 1, ": ");
    }
  }
  return words.empty() ? kNothing : words;
}

std::string date_words(std::int64_t time_ns) {
  using namespace std::chrono;
  const auto day = floor<days>(sys_time<nanoseconds>(nanoseconds(time_ns)));
  const year_month_day date(day);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text.data();
}

}  // namespace jnd::analysis
