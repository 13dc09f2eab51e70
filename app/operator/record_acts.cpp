#include "app/operator/record_acts.h"

#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/session/reopened_session.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/storage/study_store.h"
#include "core/storage/withdrawal.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

std::int64_t time_now() { return core::SystemClock().now_ns(); }

bool has_words(const std::string& text) {
  return text.find_first_not_of(" \t\r\n") != std::string::npos;
}

void require_words(const std::string& text, const char* what) {
  if (!has_words(text)) throw core::Error(tr("expected {}, found no words", what));
}

void require_over(const experiments::Session& session, const core::SessionRow& row) {
  if (session.state().ended) return;
  throw core::Error(
      tr("session {}: expected one that is over, found one that can be resumed; resume it and "
         "do this there",
         row.session));
}

}  // namespace

void correct_answer(const fs::path& folder, std::int64_t session, std::int64_t trial,
                    const std::optional<double>& value, const std::string& reason) {
  require_words(reason, tr("a reason"));
  core::StudyStore store(folder, core::StudyStore::Mode::kReadWrite);
  const core::SessionRow row = store.session(session);
  ReopenedSession reopened(store, row);
  require_over(reopened.session(), row);
  reopened.session().correct(trial, value, reason);
}

int exclude_trials(const fs::path& folder, std::int64_t session,
                   const std::vector<std::int64_t>& trials, const std::string& reason,
                   bool include) {
  require_words(reason, tr("a reason"));
  core::StudyStore store(folder, core::StudyStore::Mode::kReadWrite);
  ReopenedSession reopened(store, store.session(session));
  const auto num_trials = std::ssize(reopened.session().state().trials);
  // Checks all trials before it changes the first one.
  for (const std::int64_t trial : trials) {
    if (trial >= 1 && trial <= num_trials) continue;
    throw core::Error(tr("session {}: expected one of its {} trials, found trial {}", session,
                         num_trials, trial));
  }
  int changed = 0;
  for (const std::int64_t trial : trials) {
    if (reopened.session().state().trial(trial).excluded != include) continue;
    if (include) {
      reopened.session().include(trial, reason);
    } else {
      reopened.session().exclude(trial, reason);
    }
    ++changed;
  }
  return changed;
}

void add_note(const fs::path& folder, std::int64_t session, const std::string& text) {
  require_words(text, tr("a note"));
  core::StudyStore store(folder, core::StudyStore::Mode::kReadWrite);
  const core::SessionRow row = store.session(session);
  ReopenedSession reopened(store, row);
  require_over(reopened.session(), row);
  reopened.session().note(text);
}

void add_adverse_event(const fs::path& folder, std::int64_t session, const std::string& text) {
  require_words(text, tr("what happened"));
  core::StudyStore store(folder, core::StudyStore::Mode::kReadWrite);
  store.add_adverse_event(session, time_now(), text);
}

void acknowledge_note(const fs::path& folder, const core::ReadNote& note) {
  core::acknowledge(folder, note, time_now());
}

ActionOutcome withdraw_participant(const fs::path& folder, const std::string& participant,
                                   WorkControl& control) {
  control.stop_if_cancelled();
  const core::WithdrawalReport report = core::withdraw(folder, participant, time_now());
  control.progress(1.0);
  ActionOutcome outcome{
      .ok = report.remaining.empty(),
      .sentence = tr("{} withdrew; {} deleted here and in {}", participant,
                     trn("{} session", "{} sessions", std::ssize(report.sessions)),
                     trn("{} backup", "{} backups", std::ssize(report.backups)))};
  for (const std::string& remaining : report.remaining) {
    outcome.problems.push_back(
        tr("not reached: {}; attach it and withdraw the person again", remaining));
  }
  for (const core::ExportNote& one : report.exports) {
    outcome.caution = true;
    outcome.problems.push_back(
        tr("not deleted: {}, an export or a report that still holds {}; delete it wherever it "
           "went",
           one.place.string(), participant));
  }
  if (outcome.caution) {
    outcome.sentence += trn("; {} export still holds the person",
                            "; {} exports still hold the person", std::ssize(report.exports));
  }
  return outcome;
}

}  // namespace jnd::app
