#pragma once

#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Writes one sentence on the result of each planned contrast, primary ones first. It writes
/// nothing if the study has none.
void write_contrast_sentences(HtmlText& html, const StudyResults& results);

/// Writes the deviations from what was registered. It writes nothing if nothing was registered.
void write_deviations(HtmlText& html, const StudyResults& results);

/// Writes a chapter with the tables of the contrasts: what was planned, the results, results by
/// other methods, and who is left out.
void write_contrasts(HtmlText& html, const StudyResults& results);

}  // namespace jnd::analysis
