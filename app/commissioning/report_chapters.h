#pragma once

#include <string>

#include "analysis/report/html_text.h"
#include "app/commissioning/commissioning_record.h"
#include "app/profile/known_profile.h"

namespace jnd::app {

// Chapters of the report of a commissioning.

/// A time in words: "2026-11-25 10:12" for "2026-11-25T10:12:00Z". A text that is no time is
/// returned unchanged.
[[nodiscard]] std::string moment_words(const std::string& at);

/// Writes every quantity, one row each.
void write_quantities(analysis::HtmlText& html, const CommissioningResults& results);
/// Writes how everything was measured, with the equations, and where the intervals come from.
void write_commissioning_methods(analysis::HtmlText& html, const CommissioningResults& results);
/// Writes the loads, the marks, the limits of the force during the measurements, and those of
/// sessions.
void write_conditions(analysis::HtmlText& html, const CommissioningResults& results,
                      const std::optional<KnownProfile>& profile);
/// Writes every line of the record and every daily check.
void write_history(analysis::HtmlText& html, const CommissioningRecord& record,
                   const std::optional<KnownProfile>& profile);
void write_commissioning_references(analysis::HtmlText& html,
                                    const CommissioningResults& results);

}  // namespace jnd::app
