#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/results/person_outcome.h"

namespace jnd::analysis {

/// What simulated people depend on. With another study file, laboratory or device they would be
/// different.
struct PredictiveKey {
  std::string study, study_sha256;
  std::string laboratory, laboratory_sha256;
  std::string device;

  bool operator==(const PredictiveKey&) const = default;
};

/// Very many simulated people from whom studies are drawn. The groups have no common people and
/// were simulated from different seeds, so the differences between them show how accurate a
/// result is.
struct PredictivePeople {
  PredictiveKey key;
  std::uint64_t seed = 1;
  std::vector<std::vector<PersonOutcome>> groups;

  [[nodiscard]] int num_people() const noexcept;
};

/// A JSON document with one line for each person. Means and movement have six digits.
[[nodiscard]] std::string to_text(const PredictivePeople& people);

/// Throws `core::Error` that begins with `place` if the text is no such document or has another
/// format.
[[nodiscard]] PredictivePeople predictive_people_from(const std::string& text,
                                                      const std::string& place);

}  // namespace jnd::analysis
