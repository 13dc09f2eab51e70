#include "analysis/words/said_composed.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

// Phrases of analysis/hierarchical, analysis/fits, analysis/statistics and the study's plan,
// which do not know of languages. This list puts them into the catalogue.
[[maybe_unused]] constexpr const char* kPhrasesOfFits[] = {
    // Methods.
    said_later("probit"),
    said_later("probit, ln slope normal between people"),
    said_later("probit, slope normal between people"),
    said_later("pse"),
    said_later("pse = reference"),
    said_later("pse = reference, personal bias for an interval in each condition"),
    said_later("pse free, common"),
    said_later("pse and order of the intervals free, common"),
    said_later("pse free, one shift a person"),
    said_later("pse free, one bias for an interval a person"),
    said_later("pse free, one shift or bias for an interval a person"),
    said_later("pse free, personal in each condition"),
    said_later("pse free, personal bias for an interval in each condition"),
    said_later("pse free, personal pse or bias for an interval in each condition"),
    said_later("one lapse rate for everybody"),
    said_later("a lapse rate of each person's own"),
    said_later("guess rate {}"),
    said_later("lapse rate {}"),
    said_later("beta-binomial answers"),
    said_later("adaptive Gauss-Hermite"),
    said_later("{} nodes a dimension"),
    said_later("paired t"),
    said_later("one-sample t against 0"),
    said_later("Welch's t"),
    said_later("Student's t, pooled variance"),
    said_later("Wilcoxon's signed ranks"),
    said_later("Wilcoxon's rank sum"),
    said_later("Pearson's r"),
    said_later("Spearman's rank correlation"),
    said_later("exact"),
    said_later("exact with ties"),
    said_later("normal approximation"),
    said_later("corrected for ties and continuity"),
    said_later("corrected for continuity"),
    said_later("p by t"),
    said_later("interval by Fisher's z"),
    said_later("without {} difference of 0"),
    said_later("without {} differences of 0"),
    // Notes and cautions.
    said_later("the spread of the slopes between people is at its bound 0: the answers show "
               "none beyond chance, which with few answers a person does not mean that there "
               "is none"),
    said_later("the spread of the places between people is at its bound 0: the answers show "
               "none beyond chance, which with few answers a person does not mean that there "
               "is none"),
    said_later("the spread of the slopes and that of the places between people are at its "
               "bound 0: the answers show none beyond chance, which with few answers a person "
               "does not mean that there is none"),
    said_later("the correlation of the slopes is at its bound (a singular fit): the answers "
               "tell no difference of people's own in the one condition from that in the "
               "other"),
    said_later("no interval of a difference: people's answers are all alike"),
    said_later("the answers lie farther from people's curves than chance has them (deviance, p "
               "< 0.01): the curve is not theirs, or a person changed from session to session, "
               "and the interval is too narrow"),
    said_later("the levels are too hard: no answer was to a comparison as easy as the Weber "
               "fraction itself, which lies beyond them, and nothing tells lapses from a flat "
               "curve"),
    said_later("the levels are too hard: only {} % of the answers were to a comparison as easy "
               "as the Weber fraction itself, which lies beyond them, and nothing tells lapses "
               "from a flat curve"),
    said_later("a lapse rate of {} would make it {} instead of {}"),
    said_later("levels from {} would"),
    said_later("levels up to {} or from {} would"),
    // Reasons why there is no value.
    said_later("the pooled answers are separated: one threshold splits the answers without "
               "overlap, so the Weber fraction falls to 0"),
    said_later("the pooled answers are separated: a step explains the answers at least as well "
               "as any slope, so the Weber fraction falls to 0"),
    said_later("the pooled answers are all alike: every answer is the same, so the pse lies "
               "beyond all levels"),
    said_later("the pooled answers are all alike: every answer is the same, so nothing tells "
               "how fine the discrimination is"),
    said_later("the pooled answers are flat: the answers do not rise with the intensity, so "
               "the Weber fraction grows without bound"),
    said_later("the pooled answers are inverted: yes becomes rarer as the intensity rises, so "
               "no Weber fraction > 0 fits"),
    said_later("too few rows: a power law needs two different intensities > 0"),
    said_later("degenerate"),
    said_later("gnuplot is not installed"),
    said_later("too few rows: no level has an answer"),
    said_later("too few rows: slope, pse and lapse rate cannot be told apart with so few "
               "levels"),
    said_later("too few rows: slope and lapse rate cannot be told apart with so few levels"),
    said_later("one intensity: beside 0 and the reference, where every slope gives the same, "
               "there is none, so nothing tells how fine the discrimination is"),
    said_later("one intensity: a slope and a pse need answers at two intensities > 0 or more"),
    said_later("all alike: every answer is the same, so the pse lies beyond all levels"),
    said_later("all alike: every answer is the same, so nothing tells how fine the "
               "discrimination is"),
    said_later("separated: one threshold splits the answers without overlap, so the Weber "
               "fraction falls to 0"),
    said_later("separated: a step explains the answers at least as well as any slope, so the "
               "Weber fraction falls to 0"),
    said_later("separated: one threshold splits the answers without overlap, so how fast they "
               "change is unknown"),
    said_later("separated: one size of difference splits the answers without overlap"),
    said_later("flat: the answers do not rise with the intensity, so the Weber fraction grows "
               "without bound"),
    said_later("flat: the answers do not rise above the guess rate with the intensity, so the "
               "Weber fraction grows without bound"),
    said_later("flat: the answers rise so little that the values exceed the range of numbers"),
    said_later("flat: \"different\" does not become more frequent with the difference"),
    said_later("flat or inverted: the test is not chosen more often as it grows"),
    said_later("inverted: yes becomes rarer as the intensity rises, so no Weber fraction > 0 "
               "fits"),
    said_later("the search for the optimum did not come to rest"),
    said_later("the likelihood rises without bound: the answers are nearly separated"),
    said_later("fewer than two participants with answers: how people differ is unknown"),
    said_later("the condition has no value"),
    said_later("no value, for"),
    said_later("not identified: no answers to a stimulus"),
    said_later("not identified: fewer than two intensities with answers"),
    said_later("no pairs"),
    said_later("fewer than three pairs"),
    said_later("too few pairs: a t test needs two"),
    said_later("too few values: a t test needs two"),
    said_later("too few values: Welch's t needs two in each group"),
    said_later("too few values: a rank sum needs one in each group"),
    said_later("too few pairs: a correlation needs three"),
    said_later("all values of each group are alike: t is undefined"),
    said_later("both standard deviations are 0: t is undefined"),
    said_later("a column is constant: the correlation is undefined"),
    said_later("the columns lie on a line: t is infinite"),
    said_later("all differences are 0: there is nothing to rank"),
    said_later("all values are alike: there is nothing to rank"),
    // A contrast's plan.
    said_later("primary"),
    said_later("secondary"),
    said_later("greater"),
    said_later("less"),
    said_later("either"),
    said_later("holm"),
    said_later("bonferroni"),
    said_later("point of subjective equality"),
    said_later("exponent"),
    said_later("magnitude"),
    said_later("match"),
    said_later("rating"),
    said_later("answer to the question"),
};

/// A separator between phrases, at this place; "" if there is none.
std::string_view separator_at(std::string_view text, std::size_t at) {
  for (const std::string_view one : {", ", "; ", ": ", " (", ")"}) {
    if (text.substr(at).starts_with(one)) return one;
  }
  return "";
}

std::optional<std::string> from_catalogue(const std::string& english) {
  std::string found = said(english.c_str());
  if (found == english) return std::nullopt;
  return found;
}

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
bool is_part_of_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

/// The translation of a phrase in which every number is a hole.
std::optional<std::string> with_numbers(const std::string& english) {
  if (english.find('{') != std::string::npos) return std::nullopt;
  std::string phrase;
  fmt::dynamic_format_arg_store<fmt::format_context> numbers;
  bool any = false;
  for (std::size_t at = 0; at < english.size();) {
    if (!is_digit(english[at]) || (at > 0 && is_part_of_name(english[at - 1]))) {
      phrase += english[at++];
      continue;
    }
    std::size_t end = at;
    while (end < english.size() &&
           (is_digit(english[end]) ||
            (english[end] == '.' && end + 1 < english.size() && is_digit(english[end + 1])))) {
      ++end;
    }
    numbers.push_back(with_decimal_sign(english.substr(at, end - at)));
    phrase += "{}";
    any = true;
    at = end;
  }
  if (!any) return std::nullopt;
  const std::optional<std::string> found = from_catalogue(phrase);
  if (!found) return std::nullopt;
  try {
    return fmt::vformat(*found, numbers);
  } catch (const fmt::format_error&) {
    return std::nullopt;
  }
}

std::optional<std::string> phrase_in_language(const std::string& english) {
  const auto found = from_catalogue(english);
  return found ? found : with_numbers(english);
}

}  // namespace

std::string said_composed(const std::string& english) {
  if (spoken().words == nullptr) return english;
  if (auto whole = phrase_in_language(english)) return *whole;
  // Where phrases may end, with the last one at the end of the text.
  std::vector<std::size_t> ends;
  for (std::size_t at = 0; at < english.size(); ++at) {
    if (!separator_at(english, at).empty()) ends.push_back(at);
  }
  ends.push_back(english.size());
  std::string words;
  std::size_t at = 0;
  while (at < english.size()) {
    const std::string_view separator = separator_at(english, at);
    if (!separator.empty()) {
      words += separator;
      at += separator.size();
      continue;
    }
    const auto first = std::ranges::upper_bound(ends, at);
    std::string translated = english.substr(at, *first - at);
    std::size_t next = *first;
    for (auto end = ends.end(); end != first;) {
      --end;
      if (auto found = phrase_in_language(english.substr(at, *end - at))) {
        translated = *found;
        next = *end;
        break;
      }
    }
    words += translated;
    at = next;
  }
  return words;
}

}  // namespace jnd::analysis
