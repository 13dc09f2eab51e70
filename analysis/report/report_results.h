#pragma once

#include "analysis/charts/study_titles.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report.h"

namespace jnd::analysis {

/// Before all else what each block was asked for, the primary tests between blocks, and
/// everything that has a published value, in short.
void write_at_a_glance(HtmlText& html, const StudyResults& results, const StudyTitles& titles);

/// One section of the results: what is the answer, how else it was estimated, comparisons, who
/// was left out and why, everybody's own values, answers in their own words. Whatever is in the
/// section is shown.
void write_section(HtmlText& html, const StudyData& data, const StudyResults& results,
                   const StudyTitles& titles, const ResultsSection& section);

/// The estimates of a section "questionnaires", a row an item.
void write_questionnaires(HtmlText& html, const StudyData& data, const ResultsSection& section);

/// Everybody's own Weber fractions with their goodness of fit, and how many of the fits with
/// the pse at the reference the data reject. False, and nothing, for a section without any.
[[nodiscard]] bool write_own_fractions(HtmlText& html, const ResultsSection& section);

/// On how many presentations width and speed rest, with cautions; strokes in media explored
/// outside of trials.
void write_movement(HtmlText& html, const ReportSource& source, const StudyTitles& titles);

/// "Group D against Group E": a section's name to readers.
[[nodiscard]] std::string section_title(const StudyTitles& titles, const std::string& name);

}  // namespace jnd::analysis
