#pragma once

#include "analysis/charts/study_titles.h"
#include "analysis/report/data_quality.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report.h"

namespace jnd::analysis {

/// Whatever the chapters of a report say something about.
struct ChapterSource {
  const ReportSource& report;
  const StudyTitles& titles;
  const std::vector<core::SessionRow>& sessions;  ///< Sessions that are analysed.
  const std::vector<SessionQuality>& quality;     ///< Quality of these sessions.
};

/// What was run: design, apparatus, analysis, where everything comes from.
void write_methods(HtmlText& html, const ChapterSource& source);
/// The participants who took part: a paragraph, and a row for each of them.
void write_participants_in_short(HtmlText& html, const ChapterSource& source);
void write_participants(HtmlText& html, const ChapterSource& source);
/// Missing, resumed, undone, set aside; recordings; timing: a paragraph, and tables.
void write_data_quality_in_short(HtmlText& html, const ChapterSource& source);
void write_data_quality(HtmlText& html, const ChapterSource& source);
/// What the methods cite; nothing where they cite nothing.
void write_references(HtmlText& html, const ChapterSource& source);
/// Sessions with their seeds, hashes, versions.
void write_provenance(HtmlText& html, const ChapterSource& source);

}  // namespace jnd::analysis
