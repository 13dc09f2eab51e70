#include "app/session/attachment_watch.h"

#include <array>
#include <vector>

#include "core/for_people.h"
#include "core/hand.h"

namespace jnd::app {
namespace {

/// The names are in the order of `core::ContactPoint`.
constexpr std::array<const char*, core::kNumContactPoints> kWords = {
    core::for_people("the inner palm"), core::for_people("the outer palm"),
    core::for_people("the thumb"), core::for_people("the index finger"),
    core::for_people("the middle finger")};

template <typename Names>
std::vector<std::string> chosen(std::uint8_t bits, const Names& names) {
  std::vector<std::string> some;
  for (std::size_t point = 0; point < names.size(); ++point) {
    if ((bits >> point & 1) != 0) some.emplace_back(names[point]);
  }
  return some;
}

constexpr unsigned kAllBits = (1U << core::kNumContactPoints) - 1U;

std::uint8_t bits(unsigned of) { return static_cast<std::uint8_t>(of & kAllBits); }

}  // namespace

void AttachmentWatch::begin(const core::Telemetry& now) noexcept {
  held_bits_ = bits(held_bits_ | now.sample.attached_bits);
  given_up_bits_ = bits(given_up_bits_ & ~unsigned{now.sample.attached_bits});
  num_detachments_ = now.num_detachments;
}

std::uint8_t AttachmentWatch::loose_bits(const core::Telemetry& now) const noexcept {
  return bits(held_bits_ & ~unsigned{now.sample.attached_bits});
}

std::uint8_t AttachmentWatch::came_off_bits(const core::Telemetry& now) const noexcept {
  unsigned came_off = loose_bits(now);
  for (std::size_t point = 0; point < num_detachments_.size(); ++point) {
    if (now.num_detachments[point] != num_detachments_[point]) came_off |= 1U << point;
  }
  return bits(came_off & held_bits_);
}

std::uint8_t AttachmentWatch::absent_bits(const core::Telemetry& now) const noexcept {
  return bits(~(unsigned{now.sample.attached_bits} | held_bits_ | given_up_bits_));
}

void AttachmentWatch::give_up(std::uint8_t given_up) noexcept {
  given_up_bits_ = bits(given_up_bits_ | given_up);
  held_bits_ = bits(held_bits_ & ~unsigned{given_up});
}

std::vector<std::string> names_of_points(std::uint8_t bits) { return chosen(bits, kWords); }

std::string words_of_points(std::uint8_t bits) {
  const std::vector<std::string> points = names_of_points(bits);
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
