#include "core/streams/session_markers.h"

#include <algorithm>
#include <string_view>

namespace jnd::core {
namespace {

constexpr std::string_view kToldKinds[] = {
    "session_started",    "session_resumed",   "session_completed", "session_ended_early",
    "stage_entered",      "stage_finished",    "trial_started",     "presentation_started",
    "presentation_ended", "trial_answered",    "question_answered", "answer_undone",
    "answer_corrected",   "attempt_discarded", "medium_explored",   "paused",
    "continued",          "fault_raised"};

}  // namespace

std::optional<std::string> SessionMarkers::marker_of(const EventRow& event) {
  if (std::ranges::find(kToldKinds, event.kind) == std::end(kToldKinds)) return std::nullopt;
  std::string text = R"({"what":")" + event.kind + '"';
  const auto add = [&text](const char* key, std::int64_t number) {
    text += std::string(",\"") + key + "\":" + std::to_string(number);
  };
  add("session", event.session);
  add("event", event.sequence);
  if (event.stage) add("stage", *event.stage);
  if (event.trial) add("trial", *event.trial);
  if (event.attempt) add("attempt", *event.attempt);
  if (event.kind == "presentation_started" || event.kind == "presentation_ended") {
    if (event.trial.value_or(0) != trial_ || event.attempt.value_or(0) != attempt_) {
      trial_ = event.trial.value_or(0);
      attempt_ = event.attempt.value_or(0);
      presentation_ = 0;
    }
    if (event.kind == "presentation_started") ++presentation_;
    add("presentation", presentation_);
  }
  return text + "}";
}

StreamInfo marker_stream_info(const SessionStreamFacts& facts) {
  return {.name = "jnd-markers",
          .type = "Markers",
          .channel_count = 1,
          .nominal_rate_hz = 0.0,
          .format = ChannelFormat::kString,
          .source_id = "jnd-markers-" + facts.study_id + "-" + std::to_string(facts.session),
          .channels = {{"marker", "", "Marker"}},
          .facts = {{"manufacturer", "jnd"},
                    {"program_version", facts.program_version},
                    {"study", facts.study},
                    {"session", std::to_string(facts.session)},
                    {"content", "one line of JSON for each event"}}};
}

}  // namespace jnd::core
