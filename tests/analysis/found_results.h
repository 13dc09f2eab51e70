#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "analysis/results/study_results.h"
#include "core/error.h"

// These functions find parts of results by name.

namespace jnd::analysis {

/// Returns the section of this name. Throws `Error` if there is none.
inline const ResultsSection& section_of(const StudyResults& of, const std::string& name) {
  const auto found = std::ranges::find(of.sections, name, &ResultsSection::name);
  if (found == of.sections.end()) throw core::Error("no section " + name);
  return *found;
}

/// Returns the estimate of this name for one participant. Throws `Error` if there is none.
inline const ParticipantEstimate& own_of(const ResultsSection& of,
                                         const std::string& participant,
                                         const std::string& name) {
  for (const ParticipantEstimate& one : of.participants) {
    if (one.participant == participant && one.name == name) return one;
  }
  throw core::Error("no value " + name + " of " + participant);
}

/// Returns the group's estimate of this name, or null if there is none.
inline const Estimate* find_estimate(const ResultsSection& of, const std::string& name) {
  const auto found = std::ranges::find(of.estimates, name, &Estimate::name);
  return found == of.estimates.end() ? nullptr : &*found;
}

/// Returns the value of a group's estimate. If there is no estimate or it has no value, the
/// test fails and the result is NaN.
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
