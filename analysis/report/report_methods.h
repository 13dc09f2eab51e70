#pragma once

#include "analysis/charts/study_titles.h"
#include "analysis/report/data_quality.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report.h"

namespace jnd::analysis {

/// What the chapters of a report are about.
struct ChapterSource {
  const ReportSource& report;
  const StudyTitles& titles;
  const std::vector<core::SessionRow>& sessions;  ///< The sessions that are analysed.
  const std::vector<SessionQuality>& quality;     ///< The quality of these sessions.
};

/// Writes what was run: design, apparatus, analysis, and where everything comes from.
void write_methods(HtmlText& html, const ChapterSource& source);
/// Write about the participants: the first a paragraph, and the second a row for each of them.
void write_participants_in_short(HtmlText& html, const ChapterSource& source);
void write_participants(HtmlText& html, const ChapterSource& source);
/// Write what is missing, resumed, undone or set aside, the recordings and the timing: the
/// first a paragraph, and the second tables.
void write_data_quality_in_short(HtmlText& html, const ChapterSource& source);
void write_data_quality(HtmlText& html, const ChapterSource& source);
/// Writes what the methods cite. It writes nothing if they cite nothing.
void write_references(HtmlText& html, const ChapterSource& source);
/// Writes the sessions with their seeds, hashes and versions.
void write_provenance(HtmlText& html, const ChapterSource& source);

}  // namespace jnd::analysis
