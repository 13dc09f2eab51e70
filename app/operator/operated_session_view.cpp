#include <algorithm>
#include <cmath>

#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "app/operator/session_words.h"
#include "app/operator/study_outline.h"
#include "app/operator/trial_intervals.h"
#include "core/safety/fault.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/session/plan.h"
#include "experiments/session/session_limits.h"
#include "experiments/session/trial_course.h"
#include "experiments/study/media.h"

namespace jnd::app {

using namespace experiments;

namespace {

ItemView::Kind kind_of_item(const std::string& kind) {
  if (kind == "number") return ItemView::Kind::kNumber;
  if (kind == "choice") return ItemView::Kind::kChoice;
  if (kind == "yes_no") return ItemView::Kind::kYesNo;
  if (kind == "yes_no_which") return ItemView::Kind::kYesNoWhich;
  if (kind == "scale") return ItemView::Kind::kScale;
  if (kind == "words") return ItemView::Kind::kWords;
  return ItemView::Kind::kText;
}

const TrialState* current_state(const SessionState& state) {
  const std::optional<std::int64_t> trial = state.current_trial();
  return trial ? &state.trial(*trial) : nullptr;
}

}  // namespace

std::string OperatedSession::title_of(std::size_t stage) const {
  return shown_titles(session_.stages(), language_, hides_levels_).at(stage);
}

/// The medium that waits in an exploring stage, a training, or a post-experiment item.
std::optional<Exploration> OperatedSession::next_medium() const {
  if (stage() == nullptr || !state().stage_open) return std::nullopt;
  const auto next = static_cast<std::size_t>(state().num_explored);
  const auto of = [&](const std::vector<Exploration>& media) -> std::optional<Exploration> {
    if (next < media.size()) return media[next];
    return std::nullopt;
  };
  if (const auto* explore = std::get_if<Explore>(&stage()->content)) return of(explore->media);
  if (const auto* training = std::get_if<Training>(&stage()->content)) {
    return of(training->examples);
  }
  if (const auto* post = std::get_if<PostExperiment>(&stage()->content)) {
    for (const PostExperimentItem& item : post->items) {
      if (state().answers.contains({state().stage, item.name})) continue;
      return Exploration{.setting = item.setting, .duration_s = 0.0, .say = item.instruction};
    }
  }
  return std::nullopt;
}

bool OperatedSession::stage_is_complete() const {
  if (std::holds_alternative<Break>(stage()->content)) return now_s() >= break_until_s_;
  if (block() != nullptr) return !state().current_trial() && !session_.open_question();
  return !item_view() && !next_medium();
}

bool OperatedSession::stage_needs_no_force() const {
  if (stage() == nullptr) return true;
  return std::holds_alternative<Checklist>(stage()->content) ||
         std::holds_alternative<Consent>(stage()->content) ||
         std::holds_alternative<Questionnaire>(stage()->content) ||
         std::holds_alternative<Break>(stage()->content);
}

bool OperatedSession::is_held_up() const {
  if (known_fault_ == core::Fault::kNone) return false;
  return known_fault_ != core::Fault::kNotArmed || (begun_ && !stage_needs_no_force());
}

Step OperatedSession::step() const {
  if (!failure_.empty()) return Step::kFailed;
  if (is_held_up()) return Step::kFault;
  if (!begun_) return Step::kBegin;
  if (state().ended) return Step::kFinished;
  if (state().paused) return Step::kPaused;
  if (stage() == nullptr || !state().stage_open) return Step::kStageDone;
  return step_in_stage();
}

Step OperatedSession::step_in_stage() const {
  if (feeling_) return Step::kFeeling;
  if (std::holds_alternative<Break>(stage()->content)) return Step::kBreak;
  if (block() != nullptr) {
    if (session_.open_question()) return Step::kItem;
    const TrialState* trial = current_state(state());
    if (trial == nullptr) return Step::kStageDone;
    if (presenter_.under_way() || stimulus_is_over()) return Step::kPresenting;
    return now_s() < rest_until_s_ ? Step::kRest : Step::kReady;
  }
  if (next_medium()) return Step::kMedium;
  return item_view() ? Step::kItem : Step::kStageDone;
}

std::optional<ItemView> OperatedSession::item_view() const {
  if (stage() == nullptr || !state().stage_open) return std::nullopt;
  ItemView item{.stage = state().stage};
  const auto is_answered = [&](const std::string& name) {
    return state().answers.contains({state().stage, name});
  };
  if (const auto* checklist = std::get_if<Checklist>(&stage()->content)) {
    item.count = static_cast<int>(checklist->items.size());
    for (const ChecklistItem& tick : checklist->items) {
      item.name = "item_" + std::to_string(item.index);
      item.text = words(tick.text);
      item.say = words(tick.say);
      if (!is_answered(item.name)) return item;
      ++item.index;
    }
  } else if (const auto* consent = std::get_if<Consent>(&stage()->content)) {
    item.name = "consent";
    item.kind = ItemView::Kind::kConsent;
    item.text = words(consent->agreement);
    for (const Text& paragraph : consent->paragraphs) {
      item.paragraphs.push_back(words(paragraph));
    }
    if (!is_answered(item.name)) return item;
  } else if (const auto* post = std::get_if<PostExperiment>(&stage()->content)) {
    item.count = static_cast<int>(post->items.size());
    for (const PostExperimentItem& question : post->items) {
      item.name = question.name;
      item.kind = kind_of_item(question.answer);
      item.text = words(question.question);
      item.num_words = question.num_words;
      if (!is_answered(item.name)) return item;
      ++item.index;
    }
  } else if (const auto* form = std::get_if<Questionnaire>(&stage()->content)) {
    for (const QuestionnaireItem& question : form->items) {
      if (!is_answered(question.name)) return question_view(question, item.index, form->items);
      ++item.index;
    }
  } else if (const std::optional<OpenQuestion> open = session_.open_question()) {
    item = question_view(*open->item, open->index, block()->questions);
    item.trial = open->trial;
    return item;
  }
  return std::nullopt;
}

ItemView OperatedSession::question_view(const QuestionnaireItem& question, int index,
                                        const std::vector<QuestionnaireItem>& all) const {
  ItemView item{.stage = state().stage,
                .name = question.name,
                .kind = kind_of_item(question.kind),
                .text = words(question.question),
                .unit = question.unit,
                .minimum = question.minimum,
                .maximum = question.maximum,
                .num_steps = question.num_steps,
                .low_label = words(question.low_label),
                .high_label = words(question.high_label),
                .required = question.required,
                .index = index,
                .count = static_cast<int>(all.size())};
  for (const Option& option : question.options) {
    item.options.push_back({option.value, words(option.label)});
  }
  return item;
}

std::vector<ItemView> OperatedSession::answered_items() const {
  std::vector<ItemView> items;
  if (stage() == nullptr || !state().stage_open) return items;
  const auto* form = std::get_if<Questionnaire>(&stage()->content);
  if (form == nullptr) return items;
  int index = 0;
  for (const QuestionnaireItem& question : form->items) {
    ++index;
    const auto answer = state().answers.find({state().stage, question.name});
    if (answer == state().answers.end()) continue;
    items.push_back(question_view(question, index, form->items));
    items.back().answer = answer->second;
  }
  return items;
}

std::string OperatedSession::level_of(const TrialState& trial) const {
  if (hides_levels_ || is_alone()) return "";
  const Block& its_block =
      std::get<Block>(session_.stages().at(static_cast<std::size_t>(trial.stage))->content);
  const PlannedTrial& planned = trial.planned;
  const double level = planned.intensity.value_or(
      trial.under_way ? trial.set_intensity : planned.starting_intensity.value_or(0.0));
  std::string level_and_more = level_words(its_block.quantity, level);
  if (planned.reference_intensity) {
    const MediumSetting reference =
        setting_of(its_block, "reference", *planned.reference_intensity);
    level_and_more +=
        ", " + tr("reference {}", reference.medium == its_block.medium
                                      ? level_words(reference.quantity, reference.intensity)
                                      : words_of(reference));
  }
  return level_and_more;
}

TrialView OperatedSession::trial_view(std::int64_t number) const {
  const TrialState& trial = state().trial(number);
  const TrialForm form = session_.current_form();
  TrialView view{.trial = number,
                 .attempt = trial.attempt,
                 .repetition = trial.planned.repetition,
                 .answer = form.answer,
                 .has_reference = form.has_reference,
                 .adjustable = form.adjustable,
                 .is_solid = block()->is_pressed(),
                 .order_is_drawn = form.order_is_drawn};
  count_trials(view);
  if (presenter_.under_way()) {
    view.interval = shown_interval(form, trial);
    view.felt_s = presenter_.felt_s();
    if (!hides_levels_) view.num_strokes = running_.apparatus().num_metered_strokes();
  } else if (stimulus_is_over()) {
    const PresentationState& last = trial.presentations.back();
    view.interval = "free_space";
    view.stimulus_is_over = true;
    view.felt_s =
        static_cast<double>(last.last_tick.value_or(last.first_tick) - last.first_tick) /
        parameters_.study.device.rate_hz;
  }
  view.least_left_s = least_left_s();
  view.deadline_left_s = deadline_left_s();
  if (trial.under_way && block()->max_returns && num_returns(trial) >= *block()->max_returns) {
    for (const char* interval : {"reference", "test", "first", "second", "third"}) {
      if (felt(trial, interval)) view.closed_intervals.emplace_back(interval);
    }
  }
  view.first_felt_s = first_felt_s_;
  view.can_answer = can_answer(form, trial);
  view.takes_cannot_tell = block()->cannot_tell;
  view.question = words(block()->question);
  const auto [yes, no] = labels_of(*block());
  view.yes_label = yes;
  view.no_label = no;
  if (form.answer == AnswerKind::kInterval) view.choices = choices_of(*block(), form);
  view.num_intervals = form.num_intervals;
  view.next_interval = next_interval(form, trial);
  view.target_percent = trial.planned.target_percent;
  if (form.answer == AnswerKind::kNumber && form.has_reference) {
    view.modulus_value = block()->settings.number("modulus_value");
  }
  if (form.answer == AnswerKind::kStep) {
    view.num_steps = num_steps_of(*block());
    view.low_label = words(block()->low_label);
    view.high_label = words(block()->high_label);
  }
  view.level = level_of(trial);
  view.rest_left_s = std::max(0.0, rest_until_s_ - now_s());
  return view;
}

MediumView OperatedSession::medium_view(const Exploration& medium) const {
  MediumView view{.name = hides_levels_ && medium.setting.medium != "free_space"
                              ? tr("a fluid")
                              : words_of(medium.setting),
                  .say = words(medium.say),
                  .duration_s = medium.duration_s,
                  .index = static_cast<int>(state().num_explored) + 1};
  if (const auto* explore = std::get_if<Explore>(&stage()->content)) {
    view.count = static_cast<int>(explore->media.size());
  } else if (const auto* training = std::get_if<Training>(&stage()->content)) {
    view.count = static_cast<int>(training->examples.size());
  } else if (const auto* post = std::get_if<PostExperiment>(&stage()->content)) {
    view.count = static_cast<int>(post->items.size());
  }
  if (feeling_) {
    view.felt_s = static_cast<double>(running_.apparatus().next_tick() - feeling_->first_tick) /
                  parameters_.study.device.rate_hz;
  }
  return view;
}

void OperatedSession::describe_loop(SessionView& view) const {
  const Apparatus& apparatus = running_.apparatus();
  view.telemetry = apparatus.telemetry();
  // A fault that has come since the last look is not shown yet, so nobody has seen it.
  view.telemetry.num_faults = seen_num_faults_;
  view.max_total_force_n = apparatus.max_total_force_n();
  view.num_contact_points = apparatus.num_contact_points();
  view.loop.rate_hz = parameters_.study.device.rate_hz;
  view.loop.num_dropped_samples = view.telemetry.num_dropped_samples;
  view.stop_pressed = parameters_.exchange.emergency_stop.is_pressed();
  view.num_stop_presses = parameters_.exchange.emergency_stop.num_presses();
  if (const device::RealtimeThread* thread = apparatus.realtime_thread()) {
    const device::LoopTiming& timing = thread->timing();
    view.loop.lateness_p99_us =
        1e-3 * static_cast<double>(timing.lateness().percentile_ns(0.99));
    view.loop.max_lateness_us = 1e-3 * static_cast<double>(timing.lateness().max_ns());
    view.loop.missed_ticks = timing.missed_ticks();
    view.loop.realtime = thread->report().realtime_scheduler && thread->report().memory_locked;
  }
  view.loop.scheduler = apparatus.realtime();
  view.surroundings = {.immersion = parameters_.study.device.immersion,
                       .has_walls = parameters_.study.device.wall_stiffness_n_per_m > 0.0};
  view.loop.num_limited_ticks = view.telemetry.num_limited_ticks;
  if (!hides_levels_) {
    const bool presses =
        presenter_.under_way() && block() != nullptr &&
        block()->is_pressed_in(current_state(state())->presentations.back().interval);
    view.surroundings.surface_is_solid =
        presses || (feeling_ && experiments::is_pressed(feeling_->setting.medium));
    return;
  }
  // Speed and force tell the level. All that may be known is whether they are within limits.
  view.telemetry.total_force_n = {};
  view.telemetry.hand_velocity_m_per_s = {};
  view.telemetry.sample.tip_force_n = {};
  view.telemetry.sample.tip_velocity_m_per_s = {};
  view.telemetry.sample.tip_position_m = {};
  view.telemetry.sample.joint_position_rad = {};
  view.telemetry.sample.joint_torque_n_m = {};
  view.telemetry.contact_sums = {};
  view.telemetry.num_limited_ticks = view.loop.num_limited_ticks = 0;
}

SessionView OperatedSession::view() const {
  SessionView view{.study = words(parameters_.study.title),
                   .participant = row_.participant,
                   .device = row_.device,
                   .language = language_,
                   .pilot = row_.pilot,
                   .simulated = row_.simulated,
                   .blinding = parameters_.study.blinding,
                   .hides_levels = hides_levels_,
                   .is_alone = is_alone()};
  view.step = step();
  view.stage = state().stage;
  view.participant_answers = block() != nullptr && block()->participant_answers;
  view.controls = parameters_.controls;
  view.last_sequence = state().last_sequence;
  if (begun_ && state().stage_open && !state().ended) {
    view.item = item_view();
    view.answered_items = answered_items();
    if (const auto medium = next_medium()) view.medium = medium_view(*medium);
    if (const auto trial = state().current_trial(); trial && block() != nullptr) {
      view.trial = trial_view(*trial);
    }
    if (const auto* rest = std::get_if<Break>(&stage()->content)) {
      view.break_s = rest->duration_s;
      view.break_left_s = std::max(0.0, break_until_s_ - now_s());
    }
  }
  if (!state().ended && block() != nullptr && state().stage_open) {
    // If it were told before a question, it would influence how sure the participant says to
    // have been.
    if (!session_.open_question()) view.feedback_right = state().feedback_right;
    view.missed_deadline = state().missed_deadline;
    if (block()->practice && !view.trial) {
      view.practice = practice_words(
          *block(), practice_state(*block(), state().answered_in(state().stage)));
    }
    if (!hides_levels_ && !view.trial) view.caution = cautions();
  }
  view.doubt = doubt_view();
  view.answers = answer_lines();
  view.notes = state().notes;
  describe_loop(view);
  describe_progress(view);
  if (!failure_.empty()) {
    view.fault = failure_;
    view.fault_name = "storage_failed";
  } else if (known_fault_ != core::Fault::kNone) {
    view.fault = tr(core::words(known_fault_).data());
    view.fault_name = std::string(core::name(known_fault_));
    view.is_disarmed = known_fault_ == core::Fault::kNotArmed;
  }
  view.loose_bits = loose_bits();
  view.loose_points = told_points(view.loose_bits);
  view.came_off_points = told_points(paused_for_bits_);
  view.asks_why_paused = state().unexplained_pause != 0 && !state().ended;
  const core::Telemetry& now = running_.apparatus().telemetry();
  if (now.num_ticks > 0) view.absent_points = told_points(attachment_.absent_bits(now));
  view.refusal = refusal_;
  view.num_refusals = num_refusals_;
  view.remark = remark_;
  view.advice = limit_advice(parameters_.study.session_limits,
                             num_answers_since_break(session_.stages(), state()), visit_s());
  if (running_.sound() != nullptr) view.sound_warning = running_.sound()->warning();
  if (view.advice.empty()) view.advice = running_.markers_problem();
  // Where levels are hidden, a single one must not be told from others.
  if (view.advice.empty() && state().num_without_force >= (hides_levels_ ? 3 : 1)) {
    view.advice =
        trn("No force acted in {} presentation: {}", "No force acted in {} presentations: {}",
            state().num_without_force, tr(state().missing_force_cause.c_str()));
  }
  if (const std::string over =
          exposure_words(parameters_.study.session_limits, state().exposure);
      !over.empty()) {
    view.advice = over;
  }
  const bool has_stage = stage() != nullptr && begun_;
  add_words(view, has_stage ? title_of(static_cast<std::size_t>(state().stage)) : "",
            has_stage ? instructions() : "");
  return view;
}

}  // namespace jnd::app
