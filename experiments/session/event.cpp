#include "experiments/session/event.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "experiments/session/event_json.h"
#include "experiments/study/shown_text.h"

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
    "loop_started",       "loop_measured",        "unblinded",
    "arming_changed",     "exposure_told",        "guard_noticed",
    "fitting_kept",       "question_answered",    "turn_taken",
    "pause_explained",    "stream_opened",        "stream_closed",
    "stream_failed",      "sound_started",        "cues_played",
    "sound_measured",     "sound_missing",        "markers_opened",
    "markers_sent",       "markers_closed",       "markers_failed",
    "force_missing",      "session_completed",    "session_ended_early"};

json exposure_json(const core::Exposure& exposure) {
  return {{"force_time_n_s", exposure.force_time_n_s},
          {"under_force_s", exposure.under_force_s}};
}

core::Exposure exposure_from_json(const json& data) {
  return {.force_time_n_s = data.at("force_time_n_s").get<double>(),
          .under_force_s = data.at("under_force_s").get<double>()};
}

/// Version of the layout of `data`, for every kind.
constexpr int kVersion = 1;

/// Returns a column that this kind of event has. Throws unless its size is one with which the
/// fold can compute.
template <typename Number>
Number column(const std::optional<Number>& value, const char* name) {
  constexpr auto kLargest = static_cast<Number>(kLargestWhole);
  if (value && *value >= -kLargest && *value <= kLargest) return *value;
  throw core::Error(std::string(name) +
                    ": expected a number up to 2^53 in this column, found " +
                    (value ? std::to_string(*value) : "none"));
}

const json& list_at(const json& data, const char* key) {
  const json& list = data.at(key);
  if (list.is_array()) return list;
  throw core::Error(std::string(key) + ": expected a list, found " + list.type_name());
}

json device_json(const DeviceTold& device) {
  return {{"model", device.model},
          {"serial", device.serial},
          {"firmware", device.firmware},
          {"share_ratio", device.share_ratio},
          {"has", device.has},
          {"own_mass_kg", device.own_mass_kg},
          {"own_damping_n_s_per_m", device.own_damping_n_s_per_m},
          {"closed_loop_delay_s", device.closed_loop_delay_s}};
}

DeviceTold device_from_json(const json& data) {
  return {.model = data.at("model").get<std::string>(),
          .serial = data.at("serial").get<std::string>(),
          .firmware = data.at("firmware").get<std::string>(),
          .share_ratio = data.at("share_ratio").get<std::vector<double>>(),
          .has = data.at("has").get<std::vector<std::string>>(),
          .own_mass_kg = data.at("own_mass_kg").get<double>(),
          .own_damping_n_s_per_m = data.at("own_damping_n_s_per_m").get<double>(),
          .closed_loop_delay_s = data.at("closed_loop_delay_s").get<double>()};
}

json buckets_to_json(const std::vector<DurationBucket>& buckets) {
  json list = json::array();
  for (const DurationBucket& bucket : buckets) list.push_back({bucket.up_to_ns, bucket.count});
  return list;
}

std::vector<DurationBucket> buckets_from_json(const json& list) {
  std::vector<DurationBucket> buckets;
  for (const json& bucket : list) {
    buckets.push_back(
        {whole_number(bucket.at(0), "up_to_ns"), whole_number(bucket.at(1), "count")});
  }
  return buckets;
}

/// Has one overload for each event. What is stored in columns goes to the row, the rest to
/// `data`.
struct Writer {
  core::EventRow& row;
  json& data;

  void operator()(const SessionStarted& e) const {
    if (!e.language.empty()) data["language"] = e.language;
    if (!e.fields.empty()) data["fields"] = e.fields;
  }
  void operator()(const StageEntered& e) const {
    row.stage = e.stage;
    if (e.num_together != 1) data["num_together"] = e.num_together;
  }
  void operator()(const TurnTaken& e) const { row.stage = e.stage; }
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
    for (const PlannedTrial& trial : e.trials) {
      write_columns(trial, data["trials"].emplace_back(json::object()));
    }
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
    if (e.place != 0) data["place"] = e.place;
  }
  void operator()(const PresentationEnded& e) const {
    place(e.trial, e.attempt);
    row.last_tick = e.last_tick;
    data = {{"presentation", e.presentation}};
    write_columns(e.summary.measures, data);
    if (e.summary.exposure) data.update(exposure_json(*e.summary.exposure));
  }
  void operator()(const IntensityAdjusted& e) const {
    place(e.trial, e.attempt);
    row.intensity = e.to_intensity;
    data = {{"from_intensity", e.from_intensity}};
  }
  void operator()(const TrialAnswered& e) const {
    place(e.trial, e.attempt);
    row.last_tick = e.last_tick;
    data = {{"response", json_of(e.response)}};
    write_columns(e.measures, data);
    if (e.feedback_right) data["feedback_right"] = *e.feedback_right;
  }
  void operator()(const QuestionAnswered& e) const {
    place(e.trial, e.attempt);
    data = {{"question", e.question}, {"answer", e.answer}};
  }
  void operator()(const AnswerUndone& e) const {
    place(e.trial, e.attempt);
    row.supersedes = e.answer_sequence;
    data = {{"reason", e.reason}};
  }
  void operator()(const AnswerCorrected& e) const {
    place(e.trial, e.attempt);
    row.supersedes = e.answer_sequence;
    data = {{"response", json_of(e.response)}, {"reason", e.reason}};
    if (e.chosen_interval) data["chosen_interval"] = *e.chosen_interval;
  }
  void operator()(const ForceMissing& e) const {
    place(e.trial, e.attempt);
    data = {{"presentation", e.presentation}, {"cause", e.cause}};
  }
  void operator()(const AttemptDiscarded& e) const {
    place(e.trial, e.attempt);
    data = {{"reason", e.reason}};
    if (e.again_after != 0) data["again_after"] = e.again_after;
    if (e.missed_deadline) data["missed_deadline"] = true;
    if (e.passes_turn) data["passes_turn"] = true;
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
  void operator()(const PauseExplained& e) const {
    data = {{"pause_sequence", e.pause_sequence}, {"reason", e.reason}};
  }
  void operator()(const Continued&) const {}
  void operator()(const FaultRaised& e) const { data = {{"fault", e.fault}}; }
  void operator()(const SessionResumed& e) const {
    row.first_tick = e.lost_first_tick;
    row.last_tick = e.lost_last_tick;
    data = {{"choice", e.choice}};
  }
  void operator()(const LoopStarted& e) const {
    row.first_tick = e.first_tick;
    data = {{"scheduler", e.scheduler}, {"memory_locked", e.memory_locked}, {"cpus", e.cpus}};
    if (e.device) data["device"] = device_json(*e.device);
  }
  void operator()(const LoopMeasured& e) const {
    data = {{"num_ticks", e.num_ticks},
            {"missed_ticks", e.missed_ticks},
            {"num_dropped_samples", e.num_dropped_samples},
            {"max_lateness_ns", e.max_lateness_ns},
            {"max_tick_cost_ns", e.max_tick_cost_ns},
            {"lateness_ns", buckets_to_json(e.lateness)},
            {"tick_cost_ns", buckets_to_json(e.tick_cost)}};
    if (!e.device_clock) return;
    data["device_clock"] = {{"drift_ppm", e.device_clock->drift_ppm},
                            {"residual_s", e.device_clock->residual_s},
                            {"observed_s", e.device_clock->observed_s}};
  }
  void operator()(const Unblinded& e) const { data = {{"reason", e.reason}}; }
  void operator()(const ArmingChanged& e) const {
    data = {{"state", e.state}, {"cause", e.cause}};
  }
  void operator()(const ExposureTold& e) const { data = exposure_json(e.exposure); }
  void operator()(const FittingKept& e) const {
    data = {{"fitting", e.fitting}, {"held", e.held}, {"neutral_pose_m", e.neutral_pose_m}};
  }
  void operator()(const GuardNoticed& e) const {
    data = {
        {"guard", e.guard}, {"num_warnings", e.num_warnings}, {"num_shadowed", e.num_shadowed}};
  }
  void operator()(const StreamOpened& e) const {
    data = {{"direction", e.direction},
            {"name", e.name},
            {"type", e.type},
            {"channel_format", e.channel_format},
            {"channel_count", e.channel_count},
            {"nominal_rate_hz", e.nominal_rate_hz},
            {"source_id", e.source_id},
            {"hostname", e.hostname},
            {"file", e.file},
            {"by", e.by},
            {"monotonic_s", e.monotonic_s}};
  }
  void operator()(const StreamClosed& e) const {
    data = {{"direction", e.direction},
            {"name", e.name},
            {"file", e.file},
            {"num_samples", e.num_samples},
            {"num_offsets", e.num_offsets},
            {"num_dropped", e.num_dropped},
            {"sha256", e.sha256}};
  }
  void operator()(const StreamFailed& e) const {
    data = {{"direction", e.direction}, {"name", e.name}, {"problem", e.problem}};
  }
  void operator()(const SoundStarted& e) const {
    data = {{"output", e.output},
            {"scheduler", e.scheduler},
            {"rate_hz", e.rate_hz},
            {"cue_delay_s", e.cue_delay_s},
            {"full_scale_db_spl", json_of(e.full_scale_db_spl)},
            {"calibrated_on", e.calibrated_on},
            {"noise_level_dbfs", json_of(e.noise_level_dbfs)}};
  }
  void operator()(const CuesPlayed& e) const {
    data = {{"cues", json::array()}};
    for (const PlayedCue& cue : e.cues) {
      data["cues"].push_back({{"moment", cue.moment},
                              {"trial", cue.trial},
                              {"attempt", cue.attempt},
                              {"presentation", cue.presentation},
                              {"asked_monotonic_s", cue.asked_monotonic_s},
                              {"heard_monotonic_s", cue.heard_monotonic_s}});
    }
  }
  void operator()(const SoundMeasured& e) const {
    data = {{"num_frames", e.num_frames},
            {"num_underruns", e.num_underruns},
            {"num_limited", e.num_limited},
            {"num_lost_cues", e.num_lost_cues},
            {"max_latency_s", e.max_latency_s}};
  }
  void operator()(const SoundMissing& e) const { data = {{"problem", e.problem}}; }
  void operator()(const MarkersOpened& e) const {
    data = {{"port", e.port}, {"way", e.way}, {"width_s", e.width_s}, {"codes", e.codes}};
  }
  void operator()(const MarkersSent& e) const {
    data["pulses"] = json::array();
    for (const core::MarkerPulse& pulse : e.pulses) {
      data["pulses"].push_back(
          {pulse.event, pulse.code, pulse.monotonic_s, pulse.uncertainty_s});
    }
  }
  void operator()(const MarkersClosed& e) const {
    data = {{"port", e.port}, {"num_sent", e.num_sent}, {"num_dropped", e.num_dropped}};
  }
  void operator()(const MarkersFailed& e) const {
    data = {{"port", e.port}, {"problem", e.problem}};
  }
  void operator()(const SessionCompleted&) const {}
  void operator()(const SessionEndedEarly& e) const { data = {{"reason", e.reason}}; }

 private:
  void place(std::int64_t trial, std::int64_t attempt) const {
    row.trial = trial;
    row.attempt = attempt;
  }
};

/// The inverse of `Writer`, with one overload for each event.
struct Reader {
  const core::EventRow& row;
  const json& data;

  void operator()(SessionStarted& e) const {
    if (data.contains("language")) e.language = data.at("language").get<std::string>();
    if (data.contains("fields")) data.at("fields").get_to(e.fields);
  }
  void operator()(StageEntered& e) const {
    e.stage = column(row.stage, "stage");
    if (data.contains("num_together")) {
      e.num_together = whole_number(data.at("num_together"), "num_together");
    }
  }
  void operator()(TurnTaken& e) const { e.stage = column(row.stage, "stage"); }
  void operator()(ItemAnswered& e) const {
    e.stage = column(row.stage, "stage");
    data.at("stage_name").get_to(e.stage_name);
    data.at("item").get_to(e.item);
    data.at("answer").get_to(e.answer);
  }
  void operator()(MediumExplored& e) const {
    e.stage = column(row.stage, "stage");
    e.intensity = column(row.intensity, "intensity");
    e.first_tick = column(row.first_tick, "first_tick");
    e.last_tick = column(row.last_tick, "last_tick");
    data.at("medium").get_to(e.medium);
  }
  void operator()(StageFinished& e) const { e.stage = column(row.stage, "stage"); }
  void operator()(TrialsDrawn& e) const {
    e.stage = column(row.stage, "stage");
    e.first_trial = column(row.trial, "trial");
    for (const json& trial : list_at(data, "trials")) {
      read_columns(trial, e.trials.emplace_back());
    }
  }
  void operator()(TrialStarted& e) const {
    place(e);
    e.first_tick = column(row.first_tick, "first_tick");
  }
  void operator()(PresentationStarted& e) const {
    place(e);
    e.intensity = column(row.intensity, "intensity");
    e.first_tick = column(row.first_tick, "first_tick");
    e.presentation = whole_number(data.at("presentation"), "presentation");
    data.at("interval").get_to(e.interval);
    if (data.contains("place")) e.place = whole_number(data.at("place"), "place");
  }
  void operator()(PresentationEnded& e) const {
    place(e);
    e.last_tick = column(row.last_tick, "last_tick");
    e.presentation = whole_number(data.at("presentation"), "presentation");
    read_columns(data, e.summary.measures);
    if (data.contains("force_time_n_s")) e.summary.exposure = exposure_from_json(data);
  }
  void operator()(IntensityAdjusted& e) const {
    place(e);
    e.to_intensity = column(row.intensity, "intensity");
    data.at("from_intensity").get_to(e.from_intensity);
  }
  void operator()(TrialAnswered& e) const {
    place(e);
    e.last_tick = column(row.last_tick, "last_tick");
    read_json(data.at("response"), "response", e.response);
    read_columns(data, e.measures);
    if (const auto told = data.find("feedback_right"); told != data.end()) {
      e.feedback_right = told->get<bool>();
    }
  }
  void operator()(QuestionAnswered& e) const {
    place(e);
    data.at("question").get_to(e.question);
    data.at("answer").get_to(e.answer);
  }
  void operator()(AnswerUndone& e) const {
    place(e);
    e.answer_sequence = column(row.supersedes, "supersedes");
    data.at("reason").get_to(e.reason);
  }
  void operator()(AnswerCorrected& e) const {
    place(e);
    e.answer_sequence = column(row.supersedes, "supersedes");
    read_json(data.at("response"), "response", e.response);
    data.at("reason").get_to(e.reason);
    if (data.contains("chosen_interval")) {
      e.chosen_interval = whole_number(data.at("chosen_interval"), "chosen_interval");
    }
  }
  void operator()(ForceMissing& e) const {
    place(e);
    e.presentation = whole_number(data.at("presentation"), "presentation");
    data.at("cause").get_to(e.cause);
  }
  void operator()(AttemptDiscarded& e) const {
    place(e);
    data.at("reason").get_to(e.reason);
    e.again_after = data.value("again_after", std::int64_t{0});
    e.missed_deadline = data.value("missed_deadline", false);
    e.passes_turn = data.value("passes_turn", false);
  }
  void operator()(TrialExcluded& e) const {
    e.trial = column(row.trial, "trial");
    data.at("reason").get_to(e.reason);
  }
  void operator()(TrialIncluded& e) const {
    e.trial = column(row.trial, "trial");
    data.at("reason").get_to(e.reason);
  }
  void operator()(NoteAdded& e) const { data.at("text").get_to(e.text); }
  void operator()(Paused& e) const { data.at("reason").get_to(e.reason); }
  void operator()(PauseExplained& e) const {
    e.pause_sequence = whole_number(data.at("pause_sequence"), "pause_sequence");
    data.at("reason").get_to(e.reason);
  }
  void operator()(Continued&) const {}
  void operator()(FaultRaised& e) const { data.at("fault").get_to(e.fault); }
  void operator()(SessionResumed& e) const {
    e.lost_first_tick = column(row.first_tick, "first_tick");
    e.lost_last_tick = column(row.last_tick, "last_tick");
    data.at("choice").get_to(e.choice);
  }
  void operator()(FittingKept& e) const {
    data.at("fitting").get_to(e.fitting);
    data.at("held").get_to(e.held);
    data.at("neutral_pose_m").get_to(e.neutral_pose_m);
  }
  void operator()(LoopStarted& e) const {
    e.first_tick = column(row.first_tick, "first_tick");
    data.at("scheduler").get_to(e.scheduler);
    data.at("memory_locked").get_to(e.memory_locked);
    for (const json& cpu : list_at(data, "cpus")) {
      e.cpus.push_back(whole_number<int>(cpu, "cpus"));
    }
    if (data.contains("device")) e.device = device_from_json(data.at("device"));
  }
  void operator()(LoopMeasured& e) const {
    e.num_ticks = whole_number(data.at("num_ticks"), "num_ticks");
    e.missed_ticks = whole_number(data.at("missed_ticks"), "missed_ticks");
    e.num_dropped_samples = whole_number(data.at("num_dropped_samples"), "num_dropped_samples");
    e.max_lateness_ns = whole_number(data.at("max_lateness_ns"), "max_lateness_ns");
    e.max_tick_cost_ns = whole_number(data.at("max_tick_cost_ns"), "max_tick_cost_ns");
    e.lateness = buckets_from_json(list_at(data, "lateness_ns"));
    e.tick_cost = buckets_from_json(list_at(data, "tick_cost_ns"));
    if (!data.contains("device_clock")) return;
    const json& clock = data.at("device_clock");
    e.device_clock = core::ClockDrift{.drift_ppm = clock.at("drift_ppm").get<double>(),
                                      .residual_s = clock.at("residual_s").get<double>(),
                                      .observed_s = clock.at("observed_s").get<double>()};
  }
  void operator()(Unblinded& e) const { data.at("reason").get_to(e.reason); }
  void operator()(ArmingChanged& e) const {
    data.at("state").get_to(e.state);
    data.at("cause").get_to(e.cause);
  }
  void operator()(ExposureTold& e) const { e.exposure = exposure_from_json(data); }
  void operator()(GuardNoticed& e) const {
    data.at("guard").get_to(e.guard);
    data.at("num_warnings").get_to(e.num_warnings);
    data.at("num_shadowed").get_to(e.num_shadowed);
  }
  void operator()(StreamOpened& e) const {
    data.at("direction").get_to(e.direction);
    data.at("name").get_to(e.name);
    data.at("type").get_to(e.type);
    data.at("channel_format").get_to(e.channel_format);
    e.channel_count = whole_number(data.at("channel_count"), "channel_count");
    e.nominal_rate_hz = data.at("nominal_rate_hz").get<double>();
    data.at("source_id").get_to(e.source_id);
    data.at("hostname").get_to(e.hostname);
    data.at("file").get_to(e.file);
    data.at("by").get_to(e.by);
    e.monotonic_s = data.at("monotonic_s").get<double>();
  }
  void operator()(StreamClosed& e) const {
    data.at("direction").get_to(e.direction);
    data.at("name").get_to(e.name);
    data.at("file").get_to(e.file);
    e.num_samples = whole_number(data.at("num_samples"), "num_samples");
    e.num_offsets = whole_number(data.at("num_offsets"), "num_offsets");
    e.num_dropped = whole_number(data.at("num_dropped"), "num_dropped");
    data.at("sha256").get_to(e.sha256);
  }
  void operator()(StreamFailed& e) const {
    data.at("direction").get_to(e.direction);
    data.at("name").get_to(e.name);
    data.at("problem").get_to(e.problem);
  }
  void operator()(SoundStarted& e) const {
    data.at("output").get_to(e.output);
    data.at("scheduler").get_to(e.scheduler);
    e.rate_hz = data.at("rate_hz").get<double>();
    e.cue_delay_s = data.at("cue_delay_s").get<double>();
    read_json(data.at("full_scale_db_spl"), "full_scale_db_spl", e.full_scale_db_spl);
    data.at("calibrated_on").get_to(e.calibrated_on);
    read_json(data.at("noise_level_dbfs"), "noise_level_dbfs", e.noise_level_dbfs);
  }
  void operator()(CuesPlayed& e) const {
    for (const json& cue : list_at(data, "cues")) {
      PlayedCue& read = e.cues.emplace_back();
      cue.at("moment").get_to(read.moment);
      read.trial = whole_number(cue.at("trial"), "trial");
      read.attempt = whole_number(cue.at("attempt"), "attempt");
      read.presentation = whole_number(cue.at("presentation"), "presentation");
      read.asked_monotonic_s = cue.at("asked_monotonic_s").get<double>();
      read.heard_monotonic_s = cue.at("heard_monotonic_s").get<double>();
    }
  }
  void operator()(SoundMeasured& e) const {
    e.num_frames = whole_number(data.at("num_frames"), "num_frames");
    e.num_underruns = whole_number(data.at("num_underruns"), "num_underruns");
    e.num_limited = whole_number(data.at("num_limited"), "num_limited");
    e.num_lost_cues = whole_number(data.at("num_lost_cues"), "num_lost_cues");
    e.max_latency_s = data.at("max_latency_s").get<double>();
  }
  void operator()(SoundMissing& e) const { data.at("problem").get_to(e.problem); }
  void operator()(MarkersOpened& e) const {
    data.at("port").get_to(e.port);
    data.at("way").get_to(e.way);
    e.width_s = data.at("width_s").get<double>();
    for (const auto& [name, code] : data.at("codes").items()) {
      e.codes[name] = whole_number<int>(code, "codes");
    }
  }
  void operator()(MarkersSent& e) const {
    for (const json& pulse : list_at(data, "pulses")) {
      e.pulses.push_back({.event = whole_number(pulse.at(0), "pulses"),
                          .code = whole_number<int>(pulse.at(1), "pulses"),
                          .monotonic_s = pulse.at(2).get<double>(),
                          .uncertainty_s = pulse.at(3).get<double>()});
    }
  }
  void operator()(MarkersClosed& e) const {
    data.at("port").get_to(e.port);
    e.num_sent = whole_number(data.at("num_sent"), "num_sent");
    e.num_dropped = whole_number(data.at("num_dropped"), "num_dropped");
  }
  void operator()(MarkersFailed& e) const {
    data.at("port").get_to(e.port);
    data.at("problem").get_to(e.problem);
  }
  void operator()(SessionCompleted&) const {}
  void operator()(SessionEndedEarly& e) const { data.at("reason").get_to(e.reason); }

 private:
  template <typename E>
  void place(E& e) const {
    e.trial = column(row.trial, "trial");
    e.attempt = column(row.attempt, "attempt");
  }
};

/// Returns an empty event of the kind at this index.
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
                     .version = kVersion,
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
    // Data of an older version would be brought up to date here, once there is one.
    if (row.version > kVersion) {
      throw core::Error(place + "expected version " + std::to_string(kVersion) + " of " +
                        row.kind + " or older, found " + std::to_string(row.version) +
                        "; open it with a newer jnd");
    }
    Event event{.sequence = row.sequence,
                .time_ns = row.time_ns,
                .data = empty_event(index, std::make_index_sequence<kKinds.size()>{})};
    // The library takes a zero byte for the end of the text.
    const bool is_text = row.data.find('\0') == std::string::npos;
    const json data =
        is_text ? json::parse(row.data, nullptr, /*allow_exceptions=*/false) : json();
    if (!data.is_object()) {
      throw core::Error(place + "expected the data of " + row.kind +
                        " as a JSON object, found `" + shown_text(row.data) + '`');
    }
    try {
      std::visit(Reader{row, data}, event.data);
    } catch (const std::exception& error) {
      throw core::Error(place + "expected the data of " + row.kind +
                        ", found: " + shown_text(error.what(), 150));
    }
    return event;
  }
  throw core::Error(place + "expected a known kind of event, found `" + shown_text(row.kind) +
                    "`; open it with a newer jnd");
}

}  // namespace jnd::experiments
