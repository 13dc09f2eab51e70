#include "analysis/report/report_published.h"

#include <algorithm>
#include <iterator>

#include "analysis/report/estimate_title.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The median and the middle 95 % of the simulated studies, such as "0.70 (0.44 to 1.02)".
std::string simulated_words(const Estimate& estimate) {
  if (!estimate.predictive) return "–";
  const PredictiveTail& of = *estimate.predictive;
  return with_interval(of.median, {.low = of.low, .high = of.high});
}

/// The share of simulated studies that are as far on the published value's side, with its
/// standard error, such as "0.004 below (se 0.002)".
std::string tail_words(const Estimate& estimate) {
  if (!estimate.predictive) return "–";
  const PredictiveTail& of = *estimate.predictive;
  const std::string error =
      of.tail > 0.0 ? said(" (se {})", number_words(of.standard_error, 3)) : "";
  return p_words(of.tail) + (of.is_below ? said(" below") : said(" above")) + error;
}

std::string joint_words(const JointTail& joint, const std::string& which) {
  return said(
      "{}, {} together: {} of the simulated studies are as far out (standard error {}).", which,
      counted_words(joint.num_statistics, "value"), number_words(joint.p_value, 3),
      number_words(joint.standard_error, 3));
}

std::vector<std::string> predictive_notes(const Predictive& predictive) {
  if (predictive.num_studies == 0) {
    return predictive.reason.empty()
               ? std::vector<std::string>{}
               : std::vector<std::string>{
                     said("Without simulated studies to compare with: {}.", predictive.reason)};
  }
  std::vector<std::string> notes = {said(
      "Simulated studies: {} of {}, drawn from {} simulated people, by the statistic that was "
      "published: median (middle 95 %). Tail: the share of them as far on the published "
      "value’s side. The published study is taken for one more of these, so its own error is "
      "in it; of many values some lie far out by chance, which is what those together are for.",
      std::to_string(predictive.num_studies),
      counted_words(predictive.num_participants, "participant"),
      std::to_string(predictive.num_people))};
  if (predictive.joint) notes.push_back(joint_words(*predictive.joint, said("All")));
  if (predictive.joint_held_out) {
    notes.push_back(joint_words(*predictive.joint_held_out, said("Held out, not implied")));
  }
  return notes;
}

}  // namespace

std::string published_words(const Estimate& estimate) {
  if (estimate.published_positive && !estimate.published) return "> 0";
  if (!estimate.published) return "–";
  std::string words = shortest_words(*estimate.published);
  if (estimate.published_sd) words += " ± " + shortest_words(*estimate.published_sd);
  return words;
}

std::vector<std::string> published_notes(const std::vector<const Estimate*>& estimates) {
  const bool any_sd = std::ranges::any_of(
      estimates, [](const Estimate* estimate) { return estimate->published_sd.has_value(); });
  if (!any_sd) return {};
  return {
      said("Published a ± b: b is the standard deviation between participants; our 95 % "
           "interval is that of the estimate itself, and narrower.")};
}

std::string basis_words(const Estimate& estimate) {
  if (!estimate.is_published()) return "–";
  if (estimate.calibrated) return "calibrated";
  return estimate.implied ? "implied" : said("held out");
}

std::string unit_words(const std::string& unit) {
  std::string words;
  for (const char letter : unit == "1" ? "" : unit) {
    words += letter == ' ' ? "\u00a0" : std::string(1, letter);
  }
  return words;
}

HtmlTable published_in_short(const StudyResults& results, const StudyTitles& titles) {
  const bool has_simulated = results.predictive.num_studies > 0;
  HtmlTable table{.caption = said("Ours beside the published values"),
                  .columns = {{.title = said("Estimate")},
                              {.title = said("Ours (95 % interval)"), .is_number = true},
                              {.title = said("Unit")},
                              {.title = said("Published"), .is_number = true}}};
  if (has_simulated) {
    table.columns.push_back(
        {.title = said("As far out, of simulated studies"), .is_number = true});
  }
  for (const Estimate* estimate : estimates_where(results, &Estimate::is_published)) {
    std::vector<std::string> row = {
        estimate_title(titles, estimate->name, estimate->unit),
        with_interval(estimate->name, estimate->value, estimate->ci95),
        unit_words(estimate->unit), published_words(*estimate)};
    if (has_simulated) {
      row.push_back(estimate->predictive ? p_words(estimate->predictive->tail) : "–");
    }
    table.rows.push_back(std::move(row));
  }
  table.notes.emplace_back(
      said("How each was published, and what was simulated to compare it with, is in the "
           "supplement."));
  return table;
}

HtmlTable published_table(const StudyResults& results, const StudyTitles& titles) {
  const bool has_simulated = results.predictive.num_studies > 0;
  HtmlTable table{
      .caption = said("Ours beside the published values"),
      .columns = {{.title = said("Estimate, and how it was published"), .is_titled = true},
                  {said("Ours (95 % interval)"), true},
                  {said("Unit")},
                  {said("Published"), true}}};
  if (has_simulated) {
    table.columns.push_back({said("Simulated studies"), true});
    table.columns.push_back({said("Tail"), true});
  }
  if (results.simulated) table.columns.push_back({said("Basis")});
  const std::vector<const Estimate*> published =
      estimates_where(results, &Estimate::is_published);
  for (const Estimate* estimate : published) {
    std::vector<std::string> row = {
        estimate_title(titles, estimate->name, estimate->unit) + "\n" + estimate->name +
            (estimate->published_statistic.empty() ? "" : "\n") + estimate->published_statistic,
        with_interval(estimate->name, estimate->value, estimate->ci95),
        unit_words(estimate->unit), published_words(*estimate)};
    if (has_simulated) {
      row.push_back(simulated_words(*estimate));
      row.push_back(tail_words(*estimate));
    }
    if (results.simulated) row.push_back(basis_words(*estimate));
    table.rows.push_back(std::move(row));
  }
  table.notes = published_notes(published);
  std::ranges::move(predictive_notes(results.predictive), std::back_inserter(table.notes));
  if (results.simulated) {
    table.notes.emplace_back(said(
        "Calibrated: the simulated laboratory was fitted to the published value. Implied: it "
        "follows from values that were. Held out: the laboratory knows nothing of it."));
  }
  return table;
}

}  // namespace jnd::analysis
