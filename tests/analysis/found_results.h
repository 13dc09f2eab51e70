#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "analysis/results/study_results.h"
#include "core/error.h"

// Parts of results by their names.

namespace jnd::analysis {

/// Throws `Error` where there is none.
inline const ResultsSection& section_of(const StudyResults& of, const std::string& name) {
  const auto found = std::ranges::find(of.sections, name, &ResultsSection::name);
  if (found == of.sections.end()) throw core::Error("no section " + name);
  return *found;
}

/// Of one participant. Throws `Error` where there is none.
inline const ParticipantEstimate& own_of(const ResultsSection& of,
                                         const std::string& participant,
                                         const std::string& name) {
  for (const ParticipantEstimate& one : of.participants) {
    if (one.participant == participant && one.name == name) return one;
  }
  throw core::Error("no value " + name + " of " + participant);
}

/// Null where there is none.
inline const Estimate* find_estimate(const ResultsSection& of, const std::string& name) {
  const auto found = std::ranges::find(of.estimates, name, &Estimate::name);
  return found == of.estimates.end() ? nullptr : &*found;
}

/// Of a group; a failure of the test and NaN where there is no estimate or none could be made.
inline double value_of(const Estimate* estimate, const std::string& name) {
  if (estimate != nullptr && estimate->value) return *estimate->value;
  ADD_FAILURE() << "no value for " << name;
  return std::numeric_limits<double>::quiet_NaN();
}
inline double value_of(const StudyResults& of, const std::string& name) {
  return value_of(of.find(name), name);
}
inline double value_of(const ResultsSection& of, const std::string& name) {
  return value_of(find_estimate(of, name), name);
}

}  // namespace jnd::analysis
