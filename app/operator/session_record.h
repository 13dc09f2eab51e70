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

/// What lasted for some time in a session: a stage, or a pause. Times are seconds at the
/// device: from the begin of the session, without what lay between its visits.
struct RecordSpan {
  std::string title;  ///< Of a stage, or why it was paused.
  double begin_s = 0.0, end_s = 0.0;
};

/// An answer that stands, with what became of it and of its trial before.
struct RecordAnswer {
  std::int64_t trial = 0;  ///< In the session, as in trials.csv.
  std::string block;       ///< Title, or "Block 1".
  int in_block = 1;
  std::string stimulus;  ///< "1.65 Pa s, reference 1.85 Pa s"; "" where it is hidden.
  std::string answer;    ///< In words.
  AnswerForm form;
  std::optional<double> response_time_s;
  double at_s = 0.0;         ///< When it was given, as `RecordSpan`.
  std::int64_t attempt = 1;  ///< More than 1: the trial was run again.
  bool excluded = false;
  std::string hint;  ///< What speaks against it; "" for nothing.
  /// What was done to it, a sentence each, the oldest first: "was “no” before: slipped".
  std::vector<std::string> history;
};

/// Something that somebody wrote down, or that the session has to say in words.
struct RecordNote {
  enum class Kind {
    kNote,
    kAdverseEvent,  ///< Kept for good.
    kPause,         ///< Why there was one.
    kEnd,           ///< Why it was ended early.
    kAsked,         ///< What became of an answer that was asked about; nobody wrote it.
  };
  Kind kind = Kind::kNote;
  std::string text;
  std::string when;      ///< "today at 14:05", or the time at the device of a simulated one.
  core::ReadNote what;   ///< As it is acknowledged.
  bool is_read = false;  ///< Somebody has acknowledged it.
  double at_s = -1.0;    ///< As `RecordSpan`; < 0: not while the session went on.
};

/// A fault, or a stop that somebody pressed.
struct RecordFault {
  std::string words;  ///< What happened, a sentence.
  std::string where;  ///< "Group D, trial 23"; the stage alone outside of a trial.
  double at_s = 0.0;
  /// The last second before it, as CSV; "" where nothing was kept, or where it would tell what
  /// the study hides.
  std::filesystem::path flight_record;
};

/// Somebody wrote it for somebody to read, and nobody has acknowledged it.
[[nodiscard]] bool is_new(const RecordNote& note) noexcept;

/// One session as it was stored, for whoever looks at it afterwards. Plain data. Of a
/// double-blind study that nobody has unblinded nothing in it tells a level, an order or a
/// force.
struct SessionRecord {
  SessionLine line;  ///< As in the list of sessions.
  bool hides_levels = false;
  bool is_backup = false;  ///< Nothing can be added to it.
  bool is_over = false;    ///< Completed or ended early: nothing is left to resume.
  /// Name and value: device, program, loop, language, what was known of the participant.
  std::vector<std::pair<std::string, std::string>> facts;

  double rate_hz = 0.0;     ///< Of the loop.
  double duration_s = 0.0;  ///< At the device.
  std::vector<RecordSpan> stages, pauses;
  std::vector<RecordSpan> interruptions;  ///< `title` says for how long it was left.
  std::vector<RecordAnswer> answers;      ///< In the order in which they were given.
  std::vector<RecordNote> notes;          ///< The newest first, adverse events before others.
  std::vector<RecordFault> faults;
  /// What guards of the loop have warned of: "the force oscillates: 3 warnings".
  std::vector<std::string> warnings;

  /// Notes and adverse events that nobody has acknowledged.
  [[nodiscard]] int num_unread() const;
};

/// Reads one session of a study folder. Throws `core::Error`: none of that number, damaged, of
/// a newer program. Not real time.
[[nodiscard]] SessionRecord session_record(const std::filesystem::path& folder,
                                           std::int64_t session,
                                           std::int64_t now_ns = core::SystemClock().now_ns());

/// Whether some part of a note is what is searched for, small or capital. Everything matches
/// nothing typed.
[[nodiscard]] bool is_found(const RecordNote& note, const std::string& searched);

/// The last second before a fault.
struct FlightRecord {
  std::vector<double> time_s;         ///< Before the fault, so up to 0.
  std::vector<double> force_n;        ///< Of all points together, its size.
  std::vector<double> speed_m_per_s;  ///< Of the point that moved fastest.
};
/// Throws `core::Error` for a file that is none. Not real time.
[[nodiscard]] FlightRecord read_flight_record(const std::filesystem::path& file,
                                              double rate_hz);

}  // namespace jnd::app
