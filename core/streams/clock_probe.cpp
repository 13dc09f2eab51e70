#include "core/streams/clock_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/streams/stream_messages.h"

namespace jnd::core {
namespace {

/// An answer repeats the time of its question, perhaps with a digit less.
constexpr double kSameTime_s = 1e-6;

}  // namespace

std::string ClockProbe::due_question(double now_s) {
  if (!is_under_way_) {
    if (has_begun_ && now_s < wave_begins_s_ + parameters_.every_s) return "";
    has_begun_ = true;
    is_under_way_ = true;
    // A wave that is late, for example because the machine slept, does not make up for those it
    // missed.
    wave_begins_s_ = now_s;
    next_question_s_ = now_s;
    wave_ = wave_ == std::numeric_limits<int>::max() ? 1 : wave_ + 1;
    questions_.clear();
    num_answers_ = 0;
  }
  const bool is_due = std::ssize(questions_) < parameters_.num_questions;
  if (!is_due || now_s < next_question_s_) return "";
  questions_.push_back({.t0_s = now_s});
  next_question_s_ = now_s + parameters_.between_s;
  return time_question_message({.wave = wave_, .t0_s = now_s});
}

void ClockProbe::take_answer(std::string_view datagram, double now_s) {
  const auto answer = time_answer_of(datagram);
  if (!answer || !is_under_way_ || answer->wave != wave_) return;
  const auto asked = std::ranges::find_if(questions_, [&](const Question& one) {
    return one.is_open && std::abs(one.t0_s - answer->t0_s) < kSameTime_s;
  });
  if (asked == questions_.end()) return;
  const double there_s = answer->t2_s - answer->t1_s;
  const double here_s = now_s - asked->t0_s;
  if (!(there_s >= 0.0) || !(here_s >= there_s - kSameTime_s)) return;
  asked->is_open = false;
  const double round_trip_s = std::max(here_s - there_s, 0.0);
  ++num_answers_;
  if (num_answers_ > 1 && round_trip_s >= best_.round_trip_s) return;
  const double ahead_s =
      0.5 * ((answer->t1_s - asked->t0_s) + (answer->t2_s - now_s));  // Difference of the other
                                                                      // clock from ours.
  best_ = {.time_s = 0.5 * (answer->t1_s + answer->t2_s),
           .offset_s = -ahead_s,
           .round_trip_s = round_trip_s};
}

std::optional<ClockOffset> ClockProbe::finished(double now_s) {
  if (!is_under_way_ || std::ssize(questions_) < parameters_.num_questions) return std::nullopt;
  const bool all_came = num_answers_ == parameters_.num_questions;
  if (!all_came && now_s < questions_.back().t0_s + parameters_.patience_s) {
    return std::nullopt;
  }
  is_under_way_ = false;
  if (num_answers_ < parameters_.min_answers) return std::nullopt;
  return best_;
}

double ClockProbe::next_due_s() const noexcept {
  if (!has_begun_) return -std::numeric_limits<double>::infinity();
  if (!is_under_way_) return wave_begins_s_ + parameters_.every_s;
  if (std::ssize(questions_) < parameters_.num_questions) return next_question_s_;
  return questions_.back().t0_s + parameters_.patience_s;
}

}  // namespace jnd::core
