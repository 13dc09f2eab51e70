#pragma once

#include <filesystem>
#include <string>

#include "core/storage/recording.h"
#include "core/storage/study_store.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::core {

/// A study folder with completed sessions, to back up, withdraw and verify.
class KeptStudy {
 public:
  [[nodiscard]] std::filesystem::path folder() const { return temporary_.path() / "x.study"; }
  [[nodiscard]] std::filesystem::path beside(const std::string& name) const {
    return temporary_.path() / name;
  }
  [[nodiscard]] std::filesystem::path recording(int session) const {
    return folder() / "recordings" / ("000" + std::to_string(session) + ".sqlite");
  }

  /// Adds a session of one trial of 1000 ticks, with an answer and a note that name the
  /// participant.
  std::int64_t add_session(const std::string& participant) const {
    StudyStore store(folder(), StudyStore::Mode::kCreate, Durability::kAtClose);
    const std::string hash = store.add_protocol("x.json", "{}");
    const std::int64_t session = store.add_session(
        {.participant = participant, .protocol_sha256 = hash, .rate_hz = 1000.0});
    record(store.recording_file(session), 0, 999);
    std::int64_t sequence = 0;
    const auto next = [&](const char* kind) {
      return Commit{.event = {.session = session, .sequence = ++sequence, .kind = kind}};
    };
    store.append(next("session_started"));
    Commit drawn = next("trials_drawn");
    drawn.design.push_back({.session = session, .trial = 1, .block = "b"});
    store.append(drawn);
    Commit explored = next("medium_explored");
    explored.event.first_tick = 0;
    explored.event.last_tick = 999;
    store.append(explored);
    Commit answered = next("trial_answered");
    answered.trial = TrialRow{
        .session = session, .trial = 1, .attempt = 1, .sequence = sequence, .response = 1.0};
    answered.answers.push_back({.session = session,
                                .sequence = sequence,
                                .stage = "s",
                                .item = "i",
                                .answer = "secret of " + participant});
    store.append(answered);
    Commit asked = next("question_answered");
    asked.question_answer = QuestionAnswerRow{.session = session,
                                              .trial = 1,
                                              .attempt = 1,
                                              .sequence = sequence,
                                              .block = "b",
                                              .question = "q",
                                              .answer = "secret of " + participant};
    store.append(asked);
    Commit note = next("note_added");
    note.event.data = R"({"text":"note about )" + participant + "\"}";
    store.append(note);
    store.append(next("session_completed"));
    return session;
  }

  /// Records a new segment, as after a resumption.
  static void record(const std::filesystem::path& file, std::int64_t first_tick,
                     std::int64_t last_tick) {
    RecordingWriter writer(file, 1000.0, Durability::kAtClose);
    for (std::int64_t tick = first_tick; tick <= last_tick; ++tick) {
      Sample sample;
      sample.tick = tick;
      writer.append(sample);
    }
    writer.flush();
  }

 private:
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

/// Returns the bytes of every file in the folder, one after the other.
inline std::string all_bytes(const std::filesystem::path& folder) {
  std::string bytes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += test_support::read_file(entry.path());
  }
  return bytes;
}

}  // namespace jnd::core
