#include "app/attachment_watch.h"

#include <array>
#include <vector>

#include "core/hand.h"

namespace jnd::app {
namespace {

/// In the order of `core::ContactPoint`.
constexpr std::array<const char*, core::kNumContactPoints> kWords = {
    "the inner palm", "the outer palm", "the thumb", "the index finger", "the middle finger"};

template <typename Names>
std::vector<std::string> chosen(std::uint8_t bits, const Names& names) {
  std::vector<std::string> some;
  for (std::size_t point = 0; point < names.size(); ++point) {
    if ((bits >> point & 1) != 0) some.emplace_back(names[point]);
  }
  return some;
}

}  // namespace

std::string words_of_points(std::uint8_t bits) {
  const std::vector<std::string> points = chosen(bits, kWords);
  std::string words;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) words += i + 1 == points.size() ? " and " : ", ";
    words += points[i];
  }
  return words;
}

std::string came_off_reason(std::uint8_t bits) {
  std::string names;
  for (const std::string& name : chosen(bits, core::kContactPointNames)) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return "came off: " + names;
}

}  // namespace jnd::app
