#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/report/figure.h"
#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// The results of a study with the intensities that the devices delivered, as they were
/// measured before.
struct DeliveredReport {
  StudyResults results;  ///< The results, with `device_ci95` of each estimate.
  /// One sentence for each device: which one, its gain and own damping, and its sessions.
  std::vector<std::string> devices;
  std::int64_t num_trials = 0;    ///< The number of trials whose intensity was replaced.
  std::int64_t num_left_out = 0;  ///< The number of trials whose stimulus was not measured.
};

/// Writes the primary values of each block by commanded and by delivered intensities. For the
/// latter it adds the uncertainties from people and from the device. It writes nothing if there
/// is nothing to compare.
void write_delivered(HtmlText& html, const StudyResults& commanded,
                     const DeliveredReport& delivered, const StudyTitles& titles);

/// A figure of the Weber fractions by both intensities (`delivered`), if there are any.
[[nodiscard]] std::vector<Figure> delivered_figures(const StudyResults& commanded,
                                                    const DeliveredReport& delivered,
                                                    const StudyTitles& titles);

}  // namespace jnd::analysis
