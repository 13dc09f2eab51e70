#include "app/session/trial_player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/participants/counting.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/session/trial_course.h"
#include "experiments/study/media.h"

namespace jnd::app {

using namespace experiments;

void stop_if_cancelled(const LaboratoryRun& run) {
  if (run.is_cancelled && run.is_cancelled()) throw Cancelled{};
}

/// Lets the time pass; in real time, ends early when the run is asked to stop.
void TrialPlayer::wait(double duration_s) {
  if (!run_.realtime) return apparatus_.run_for(duration_s);
  constexpr double kGlanceS = 0.020;
  for (double waited_s = 0.0; waited_s < duration_s; waited_s += kGlanceS) {
    stop_if_cancelled(run_);
    apparatus_.run_for(std::min(kGlanceS, duration_s - waited_s));
  }
}

/// Thrown from within a presentation: these points came off.
struct TrialPlayer::CameOff {
  std::uint8_t bits;
};

/// Thrown after a presentation that does not count.
struct TrialPlayer::Missed {
  std::string reason;
};

/// Thrown when the time to answer is over without an answer.
struct TrialPlayer::TooLate {};

/// Returns to free space and repeats the trial later.
void TrialPlayer::miss_deadline() {
  apparatus_.render(core::free_space());
  apparatus_.go_home();
  session_.miss_deadline();
  presenter_.tell_exposure();
}

/// True if the participant hurries: after they were too late or were interrupted, they answer
/// in time when the trial comes again.
bool TrialPlayer::hurries(const Block& block) const {
  return block.answer_deadline_s &&
         session_.state().trial(*session_.state().current_trial()).attempt > 1;
}

/// Returns to free space and repeats the trial later. After several times in a row it gives up,
/// because a machine that cannot keep up does not improve by trying again.
void TrialPlayer::begin_anew(const std::string& reason) {
  constexpr int kMostInARow = 3;
  apparatus_.render(core::free_space());
  apparatus_.go_home();
  session_.put_off_attempt(reason);
  presenter_.tell_exposure();
  if (++num_missed_in_a_row_ < kMostInARow) return;
  throw core::Error(
      "haptic loop: expected a machine that keeps its time, found three attempts "
      "in a row with " +
      reason +
      "; close what burdens the machine, look at `jnd doctor`, then resume the "
      "session");
}

void TrialPlayer::stop_if_loose() const {
  const std::uint8_t came_off = attachment_.came_off_bits(apparatus_.telemetry());
  if (came_off != 0) throw CameOff{came_off};
}

/// Does what the experimenter and the participant would do about it. What was felt does not
/// count.
void TrialPlayer::put_fingers_back(std::uint8_t loose_bits) {
  constexpr double kPatienceS = 20.0;
  constexpr double kGlanceS = 0.020;
  apparatus_.render(core::free_space());
  apparatus_.go_home();
  presenter_.abandon();
  const std::optional<std::int64_t> trial = session_.state().current_trial();
  const std::string reason = came_off_reason(loose_bits);
  if (trial && session_.state().trial(*trial).under_way) session_.put_off_attempt(reason);
  session_.pause(reason);
  presenter_.tell_exposure();
  apparatus_.put_fingers_back();
  double waited_s = 0.0;
  while (attachment_.loose_bits(apparatus_.telemetry()) != 0) {
    stop_if_cancelled(run_);
    if (waited_s >= kPatienceS) {
      throw core::Error("device: expected " + words_of_points(loose_bits) +
                        " to hold again within 20 s, found that it does not; look at the "
                        "device, then resume the session");
    }
    apparatus_.run_for(kGlanceS);
    waited_s += kGlanceS;
  }
  session_.go_on();
}

void TrialPlayer::explore(const Exploration& exploration) {
  while (true) {
    try {
      return feel(exploration);
    } catch (const CameOff& off) {
      put_fingers_back(off.bits);
    }
  }
}

void TrialPlayer::feel(const Exploration& exploration) {
  stop_if_cancelled(run_);
  session_.require_exposure_left();
  attachment_.begin(apparatus_.telemetry());
  const std::int64_t first_tick = apparatus_.next_tick();
  apparatus_.render(amounts_of(exploration.setting));
  StrokeIntent intent = participant_.strokes("");
  if (is_pressed(exploration.setting.medium)) intent.height_m = -0.005;
  apparatus_.begin_strokes(
      plan_of(intent), stroke_stream(0, session_.state().stage, session_.state().num_explored));
  wait(exploration.duration_s);
  stop_if_loose();
  session_.explored(exploration.setting.medium, exploration.setting.intensity, first_tick,
                    apparatus_.next_tick() - 1);
  presenter_.tell_exposure();
}

/// Rests in free space, with the hand at home.
void TrialPlayer::rest(double duration_s) {
  apparatus_.render(core::free_space());
  apparatus_.go_home();
  wait(std::max(duration_s, 2.0 * run_.laboratory.arm.home_s));
}

device::StrokePlan TrialPlayer::plan_of(const StrokeIntent& intent) const {
  const Laboratory::Movement& habit = run_.laboratory.movement;
  return {.amplitude_m = intent.amplitude_m,
          .max_speed_m_per_s = intent.max_speed_m_per_s,
          .height_m = intent.height_m,
          .lift_m = intent.lift_m.value_or(habit.lift_m),
          .amplitude_sd_ratio = habit.stroke_amplitude_sd_ratio,
          .speed_sd_ratio = habit.stroke_speed_sd_ratio,
          .height_sd_m = habit.stroke_height_sd_m};
}

core::RandomStream TrialPlayer::stroke_stream(std::int64_t trial, std::int64_t attempt,
                                              std::int64_t presentation) const {
  return {session_.seed(), "stroke", {trial, attempt, presentation}};
}

/// The stiffness with which a solid gave way: the regression through the origin of the force on
/// the hand's depth in it. The depth is weighted over the points as the force is.
class TrialPlayer::StiffnessMeter {
 public:
  StiffnessMeter(double surface_m, const core::ShareRatios& share_ratio)
      : surface_m_(surface_m), share_ratio_(share_ratio) {}

  void look(const core::Telemetry& telemetry) {
    double depth_m = 0.0;
    for (std::size_t point = 0; point < share_ratio_.size(); ++point) {
      const double height_m = telemetry.sample.tip_position_m[point][2];
      depth_m += share_ratio_[point] * std::max(0.0, surface_m_ - height_m);
    }
    sum_force_depth_ += telemetry.total_force_n[2] * depth_m;
    sum_depth_depth_ += depth_m * depth_m;
  }
  /// In N/m; 0 without contact.
  [[nodiscard]] double stiffness_n_per_m() const {
    return sum_depth_depth_ > 0.0 ? std::max(0.0, sum_force_depth_ / sum_depth_depth_) : 0.0;
  }

 private:
  double surface_m_;
  core::ShareRatios share_ratio_;
  double sum_force_depth_ = 0.0, sum_depth_depth_ = 0.0;
};

/// Moves the hand out of whatever is below, because a surface has to be entered from above.
void TrialPlayer::rise_above(double surface_m) {
  constexpr double kGlanceS = 0.020, kPatienceS = 10.0;
  apparatus_.begin_strokes(plan_of(participant_.hover(surface_m)),
                           stroke_stream(*session_.state().current_trial(), 0, 0));
  const auto lowest_m = [&] {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& tip_m : apparatus_.telemetry().sample.tip_position_m) {
      lowest = std::min<double>(lowest, tip_m[2]);
    }
    return lowest;
  };
  double waited_s = 0.0;
  while (lowest_m() <= surface_m && waited_s < kPatienceS) {
    stop_if_cancelled(run_);
    apparatus_.run_for(kGlanceS);
    waited_s += kGlanceS;
    stop_if_loose();
  }
}

/// True if the stimulus under way has lasted so long, to the nearest tick.
bool TrialPlayer::has_felt(double duration_s) const {
  return presenter_.felt_s() > duration_s - 0.5 / run_.study.device.rate_hz;
}

/// Lets this much time pass, but not beyond the end of the stimulus. Returns false once that
/// end is reached.
bool TrialPlayer::pass(double duration_s, double end_s) {
  stop_if_cancelled(run_);
  if (!has_felt(end_s)) {
    apparatus_.run_for(std::min(duration_s, end_s - presenter_.felt_s()));
  }
  stop_if_loose();
  return !has_felt(end_s);
}

/// Runs until the strokes are done and the hand has visibly turned, or far too much time has
/// passed, but at most until `end_s` after the stimulus began.
void TrialPlayer::run_strokes(const StrokeIntent& intent, StiffnessMeter& stiffness,
                              double end_s) {
  // How often the participant checks whether it is enough.
  constexpr double kGlanceS = 0.020;
  const double limit_s = 3.0 * static_cast<double>(intent.num_strokes + 1) * intent.period_s;
  double elapsed_s = 0.0;
  while (apparatus_.strokes_finished() < intent.num_strokes && elapsed_s < limit_s) {
    const bool goes_on = pass(kGlanceS, end_s);
    elapsed_s += kGlanceS;
    stiffness.look(apparatus_.telemetry());
    if (!goes_on) return;
  }
  if (!pass(intent.turning_s(), end_s)) return;
  // The arm has finished, but in a thick fluid the hand trails behind it.
  constexpr double kLongestTrailS = 1.5;
  for (double trail_s = 0.0;
       apparatus_.num_metered_strokes() < intent.num_strokes && trail_s < kLongestTrailS;
       trail_s += kGlanceS) {
    if (!pass(kGlanceS, end_s)) return;
  }
}

/// The time until the deadline; infinite if there is none, or if nothing is asked yet.
double TrialPlayer::left_to_answer_s(const Block& block) const {
  const TrialState& trial = session_.state().trial(*session_.state().current_trial());
  const auto asked = asked_tick(session_.current_form(), trial);
  if (!block.answer_deadline_s || !asked) return std::numeric_limits<double>::infinity();
  const auto since = static_cast<double>(apparatus_.next_tick() - *asked);
  return *block.answer_deadline_s - since / run_.study.device.rate_hz;
}

TrialPlayer::Felt TrialPlayer::present(const Block& block, const std::string& interval,
                                       Presenter::Beginning beginning) {
  attachment_.begin(apparatus_.telemetry());
  stop_if_loose();
  const double surface_m = run_.study.device.immersion.origin_z_m;
  const bool is_pressed = block.is_pressed_in(interval);
  if (is_pressed) rise_above(surface_m);
  const double tick_s = 1.0 / run_.study.device.rate_hz;
  if (left_to_answer_s(block) < tick_s) throw TooLate{};
  presenter_.begin(block, interval, beginning);
  const std::int64_t number = *session_.state().current_trial();
  const TrialState& trial = session_.state().trial(number);
  const StrokeIntent intent = is_pressed ? participant_.presses(block.procedure, surface_m)
                                         : participant_.strokes(block.procedure);
  apparatus_.begin_strokes(
      plan_of(intent), stroke_stream(number, trial.attempt,
                                     static_cast<std::int64_t>(trial.presentations.size())));
  // A participant who hurries answers at the last moment at the latest.
  const double deadline_s = left_to_answer_s(block);
  const double last_s = hurries(block) ? deadline_s - tick_s : deadline_s;
  apparatus_.run_for(std::clamp(deadline_s, 0.0, run_.study.device.ramp_s));
  while (run_.realtime && !presenter_.ramp_has_passed()) apparatus_.run_for(tick_s);
  presenter_.ramp_is_over();
  StiffnessMeter stiffness(surface_m, apparatus_.share_ratio());
  const double longest_s = block.max_stimulus_s.value_or(deadline_s);
  run_strokes(intent, stiffness, std::min(longest_s, last_s));
  // A participant who has felt enough earlier goes on stroking.
  while (!has_felt(block.min_stimulus_s) &&
         pass(std::max(tick_s, block.min_stimulus_s - presenter_.felt_s()), deadline_s)) {
  }
  const bool is_too_late = has_felt(deadline_s);
  const bool ended_by_itself = has_felt(longest_s);
  const Presenter::Felt felt = presenter_.end(
      ended_by_itself ? Presenter::Afterwards::kFreeSpace : Presenter::Afterwards::kSameMedium);
  if (const std::string reason = presenter_.missed_reason(felt); !reason.empty()) {
    throw Missed{reason};
  }
  if (is_too_late) throw TooLate{};
  return {.amount = is_pressed ? stiffness.stiffness_n_per_m()
                               : felt.delivered_damping_n_s_per_m + device_damping(felt),
          .last_tick = felt.last_tick,
          .duration_s = felt.duration_s};
}

/// What the hand feels in addition to the medium. For the lumped hand, it is the laboratory's
/// viscosity, because dry friction is felt as something else. A device with mechanics of its
/// own adds whatever opposed the hand.
double TrialPlayer::device_damping(const Presenter::Felt& felt) const {
  return apparatus_.is_laboratory_hand() ? run_.laboratory.device.mechanical_viscosity_n_s_per_m
                                         : felt.device_damping_n_s_per_m;
}

Moment TrialPlayer::moment(const Block& block) const {
  const std::int64_t number = *session_.state().current_trial();
  const TrialState& trial = session_.state().trial(number);
  return {.trial = number,
          .attempt = trial.attempt,
          .presentation = static_cast<std::int64_t>(trial.presentations.size()),
          .trial_in_block = trial_in_block(block, trial.planned)};
}

/// True if the participant looks again, as far as the block allows going back to each stimulus.
bool TrialPlayer::looks_again(const Block& block) const {
  const Moment now = moment(block);
  if (block.max_returns && now.presentation > *block.max_returns) return false;
  if (hurries(block)) return false;
  return participant_.perceiver(block).looks_again(now);
}

double TrialPlayer::read(const Felt& felt, const Block& block) const {
  return participant_.perceiver(block).reading_ln(felt.amount, moment(block));
}

void TrialPlayer::run_trial(const Block& block) {
  stop_if_cancelled(run_);
  const std::int64_t trial = *session_.state().current_trial();
  rest(block.free_space_between_s);
  session_.start_trial(apparatus_.next_tick());
  try {
    play_trial(block, trial);
    num_missed_in_a_row_ = 0;
  } catch (const TooLate&) {
    miss_deadline();
  } catch (const CameOff& off) {
    put_fingers_back(off.bits);
  } catch (const Missed& missed) {
    begin_anew(missed.reason);
  }
}

void TrialPlayer::answer_questions(const Block& block) {
  std::optional<TrialFeeling> feeling;
  while (const std::optional<OpenQuestion> open = session_.open_question()) {
    stop_if_cancelled(run_);
    if (!feeling) {
      const auto map = force_map_of(run_.study.device);
      feeling = feeling_of(run_.laboratory, participant_, block, open->trial,
                           session_.state().trial(open->trial), map.get());
    }
    session_.answer_question(open->item->name, participant_.answer(*open->item, *feeling));
  }
}

void TrialPlayer::play_trial(const Block& block, std::int64_t trial) {
  const TrialForm form = session_.current_form();
  if (form.adjustable) return adjust(block, trial, form.has_reference);
  if (form.order_is_drawn) return compare_intervals(block, form.answer);
  if (form.answer == AnswerKind::kYesNo && !form.has_reference) return detect(block);
  if (form.answer == AnswerKind::kYesNo) return compare(block);
  estimate(block, form);
}

void TrialPlayer::estimate(const Block& block, const TrialForm& form) {
  double sum_ln = 0.0, standard_ln = 0.0;
  int looks = 0;
  Felt felt;
  do {
    if (form.has_reference) standard_ln += read(present(block, "reference"), block);
    felt = present(block, "test");
    sum_ln += read(felt, block);
    ++looks;
  } while (looks_again(block));
  std::optional<double> previous;
  // Only answers of this block count, because those of other blocks are on another scale.
  if (const auto last = session_.state().last_answered_in(session_.state().stage)) {
    previous = session_.state().trial(*last).response;
  }
  const Perceiver& perceiver = participant_.perceiver(block);
  double answer = 0.0;
  if (form.answer == AnswerKind::kStep) {
    const auto map = force_map_of(run_.study.device);
    const double ratio =
        magnitude_ratio(run_.laboratory, participant_, block, sum_ln / looks, map.get());
    answer = perceiver.rate(ratio, num_steps_of(block), moment(block), previous);
  } else if (form.answer == AnswerKind::kPercent) {
    answer = perceiver.estimate_percent(sum_ln / looks, moment(block), previous);
  } else {
    std::optional<double> felt_standard_ln;
    if (form.has_reference) felt_standard_ln = standard_ln / looks;
    const auto map = force_map_of(run_.study.device);
    answer = perceiver.estimate_number(
        sum_ln / looks, moment(block), previous,
        counting_of(run_.laboratory, participant_, block, felt_standard_ln, map.get()));
  }
  session_.answer(answer, {.response_time_s = felt.duration_s}, felt.last_tick);
}

/// Decides whether anything is there, compared with the memory of free space.
void TrialPlayer::detect(const Block& block) {
  const Perceiver& perceiver = participant_.perceiver(block);
  double test_ln = 0.0;
  int looks = 0;
  Felt felt;
  do {
    felt = present(block, "test");
    test_ln += read(felt, block);
    ++looks;
  } while (looks_again(block));
  const bool there =
      perceiver.says_present(test_ln / looks, perceiver.free_space_ln(), moment(block));
  session_.answer(perceiver.answer_or_cannot_tell(
                      block, there ? 1.0 : 0.0,
                      [&] {
                        return perceiver.certainty_of_present(
                            test_ln / looks, perceiver.free_space_ln(), looks, moment(block));
                      }),
                  {.response_time_s = felt.duration_s}, felt.last_tick);
}

void TrialPlayer::compare(const Block& block) {
  double reference_ln = 0.0;
  double test_ln = 0.0;
  int looks = 0;
  Felt felt;
  do {
    reference_ln += read(present(block, "reference"), block);
    felt = present(block, "test");
    test_ln += read(felt, block);
    ++looks;
  } while (looks_again(block));
  const Perceiver& person = participant_.perceiver(block);
  const bool thicker =
      person.says_thicker(test_ln / looks, reference_ln / looks, moment(block));
  session_.answer(person.answer_or_cannot_tell(block, thicker ? 1.0 : 0.0,
                                               [&] {
                                                 return person.certainty_of_thicker(
                                                     test_ln / looks, reference_ln / looks,
                                                     looks, moment(block));
                                               }),
                  {.response_time_s = felt.duration_s}, felt.last_tick);
}

/// Chooses one of three intervals.
void TrialPlayer::choose_interval(const Block& block) {
  const Perceiver& person = participant_.perceiver(block);
  std::vector<double> readings_ln(3, 0.0);
  int looks = 0;
  Felt felt;
  do {
    for (std::size_t i = 0; i < readings_ln.size(); ++i) {
      felt = present(block, std::vector{"first", "second", "third"}[i]);
      readings_ln[i] += read(felt, block);
    }
    ++looks;
  } while (looks_again(block));
  for (double& reading : readings_ln) reading /= looks;
  const Task task = task_of(block);
  session_.answer(
      person.answer_or_cannot_tell(
          block, person.choose_interval(task, readings_ln, moment(block)),
          [&] { return person.certainty_of_choice(task, readings_ln, looks, moment(block)); }),
      {.response_time_s = felt.duration_s}, felt.last_tick);
}

void TrialPlayer::compare_intervals(const Block& block, AnswerKind asked) {
  if (session_.current_form().num_intervals > 2) return choose_interval(block);
  const Perceiver& person = participant_.perceiver(block);
  double first_ln = 0.0;
  double second_ln = 0.0;
  int looks = 0;
  Felt felt;
  do {
    first_ln += read(present(block, "first"), block);
    felt = present(block, "second");
    second_ln += read(felt, block);
    ++looks;
  } while (looks_again(block));
  first_ln /= looks;
  second_ln /= looks;
  std::optional<double> answer;
  if (asked == AnswerKind::kInterval) {
    const bool second = person.says_thicker(second_ln, first_ln, moment(block));
    answer = person.answer_or_cannot_tell(block, second ? 2.0 : 1.0, [&] {
      return person.certainty_of_thicker(second_ln, first_ln, looks, moment(block));
    });
  } else {
    const bool different = person.says_different(first_ln, second_ln, moment(block));
    answer = person.answer_or_cannot_tell(block, different ? 1.0 : 0.0, [&] {
      return person.certainty_of_different(first_ln, second_ln, looks, moment(block));
    });
  }
  session_.answer(answer, {.response_time_s = felt.duration_s}, felt.last_tick);
}

/// Runs a production or, with a reference, a matching, in which the participant may go back to
/// the reference.
void TrialPlayer::adjust(const Block& block, std::int64_t trial, bool has_reference) {
  // After so many steps, a person gives up and accepts what there is.
  constexpr int kMaxSteps = 60;
  const PlannedTrial planned = session_.state().trial(trial).planned;
  const Perceiver& perceiver = participant_.perceiver(block);
  double standard_ln = 0.0;
  int standard_looks = 0;
  const auto feel_standard = [&] {
    const Felt reference = present(block, "reference");
    const double reading_ln = participant_.standard_as_test_ln(
        block,
        participant_.perceiver(block, "reference").reading_ln(reference.amount, moment(block)));
    standard_ln += (reading_ln - standard_ln) / ++standard_looks;
  };
  if (has_reference) feel_standard();
  // The reading of the present stimulus, with the noise averaged over all looks in this trial:
  // whoever makes many steps knows better where they are than somebody who felt it once.
  double noise_ln = 0.0;
  int looks = 0;
  double duration_s = 0.0;
  Felt felt;
  const auto look = [&](Presenter::Beginning beginning) {
    felt = present(block, "test", beginning);
    duration_s += felt.duration_s;
    const double felt_ln = std::log(std::max(felt.amount, 1e-6));
    noise_ln += read(felt, block) - felt_ln;
    ++looks;
    return felt_ln + noise_ln / looks;
  };
  double reading_ln = look(Presenter::Beginning::kStimulus);
  const double first_ln = reading_ln;
  using Wish = Perceiver::Wish;
  Wish last_wish = Wish::kMatches;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (hurries(block) && left_to_answer_s(block) < felt.duration_s) break;
    const Wish wish =
        has_reference
            ? perceiver.wish_to_match(reading_ln, first_ln, standard_ln, moment(block))
            : perceiver.wish(reading_ln, first_ln, planned.target_percent.value(),
                             moment(block));
    if (wish == Wish::kMatches) {
      if (!has_reference || !looks_again(block)) break;
      feel_standard();
      reading_ln = look(Presenter::Beginning::kStimulus);
      continue;
    }
    // The steps go back and forth over the target by the smallest step, so it gets no closer.
    if ((last_wish == Wish::kRaiseFine && wish == Wish::kLowerFine) ||
        (last_wish == Wish::kLowerFine && wish == Wish::kRaiseFine)) {
      break;
    }
    last_wish = wish;
    const bool raise = wish == Wish::kRaiseFine || wish == Wish::kRaiseCoarse;
    const bool coarse = wish == Wish::kRaiseCoarse || wish == Wish::kLowerCoarse;
    if (!session_.adjust(raise ? Direction::kRaise : Direction::kLower,
                         coarse ? StepSize::kCoarse : StepSize::kFine)) {
      break;
    }
    reading_ln = look(Presenter::Beginning::kStep);
  }
  session_.answer(0.0, {.response_time_s = duration_s}, felt.last_tick);
}

}  // namespace jnd::app
