#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/operator/session_view.h"
#include "app/operator/study_folder.h"
#include "core/storage/acknowledgement.h"

namespace jnd::app {

/// A stage or a pause of a session. Times are in seconds at the device: from the beginning of
/// the session, without the time between its visits.
struct RecordSpan {
  std::string title;  ///< The title of a stage, or the reason of a pause.
  double begin_s = 0.0, end_s = 0.0;
};

/// An answer that counts, and what happened to it and its trial before.
struct RecordAnswer {
  std::int64_t trial = 0;  ///< The trial's number in the session, as in trials.csv.
  std::string block;       ///< The block's title, or "Block 1".
  int in_block = 1;
  /// Such as "1.65 Pa s, reference 1.85 Pa s"; "" where it is hidden.
  std::string stimulus;
  std::string answer;  ///< The answer in words.
  AnswerForm form;
  std::optional<double> response_time_s;
  /// When it was given, in the time of `RecordSpan`.
  double at_s = 0.0;
  std::int64_t attempt = 1;  ///< If more than 1, the trial was run again.
  bool excluded = false;
  std::string hint;  ///< Why it is doubtful; "" if it is not.
  /// What was done to it, oldest first, one sentence each: "was “no” before: slipped".
  std::vector<std::string> history;
};

/// Something that somebody wrote down, or that the session tells in words.
struct RecordNote {
  enum class Kind {
    kNote,
    kAdverseEvent,  ///< It is kept forever.
    kPause,         ///< The reason of a pause.
    kEnd,           ///< The reason of an early end.
    /// What happened to an answer that was asked about; the program wrote it.
    kAsked,
  };
  Kind kind = Kind::kNote;
  std::string text;
  /// Such as "today at 14:05"; for a simulated session, the time at the device.
  std::string when;
  core::ReadNote what;   ///< What is acknowledged when somebody has read the note.
  bool is_read = false;  ///< Somebody has acknowledged it.
  /// In the time of `RecordSpan`; < 0 if it was not written while the session went on.
  double at_s = -1.0;
};

/// A fault, or a stop that somebody pressed.
struct RecordFault {
  std::string words;  ///< What happened, in a sentence.
  /// Such as "Group D, trial 23"; outside of a trial, the stage alone.
  std::string where;
  double at_s = 0.0;
  /// The CSV file of the last second before it. "" if none was stored, or if it would tell what
  /// the study hides.
  std::filesystem::path flight_record;
};

/// True if a person wrote the note and nobody has acknowledged it.
[[nodiscard]] bool is_new(const RecordNote& note) noexcept;

/// One stored session, for whoever looks at it afterwards. Plain data. If the study is
/// double-blind and nobody has unblinded it, nothing in here tells a level, an order or a
/// force.
struct SessionRecord {
  SessionLine line;  ///< The session as in the list of sessions.
  bool hides_levels = false;
  bool is_backup = false;  ///< Nothing can be added to the session.
  /// It was completed or ended early, so it cannot be resumed.
  bool is_over = false;
  /// Names and values: device, program, loop, language, and what the study asks about the
  /// participant.
  std::vector<std::pair<std::string, std::string>> facts;

  double rate_hz = 0.0;     ///< The loop's rate.
  double duration_s = 0.0;  ///< The time at the device.
  std::vector<RecordSpan> stages, pauses;
  /// `title` says how long the session was left.
  std::vector<RecordSpan> interruptions;
  /// In the order in which they were given.
  std::vector<RecordAnswer> answers;
  /// The newest comes first, and adverse events come before others.
  std::vector<RecordNote> notes;
  std::vector<RecordFault> faults;
  /// The warnings of the loop's guards, such as "the force oscillates: 3 warnings".
  std::vector<std::string> warnings;

  /// The number of notes and adverse events that nobody has acknowledged.
  [[nodiscard]] int num_unread() const;
};

/// Reads one session of a study folder. Throws `core::Error` if there is no session of that
/// number, if the folder is damaged, or if a newer program wrote it. Not real time.
[[nodiscard]] SessionRecord session_record(const std::filesystem::path& folder,
                                           std::int64_t session,
                                           std::int64_t now_ns = core::SystemClock().now_ns());

/// True if the note contains what is searched for, in capital or small letters. If nothing was
/// typed, every note matches.
[[nodiscard]] bool is_found(const RecordNote& note, const std::string& searched);

/// The last second before a fault.
struct FlightRecord {
  std::vector<double> time_s;         ///< Relative to the fault, so at most 0.
  std::vector<double> force_n;        ///< The size of the sum over all points.
  std::vector<double> speed_m_per_s;  ///< The speed of the fastest point.
};
/// Throws `core::Error` if the file is no flight record. Not real time.
[[nodiscard]] FlightRecord read_flight_record(const std::filesystem::path& file,
                                              double rate_hz);

}  // namespace jnd::app
