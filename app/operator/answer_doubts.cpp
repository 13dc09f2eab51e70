#include "app/operator/answer_doubts.h"

#include <fmt/format.h>

#include <cmath>

#include "app/language/words.h"
#include "app/operator/session_words.h"

namespace jnd::app {
namespace {

using experiments::AnswerKind;

template <typename... Values>
std::string for_log(const char* english, const Values&... values) {
  return fmt::format(fmt::runtime(english), values...);
}

void add_magnitude(const GivenAnswer& given, std::vector<AnswerDoubt>& doubts) {
  const bool is_percent = given.kind == AnswerKind::kPercent;
  if (!given.value || (!is_percent && given.kind != AnswerKind::kNumber)) return;
  if (is_percent && *given.value > kMostLikelyPercent) {
    doubts.push_back({tr("more than {:.0f} %", kMostLikelyPercent),
                      for_log(as_is("more than {:.0f} %"), kMostLikelyPercent)});
  }
  if (!given.last_value || !(*given.last_value > 0.0) || !(*given.value > 0.0)) return;
  const double ratio = *given.value / *given.last_value;
  if (ratio > kMostLikelyStep) {
    const std::string times = number_words(ratio);
    doubts.push_back({tr("{} times the last answer", times),
                      for_log(as_is("{} times the last answer"), times)});
  } else if (ratio < 1.0 / kMostLikelyStep) {
    const std::string part = number_words(1.0 / ratio);
    doubts.push_back(
        {tr("1/{} of the last answer", part), for_log(as_is("1/{} of the last answer"), part)});
  }
}

AnswerDoubt without_stroke(const std::string& interval) {
  const std::string stored = for_log(as_is("no stroke in the {}"), interval);
  if (interval == "reference") return {tr("no stroke in the reference"), stored};
  if (interval == "first") return {tr("no stroke in the first"), stored};
  if (interval == "second") return {tr("no stroke in the second"), stored};
  if (interval == "third") return {tr("no stroke in the third"), stored};
  return {tr("no stroke in the test"), stored};
}

std::string joined_doubts(const std::vector<AnswerDoubt>& doubts,
                          std::string AnswerDoubt::*words) {
  std::string all;
  for (const AnswerDoubt& doubt : doubts) all += (all.empty() ? "" : "; ") + doubt.*words;
  return all;
}

}  // namespace

std::vector<AnswerDoubt> doubts_about(const GivenAnswer& given) {
  std::vector<AnswerDoubt> doubts;
  add_magnitude(given, doubts);
  if (given.felt_s && *given.felt_s < kLeastLikelyAnswer_s) {
    doubts.push_back({tr("{:.1f} s after the stimulus began", *given.felt_s),
                      for_log(as_is("{:.1f} s after the stimulus began"), *given.felt_s)});
  }
  for (const std::string& interval : given.unstroked) {
    doubts.push_back(without_stroke(interval));
  }
  return doubts;
}

std::string shown_doubts(const std::vector<AnswerDoubt>& doubts) {
  return joined_doubts(doubts, &AnswerDoubt::shown);
}

std::string stored_doubts(const std::vector<AnswerDoubt>& doubts) {
  return joined_doubts(doubts, &AnswerDoubt::stored);
}

bool is_note_of_doubt(std::string_view note) noexcept { return note.starts_with(kNoteOfDoubt); }

}  // namespace jnd::app
