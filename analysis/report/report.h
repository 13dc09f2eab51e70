#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/movement/movement_analysis.h"
#include "analysis/report/report_delivered.h"
#include "analysis/report/report_document.h"
#include "analysis/results/study_results.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What a report is made of. Whether the study may be seen (double-blind ones) is the caller's.
struct ReportSource {
  const core::StudyStore& store;
  const StudyData& data;
  const StudyResults& results;
  ResultsOptions results_options;  ///< That the results were computed with.
  const MovementAnalysis& movement;
  const DeliveredReport* delivered = nullptr;  ///< nullptr: nothing was measured of devices.
  std::string program_version;
  bool pilot = false;  ///< Pilot sessions are among the data.
};

/// As `write_document` does. The same study gives the same bytes. Not real time.
[[nodiscard]] ReportOutcome write_report(const ReportSource& source,
                                         const std::filesystem::path& folder,
                                         const ReportOptions& options);

/// Every figure that there are data for, in the order of the report.
[[nodiscard]] std::vector<Figure> figures_of(const ReportSource& source);

/// What a paper needs, as one self-contained HTML document: the answers, how they were found,
/// one figure for each part of the results. `drawn` in the order of `figures`.
[[nodiscard]] std::string report_html(const ReportSource& source,
                                      const std::vector<Figure>& figures,
                                      const std::vector<DrawnFigure>& drawn);

/// All else there is to tell: every participant, every estimate, every comparison, every other
/// figure, where all of it comes from.
[[nodiscard]] std::string supplement_html(const ReportSource& source,
                                          const std::vector<Figure>& figures,
                                          const std::vector<DrawnFigure>& drawn);

}  // namespace jnd::analysis
