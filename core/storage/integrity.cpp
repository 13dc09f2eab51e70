#include "core/storage/integrity.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include "core/storage/backup_mark.h"
#include "core/storage/flight_record.h"
#include "core/storage/recorded_ticks.h"
#include "core/storage/recording.h"
#include "core/storage/sha256.h"
#include "core/storage/stream_file.h"

namespace jnd::core {
namespace {

std::string span(std::int64_t first, std::int64_t last) {
  return std::to_string(first) + " to " + std::to_string(last);
}

/// Returns words for the ticks of a chunk, whose numbers may be damaged, too.
std::string ticks_of(const RecordingChunk& chunk) {
  constexpr std::int64_t kBeyond = std::int64_t{1} << 53;
  const auto plausible = [](std::int64_t number) { return number >= 0 && number < kBeyond; };
  if (!plausible(chunk.first_tick) || !plausible(chunk.num_samples))
    return "that make no sense";
  return span(chunk.first_tick, chunk.first_tick + chunk.num_samples - 1);
}

class SessionCheck {
 public:
  SessionCheck(const StudyStore& store, const SessionRow& session, Integrity& integrity)
      : store_(store), session_(session), integrity_(integrity) {}

  void run() {
    const std::vector<EventRow> events = store_.events(session_.session);
    integrity_.num_events += static_cast<std::int64_t>(events.size());
    check_protocol();
    check_device_profile();
    check_sequence(events);
    count_answers();
    if (session_.recorded) check_recording(events);
    check_streams();
  }

 private:
  void problem(std::string message) {
    integrity_.problems.push_back({session_.session, std::move(message)});
  }
  void remark(std::string message) {
    integrity_.remarks.push_back({session_.session, std::move(message)});
  }

  void check_protocol() {
    const ProtocolRow protocol = store_.protocol(session_.protocol_sha256);
    if (sha256(protocol.text) == protocol.sha256) return;
    problem("expected the study's text to fit its hash, found it damaged");
  }

  void check_device_profile() {
    const std::string& hash = session_.device_profile_sha256;
    if (hash.empty()) return;
    try {
      if (sha256(store_.device_profile(hash).text) == hash) return;
      problem("expected the text of its device profile to fit its hash, found it damaged");
    } catch (const Error&) {
      problem("expected the device profile that it was begun with, found none of that hash");
    }
  }

  void check_sequence(const std::vector<EventRow>& events) {
    std::int64_t expected = 1;
    for (const EventRow& event : events) {
      if (event.sequence != expected) {
        problem("expected event " + std::to_string(expected) + ", found " +
                std::to_string(event.sequence) + "; events are missing");
        expected = event.sequence;
      }
      ++expected;
    }
  }

  void count_answers() {
    const bool ended = store_.finished(session_.session);
    std::set<std::int64_t> answered;
    for (const TrialRow& trial : store_.trials(session_.session, /*include_excluded=*/true)) {
      answered.insert(trial.trial);
    }
    integrity_.num_trials += static_cast<std::int64_t>(answered.size());
    std::int64_t unanswered = 0;
    for (const DesignRow& row : store_.design(session_.session)) {
      if (!answered.contains(row.trial)) ++unanswered;
    }
    if (!ended) {
      remark("the session is open; `jnd resume` goes on with it");
    } else if (unanswered > 0) {
      const std::string found = std::to_string(unanswered) + " drawn trials without an answer";
      if (store_.completed(session_.session)) {
        problem("expected an answer to every trial, found " + found);
      } else {
        remark("ended early, " + found);
      }
    }
  }

  void check_recording(const std::vector<EventRow>& events) {
    const std::filesystem::path file = store_.recording_file(session_.session);
    std::vector<TickRange> recorded, missed;
    try {
      const RecordingReader reader(file);
      missed = reader.missed();
      if (reader.rate_hz() != 0.0 && reader.rate_hz() != session_.rate_hz) {
        problem(file.filename().string() + ": expected a rate of " +
                std::to_string(session_.rate_hz) + " Hz, found " +
                std::to_string(reader.rate_hz()));
      }
      for (const RecordingChunk& chunk : reader.chunks()) {
        if (!chunk.intact) {
          problem(file.filename().string() + ": expected the chunk of ticks " +
                  ticks_of(chunk) +
                  " to fit its hash and its number of samples, found it damaged");
          continue;
        }
        const std::int64_t last = chunk.first_tick + chunk.num_samples - 1;
        recorded.push_back({chunk.first_tick, last});
        integrity_.num_samples += chunk.num_samples;
      }
    } catch (const Error& error) {
      // A session that was just added, or died before its first stimulus, may have no recording
      // yet.
      if (speaks_of_ticks(events)) problem(error.what());
      return;
    }
    recorded.insert(recorded.end(), missed.begin(), missed.end());
    check_interruptions(events);
    check_claims(merged(std::move(recorded)), missed, events);
  }

  void check_streams() {
    for (const std::filesystem::path& file :
         stream_files(store_.recording_file(session_.session))) {
      try {
        const StreamFileReader reader(file);
        for (std::string& found : reader.problems()) problem(std::move(found));
        if (!reader.seal()) {
          remark(file.filename().string() +
                 ": its program ended before the stream did, or still records it");
        }
      } catch (const Error& error) {
        problem(error.what());
      }
    }
  }

  static bool speaks_of_ticks(const std::vector<EventRow>& events) {
    return std::any_of(events.begin(), events.end(), [](const EventRow& event) {
      return event.kind == "medium_explored" || event.kind == "presentation_ended";
    });
  }

  void check_interruptions(const std::vector<EventRow>& events) {
    for (const EventRow& event : events) {
      if (event.kind == "session_resumed" && event.first_tick && event.last_tick &&
          *event.last_tick >= *event.first_tick) {
        remark("ticks " + span(*event.first_tick, *event.last_tick) +
               " belong to the attempt that was interrupted");
      }
    }
  }

  /// `accounted` are the ticks of intact chunks and `missed`, the ticks that never ran.
  void check_claims(const std::vector<TickRange>& accounted,
                    const std::vector<TickRange>& missed, const std::vector<EventRow>& events) {
    std::int64_t num_held_up = 0, most_held_up = 0, all_held_up = 0;
    std::string longest;
    for (const TickClaim& claim : tick_claims(events)) {
      const std::string whose =
          claim.kind + (claim.trial ? " in trial " + std::to_string(*claim.trial) : "");
      const std::string ticks = span(claim.ticks.first_tick, claim.ticks.last_tick);
      const std::int64_t missing = num_ticks(missing_in(accounted, claim.ticks));
      if (missing > 0) {
        problem("expected ticks " + ticks + " of " + whose + ", found " +
                std::to_string(missing) + " of them missing");
      }
      const std::int64_t never_ran =
          num_ticks({claim.ticks}) - num_ticks(missing_in(missed, claim.ticks));
      if (never_ran == 0) continue;
      ++num_held_up;
      all_held_up += never_ran;
      if (never_ran <= most_held_up) continue;
      most_held_up = never_ran;
      longest = std::to_string(never_ran) + " of the ticks " + ticks + " of " + whose;
    }
    if (num_held_up == 0) return;
    const std::string others = ", the most of " + std::to_string(num_held_up) + " times (" +
                               std::to_string(all_held_up) + " ticks in all)";
    remark(longest + " never ran" + (num_held_up > 1 ? others : "") + ": the loop was held up");
  }

  const StudyStore& store_;
  const SessionRow& session_;
  Integrity& integrity_;
};

/// Returns the recordings that belong to neither a session nor a tombstone.
std::vector<std::filesystem::path> recordings_without_session(const StudyStore& store) {
  std::set<std::filesystem::path> known;
  for (const SessionRow& session : store.sessions()) {
    known.insert(store.recording_file(session.session));
  }
  for (const WithdrawalRow& withdrawn : store.withdrawals()) {
    known.insert(store.recording_file(withdrawn.session));
  }
  std::vector<std::filesystem::path> orphans;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator(store.folder() / "recordings", error)) {
    if (entry.path().extension() != ".sqlite" || known.contains(entry.path())) continue;
    if (known.contains(recording_beside(entry.path()))) continue;
    orphans.push_back(entry.path());
  }
  std::sort(orphans.begin(), orphans.end());
  return orphans;
}

}  // namespace

Integrity verify(const StudyStore& store, const Progress& progress) {
  Integrity integrity;
  // Data that cannot be read is what this function looks for, so it is reported and not thrown.
  const auto check = [&](std::int64_t session, const std::function<void()>& part) {
    try {
      part();
    } catch (const Error& error) {
      integrity.problems.push_back({session, error.what()});
    }
  };
  check(0, [&] {
    for (const std::string& damage : store.database_damage()) {
      integrity.problems.push_back({0, "study.sqlite: " + damage});
    }
  });
  check(0, [&] {
    for (const WithdrawalRow& withdrawn : store.withdrawals()) {
      integrity.remarks.push_back({withdrawn.session, withdrawn.participant + " withdrew"});
      const std::filesystem::path recording = store.recording_file(withdrawn.session);
      if (!std::filesystem::exists(recording) && flight_records(recording).empty() &&
          stream_files(recording).empty()) {
        continue;
      }
      integrity.problems.push_back(
          {withdrawn.session, "expected the recording of " + withdrawn.participant +
                                  ", who withdrew, to be gone, found it; run `jnd withdraw` "
                                  "again"});
    }
  });
  check(0, [&] {
    for (const UnfinishedWithdrawal& one : store.unfinished_withdrawals()) {
      integrity.problems.push_back(
          {0, one.erased
                  ? "expected the withdrawal of " + one.participant +
                        " to be finished, found that it has not reached every backup that is "
                        "known; attach "
                        "them, or forget those that are gone, and repeat `jnd withdraw`"
                  : "study.sqlite: expected the withdrawal of " + one.participant +
                        " to be finished, found it interrupted, so that the file may still "
                        "hold what was deleted; repeat `jnd withdraw`"});
    }
  });
  const bool is_backup_begun = is_unfinished_backup(store.folder());
  if (is_backup_begun) {
    integrity.remarks.push_back(
        {0,
         "a backup to this folder was begun and is not finished; what was here before is "
         "whole, repeat `jnd backup`"});
  }
  check(0, [&] {
    // These may be recordings of sessions that this copy does not know yet.
    if (is_backup_begun) return;
    for (const std::filesystem::path& orphan : recordings_without_session(store)) {
      integrity.problems.push_back(
          {0, orphan.string() + ": expected a session of this recording, found none; was "
                                "study.sqlite put back from an older copy?"});
    }
  });
  check(0, [&] {
    const std::vector<SessionRow> sessions = store.sessions();
    for (const SessionRow& session : sessions) {
      tell(progress, integrity.num_sessions, std::ssize(sessions));
      ++integrity.num_sessions;
      check(session.session, [&] { SessionCheck(store, session, integrity).run(); });
    }
  });
  integrity.complete = integrity.problems.empty();
  return integrity;
}

}  // namespace jnd::core
