#include "app/operator/study_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>

#include "analysis/results/block_words.h"
#include "app/language/words.h"
#include "app/operator/session_count.h"
#include "app/operator/study_words.h"
#include "app/preregistration/preregistration.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/backup_mark.h"
#include "core/storage/recording.h"
#include "experiments/order/counterbalance.h"
#include "experiments/procedures/practice.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_state.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using SessionStatus = SessionLine::Status;

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::tm local(std::int64_t time_ns) {
  const std::time_t seconds = time_ns / kNsPerS;
  std::tm parts{};
  ::localtime_r(&seconds, &parts);
  return parts;
}

/// The number of a day, so that days can be counted from one to another.
std::int64_t day_number(std::tm parts) {
  constexpr std::int64_t kSecondsPerDay = 86'400;
  return ::timegm(&parts) / kSecondsPerDay;
}

experiments::Study study_of(const core::StudyStore& store, const core::ProtocolRow& protocol) {
  return experiments::read_stored_study(protocol.text,
                                        store.folder().string() + as_is(": stored protocol"));
}

/// What the log of an open session says.
class Interruption {
 public:
  Interruption(const core::StudyStore& store, const experiments::Study& study,
               bool hides_levels)
      : store_(store), study_(study), hides_levels_(hides_levels) {}

  /// Sets how many trials a session will have, whether they are drawn yet or not. If its log
  /// cannot be read, or its orders belong to another study, the number of those drawn so far
  /// stays.
  void try_to_count(const core::SessionRow& row, SessionLine& line) const try {
    const SessionCount count =
        count_of_session(state_of(row), stages_of_session(study_, row.cells));
    line.num_trials = count.num_trials;
    line.num_is_expected = count.is_expected;
  } catch (const core::Error&) {
    return;
  }

  void describe(const core::SessionRow& row, InterruptedSession& session) const {
    const experiments::SessionState state = state_of(row);
    const std::vector<std::string> titles = shown_titles(
        stages_of_session(study_, row.cells), shown_language(study_.languages), hides_levels_);
    const auto stage = static_cast<std::size_t>(state.stage);
    session.stage = stage < titles.size() ? titles[stage] : "";
    if (state.current_trial() || state.turn_is_due) {
      session.trial = 1;
      const auto stages = stages_of_session(study_, row.cells);
      for (std::int64_t one = state.first_together;
           one < state.first_together + state.num_together; ++one) {
        add_trials(state, one, *stages.at(static_cast<std::size_t>(one)), session);
      }
    }
    const fs::path file = store_.recording_file(row.session);
    std::error_code ignored;
    if (row.recorded && row.rate_hz > 0.0 && fs::exists(file, ignored)) {
      const auto samples = static_cast<double>(core::RecordingReader(file).last_tick() + 1);
      session.recorded_min = samples / row.rate_hz / 60.0;
    }
  }

 private:
  [[nodiscard]] experiments::SessionState state_of(const core::SessionRow& row) const {
    experiments::SessionState state;
    for (const core::EventRow& event : store_.events(row.session)) {
      experiments::apply(state, experiments::event_from_row(event));
    }
    return state;
  }
  /// Adds the trials of a block under way. If the answers decide, more trials may come than are
  /// drawn so far.
  static void add_trials(const experiments::SessionState& state, std::int64_t index,
                         const experiments::Stage& stage, InterruptedSession& session) {
    auto num_trials = decltype(session.num_trials)(0);
    for (const experiments::TrialState& trial : state.trials) {
      if (trial.stage != index || trial.is_void) continue;
      ++num_trials;
      if (trial.is_answered) ++session.trial;
    }
    const auto* block = std::get_if<experiments::Block>(&stage.content);
    if (block != nullptr && (analysis::length_is_expected(*block) || block->practice)) {
      session.num_is_expected = true;
      num_trials = std::max(num_trials, experiments::expected_trials(*block));
    }
    session.num_trials += num_trials;
  }

  const core::StudyStore& store_;
  const experiments::Study& study_;
  bool hides_levels_;
};

std::string cells_in_words(const experiments::Study& study, const std::string& cells) try {
  return cell_words(study, experiments::cell_from_text(study, cells));
} catch (const core::Error&) {
  return "";
}

SessionLine line_of(const core::SessionRow& row, const core::SessionOverview& overview,
                    std::int64_t now_ns) {
  return {.session = row.session,
          .participant = row.participant,
          .status = overview.completed     ? SessionStatus::kCompleted
                    : overview.ended_early ? SessionStatus::kEndedEarly
                                           : SessionStatus::kOpen,
          .pilot = row.pilot,
          .simulated = row.simulated,
          .device = row.device,
          .num_answers = overview.num_answers,
          .num_trials = overview.num_trials,
          .when = day_in_words(overview.last_time_ns.value_or(row.started_time_ns), now_ns)};
}

void count(const SessionLine& line, const core::SessionOverview& overview,
           std::set<std::string>& done, StudyFolder& study) {
  ++study.num_sessions;
  study.num_open += line.status == SessionStatus::kOpen ? 1 : 0;
  study.num_pilots += line.pilot ? 1 : 0;
  study.simulated |= line.simulated;
  if (!line.pilot && overview.counts()) done.insert(line.participant);
}

fs::path data_folder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && fs::path(data).is_absolute()) return fs::path(data) / "jnd";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return fs::path(home) / "jnd";
  std::error_code ignored;
  return fs::current_path(ignored) / "jnd";
}

}  // namespace

std::string InterruptedSession::sentence() const {
  if (stage.empty()) return tr("{} was interrupted", participant);
  if (num_trials == 0) return tr("{} was interrupted in {}", participant, stage);
  return num_is_expected ? tr("{} was interrupted in {}, trial {} of about {}", participant,
                              stage, trial, num_trials)
                         : tr("{} was interrupted in {}, trial {} of {}", participant, stage,
                              trial, num_trials);
}

std::string InterruptedSession::safe() const {
  if (recorded_min < 1.0) {
    return trn("{} answer is safe on disk", "{} answers are safe on disk", num_answers);
  }
  const auto minutes = static_cast<std::int64_t>(recorded_min);
  return tr("{} and {} of recording are safe on disk",
            trn("{} answer", "{} answers", num_answers),
            trn("{} minute", "{} minutes", minutes));
}

std::string StudyFolder::summary() const {
  const std::string begin = is_backup ? tr("backup, to be read only · ") : "";
  if (num_sessions == 0) return begin + tr("no session yet");
  std::string words =
      begin + trn("{} participant done", "{} participants done", num_participants_done);
  if (num_open > 0) words += tr(", {} open", num_open);
  if (num_pilots > 0) words += ", " + trn("{} pilot", "{} pilots", num_pilots);
  if (simulated) words += tr(" · simulated");
  if (!last_session.empty()) words += tr(" · last session {}", last_session);
  return words;
}

StudyFolder open_study_folder(const fs::path& folder, std::int64_t now_ns) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  const core::ProtocolRow protocol = protocol_in(store);
  const experiments::Study study = study_of(store, protocol);
  StudyFolder opened{.folder = fs::absolute(folder).lexically_normal(),
                     .name = study.name,
                     .title = title_of(study),
                     .blinding = study.blinding,
                     .study_file = study_file_of(store, protocol),
                     .is_backup = core::is_backup(folder),
                     .backups = core::known_backups(folder)};
  opened.is_safe_elsewhere = std::ranges::any_of(opened.backups, [&](const fs::path& backup) {
    std::error_code ignored;
    return fs::exists(backup / "study.sqlite", ignored) && !core::on_one_disk(folder, backup);
  });
  opened.hides_levels = study.blinding == experiments::Blinding::kDouble && !store.unblinded();
  std::map<std::int64_t, core::SessionOverview> overviews;
  for (core::SessionOverview& one : store.overview()) overviews[one.session] = one;
  const Interruption interruption(store, study, opened.hides_levels);
  std::set<std::string> done;
  std::int64_t last_ns = 0;
  for (const core::SessionRow& row : store.sessions()) {
    const core::SessionOverview& overview = overviews[row.session];
    SessionLine line = line_of(row, overview, now_ns);
    if (!opened.hides_levels) line.cells = cells_in_words(study, row.cells);
    // A completed session has drawn all of its trials.
    if (line.status != SessionStatus::kCompleted) interruption.try_to_count(row, line);
    count(line, overview, done, opened);
    last_ns = std::max(last_ns, overview.last_time_ns.value_or(row.started_time_ns));
    // An interrupted session is resumed in the study itself, not in a backup.
    if (line.status == SessionStatus::kOpen && !opened.is_backup) {
      InterruptedSession open{.session = row.session,
                              .participant = row.participant,
                              .num_answers = overview.num_answers,
                              .when = line.when,
                              .pilot = row.pilot,
                              .simulated = row.simulated};
      try {
        interruption.describe(row, open);
      } catch (const core::Error& error) {
        open.problem = error.what();
      }
      opened.interrupted.insert(opened.interrupted.begin(), std::move(open));
    }
    opened.sessions.push_back(std::move(line));
  }
  opened.num_participants_done = static_cast<int>(done.size());
  opened.last_session = day_in_words(last_ns, now_ns);
  // The hour distinguishes two studies of the same day.
  if (!opened.last_session.empty() && day_number(local(last_ns)) == day_number(local(now_ns))) {
    opened.last_session += hour_in_words(last_ns);
  }
  return opened;
}

core::ProtocolRow protocol_in(const core::StudyStore& store) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  if (!sessions.empty()) return store.protocol(sessions.back().protocol_sha256);
  std::vector<core::ProtocolRow> protocols = store.protocols();
  std::erase_if(protocols, [](const core::ProtocolRow& row) {
    return row.file_name == kPreregistrationFile;
  });
  if (protocols.empty()) {
    throw core::Error(
        tr("{}: expected a study in this folder, found none; begin it with a study "
           "file in a new folder",
           store.folder().string()));
  }
  return std::move(protocols.back());
}

experiments::Study study_in(const core::StudyStore& store) {
  return study_of(store, protocol_in(store));
}

fs::path study_file_of(const core::StudyStore& store, const core::ProtocolRow& protocol) {
  if (protocol.relative_path.empty()) return {};
  return (fs::absolute(store.folder()) / protocol.relative_path).lexically_normal();
}

void create_study_folder(const fs::path& study_file, const fs::path& folder) {
  const experiments::Study study = experiments::read_study(study_file);
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error))) {
    throw core::Error(
        tr("{}: expected a place for a new study, found that something is there "
           "already; choose another name",
           folder.string()));
  }
  core::StudyStore store(folder, core::StudyStore::Mode::kCreate);
  store.add_protocol(study_file.filename().string(), study.text,
                     fs::relative(study_file, folder, error).generic_string());
}

fs::path default_study_folder(const std::string& name) {
  const fs::path parent = data_folder();
  fs::path folder = parent / (name + ".study");
  std::error_code ignored;
  for (int number = 2; fs::exists(fs::symlink_status(folder, ignored)); ++number) {
    folder = parent / (name + "-" + std::to_string(number) + ".study");
  }
  return folder;
}

std::string hour_in_words(std::int64_t time_ns) {
  const std::tm then = local(time_ns);
  return tr(" at {}:{:02}", then.tm_hour, then.tm_min);
}

std::string day_in_words(std::int64_t time_ns, std::int64_t now_ns) {
  constexpr std::int64_t kYear2000_s = 946'684'800;
  if (time_ns / kNsPerS < kYear2000_s) return "";
  const std::tm then = local(time_ns);
  const std::tm now = local(now_ns);
  const std::int64_t days = day_number(now) - day_number(then);
  if (days == 0) return tr("today");
  if (days == 1) return tr("yesterday");
  if (days == -1) return tr("tomorrow");
  constexpr std::array kMonths = {
      tr_later("January"),   tr_later("February"), tr_later("March"),    tr_later("April"),
      tr_later("May"),       tr_later("June"),     tr_later("July"),     tr_later("August"),
      tr_later("September"), tr_later("October"),  tr_later("November"), tr_later("December")};
  std::string words =
      tr("{} {}", then.tm_mday, tr(kMonths[static_cast<std::size_t>(then.tm_mon)]));
  if (then.tm_year != now.tm_year) words += fmt::format(" {}", then.tm_year + 1900);
  return words;
}

}  // namespace jnd::app
