#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/report/figure.h"
#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What comes of a study where its intensities are those that devices delivered, which were
/// measured before.
struct DeliveredReport {
  StudyResults results;              ///< With `device_ci95` of each estimate.
  std::vector<std::string> devices;  ///< A sentence each: which, gain, own damping, sessions.
  std::int64_t num_trials = 0;       ///< Whose intensity was replaced.
  std::int64_t num_left_out = 0;     ///< Whose stimulus nobody measured.
};

/// What each block was asked for, by intensities as commanded and as delivered, with what
/// people and what the device leave open of the latter. Nothing where there is nothing to
/// compare.
void write_delivered(HtmlText& html, const StudyResults& commanded,
                     const DeliveredReport& delivered, const StudyTitles& titles);

/// The Weber fractions of it (`delivered`), if there are any.
[[nodiscard]] std::vector<Figure> delivered_figures(const StudyResults& commanded,
                                                    const DeliveredReport& delivered,
                                                    const StudyTitles& titles);

}  // namespace jnd::analysis
