#include "core/require.h"

#include <charconv>
#include <cmath>
#include <string>

namespace jnd::core {

void require(bool holds, std::string_view field, std::string_view rule, double value) {
  if (holds) return;
  char digits[32];
  char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  throw Error(std::string(field) + ": expected " + std::string(rule) + ", found " +
              std::string(digits, end));
}

void require_positive(double value, std::string_view field) {
  require(value > 0.0 && std::isfinite(value), field, "a finite number > 0", value);
}

void require_not_negative(double value, std::string_view field) {
  require(value >= 0.0 && std::isfinite(value), field, "a finite number >= 0", value);
}

double period_s_at(double rate_hz) {
  require_positive(rate_hz, "rate_hz");
  return 1.0 / rate_hz;
}

}  // namespace jnd::core
