#include "experiments/participants/answer_simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/participants/abilities.h"
#include "experiments/participants/calculated_stroke.h"
#include "experiments/participants/counting.h"
#include "experiments/procedures/adjustment.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

/// Plays one participant in one block.
class BlockPlayer {
 public:
  BlockPlayer(const Laboratory& laboratory, const core::ForceMap* map,
              const SimulatedParticipant& participant, std::uint64_t session_seed,
              const Block& block, const DeviceNeeds& device)
      : laboratory_(laboratory),
        map_(map),
        participant_(participant),
        seed_(session_seed),
        block_(block),
        form_(procedure_named(block.procedure).form(block)),
        strokes_(block.is_pressed()
                     ? participant.presses(block.procedure, device.immersion.origin_z_m)
                     : participant.strokes(block.procedure)),
        stroking_(participant.strokes(block.procedure)),
        presentation_s_(
            std::clamp(device.ramp_s + strokes_.duration_s(), block.min_stimulus_s,
                       std::max(block.min_stimulus_s, block.max_stimulus_s.value_or(kNoEnd)))),
        deadline_s_(block.answer_deadline_s.value_or(kNoEnd)),
        perceiver_(participant.perceiver(block)) {}

  /// Returns the response to a trial; none means "cannot tell". `answered` are the trials
  /// before it in the block.
  std::optional<double> respond(const PlannedTrial& planned, std::int64_t trial,
                                const std::vector<AnsweredTrial>& answered) {
    for (int attempt = 1;; ++attempt) {
      moment_ = {.trial = trial,
                 .attempt = attempt,
                 .presentation = 0,
                 .trial_in_block = static_cast<std::int64_t>(answered.size()) + 1};
      const double felt_before_s = felt_s_;
      const std::optional<double> answer = respond_once(planned, answered);
      const double before_question_s = (num_stimuli(planned) - 1) * presentation_s_;
      if (felt_s_ - felt_before_s - before_question_s < deadline_s_) return answer;
      // The stimulus was not felt after the deadline.
      felt_s_ = felt_before_s + before_question_s + deadline_s_;
      if (hurries()) return answer;
    }
  }

  [[nodiscard]] double felt_s() const noexcept { return felt_s_; }

 private:
  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();

  /// A participant who missed the deadline answers in time when the trial is repeated.
  [[nodiscard]] bool hurries() const noexcept { return moment_.attempt > 1; }

  /// Returns how many stimuli come before the trial can be answered.
  [[nodiscard]] int num_stimuli(const PlannedTrial& planned) const {
    if (form_.order_is_drawn) return form_.num_intervals;
    return form_.has_reference && planned.reference_intensity ? 2 : 1;
  }

  std::optional<double> respond_once(const PlannedTrial& planned,
                                     const std::vector<AnsweredTrial>& answered) {
    if (form_.adjustable) return adjust(planned);
    if (form_.order_is_drawn) return compare_intervals(planned);
    if (form_.answer == AnswerKind::kYesNo && !form_.has_reference) return detect(planned);
    if (form_.answer == AnswerKind::kYesNo) return compare(planned);
    return estimate(planned, answered);
  }

  /// Returns the reading of the next presentation in ln(N s/m), or for a solid in ln(N/m).
  double present(const char* interval, double intensity) {
    ++moment_.presentation;
    felt_s_ += presentation_s_;
    const core::MediumAmounts medium = amounts_of(setting_of(block_, interval, intensity));
    double delivered = medium.damping_n_s_per_m;
    const bool is_pressed = block_.is_pressed_in(interval);
    if (!medium.is_plain_damping() && !is_pressed) {
      delivered = calculated_stroke(laboratory_, stroking_.amplitude_m, drawn_speed_m_per_s(),
                                    medium, map_)
                      .delivered_damping_n_s_per_m;
    }
    felt_ = is_pressed ? medium.plane_stiffness_n_per_m
                       : delivered + laboratory_.device.mechanical_viscosity_n_s_per_m;
    const double reading_ln =
        participant_.perceiver(block_, interval).reading_ln(felt_, moment_);
    return std::string_view(interval) == "reference"
               ? participant_.standard_as_test_ln(block_, reading_ln)
               : reading_ln;
  }

  /// Returns the mean of this presentation's strokes, each of which is a little faster or
  /// slower.
  [[nodiscard]] double drawn_speed_m_per_s() const {
    core::RandomStream random(seed_, "calculated stroke",
                              {moment_.trial, moment_.attempt, moment_.presentation});
    double sum = 0.0;
    for (int stroke = 0; stroke < strokes_.num_strokes; ++stroke) {
      sum += 1.0 + laboratory_.movement.stroke_speed_sd_ratio *
                       std::clamp(random.normal(), -2.5, 2.5);
    }
    return stroking_.max_speed_m_per_s * sum / strokes_.num_strokes;
  }

  /// Whether the participant returns to a stimulus, within what the block allows.
  [[nodiscard]] bool looks_again() const {
    if (block_.max_returns && moment_.presentation > *block_.max_returns) return false;
    if (hurries()) return false;
    return perceiver_.looks_again(moment_);
  }

  double estimate(const PlannedTrial& planned, const std::vector<AnsweredTrial>& answered) {
    double sum_ln = 0.0, standard_ln = 0.0;
    int looks = 0;
    do {
      if (planned.reference_intensity) {
        standard_ln += present("reference", *planned.reference_intensity);
      }
      sum_ln += present("test", planned.intensity.value());
      ++looks;
    } while (looks_again());
    std::optional<double> previous, felt_standard_ln;
    if (!answered.empty()) previous = answered.back().response;
    if (planned.reference_intensity) felt_standard_ln = standard_ln / looks;
    if (form_.answer == AnswerKind::kStep) {
      const double ratio =
          magnitude_ratio(laboratory_, participant_, block_, sum_ln / looks, map_);
      return perceiver_.rate(ratio, num_steps_of(block_), moment_, previous);
    }
    if (form_.answer == AnswerKind::kPercent) {
      return perceiver_.estimate_percent(sum_ln / looks, moment_, previous);
    }
    return perceiver_.estimate_number(
        sum_ln / looks, moment_, previous,
        counting_of(laboratory_, participant_, block_, felt_standard_ln, map_));
  }

  /// Answers whether anything is there, compared with the remembered free space.
  std::optional<double> detect(const PlannedTrial& planned) {
    double test_ln = 0.0;
    int looks = 0;
    do {
      test_ln += present("test", planned.intensity.value());
      ++looks;
    } while (looks_again());
    const double nothing_ln = perceiver_.free_space_ln();
    const bool there = perceiver_.says_present(test_ln / looks, nothing_ln, moment_);
    return perceiver_.answer_or_cannot_tell(block_, there ? 1.0 : 0.0, [&] {
      return perceiver_.certainty_of_present(test_ln / looks, nothing_ln, looks, moment_);
    });
  }

  std::optional<double> compare(const PlannedTrial& planned) {
    double reference_ln = 0.0, test_ln = 0.0;
    int looks = 0;
    do {
      reference_ln += present("reference", planned.reference_intensity.value());
      test_ln += present("test", planned.intensity.value());
      ++looks;
    } while (looks_again());
    const bool thicker =
        perceiver_.says_thicker(test_ln / looks, reference_ln / looks, moment_);
    return perceiver_.answer_or_cannot_tell(block_, thicker ? 1.0 : 0.0, [&] {
      return perceiver_.certainty_of_thicker(test_ln / looks, reference_ln / looks, looks,
                                             moment_);
    });
  }

  std::optional<double> choose_interval(const PlannedTrial& planned) {
    std::vector<double> sums_ln(planned.intervals.size(), 0.0);
    int looks = 0;
    do {
      for (std::size_t i = 0; i < sums_ln.size(); ++i) {
        const double intensity = planned.intervals[i] == 't'
                                     ? planned.intensity.value()
                                     : planned.reference_intensity.value();
        sums_ln[i] += present("interval", intensity);
      }
      ++looks;
    } while (looks_again());
    for (double& sum : sums_ln) sum /= looks;
    const Task task = task_of(block_);
    return response_of(
        form_.answer, planned,
        perceiver_.answer_or_cannot_tell(
            block_, perceiver_.choose_interval(task, sums_ln, moment_),
            [&] { return perceiver_.certainty_of_choice(task, sums_ln, looks, moment_); }));
  }

  std::optional<double> compare_intervals(const PlannedTrial& planned) {
    if (!planned.intervals.empty()) return choose_interval(planned);
    const double test = planned.intensity.value();
    const double reference = planned.reference_intensity.value();
    const bool test_first = planned.test_interval.value() == 1;
    double first_ln = 0.0, second_ln = 0.0;
    int looks = 0;
    do {
      first_ln += present("first", test_first ? test : reference);
      second_ln += present("second", test_first ? reference : test);
      ++looks;
    } while (looks_again());
    first_ln /= looks;
    second_ln /= looks;
    if (form_.answer != AnswerKind::kInterval) {
      const bool different = perceiver_.says_different(first_ln, second_ln, moment_);
      return perceiver_.answer_or_cannot_tell(block_, different ? 1.0 : 0.0, [&] {
        return perceiver_.certainty_of_different(first_ln, second_ln, looks, moment_);
      });
    }
    const bool second = perceiver_.says_thicker(second_ln, first_ln, moment_);
    return response_of(form_.answer, planned,
                       perceiver_.answer_or_cannot_tell(block_, second ? 2.0 : 1.0, [&] {
                         return perceiver_.certainty_of_thicker(second_ln, first_ln, looks,
                                                                moment_);
                       }));
  }

  /// Returns what a step shall do in a production or a matching.
  [[nodiscard]] Perceiver::Wish wish(const PlannedTrial& planned, double reading_ln,
                                     double first_ln, double standard_ln) const {
    if (form_.has_reference) {
      return perceiver_.wish_to_match(reading_ln, first_ln, standard_ln, moment_);
    }
    return perceiver_.wish(reading_ln, first_ln, planned.target_percent.value(), moment_);
  }

  double adjust(const PlannedTrial& planned) {
    using Wish = Perceiver::Wish;
    // After this many steps a person gives up and accepts the setting.
    constexpr int kMaxSteps = 60;
    double standard_ln = 0.0;
    int standard_looks = 0;
    const auto feel_standard = [&] {
      const double reading_ln = present("reference", planned.reference_intensity.value());
      standard_ln += (reading_ln - standard_ln) / ++standard_looks;
    };
    if (form_.has_reference) feel_standard();
    const double start = planned.starting_intensity.value();
    double set = start, noise_ln = 0.0;
    int looks = 0;
    // The noise of all looks at this trial is averaged, as in a session.
    const auto look = [&] {
      const double reading_ln = present("test", set);
      const double felt_ln = std::log(std::max(felt_, 1e-6));
      noise_ln += reading_ln - felt_ln;
      return felt_ln + noise_ln / ++looks;
    };
    double reading_ln = look();
    const double first_ln = reading_ln;
    Wish last_wish = Wish::kMatches;
    for (int step = 0; step < kMaxSteps; ++step) {
      if (hurries() && (looks + 1) * presentation_s_ > deadline_s_) break;
      const Wish next = wish(planned, reading_ln, first_ln, standard_ln);
      if (next == Wish::kMatches) {
        if (!form_.has_reference || !looks_again()) break;
        feel_standard();
        reading_ln = look();
        continue;
      }
      // The setting alternates about the target by the smallest step, so it gets no closer.
      if ((last_wish == Wish::kRaiseFine && next == Wish::kLowerFine) ||
          (last_wish == Wish::kLowerFine && next == Wish::kRaiseFine)) {
        break;
      }
      last_wish = next;
      const bool raise = next == Wish::kRaiseFine || next == Wish::kRaiseCoarse;
      const bool coarse = next == Wish::kRaiseCoarse || next == Wish::kLowerCoarse;
      const double size = coarse ? block_.coarse_step : block_.fine_step;
      const double target = stepped_intensity(block_, start, set, raise ? size : -size);
      if (target == set) break;
      set = target;
      reading_ln = look();
    }
    return set;
  }

  const Laboratory& laboratory_;
  const core::ForceMap* map_;
  const SimulatedParticipant& participant_;
  std::uint64_t seed_;
  const Block& block_;
  TrialForm form_;
  StrokeIntent strokes_;
  /// Strokes through a fluid. In a block of presses, `strokes_` are the presses.
  StrokeIntent stroking_;
  double presentation_s_;
  double deadline_s_;
  const Perceiver perceiver_;
  Moment moment_;
  double felt_ = 0.0;
  double felt_s_ = 0.0;
};

/// Throws `Error` for a form of answer that no simulated person can give, before any question
/// is asked.
void require_answerable(const Stage& stage) {
  const auto* block = std::get_if<Block>(&stage.content);
  if (block == nullptr) return;
  const TrialForm form = procedure_named(block->procedure).form(*block);
  const bool known = form.adjustable ? form.answer == AnswerKind::kMatch
                     : form.answer == AnswerKind::kPercent
                         ? !form.has_reference
                         : form.answer == AnswerKind::kYesNo ||
                               form.answer == AnswerKind::kNumber ||
                               form.answer == AnswerKind::kStep || form.order_is_drawn;
  if (!known) {
    throw core::Error("block " + stage.name +
                      ": expected a procedure that simulated participants answer without a "
                      "device, found " +
                      block->procedure);
  }
}

}  // namespace

AnswerSimulator::AnswerSimulator(const Study& study, const Laboratory& laboratory)
    : laboratory_(laboratory), device_(study.device), map_(force_map_of(study.device)) {
  for_each_stage(study.stages, require_answerable);
  require_abilities(laboratory, study);
}

std::vector<AnsweredBlock> AnswerSimulator::answers(const std::vector<StageInstance>& stages,
                                                    std::uint64_t session_seed) const {
  const SimulatedParticipant participant(laboratory_, session_seed);
  // Interleaved blocks are run one after another, because these participants carry nothing over
  // from one block to another.
  std::vector<AnsweredBlock> blocks;
  std::int64_t trial = 0;  // Running number in the session.
  for (std::size_t index = 0; index < stages.size(); ++index) {
    if (!std::holds_alternative<Block>(stages[index].stage->content)) continue;
    const Block block =
        block_of(*stages[index].stage, stages[index].order_row, stages[index].people);
    BlockPlayer player(laboratory_, map_.get(), participant, session_seed, block, device_);
    std::vector<AnsweredTrial> answered;
    while (true) {
      // This is the key of a session's draw.
      core::RandomStream stream(
          session_seed, "order",
          {static_cast<std::int64_t>(index), static_cast<std::int64_t>(answered.size())});
      const std::vector<PlannedTrial> drawn = next_trials(block, answered, stream);
      if (drawn.empty()) break;
      for (const PlannedTrial& planned : drawn) {
        answered.push_back({planned, player.respond(planned, ++trial, answered)});
      }
    }
    blocks.push_back({stages[index].stage, std::move(answered), player.felt_s()});
  }
  return blocks;
}

}  // namespace jnd::experiments
