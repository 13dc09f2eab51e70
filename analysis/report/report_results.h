#pragma once

#include "analysis/charts/study_titles.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report.h"

namespace jnd::analysis {

/// Writes the most important results first: the primary values of each block, the primary tests
/// between blocks, and everything that has a published value, in short.
void write_at_a_glance(HtmlText& html, const StudyResults& results, const StudyTitles& titles);

/// Writes one section of the results: the primary values, other estimates, comparisons, who was
/// left out and why, everybody's own values, and answers in participants' own words. It shows
/// everything in the section.
void write_section(HtmlText& html, const StudyData& data, const StudyResults& results,
                   const StudyTitles& titles, const ResultsSection& section);

/// Writes the estimates of a section "questionnaires", one row for each item.
void write_questionnaires(HtmlText& html, const StudyData& data, const ResultsSection& section);

/// Writes everybody's own Weber fractions with their goodness of fit, and how many of the fits
/// with the pse at the reference the data reject. Returns false and writes nothing if a section
/// has none.
[[nodiscard]] bool write_own_fractions(HtmlText& html, const ResultsSection& section);

/// Writes on how many presentations width and speed rest, with cautions, and the strokes in
/// media that were explored outside of trials.
void write_movement(HtmlText& html, const ReportSource& source, const StudyTitles& titles);

/// The title of a section for readers, such as "Group D against Group E".
[[nodiscard]] std::string section_title(const StudyTitles& titles, const std::string& name);

}  // namespace jnd::analysis
