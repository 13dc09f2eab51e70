#include "analysis/report/report_results.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "analysis/report/estimate_title.h"
#include "analysis/report/report_contrasts.h"
#include "analysis/report/report_published.h"
#include "analysis/results/number_words.h"
#include "analysis/results/test_families.h"
#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::analysis {
namespace {

std::string effect_words(const Comparison& c) {
  if (c.cohen_dz) return "d_z " + with_interval(c.cohen_dz, c.cohen_dz_ci95);
  if (c.hedges_g) return "g " + with_interval(c.hedges_g, c.hedges_g_ci95);
  if (c.rank_biserial) return "r_rb " + number_words(c.rank_biserial);
  return "–";
}

/// Why numbers may be wrong for these data. It follows their description.
std::string caution_words(const std::vector<std::string>& cautions) {
  std::string words;
  for (const std::string& caution : cautions)
    words += said(". Caution: {}", said_composed(caution));
  return words;
}

/// A statistic such as "t = 2.31". Rank tests have every name of the statistic: "V = 45, T =
/// 0".
std::string statistic_words(const Comparison& c) {
  std::string words;
  for (const auto& [name, value] : c.all_statistics()) {
    const bool is_of_ranks = name != "t" && c.kind != Comparison::Kind::kDispersion;
    words += (words.empty() ? "" : ", ") + name + " = " +
             (is_of_ranks ? shortest_words(value) : number_words(value, 2));
  }
  return words.empty() ? "–" : words;
}

/// The index of the column of adjusted p values, if there are any.
constexpr std::size_t kHolmColumn = 5;

std::vector<std::string> comparison_row(const NamedComparison& named,
                                        const StudyTitles& titles) {
  const Comparison& c = named.comparison;
  std::string name = titles.titled(named.name);
  if (!named.family.empty()) name += " [" + said_of(named.family) + "]";
  name += caution_words(named.cautions);
  if (c.status != FitStatus::kOk) {
    return {name, said_of(std::string(to_string(c.status))) + ": " + said_composed(c.reason),
            "–",  "–",
            "–",  "–",
            "–",  "–"};
  }
  using Kind = Comparison::Kind;
  const bool are_two_groups = c.of_other_people || c.kind == Kind::kWelch ||
                              c.kind == Kind::kPooled || c.kind == Kind::kRankSum;
  std::string count = std::to_string(c.num_a);
  if (c.num_b > 0 && (are_two_groups || c.num_b != c.num_a)) {
    count += ", " + std::to_string(c.num_b);
  }
  // The effect that the test is about: the median of pairwise differences for rank tests, and
  // the mean otherwise.
  std::string effect =
      c.hodges_lehmann
          ? "Hodges-Lehmann " + with_interval(c.hodges_lehmann, c.hodges_lehmann_ci95)
          : with_interval(c.estimate, c.ci95);
  if (named.ratio()) {
    effect = said("{} {} times as large; its logarithm differs by {}", said_of(named.ratio_of),
                  with_interval(named.ratio(), named.ratio_ci95()), effect);
  }
  return {name,
          std::move(effect),
          statistic_words(c),
          c.degrees_of_freedom ? number_words(c.degrees_of_freedom, 1) : "–",
          p_words(c.p_value),
          p_words(named.p_value_holm),
          effect_words(c),
          count};
}

HtmlTable estimates_table(const std::string& caption) {
  return {.caption = caption,
          .columns = {{.title = said("Estimate, and what it is"), .is_titled = true},
                      {said("Value"), true},
                      {said("95 % interval"), true},
                      {said("Unit")},
                      {"n", true}}};
}

std::vector<std::string> estimate_row(const StudyTitles& titles, const Estimate& estimate) {
  const std::string words =
      estimate.meaning +
      (estimate.reason.empty() ? "" : said(". No value: {}", said_composed(estimate.reason))) +
      caution_words(estimate.cautions);
  return {estimate_title(titles, estimate.name, estimate.unit) + "\n" + estimate.name + "\n" +
              words,
          number_words(estimate.value),
          interval_words(estimate.name, estimate.ci95, estimate.value),
          unit_words(estimate.unit), std::to_string(estimate.n)};
}

/// Writes the estimates of a section that answer the question, or those that do not.
void write_estimates(HtmlText& html, const StudyResults& results, const StudyTitles& titles,
                     const ResultsSection& section, bool primary, const char* caption) {
  const bool any_published = std::ranges::any_of(section.estimates, &Estimate::is_published);
  HtmlTable table = estimates_table(caption);
  if (any_published) table.columns.push_back({said("Published"), true});
  if (any_published && results.simulated) table.columns.push_back({said("Basis")});
  std::vector<const Estimate*> published;
  for (const Estimate& estimate : section.estimates) {
    if (estimate.primary != primary) continue;
    std::vector<std::string> row = estimate_row(titles, estimate);
    if (any_published) row.push_back(published_words(estimate));
    if (any_published && results.simulated) row.push_back(basis_words(estimate));
    table.rows.push_back(std::move(row));
    if (estimate.is_published()) published.push_back(&estimate);
  }
  table.notes = published_notes(published);
  html.table(table);
}

void write_comparisons(HtmlText& html, const ResultsSection& section,
                       const StudyTitles& titles) {
  HtmlTable table{.caption = said("Comparisons, with 95 % intervals; p two-sided"),
                  .columns = {{said("Comparison")},
                              {said("Difference or correlation")},
                              {said("Statistic"), true},
                              {"df", true},
                              {"p", true},
                              {said("p, Holm"), true},
                              {said("Effect size")},
                              {"n", true}}};
  std::vector<std::string> methods;
  bool any_adjusted = false;
  for (const NamedComparison& named : section.comparisons) {
    table.rows.push_back(comparison_row(named, titles));
    const std::string about = family_note(named);
    if (!about.empty() && std::ranges::find(table.notes, about) == table.notes.end()) {
      table.notes.push_back(about);
    }
    any_adjusted = any_adjusted || named.p_value_holm;
    const std::string& method = named.comparison.method;
    if (!method.empty() && std::find(methods.begin(), methods.end(), method) == methods.end()) {
      methods.push_back(method);
    }
  }
  if (!any_adjusted) {
    table.columns.erase(table.columns.begin() + kHolmColumn);
    for (auto& row : table.rows) row.erase(row.begin() + kHolmColumn);
  }
  if (!methods.empty()) {
    std::string note;
    for (const std::string& method : methods)
      note += (note.empty() ? said("Tests: ") : "; ") + said_composed(method);
    table.notes.push_back(note + ".");
  }
  html.table(table);
}

/// The common beginning of all names up to a dot, such as "magnitude_estimation.".
std::string common_start(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string start = names.front().substr(0, names.front().find('.') + 1);
  for (const std::string& name : names) {
    if (!name.starts_with(start)) return "";
  }
  return start;
}

/// Everybody's own numbers, with one column for each number.
class OwnValues {
 public:
  explicit OwnValues(const ResultsSection& section) {
    for (const ParticipantEstimate& own : section.participants) {
      if (std::find(names_.begin(), names_.end(), own.name) == names_.end()) {
        names_.push_back(own.name);
      }
      if (std::find(people_.begin(), people_.end(), own.participant) == people_.end()) {
        people_.push_back(own.participant);
      }
      has_intervals_ = has_intervals_ || own.ci95.low || own.ci95.high;
      cells_[{own.participant, own.name}] = &own;
    }
  }

  void write(HtmlText& html) const {
    // The number of columns that fit on a page.
    const std::size_t num_columns = has_intervals_ ? 3 : 7;
    for (std::size_t first = 0; first < names_.size(); first += num_columns) {
      html.table(table_of(first, std::min(first + num_columns, names_.size())));
    }
  }

 private:
  [[nodiscard]] HtmlTable table_of(std::size_t first, std::size_t end) const {
    const std::string start = common_start(names_);
    HtmlTable table{.caption = said("Values of every participant{}",
                                    (has_intervals_ ? said(", with 95 % intervals") : "")),
                    .columns = {{said("Participant")}}};
    for (std::size_t i = first; i < end; ++i) {
      table.columns.push_back({names_[i].substr(start.size()), true});
    }
    for (const std::string& person : people_) {
      std::vector<std::string> row = {person};
      for (std::size_t i = first; i < end; ++i) {
        const auto found = cells_.find({person, names_[i]});
        if (found == cells_.end()) {
          row.emplace_back("–");
          continue;
        }
        const ParticipantEstimate& own = *found->second;
        const bool is_told = !own.value && !own.reason.empty();
        row.push_back(is_told ? "– *" : with_interval(own.name, own.value, own.ci95));
        if (is_told)
          table.notes.push_back("* " + person + ", " + names_[i] + ": " +
                                said_composed(own.reason));
        for (const std::string& caution : own.cautions) {
          row.back() += " §";
          table.notes.push_back("§ " + person + ", " + names_[i] + ": " +
                                said_composed(caution));
        }
      }
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  std::vector<std::string> names_, people_;
  std::map<std::pair<std::string, std::string>, const ParticipantEstimate*> cells_;
  bool has_intervals_ = false;
};

void write_excluded(HtmlText& html, const ResultsSection& section) {
  HtmlTable table{.caption = said("Left out, and why"),
                  .columns = {{said("Who")}, {said("Reason")}}};
  for (const ExcludedParticipant& one : section.excluded) {
    table.rows.push_back({one.participant, said_composed(one.reason)});
  }
  html.table(table);
}

void write_cautions(HtmlText& html, const ResultsSection& section) {
  HtmlTable table{
      .caption = said("Cautions: in the numbers all the same, and why they may be wrong"),
      .columns = {{said("Who")}, {said("What")}}};
  for (const Caution& one : section.cautions) {
    table.rows.push_back({one.participant, said_composed(one.caution)});
  }
  html.table(table);
}

/// Writes each question, and below it the answers.
void write_free_answers(HtmlText& html, const ResultsSection& section) {
  std::vector<std::string> items;
  for (const FreeAnswer& one : section.free_answers) {
    if (std::find(items.begin(), items.end(), one.item) == items.end()) {
      items.push_back(one.item);
    }
  }
  if (!items.empty()) html.heading(4, said("In participants’ own words"));
  for (const std::string& item : items) {
    std::string question = item;
    std::string answers;
    for (const FreeAnswer& one : section.free_answers) {
      if (one.item != item) continue;
      if (!one.question.empty()) question = one.question;
      answers += (answers.empty() ? "" : " · ") + one.participant + ": " + one.answer;
    }
    html.paragraph_about(question, answers);
  }
}

/// The primary values of each block. A value that its own goodness of fit rejects is not shown.
HtmlTable primary_table(const StudyResults& results, const StudyTitles& titles) {
  HtmlTable table = estimates_table(said("Primary values"));
  bool any_rejected = false;
  for (const Estimate* estimate : estimates_where(results, &Estimate::primary)) {
    std::vector<std::string> row = estimate_row(titles, *estimate);
    if (estimate->is_rejected_by_fit) {
      any_rejected = true;
      row[1] = "– †";
      row[2] = "–";
    }
    table.rows.push_back(std::move(row));
  }
  if (any_rejected) {
    table.notes.emplace_back(
        said("† Not told here, for its own goodness of fit rejects the curve that it is of (p "
             "< 0.01): a single number would promise more than these answers hold. The value "
             "and its caution are in the supplement."));
  }
  return table;
}

ResultsSection primary_comparisons(const StudyResults& results) {
  ResultsSection primary;
  for (const ResultsSection& section : results.sections) {
    std::ranges::copy_if(section.comparisons, std::back_inserter(primary.comparisons),
                         &NamedComparison::primary);
  }
  return primary;
}

}  // namespace

std::string section_title(const StudyTitles& titles, const std::string& name) {
  std::vector<std::pair<std::string, const char*>> endings = {
      {"_intervals", said_later(": order of the intervals")},
      {"_catch_trials", said_later(": catch trials")},
      {"_questions", said_later(": questions after each trial")}};
  for (const experiments::Procedure* procedure : experiments::procedures()) {
    const experiments::RuleWords words = procedure->rule_words();
    if (*words.section == '\0') continue;
    endings.emplace_back("_" + std::string(procedure->name()), words.section);
  }
  for (const auto& [ending, title] : endings) {
    if (titles.stages.contains(name) || !name.ends_with(ending)) continue;
    return section_title(titles, name.substr(0, name.size() - ending.size())) + said(title);
  }
  const std::string between = "_against_";
  const std::size_t at = name.find(between);
  if (at != std::string::npos) {
    return said("{} against {}", titles.short_title_of(name.substr(0, at)),
                titles.short_title_of(name.substr(at + between.size())));
  }
  std::string title = titles.title_of(name);
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') {
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
  }
  return titles.stages.contains(name) ? title : said_of(title);
}

void write_at_a_glance(HtmlText& html, const StudyResults& results, const StudyTitles& titles) {
  const HtmlTable primary = primary_table(results, titles);
  const HtmlTable published = published_in_short(results, titles);
  const ResultsSection comparisons = primary_comparisons(results);
  if (primary.rows.empty() && published.rows.empty()) return;
  html.heading(2, said("At a glance"));
  write_contrast_sentences(html, results);
  if (!primary.rows.empty()) html.table(primary);
  if (!comparisons.comparisons.empty()) write_comparisons(html, comparisons, titles);
  if (!published.rows.empty()) html.table(published);
}

void write_section(HtmlText& html, const StudyData& data, const StudyResults& results,
                   const StudyTitles& titles, const ResultsSection& section) {
  if (section.name == "questionnaires") {
    write_questionnaires(html, data, section);
  } else {
    const bool any_primary = std::ranges::any_of(section.estimates, &Estimate::primary);
    write_estimates(html, results, titles, section, true, said("The answer to what was asked"));
    write_estimates(html, results, titles, section, false,
                    any_primary ? said("How else it can be estimated, and what else was found")
                                : said("Estimates"));
  }
  write_comparisons(html, section, titles);
  write_excluded(html, section);
  write_cautions(html, section);
  if (!write_own_fractions(html, section)) OwnValues(section).write(html);
  write_free_answers(html, section);
}

}  // namespace jnd::analysis
