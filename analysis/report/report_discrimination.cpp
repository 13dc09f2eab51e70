#include <algorithm>

#include "analysis/discrimination_own_values.h"
#include "analysis/report/report_results.h"
#include "analysis/report/report_words.h"

namespace jnd::analysis {
namespace {

/// A likelihood that flattens out bounds nothing, though it crosses its threshold far away.
Interval bounded(Interval ci95, const std::optional<double>& value) {
  constexpr double kFar = 1000.0;
  if (value && ci95.high && *ci95.high > kFar * *value) ci95.high.reset();
  if (value && ci95.low && *ci95.low < *value / kFar) ci95.low.reset();
  return ci95;
}

/// One participant's values of a block, by the ends of their names.
struct OwnRow {
  const ResultsSection& section;
  std::string participant;

  [[nodiscard]] const ParticipantEstimate* find(const std::string& name) const {
    for (const ParticipantEstimate& own : section.participants) {
      if (own.participant == participant && own.name == section.name + "." + name) return &own;
    }
    return nullptr;
  }
  /// "– *" where there is a reason why there is none, which goes below the table.
  [[nodiscard]] std::string value(const std::string& name, const std::string& title,
                                  std::vector<std::string>& notes) const {
    const ParticipantEstimate* const own = find(name);
    if (own == nullptr) return "–";
    if (own->value || own->reason.empty())
      return with_interval(own->value, bounded(own->ci95, own->value));
    notes.push_back("* " + participant + ", " + title + ": " + own->reason);
    return "– *";
  }
  [[nodiscard]] std::string goodness(const std::string& name) const {
    const ParticipantEstimate* const own = find(name);
    if (own == nullptr || !own->value) return "–";
    return p_words(own->value) + (*own->value < kRejectedBelow ? " †" : "");
  }
};

std::string rejected_words(const FitsBorne& borne) {
  std::string words =
      "† The answers reject the curve (p < 0.05). Goodness of fit: the share of answers "
      "redrawn "
      "from the fitted curve that lie at least as far off it. With the point of subjective "
      "equality (PSE) at the reference " +
      std::to_string(borne.num_rejected) + " of " + counted_words(borne.num_fits, "fit") +
      (borne.num_rejected == 1 ? " is" : " are") + " rejected";
  if (borne.num_rejected == 0) return words + ".";
  return words +
         ": where the PSE lies elsewhere, such a Weber fraction holds this bias beside the "
         "sensitivity; the one with a free PSE does not.";
}

}  // namespace

bool write_own_fractions(HtmlText& html, const ResultsSection& section) {
  std::vector<std::string> people;
  for (const ParticipantEstimate& own : section.participants) {
    if (own.name == section.name + ".weber_fraction_free_pse")
      people.push_back(own.participant);
  }
  if (people.empty()) return false;
  HtmlTable table{
      .caption =
          "Values of every participant, with 95 % intervals: Weber fraction w with the "
          "PSE at the reference and with a free PSE",
      .columns = {{"Participant"},
                  {"w, PSE at the reference", true},
                  {"Goodness p", true},
                  {"w, PSE free", true},
                  {"PSE", true},
                  {"Goodness p", true}}};
  std::vector<std::string> reasons;
  for (const std::string& person : people) {
    const OwnRow row{section, person};
    std::vector<std::string> cells = {person};
    cells.push_back(row.value("weber_fraction", "PSE at the reference", reasons));
    cells.push_back(row.goodness("goodness_p"));
    cells.push_back(row.value("weber_fraction_free_pse", "PSE free", reasons));
    const ParticipantEstimate* const pse = row.find("pse");
    cells.push_back(pse == nullptr ? "–"
                                   : with_interval(pse->value, bounded(pse->ci95, pse->value)));
    cells.push_back(row.goodness("goodness_p_free_pse"));
    table.rows.push_back(std::move(cells));
  }
  table.notes.push_back(rejected_words(fits_borne(section, section.name)));
  table.notes.emplace_back("An end more than a factor 1000 off its value is left open.");
  table.notes.insert(table.notes.end(), reasons.begin(), reasons.end());
  html.table(table);
  return true;
}

}  // namespace jnd::analysis
