#include "analysis/report/report_contrasts.h"

#include <algorithm>
#include <string>
#include <vector>

#include "analysis/results/contrast_words.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"

namespace jnd::analysis {
namespace {

using experiments::PlannedContrast;

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string title_of(const ContrastResult& one) {
  const PlannedContrast& plan = one.plan;
  std::string title = spaced(plan.name);
  if (!one.hypothesis.empty()) title += "\n" + one.hypothesis;
  return title;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : "; ") + word;
  return all;
}

HtmlTable plan_table(const StudyResults& results) {
  HtmlTable table{.caption = said("Contrasts as they were planned in the study file"),
                  .columns = {{said("Contrast"), false, true},
                              {said("In")},
                              {said("Conditions and their weights")},
                              {said("Role, family")},
                              {said("Direction")},
                              {said("Smallest effect"), true},
                              {said("Alpha"), true},
                              {said("Correction")}}};
  for (const ContrastResult& one : results.contrasts) {
    const PlannedContrast& plan = one.plan;
    const std::string role = plan.primary ? "primary" : "secondary";
    table.rows.push_back(
        {title_of(one), said_measure(plan), joined(one.conditions),
         plan.family == role ? said_of(role) : said_of(role) + ", " + plan.family,
         said_of(to_string(plan.direction)),
         plan.smallest_effect ? shortest_words(*plan.smallest_effect) : "–",
         shortest_words(plan.alpha), said_of(to_string(plan.correction))});
  }
  return table;
}

std::vector<std::string> test_row(const std::string& title, const ContrastTest& test,
                                  const std::optional<double>& adjusted) {
  std::string statistic = "–";
  if (test.statistic) {
    statistic = test.statistic_name + " = " + number_words(test.statistic, 2);
  }
  return {title,
          test.effect ? number_words(test.effect) : "– " + said_composed(test.reason),
          test.effect ? interval_words(test.ci95, test.effect) : "–",
          statistic,
          test.degrees_of_freedom ? number_words(test.degrees_of_freedom, 1) : "–",
          p_words(test.p_value),
          p_words(adjusted),
          std::to_string(test.num_participants)};
}

HtmlTable outcome_table(const std::string& caption) {
  return {.caption = caption,
          .columns = {{said("Contrast"), false, true},
                      {said("Effect"), true},
                      {said("95 % interval"), true},
                      {said("Statistic"), true},
                      {"df", true},
                      {"p", true},
                      {said("p, adjusted"), true},
                      {"n", true}}};
}

}  // namespace

void write_contrast_sentences(HtmlText& html, const StudyResults& results) {
  for (const bool primary : {true, false}) {
    std::vector<std::string> sentences;
    for (const ContrastResult& one : results.contrasts) {
      if (one.plan.primary != primary) continue;
      sentences.push_back(one.sentence.empty()
                              ? said("The contrast “{}” has no value: {}.",
                                     spaced(one.plan.name), said_composed(one.test.reason))
                              : one.sentence);
    }
    if (sentences.empty()) continue;
    html.paragraph(primary ? said("What the study was planned to answer:")
                           : said("What else was planned:"));
    html.list(sentences);
  }
}

void write_deviations(HtmlText& html, const StudyResults& results) {
  const PreregisteredStudy& plan = results.preregistration;
  if (plan.registered_on.empty()) return;
  html.heading(2, said("Deviations from the preregistration"));
  html.paragraph(said("The study was registered on {} (SHA-256 {}). {}", plan.registered_on,
                      plan.sha256,
                      (plan.deviations.empty() ? said("Nothing deviates from it.") : "")));
  HtmlTable table{.caption = said("What is not as it was planned"),
                  .columns = {{said("What")}, {said("Planned")}, {said("Found")}}};
  for (const Deviation& one : plan.deviations) {
    table.rows.push_back({one.topic, one.planned, one.found});
  }
  html.table(table);
}

void write_contrasts(HtmlText& html, const StudyResults& results) {
  if (results.contrasts.empty()) return;
  html.heading(3, said("Planned contrasts"));
  html.table(plan_table(results));
  HtmlTable answers = outcome_table(said("What came of them"));
  HtmlTable otherwise = outcome_table(said("The same by other means"));
  HtmlTable equivalence{.caption = said("Against the smallest effect of interest"),
                        .columns = {{said("Contrast"), false, true},
                                    {said("Margin"), true},
                                    {said("Interval"), true},
                                    {said("p, two one-sided tests"), true},
                                    {said("Equivalent")}}};
  HtmlTable excluded{
      .caption = said("Left out of people's own contrasts, and why"),
      .columns = {{said("Contrast"), false, true}, {said("Who")}, {said("Reason")}}};
  std::vector<std::string> cautions;
  for (const ContrastResult& one : results.contrasts) {
    const std::string title = spaced(one.plan.name);
    answers.rows.push_back(test_row(title + "\n" + said_composed(one.test.method), one.test,
                                    one.p_value_adjusted));
    for (const ContrastTest& other : one.otherwise) {
      otherwise.rows.push_back(
          test_row(title + "\n" + said_composed(other.method), other, std::nullopt));
    }
    if (one.equivalence) {
      const Equivalence& found = *one.equivalence;
      equivalence.rows.push_back(
          {title, shortest_words(found.margin), interval_words(found.interval, one.test.effect),
           p_words(found.p_value), found.is_shown ? said("yes") : said("not shown")});
    }
    for (const ExcludedParticipant& left_out : one.excluded) {
      excluded.rows.push_back({title, left_out.participant, said_composed(left_out.reason)});
    }
    for (const std::string& caution : one.cautions)
      cautions.push_back(title + ": " + said_composed(caution));
    if (const std::string looks = looks_sentence(one); !looks.empty()) html.paragraph(looks);
  }
  answers.notes.emplace_back(said(
      "Effects are ratios; of exponents, ratings and answers to questions they are "
      "differences. p values are on the side that was planned; the adjusted ones are within "
      "the family of each contrast."));
  html.table(answers);
  if (!cautions.empty()) html.list(cautions);
  html.table(equivalence);
  html.table(otherwise);
  html.table(excluded);
}

}  // namespace jnd::analysis
