#include "analysis/report/data_quality.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "analysis/data/json_fields.h"
#include "analysis/data/stored_studies.h"
#include "analysis/words/said.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "core/storage/sha256.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

std::int64_t count_in(const json& data, const char* key) {
  const auto found = data.find(key);
  return found != data.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

std::string trial_words(const core::EventRow& event) {
  return event.trial ? said("trial {}", std::to_string(*event.trial)) : said("a trial");
}

/// Adds up the timing of a session. Measurements count from the start of a loop, so the last
/// one of each start is added.
// clang-tidy mistakes the assertions of nlohmann::json for exceptions.
// NOLINTNEXTLINE(bugprone-exception-escape)
class TimingSum {
 public:
  void measured(json data) { last_ = std::move(data); }
  void loop_started() {
    if (last_.is_null()) return;
    if (!sum_) sum_.emplace();
    SessionTiming& sum = *sum_;
    sum.num_ticks += count_in(last_, "num_ticks");
    sum.missed_ticks += count_in(last_, "missed_ticks");
    sum.num_dropped_samples += count_in(last_, "num_dropped_samples");
    sum.max_lateness_s = std::max(
        sum.max_lateness_s, 1e-9 * static_cast<double>(count_in(last_, "max_lateness_ns")));
    if (const auto buckets = last_.find("lateness_ns");
        buckets != last_.end() && buckets->is_array()) {
      for (const json& bucket : *buckets) {
        if (bucket.is_array() && bucket.size() == 2 && bucket[0].is_number_integer() &&
            bucket[1].is_number_integer()) {
          lateness_[bucket[0].get<std::int64_t>()] += bucket[1].get<std::int64_t>();
        }
      }
    }
    last_ = json();
  }
  [[nodiscard]] std::optional<SessionTiming> whole() {
    loop_started();
    std::int64_t count = 0;
    for (const auto& [up_to_ns, ticks] : lateness_) count += ticks;
    std::int64_t seen = 0;
    for (const auto& [up_to_ns, ticks] : lateness_) {
      seen += ticks;
      if (sum_ && seen * 100 >= count * 99) {
        sum_->lateness_p99_s = 1e-9 * static_cast<double>(up_to_ns);
        break;
      }
    }
    return sum_;
  }

 private:
  json last_;
  std::optional<SessionTiming> sum_;
  std::map<std::int64_t, std::int64_t> lateness_;
};

void count_events(const core::StudyStore& store, SessionQuality& quality) {
  TimingSum timing;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  bool any = false;
  std::int64_t num_without_force = 0;
  std::string missing_force_cause;
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> guards;  // Warned, shadowed.
  for (const core::EventRow& event : store.events(quality.session.session)) {
    // Later acts on a session do not make it longer.
    const bool is_afterwards = event.kind == "trial_excluded" ||
                               event.kind == "trial_included" || event.kind == "unblinded";
    if (!is_afterwards) {
      if (!any) first_ns = event.time_ns;
      last_ns = event.time_ns;
      any = true;
    }
    const auto remark = [&](const std::string& words) { quality.remarks.push_back(words); };
    if (event.kind == "answer_undone") ++quality.num_undone;
    if (event.kind == "answer_corrected") ++quality.num_corrected;
    if (event.kind == "session_resumed") ++quality.num_resumed;
    if (event.kind == "paused") ++quality.num_paused;
    if (event.kind == "loop_started") timing.loop_started();
    if (event.kind == "loop_measured") timing.measured(object_in(event.data));
    if (event.kind == "attempt_discarded") {
      ++quality.num_discarded;
      remark(said("{} run again: {}", trial_words(event),
                  string_at(object_in(event.data), "reason")));
    }
    if (event.kind == "trial_excluded" || event.kind == "trial_included") {
      remark(
          trial_words(event) +
          (event.kind == "trial_excluded" ? said(" set aside: ") : said(" taken back in: ")) +
          string_at(object_in(event.data), "reason"));
    }
    if (event.kind == "fault_raised") {
      ++quality.num_faults;
      remark(said("fault: {}", string_at(object_in(event.data), "fault")));
    }
    if (event.kind == "force_missing") {
      ++num_without_force;
      missing_force_cause = string_at(object_in(event.data), "cause");
    }
    if (event.kind == "guard_noticed") {
      const json noticed = object_in(event.data);
      auto& [num_warnings, num_shadowed] = guards[string_at(noticed, "guard")];
      num_warnings += noticed.value("num_warnings", std::int64_t{0});
      num_shadowed += noticed.value("num_shadowed", std::int64_t{0});
    }
    if (event.kind == "note_added")
      remark(said("note: {}", string_at(object_in(event.data), "text")));
    if (event.kind == "pause_explained") {
      remark(said("paused: {}", string_at(object_in(event.data), "reason")));
    }
    if (event.kind == "session_ended_early") {
      quality.ended_early = string_at(object_in(event.data), "reason");
      if (quality.ended_early.empty()) quality.ended_early = said("no reason given");
      remark(said("ended early: {}", quality.ended_early));
    }
  }
  if (num_without_force > 0) {
    quality.remarks.push_back(
        said("CAUTION, no force acted in {} presentations of stimuli that ask for one: {}",
             std::to_string(num_without_force), missing_force_cause));
  }
  for (const auto& [guard, counts] : guards) {
    std::string words = said("guard {}: warned {} times", guard, std::to_string(counts.first));
    if (counts.second > 0) {
      words += said(", only counted {} faults (shadow mode)", std::to_string(counts.second));
    }
    quality.remarks.push_back(words);
  }
  quality.duration_s = 1e-9 * static_cast<double>(last_ns - first_ns);
  quality.timing = timing.whole();
}

std::string minutes_of(double duration_s) {
  return std::to_string(std::llround(duration_s / 60.0)) + " min";
}

/// Adds a remark if the session was longer than its study permits.
void check_limit(const core::StudyStore& store, SessionQuality& quality) {
  StoredStudies studies(store);
  const std::optional<double> most_s =
      studies.study(quality.session.protocol_sha256).session_limits.max_duration_s;
  if (!most_s || quality.duration_s <= *most_s) return;
  quality.remarks.push_back(said("took {}, of at most {} that the study allows",
                                 minutes_of(quality.duration_s), minutes_of(*most_s)));
}

void check_recording(const core::StudyStore& store, SessionQuality& quality) {
  if (!quality.session.recorded) return;
  const std::filesystem::path file = store.recording_file(quality.session.session);
  if (!std::filesystem::exists(file)) {
    quality.remarks.emplace_back(said("its recording is missing"));
    return;
  }
  try {
    quality.missing_ticks = core::RecordingReader(file).missing_ticks();
  } catch (const core::Error&) {
    quality.remarks.emplace_back(said("its recording cannot be read; jnd verify tells more"));
  }
}

}  // namespace

std::vector<SessionQuality> session_quality(const core::StudyStore& store,
                                            const std::vector<core::SessionRow>& sessions) {
  std::vector<SessionQuality> all;
  for (const core::SessionRow& session : sessions) {
    SessionQuality quality{.session = session, .completed = store.completed(session.session)};
    const auto answered = std::ssize(store.trials(session.session));
    quality.num_drawn = std::ssize(store.design(session.session));
    quality.num_answered = answered;
    quality.num_excluded = std::ssize(store.trials(session.session, true)) - answered;
    for (const core::PresentationRow& row : store.presentations(session.session)) {
      ++quality.num_presentations;
      quality.num_limited += row.measures.limited_ticks > 0 ? 1 : 0;
      const bool is_stimulus = row.interval != "free_space";
      quality.num_strokeless += is_stimulus && row.measures.num_strokes < 1 ? 1 : 0;
    }
    count_events(store, quality);
    check_limit(store, quality);
    check_recording(store, quality);
    for (const core::AdverseEventRow& row : store.adverse_events()) {
      if (row.session != session.session) continue;
      quality.remarks.push_back(said("adverse event: {}", row.text));
    }
    all.push_back(std::move(quality));
  }
  return all;
}

std::string data_sha256(const core::StudyStore& store,
                        const std::vector<core::SessionRow>& sessions) {
  std::string hashes;
  for (const core::SessionRow& session : sessions) {
    // Storing the lengths distinguishes "a", "bc" from "ab", "c".
    std::string text;
    const auto put = [&text](const std::string& part) {
      text += std::to_string(part.size()) + ":" + part;
    };
    for (const std::string& part :
         {session.participant, session.protocol_sha256, std::to_string(session.seed),
          session.cells, session.device, session.laboratory, session.program_version}) {
      put(part);
    }
    for (const core::EventRow& event : store.events(session.session)) {
      put(event.kind);
      put(std::to_string(event.time_ns));
      for (const auto& number : {event.stage, event.trial, event.attempt, event.first_tick,
                                 event.last_tick, event.supersedes}) {
        put(number ? std::to_string(*number) : "");
      }
      put(event.intensity ? json(*event.intensity).dump() : "");
      put(event.data);
    }
    hashes += core::sha256(text) + "\n";
  }
  return core::sha256(hashes);
}

}  // namespace jnd::analysis
