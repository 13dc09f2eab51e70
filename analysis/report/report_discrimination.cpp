#include <algorithm>

#include "analysis/report/report_results.h"
#include "analysis/results/discrimination_own_values.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"

namespace jnd::analysis {
namespace {

/// Opens ends that lie far away. There the likelihood is nearly flat and bounds nothing,
/// although it crosses its threshold.
Interval bounded(Interval ci95, const std::optional<double>& value) {
  constexpr double kFar = 1000.0;
  if (value && ci95.high && *ci95.high > kFar * *value) ci95.high.reset();
  if (value && ci95.low && *ci95.low < *value / kFar) ci95.low.reset();
  return ci95;
}

/// One participant's values in a block, by the endings of their names.
struct OwnRow {
  const ResultsSection& section;
  std::string participant;

  [[nodiscard]] const ParticipantEstimate* find(const std::string& name) const {
    for (const ParticipantEstimate& own : section.participants) {
      if (own.participant == participant && own.name == section.name + "." + name) return &own;
    }
    return nullptr;
  }
  /// The value in words. It is "– *" if there is a reason why it is missing; the reason goes
  /// into the notes below the table.
  [[nodiscard]] std::string value(const std::string& name, const std::string& title,
                                  std::vector<std::string>& notes) const {
    const ParticipantEstimate* const own = find(name);
    if (own == nullptr) return "–";
    for (const std::string& caution : own->cautions) {
      notes.push_back("§ " + participant + ", " + title + ": " + caution);
    }
    if (own->value || own->reason.empty())
      return with_interval(own->value, bounded(own->ci95, own->value)) +
             (own->cautions.empty() ? "" : " §");
    notes.push_back("* " + participant + ", " + title + ": " + said_composed(own->reason));
    return "– *";
  }
  [[nodiscard]] std::string goodness(const std::string& name) const {
    const ParticipantEstimate* const own = find(name);
    if (own == nullptr || !own->value) return "–";
    return p_words(own->value) + (*own->value < kRejectedBelow ? " †" : "");
  }
};

std::string rejected_words(const FitsBorne& borne) {
  std::string words = said(
      "† The answers reject the curve (p < 0.05). Goodness of fit: the share of answers "
      "redrawn from the fitted curve that lie at least as far off it. With the point of "
      "subjective equality (PSE) at the reference {} of {}{} rejected",
      std::to_string(borne.num_rejected), counted_words(borne.num_fits, "fit"),
      (borne.num_rejected == 1 ? said(" is") : said(" are")));
  if (borne.num_rejected == 0) return words + ".";
  return said(
      "{}: where the PSE lies elsewhere, such a Weber fraction holds this bias beside the "
      "sensitivity; the one with a free PSE does not.",
      words);
}

}  // namespace

bool write_own_fractions(HtmlText& html, const ResultsSection& section) {
  std::vector<std::string> people;
  for (const ParticipantEstimate& own : section.participants) {
    if (own.name == section.name + ".weber_fraction_free_pse")
      people.push_back(own.participant);
  }
  if (people.empty()) return false;
  const bool frees = section.own_fractions_free_pse;
  HtmlTable table{
      .caption = said(
          "Values of every participant, with 95 % intervals: Weber fraction w with the PSE {}",
          (frees ? said("free, as the primary value has it, and at the reference")
                 : said("at the reference, as the primary value has it, and free"))),
      .columns = {{said("Participant")}}};
  const HtmlTable::Column at_reference = {said("w, PSE at the reference"), true};
  const HtmlTable::Column free = {said("w, PSE free"), true};
  const HtmlTable::Column goodness = {said("Goodness p"), true};
  if (frees) {
    table.columns.insert(table.columns.end(),
                         {free, {"PSE", true}, goodness, at_reference, goodness});
  } else {
    table.columns.insert(table.columns.end(),
                         {at_reference, goodness, free, {"PSE", true}, goodness});
  }
  std::vector<std::string> reasons;
  for (const std::string& person : people) {
    const OwnRow row{section, person};
    const std::vector<std::string> fixed = {
        row.value("weber_fraction", said("PSE at the reference"), reasons),
        row.goodness("goodness_p")};
    const ParticipantEstimate* const pse = row.find("pse");
    const std::vector<std::string> freed = {
        row.value("weber_fraction_free_pse", said("PSE free"), reasons),
        pse == nullptr ? "–" : with_interval(pse->value, bounded(pse->ci95, pse->value)),
        row.goodness("goodness_p_free_pse")};
    std::vector<std::string> cells = {person};
    for (const auto* own : {frees ? &freed : &fixed, frees ? &fixed : &freed}) {
      cells.insert(cells.end(), own->begin(), own->end());
    }
    table.rows.push_back(std::move(cells));
  }
  table.notes.push_back(rejected_words(fits_borne(section, section.name)));
  table.notes.emplace_back(said("An end more than a factor 1000 off its value is left open."));
  table.notes.insert(table.notes.end(), reasons.begin(), reasons.end());
  html.table(table);
  return true;
}

}  // namespace jnd::analysis
