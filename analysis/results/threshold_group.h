#pragma once

#include <map>
#include <string>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Participants' own values by pseudonym.
using OwnNumbers = std::map<std::string, double>;

/// The name and meaning of a group estimate, such as "group_d.threshold".
struct GroupName {
  std::string name;
  std::string meaning;
  std::string unit = "1";
  std::string suffix;  ///< Appended to the name, such as ".with_degenerate".
  std::string words;   ///< Appended to the meaning.
};

/// Adds the geometric mean of values > 0 with Student's interval in ln, and as NAME_sd_ln the
/// standard deviation of their ln between people. It adds nothing without values.
void add_geometric_mean(ResultsSection& section, const GroupName& group,
                        const OwnNumbers& values);

/// Adds the median person's Weber fraction from the mean of ln ln(1 + w), with Student's
/// interval, and the standard deviation of ln ln(1 + w) between people.
void add_median_fraction(ResultsSection& section, const std::string& block,
                         const GroupName& group, const OwnNumbers& fractions);

/// Adds the mean with Student's interval.
void add_mean(ResultsSection& section, const GroupName& group, const OwnNumbers& values);

/// Adds the mean of rates. Student's interval is cut off at 0 and 1.
void add_mean_rate(ResultsSection& section, const GroupName& group, const OwnNumbers& rates);

}  // namespace jnd::analysis
