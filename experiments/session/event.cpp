#include "experiments/session/event.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

constexpr std::array<const char*, std::variant_size_v<EventData>> kKinds = {
    "session_started",    "stage_entered",        "item_answered",
    "medium_explored",    "stage_finished",       "trials_drawn",
    "trial_started",      "presentation_started", "presentation_ended",
    "intensity_adjusted", "trial_answered",       "answer_undone",
    "answer_corrected",   "attempt_discarded",    "trial_excluded",
    "trial_included",     "note_added",           "paused",
    "continued",          "fault_raised",         "session_resumed",
    "session_completed",  "session_ended_early"};

json optional_number(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

std::optional<double> optional_number(const json& data, const char* key) {
  const json& value = data.at(key);
  if (value.is_null()) return std::nullopt;
  return value.get<double>();
}

json planned_to_json(const PlannedTrial& trial) {
  return {{"repetition", trial.repetition},
          {"position", trial.position},
          {"intensity", optional_number(trial.intensity)},
          {"reference_intensity", optional_number(trial.reference_intensity)},
          {"starting_intensity", optional_number(trial.starting_intensity)},
          {"target_percent", optional_number(trial.target_percent)}};
}

PlannedTrial planned_from_json(const json& data) {
  return {.repetition = data.at("repetition").get<int>(),
          .position = data.at("position").get<int>(),
          .intensity = optional_number(data, "intensity"),
          .reference_intensity = optional_number(data, "reference_intensity"),
          .starting_intensity = optional_number(data, "starting_intensity"),
          .target_percent = optional_number(data, "target_percent")};
}

/// One overload an event: what stands in columns goes to the row, the rest to `data`.
struct Writer {
  core::EventRow& row;
  json& data;

  void operator()(const SessionStarted&) const {}
  void operator()(const StageEntered& e) const { row.stage = e.stage; }
  void operator()(const ItemAnswered& e) const {
    row.stage = e.stage;
    data = {{"stage_name", e.stage_name}, {"item", e.item}, {"answer", e.answer}};
  }
  void operator()(const MediumExplored& e) const {
    row.stage = e.stage;
    row.intensity = e.intensity;
    row.first_tick = e.first_tick;
    row.last_tick = e.last_tick;
    data = {{"medium", e.medium}};
  }
  void operator()(const StageFinished& e) const { row.stage = e.stage; }
  void operator()(const TrialsDrawn& e) const {
    row.stage = e.stage;
    row.trial = e.first_trial;
    data["trials"] = json::array();
    for (const PlannedTrial& trial : e.trials) data["trials"].push_back(planned_to_json(trial));
  }
  void operator()(const TrialStarted& e) const {
    place(e.trial, e.attempt);
    row.first_tick = e.first_tick;
  }
  void operator()(const PresentationStarted& e) const {
    place(e.trial, e.attempt);
    row.intensity = e.intensity;
    row.first_tick = e.first_tick;
    data = {{"presentation", e.presentation}, {"interval", e.interval}};
  }
  void operator()(const PresentationEnded& e) const {
    place(e.trial, e.attempt);
    row.last_tick = e.last_tick;
    const PresentationSummary& s = e.summary;
    data = {{"presentation", e.presentation},
            {"stroke_width_m", optional_number(s.stroke_width_m)},
            {"max_speed_m_per_s", optional_number(s.max_speed_m_per_s)},
            {"mean_height_m", optional_number(s.mean_height_m)},
            {"num_strokes", s.num_strokes},
            {"delivered_damping_n_s_per_m", optional_number(s.delivered_damping_n_s_per_m)},
            {"commanded_damping_n_s_per_m", optional_number(s.commanded_damping_n_s_per_m)},
            {"limited_ticks", s.limited_ticks}};
  }
  void operator()(const IntensityAdjusted& e) const {
    place(e.trial, e.attempt);
    row.intensity = e.to_intensity;
    data = {{"from_intensity", e.from_intensity}};
  }
  void operator()(const TrialAnswered& e) const {
    place(e.trial, e.attempt);
    row.last_tick = e.last_tick;
    data = {{"response", e.response}, {"response_time_s", e.response_time_s}};
  }
  void operator()(const AnswerUndone& e) const {
    place(e.trial, e.attempt);
    row.supersedes = e.answer_sequence;
    data = {{"reason", e.reason}};
  }
  void operator()(const AnswerCorrected& e) const {
    place(e.trial, e.attempt);
    row.supersedes = e.answer_sequence;
    data = {{"response", e.response}, {"reason", e.reason}};
  }
  void operator()(const AttemptDiscarded& e) const {
    place(e.trial, e.attempt);
    data = {{"reason", e.reason}};
  }
  void operator()(const TrialExcluded& e) const {
    row.trial = e.trial;
    data = {{"reason", e.reason}};
  }
  void operator()(const TrialIncluded& e) const {
    row.trial = e.trial;
    data = {{"reason", e.reason}};
  }
  void operator()(const NoteAdded& e) const { data = {{"text", e.text}}; }
  void operator()(const Paused& e) const { data = {{"reason", e.reason}}; }
  void operator()(const Continued&) const {}
  void operator()(const FaultRaised& e) const { data = {{"fault", e.fault}}; }
  void operator()(const SessionResumed& e) const {
    row.first_tick = e.lost_first_tick;
    row.last_tick = e.lost_last_tick;
    data = {{"choice", e.choice}};
  }
  void operator()(const SessionCompleted&) const {}
  void operator()(const SessionEndedEarly& e) const { data = {{"reason", e.reason}}; }

 private:
  void place(std::int64_t trial, std::int64_t attempt) const {
    row.trial = trial;
    row.attempt = attempt;
  }
};

/// The inverse of `Writer`, one overload an event.
struct Reader {
  const core::EventRow& row;
  const json& data;

  void operator()(SessionStarted&) const {}
  void operator()(StageEntered& e) const { e.stage = row.stage.value(); }
  void operator()(ItemAnswered& e) const {
    e.stage = row.stage.value();
    data.at("stage_name").get_to(e.stage_name);
    data.at("item").get_to(e.item);
    data.at("answer").get_to(e.answer);
  }
  void operator()(MediumExplored& e) const {
    e.stage = row.stage.value();
    e.intensity = row.intensity.value();
    e.first_tick = row.first_tick.value();
    e.last_tick = row.last_tick.value();
    data.at("medium").get_to(e.medium);
  }
  void operator()(StageFinished& e) const { e.stage = row.stage.value(); }
  void operator()(TrialsDrawn& e) const {
    e.stage = row.stage.value();
    e.first_trial = row.trial.value();
    for (const json& trial : data.at("trials")) e.trials.push_back(planned_from_json(trial));
  }
  void operator()(TrialStarted& e) const {
    place(e);
    e.first_tick = row.first_tick.value();
  }
  void operator()(PresentationStarted& e) const {
    place(e);
    e.intensity = row.intensity.value();
    e.first_tick = row.first_tick.value();
    data.at("presentation").get_to(e.presentation);
    data.at("interval").get_to(e.interval);
  }
  void operator()(PresentationEnded& e) const {
    place(e);
    e.last_tick = row.last_tick.value();
    data.at("presentation").get_to(e.presentation);
    PresentationSummary& s = e.summary;
    s.stroke_width_m = optional_number(data, "stroke_width_m");
    s.max_speed_m_per_s = optional_number(data, "max_speed_m_per_s");
    s.mean_height_m = optional_number(data, "mean_height_m");
    data.at("num_strokes").get_to(s.num_strokes);
    s.delivered_damping_n_s_per_m = optional_number(data, "delivered_damping_n_s_per_m");
    s.commanded_damping_n_s_per_m = optional_number(data, "commanded_damping_n_s_per_m");
    data.at("limited_ticks").get_to(s.limited_ticks);
  }
  void operator()(IntensityAdjusted& e) const {
    place(e);
    e.to_intensity = row.intensity.value();
    data.at("from_intensity").get_to(e.from_intensity);
  }
  void operator()(TrialAnswered& e) const {
    place(e);
    e.last_tick = row.last_tick.value();
    data.at("response").get_to(e.response);
    data.at("response_time_s").get_to(e.response_time_s);
  }
  void operator()(AnswerUndone& e) const {
    place(e);
    e.answer_sequence = row.supersedes.value();
    data.at("reason").get_to(e.reason);
  }
  void operator()(AnswerCorrected& e) const {
    place(e);
    e.answer_sequence = row.supersedes.value();
    data.at("response").get_to(e.response);
    data.at("reason").get_to(e.reason);
  }
  void operator()(AttemptDiscarded& e) const {
    place(e);
    data.at("reason").get_to(e.reason);
  }
  void operator()(TrialExcluded& e) const {
    e.trial = row.trial.value();
    data.at("reason").get_to(e.reason);
  }
  void operator()(TrialIncluded& e) const {
    e.trial = row.trial.value();
    data.at("reason").get_to(e.reason);
  }
  void operator()(NoteAdded& e) const { data.at("text").get_to(e.text); }
  void operator()(Paused& e) const { data.at("reason").get_to(e.reason); }
  void operator()(Continued&) const {}
  void operator()(FaultRaised& e) const { data.at("fault").get_to(e.fault); }
  void operator()(SessionResumed& e) const {
    e.lost_first_tick = row.first_tick.value();
    e.lost_last_tick = row.last_tick.value();
    data.at("choice").get_to(e.choice);
  }
  void operator()(SessionCompleted&) const {}
  void operator()(SessionEndedEarly& e) const { data.at("reason").get_to(e.reason); }

 private:
  template <typename E>
  void place(E& e) const {
    e.trial = row.trial.value();
    e.attempt = row.attempt.value();
  }
};

/// The event of the kind at this index, with nothing in it yet.
template <std::size_t... kIndices>
EventData empty_event(std::size_t index, std::index_sequence<kIndices...>) {
  EventData data;
  (void)((kIndices == index && (data.emplace<kIndices>(), true)) || ...);
  return data;
}

}  // namespace

std::string kind_of(const EventData& data) { return kKinds.at(data.index()); }

core::EventRow row_from_event(std::int64_t session, const Event& event) {
  core::EventRow row{.session = session,
                     .sequence = event.sequence,
                     .kind = kind_of(event.data),
                     .time_ns = event.time_ns};
  json data = json::object();
  std::visit(Writer{row, data}, event.data);
  row.data = data.dump(-1, ' ', false, json::error_handler_t::replace);
  return row;
}

Event event_from_row(const core::EventRow& row) {
  const std::string place = "session " + std::to_string(row.session) + ", event " +
                            std::to_string(row.sequence) + ": ";
  for (std::size_t index = 0; index < kKinds.size(); ++index) {
    if (row.kind != kKinds[index]) continue;
    Event event{.sequence = row.sequence,
                .time_ns = row.time_ns,
                .data = empty_event(index, std::make_index_sequence<kKinds.size()>{})};
    try {
      const json data = json::parse(row.data);
      std::visit(Reader{row, data}, event.data);
    } catch (const std::exception& error) {
      throw core::Error(place + "expected the data of " + row.kind +
                        ", found: " + error.what());
    }
    return event;
  }
  throw core::Error(place + "expected a known kind of event, found " + row.kind +
                    "; open it with a newer jnd");
}

}  // namespace jnd::experiments
