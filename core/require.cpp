#include "core/require.h"

#include <charconv>
#include <string>

namespace jnd::core {

void require(bool holds, std::string_view field, std::string_view rule, double value) {
  if (holds) return;
  char digits[32];
  char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  throw Error(std::string(field) + ": expected " + std::string(rule) + ", found " +
              std::string(digits, end));
}

}  // namespace jnd::core
