#include "analysis/results/study_sections.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "analysis/results/magnitude_section.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr std::string_view kYesAnd = "yes: ";

/// Answers to one item by participant.
using ItemAnswers = std::map<std::string, std::string>;

/// The same for each time that the item's stage came in a session; once at least.
std::vector<ItemAnswers> answers_to(const StudyData& data, const QuestionnaireItem& item) {
  std::vector<ItemAnswers> times(1);
  for (const ParticipantData& participant : data.participants) {
    const std::vector<std::string> answers = answers_by_time(participant.answers, item);
    times.resize(std::max(times.size(), answers.size()));
    for (std::size_t time = 0; time < answers.size(); ++time) {
      if (!answers[time].empty()) times[time][participant.participant] = answers[time];
    }
  }
  return times;
}

/// The item as it was asked for this time of several.
QuestionnaireItem at_time(QuestionnaireItem item, std::size_t time) {
  const std::string number = std::to_string(time + 1);
  item.name += ".time_" + number;
  item.question = said("{} (time {})", item.question, number);
  return item;
}

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  const bool whole = error == std::errc() && stopped == end && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

std::string prefix_of(const QuestionnaireItem& item) { return "questionnaire." + item.name; }

/// The meaning of the steps, such as "rating from 1, the worst, to 10, the best: ". For a scale
/// without a favourable end, it gives the labels of its ends.
std::string steps_words(const QuestionnaireItem& item) {
  const std::string last = std::to_string(item.num_steps);
  if (item.high_is_good) {
    return said(
        "rating from 1, the worst, to {}, the best{}", last,
        (*item.high_is_good ? ": "
                            : said(" (turned round: it was asked with 1 as the best): ")));
  }
  const auto end = [](const std::string& step, const std::string& label) {
    return label.empty() ? step : step + ", “" + label + "”";
  };
  return said("step from {}, to {}: ", end("1", item.low_label), end(last, item.high_label));
}

/// Adds everybody's own number. Scales are turned so that 1 is the worst step, if there is a
/// worst one.
std::vector<double> add_own_numbers(ResultsSection& section, const QuestionnaireItem& item,
                                    const ItemAnswers& answers) {
  std::vector<double> values;
  for (const auto& [participant, text] : answers) {
    std::optional<double> value = number_of(text);
    if (value && item.kind == "scale" && !item.high_is_good.value_or(true))
      value = item.num_steps + 1 - *value;
    section.participants.push_back({participant,
                                    prefix_of(item),
                                    value,
                                    {},
                                    value ? "" : "expected a number, found \"" + text + "\""});
    if (value) values.push_back(*value);
  }
  return values;
}

void add(ResultsSection& section, const std::string& name, std::optional<double> value,
         const std::string& unit, const std::string& meaning, std::size_t num_answered) {
  section.estimates.push_back({.name = name,
                               .value = value,
                               .unit = unit,
                               .meaning = meaning,
                               .n = static_cast<int>(num_answered)});
}

void add_scale(ResultsSection& section, const QuestionnaireItem& item,
               const ItemAnswers& answers) {
  const std::vector<double> values = add_own_numbers(section, item, answers);
  const Summary summary = summary_of(values);
  const std::string steps = steps_words(item);
  add_mean(section, prefix_of(item), said("mean {}{}", steps, item.question), values);
  add(section, prefix_of(item) + ".sd", summary.standard_deviation, "1",
      said("standard deviation between participants"), values.size());
  add(section, prefix_of(item) + ".median", summary.median, "1",
      said("median {}{}", steps, item.question), values.size());
}

void add_number(ResultsSection& section, const QuestionnaireItem& item,
                const ItemAnswers& answers) {
  const std::vector<double> values = add_own_numbers(section, item, answers);
  const std::string unit = item.unit.empty() ? "1" : item.unit;
  const Summary summary = summary_of(values);
  add_mean(section, prefix_of(item), said("mean: {}", item.question), values, unit);
  add(section, prefix_of(item) + ".sd", summary.standard_deviation, unit,
      said("standard deviation between participants"), values.size());
  if (values.empty()) return;
  add(section, prefix_of(item) + ".minimum", *std::ranges::min_element(values), unit,
      "smallest", values.size());
  add(section, prefix_of(item) + ".maximum", *std::ranges::max_element(values), unit, "largest",
      values.size());
}

/// "yes: a glove" counts as "yes".
std::string counted_answer(const QuestionnaireItem& item, const std::string& text) {
  return item.kind == "yes_no_which" && text.starts_with(kYesAnd) ? "yes" : text;
}

void add_counts(ResultsSection& section, const QuestionnaireItem& item,
                const ItemAnswers& answers) {
  std::vector<std::string> options = item.options;
  if (item.kind != "choice") options = {"yes", "no"};
  for (const auto& [participant, text] : answers) {
    // An earlier version of the study offered this answer, but the last one does not.
    const std::string given = counted_answer(item, text);
    if (std::ranges::find(options, given) == options.end()) options.push_back(given);
  }
  for (const std::string& option : options) {
    const auto num = std::ranges::count_if(
        answers, [&](const auto& one) { return counted_answer(item, one.second) == option; });
    add(section, prefix_of(item) + "." + option, static_cast<double>(num), "1",
        said("participants who answered \"{}\": {}", option, item.question), answers.size());
  }
}

void add_free_answers(ResultsSection& section, const QuestionnaireItem& item,
                      const ItemAnswers& answers) {
  for (const auto& [participant, text] : answers) {
    const bool which = item.kind == "yes_no_which";
    if (which && !text.starts_with(kYesAnd)) continue;
    section.free_answers.push_back(
        {participant, item.name, item.question, which ? text.substr(kYesAnd.size()) : text});
  }
}

void add_item(ResultsSection& section, const QuestionnaireItem& item,
              const ItemAnswers& answers) {
  if (item.kind == "scale") return add_scale(section, item, answers);
  if (item.kind == "number") return add_number(section, item, answers);
  const bool counted =
      item.kind == "choice" || item.kind == "yes_no" || item.kind == "yes_no_which";
  if (counted) add_counts(section, item, answers);
  if (!counted || item.kind == "yes_no_which") add_free_answers(section, item, answers);
}

/// Names the participants who answered nothing in a stage with questions.
void name_missing(ResultsSection& section, const StudyData& data) {
  std::vector<std::string> stages;
  for (const QuestionnaireItem& item : data.items) {
    if (std::ranges::find(stages, item.stage) == stages.end()) stages.push_back(item.stage);
  }
  for (const std::string& stage : stages) {
    std::vector<ExcludedParticipant> missing;
    bool any_answers = false;
    for (const ParticipantData& participant : data.participants) {
      if (std::ranges::find(participant.answers, stage, &core::AnswerRow::stage) !=
          participant.answers.end()) {
        any_answers = true;
        continue;
      }
      name_without_answers(missing, participant, stage);
    }
    if (!any_answers && missing.size() > 1) {
      missing = {{"everyone", said("no answers in {}", stage)}};
    }
    section.excluded.insert(section.excluded.end(), missing.begin(), missing.end());
  }
}

}  // namespace

std::optional<ResultsSection> questionnaire_results(const StudyData& data) {
  if (data.items.empty()) return std::nullopt;
  ResultsSection section{.name = "questionnaires"};
  for (const QuestionnaireItem& item : data.items) {
    const std::vector<ItemAnswers> times = answers_to(data, item);
    for (std::size_t time = 0; time < times.size(); ++time) {
      add_item(section, times.size() == 1 ? item : at_time(item, time), times[time]);
    }
  }
  name_missing(section, data);
  return section;
}

}  // namespace jnd::analysis
