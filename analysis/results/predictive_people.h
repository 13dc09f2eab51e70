#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/results/person_outcome.h"

namespace jnd::analysis {

/// What simulated people rest on: of another study file, laboratory or device they would be
/// other people.
struct PredictiveKey {
  std::string study, study_sha256;
  std::string laboratory, laboratory_sha256;
  std::string device;

  bool operator==(const PredictiveKey&) const = default;
};

/// Very many simulated people, from whom studies are drawn. The groups have nobody in common
/// and were simulated from seeds of their own, so that the differences between what they come
/// to say how far any of it is known.
struct PredictivePeople {
  PredictiveKey key;
  std::uint64_t seed = 1;
  std::vector<std::vector<PersonOutcome>> groups;

  [[nodiscard]] int num_people() const noexcept;
};

/// A JSON document with a line a person; means and movement to six digits.
[[nodiscard]] std::string to_text(const PredictivePeople& people);

/// Throws `core::Error` that begins with `place` for a text that is no such document, or of
/// another format.
[[nodiscard]] PredictivePeople predictive_people_from(const std::string& text,
                                                      const std::string& place);

}  // namespace jnd::analysis
