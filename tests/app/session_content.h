#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/storage/recording.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// Prints rows with every digit, so that equal texts mean equal rows.
class RowText {
 public:
  RowText() { stream_.precision(17); }
  template <typename T>
  RowText& operator<<(const T& value) {
    stream_ << value << '|';
    return *this;
  }
  template <typename T>
  RowText& operator<<(const std::optional<T>& value) {
    if (value) return *this << *value;
    stream_ << "-|";
    return *this;
  }
  RowText& end() {
    stream_ << '\n';
    return *this;
  }
  [[nodiscard]] std::string text() const { return stream_.str(); }

 private:
  std::ostringstream stream_;
};

/// Returns "" if the texts are equal, and else the first line of both in which they differ.
/// (EXPECT_EQ itself looks for the shortest edit, which takes all memory for a recording.)
inline std::string difference(const std::string& a, const std::string& b) {
  if (a == b) return "";
  std::istringstream lines_a(a);
  std::istringstream lines_b(b);
  std::string line_a;
  std::string line_b;
  do {
    line_a = line_b = "(end)";
    std::getline(lines_a, line_a);
    std::getline(lines_b, line_b);
  } while (line_a == line_b && lines_a && lines_b);
  return line_a + "\n" + line_b;
}

/// Returns all columns of the rows except the number of the session and one other column.
template <typename Row>
std::string rows_text(const std::vector<Row>& rows, std::string_view left_out = "session") {
  RowText text;
  for (const Row& row : rows) {
    core::for_each_column<Row>([&](const auto& column, const auto& value_in) {
      const std::string_view name = column.name;
      if (name != "session" && name != left_out) text << value_in(row);
    });
    text.end();
  }
  return text.text();
}

/// Returns the design of a session without the numbers of its events, because an interruption
/// moves the events that draw and not what they draw.
inline std::string design_text(const core::StudyStore& store, std::int64_t session) {
  return rows_text(store.design(session), "sequence");
}

inline std::string trials_text(const core::StudyStore& store, std::int64_t session) {
  return rows_text(store.trials(session, /*include_excluded=*/true));
}

inline std::string presentations_text(const core::StudyStore& store, std::int64_t session) {
  return rows_text(store.presentations(session));
}

inline std::string events_text(const core::StudyStore& store, std::int64_t session) {
  return rows_text(store.events(session));
}

inline std::string answers_text(const core::StudyStore& store, std::int64_t session) {
  return rows_text(store.answers(session));
}

/// Returns the samples of the recording, or "" if there is none.
inline std::string samples_text(const core::StudyStore& store, std::int64_t session) {
  if (!std::filesystem::exists(store.recording_file(session))) return "";
  RowText text;
  const core::RecordingReader reader(store.recording_file(session));
  reader.read(0, INT64_MAX, [&](const core::Sample& sample) {
    text << sample.tick << sample.tip_position_m[0][0] << sample.tip_velocity_m_per_s[0][1]
         << sample.tip_force_n[4][1];
    text.end();
  });
  return text.text();
}

/// Returns every table of a session except the samples.
inline std::string tables_text(const core::StudyStore& store, std::int64_t session) {
  std::string text;
  for (const core::SessionRow& r : store.sessions()) {
    if (r.session != session) continue;
    text += r.participant + "|" + std::to_string(r.seed) + "|" + r.cells + "\n";
  }
  return text + design_text(store, session) + trials_text(store, session) +
         presentations_text(store, session) + events_text(store, session) +
         answers_text(store, session);
}

/// Returns what was presented in each trial. For production this is the intensity at which the
/// steps began, because the participant decides where they lead. For other procedures it is
/// every intensity that was presented, with its interval.
inline std::string stimuli_text(const core::StudyStore& store, std::int64_t session) {
  RowText text;
  std::int64_t trial = 0;
  std::string seen;
  for (const core::TrialRow& r : store.trials(session, true)) {
    text << r.trial << r.starting_intensity;
    seen.clear();
    for (const core::PresentationRow& p : store.presentations(session)) {
      if (p.trial != r.trial) continue;
      RowText one;
      one << p.interval << p.intensity;
      if (p.presentation > 1 && r.starting_intensity) continue;
      if (seen.find(one.text()) == std::string::npos) seen += one.text();
    }
    text << seen;
    text.end();
    trial = r.trial;
  }
  text << trial;
  return text.text();
}

}  // namespace jnd::app
