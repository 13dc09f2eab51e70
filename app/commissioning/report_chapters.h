#pragma once

#include <string>

#include "analysis/report/html_text.h"
#include "app/commissioning/commissioning_record.h"
#include "app/profile/known_profile.h"

namespace jnd::app {

// Chapters of the report of a commissioning.

/// "2026-11-25 10:12" of "2026-11-25T10:12:00Z"; as it is where it is no moment.
[[nodiscard]] std::string moment_words(const std::string& at);

/// Every quantity, a row each.
void write_quantities(analysis::HtmlText& html, const CommissioningResults& results);
/// What was measured how, with its equations; and where the intervals are from.
void write_commissioning_methods(analysis::HtmlText& html, const CommissioningResults& results);
/// Loads, marks, limits of the force while it was measured, and those of sessions.
void write_conditions(analysis::HtmlText& html, const CommissioningResults& results,
                      const std::optional<KnownProfile>& profile);
/// Every line of the record and every daily check.
void write_history(analysis::HtmlText& html, const CommissioningRecord& record,
                   const std::optional<KnownProfile>& profile);
void write_commissioning_references(analysis::HtmlText& html,
                                    const CommissioningResults& results);

}  // namespace jnd::app
