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

/// The data of a report. The caller decides whether the study may be seen (in double-blind
/// studies).
struct ReportSource {
  const core::StudyStore& store;
  const StudyData& data;
  const StudyResults& results;
  ResultsOptions results_options;  ///< The options with which the results were computed.
  const MovementAnalysis& movement;
  const DeliveredReport* delivered = nullptr;  ///< nullptr if no device was measured.
  std::string program_version;
  bool pilot = false;  ///< Whether pilot sessions are among the data.
};

/// Writes a report as `write_document` does. The same study gives the same bytes.
/// Not real time.
[[nodiscard]] ReportOutcome write_report(const ReportSource& source,
                                         const std::filesystem::path& folder,
                                         const ReportOptions& options);

/// Every figure for which there are data, in the order of the report.
[[nodiscard]] std::vector<Figure> figures_of(const ReportSource& source);

/// The content of a paper as one self-contained HTML document: the answers, how they were
/// found, and one figure for each part of the results. `drawn` is in the order of `figures`.
[[nodiscard]] std::string report_html(const ReportSource& source,
                                      const std::vector<Figure>& figures,
                                      const std::vector<DrawnFigure>& drawn);

/// Everything else: every participant, every estimate, every comparison, every other figure,
/// and where all of it comes from.
[[nodiscard]] std::string supplement_html(const ReportSource& source,
                                          const std::vector<Figure>& figures,
                                          const std::vector<DrawnFigure>& drawn);

}  // namespace jnd::analysis
