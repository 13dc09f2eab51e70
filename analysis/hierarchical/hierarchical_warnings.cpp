#include "analysis/hierarchical/hierarchical_warnings.h"

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/fits/answer_scatter.h"
#include "analysis/fits/chance_level.h"
#include "analysis/fits/falling_test.h"

namespace jnd::analysis {
namespace {

/// The chance suspected from everybody's rows in each condition. If there are several, the
/// largest.
std::optional<double> chance_in_any(const std::vector<ParticipantAnswers>& answers) {
  std::map<std::string, std::vector<AnswerCount>> by_condition;
  for (const ParticipantAnswers& one : answers) {
    auto& rows = by_condition[one.condition];
    rows.insert(rows.end(), one.rows.begin(), one.rows.end());
  }
  std::optional<double> chance;
  for (const auto& [condition, rows] : by_condition) {
    const std::optional<double> suspected = suspected_chance(rows);
    if (suspected) chance = std::max(chance.value_or(0.0), *suspected);
  }
  return chance;
}

/// The names of everybody whose answers fall, such as "P03 (p < 0.001)" or, with conditions,
/// "P03 in d (p < 0.001)".
std::vector<std::string> whose_answers_fall(const std::vector<ParticipantAnswers>& answers) {
  std::vector<std::string> names;
  for (const ParticipantAnswers& one : answers) {
    const std::optional<double> p_value = significant_fall(one.rows);
    if (!p_value) continue;
    names.push_back(one.participant + (one.condition.empty() ? "" : " in " + one.condition) +
                    " (" + falling_p_words(*p_value) + ")");
  }
  return names;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return list;
}

/// A warning about scatter of everybody's rows together, so that many small differences count;
/// "" if they do not scatter. It names people whose own rows scatter, at a level that is
/// adjusted for the number of people.
std::string scatter_words(const std::vector<ParticipantAnswers>& answers) {
  RowScatter all;
  for (const ParticipantAnswers& one : answers) all += row_scatter(one.rows);
  if (!all.is_significant()) return "";
  std::vector<std::string> names;
  for (const ParticipantAnswers& one : answers) {
    const std::optional<double> p_value = row_scatter(one.rows).p_value();
    const auto num = static_cast<double>(answers.size());
    if (!p_value || !(*p_value * num < kScatterBelow)) continue;
    names.push_back(one.participant + (one.condition.empty() ? "" : " in " + one.condition));
  }
  return "rows of the same person and level scatter more than independent answers do "
         "(chi-squared, p < 0.01" +
         (names.empty() ? "" : "; most of all those of " + list_of(names)) +
         "), as those of several sessions may: the model has one curve a person, and takes a "
         "criterion that moves from session to session for a flatter one; jnd fit weber "
         "--group-by participant with a column of the session fits each of them";
}

std::string inverted_words(const std::vector<std::string>& names) {
  const std::string list = list_of(names);
  const bool one = names.size() == 1;
  return list + (one ? " answers" : " answer") +
         " the wrong way round: " + (one ? "the" : "their") +
         " answers fall as the intensity grows (exact trend test), which the fit takes for a "
         "very large Weber fraction and for people far apart; see whether num_yes counts the "
         "other answer there, or leave those rows out";
}

}  // namespace

std::vector<std::string> hierarchical_warnings(const std::vector<ParticipantAnswers>& answers,
                                               double guess_rate) {
  std::vector<std::string> warnings;
  const std::optional<double> chance = guess_rate > 0.0 ? std::nullopt : chance_in_any(answers);
  if (chance) warnings.push_back(chance_warning(*chance));
  const std::vector<std::string> names = whose_answers_fall(answers);
  if (!names.empty()) warnings.push_back(inverted_words(names));
  const std::string scatter = scatter_words(answers);
  if (!scatter.empty()) warnings.push_back(scatter);
  return warnings;
}

}  // namespace jnd::analysis
