#pragma once

#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What the planned contrasts came to, a sentence each, the primary ones first; nothing for a
/// study without.
void write_contrast_sentences(HtmlText& html, const StudyResults& results);

/// What deviates from what was registered; nothing where nothing was.
void write_deviations(HtmlText& html, const StudyResults& results);

/// A chapter with their tables: what was planned, what came of it, the same by other means, who
/// is left out.
void write_contrasts(HtmlText& html, const StudyResults& results);

}  // namespace jnd::analysis
