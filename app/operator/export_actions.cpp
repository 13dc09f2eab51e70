#include "app/operator/export_actions.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/language/words.h"
#include "app/results/study_export.h"
#include "app/results/study_report.h"
#include "app/session/reopened_session.h"
#include "app/session/replay_check.h"
#include "app/session/stored_session.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

std::string sessions_words(std::int64_t count) {
  return trn("{} session", "{} sessions", count);
}

std::string answers_words(std::int64_t count) { return trn("{} answer", "{} answers", count); }

std::string sentence_of(const core::Finding& finding) {
  return finding.session == 0 ? finding.message
                              : tr("session {}: {}", finding.session, finding.message);
}

bool is_unblinded(const core::StudyStore& store, std::int64_t session) {
  const std::vector<core::EventRow> events = store.events(session);
  return std::any_of(events.begin(), events.end(),
                     [](const core::EventRow& event) { return event.kind == "unblinded"; });
}

ActionOutcome outcome_of(const core::Integrity& integrity, const std::string& what) {
  ActionOutcome outcome{.ok = integrity.complete};
  for (const core::Finding& problem : integrity.problems) {
    outcome.problems.push_back(sentence_of(problem));
  }
  outcome.sentence =
      outcome.ok
          ? tr("{}: complete, {} with {} and {} read back", what,
               sessions_words(integrity.num_sessions), answers_words(integrity.num_trials),
               trn("{} sample", "{} samples", integrity.num_samples))
          : trn("{1}: {0} problem, the first: {2}", "{1}: {0} problems, the first: {2}",
                std::ssize(outcome.problems), what,
                outcome.problems.empty() ? "" : outcome.problems.front());
  return outcome;
}

}  // namespace

ActionOutcome export_study(const fs::path& folder, const fs::path& target,
                           const ExportChoice& choice, WorkControl& control) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  StudyExportRequest request{.format = choice.format, .out = target};
  request.data.recordings = choice.recordings;
  request.data.on_progress = [&control](double done) { control.progress(done); };
  request.data.keep_going = [&control] { control.stop_if_cancelled(); };
  control.stop_if_cancelled();
  StudyExport written = write_study_export(store, request);
  std::int64_t answers = 0;
  for (const core::SessionOverview& one : store.overview()) answers += one.num_answers;
  control.progress(1.0);
  if (!written.forgotten.empty()) written.problems.push_back(written.forgotten);
  const std::string what = choice.format == "bids"   ? tr("a BIDS data set")
                           : choice.format == "hdf5" ? tr("tables and an HDF5 file")
                           : choice.format == "xdf"  ? tr("an XDF file for each session")
                                                     : tr("tables with a codebook");
  return {.sentence = tr("{} of {} are written to {}: {}", answers_words(answers),
                         sessions_words(std::ssize(store.sessions())), target.string(), what),
          .problems = std::move(written.problems),
          .opens = target};
}

ActionOutcome save_figures(StudyFiguresRequest request, WorkControl& control) {
  request.on_progress = [&control](double done) {
    control.stop_if_cancelled();
    control.progress(done);
  };
  StudyFigures written = write_study_figures(request);
  return {.ok = written.num_drawn > 0,
          .sentence =
              trn("{} figure is in {}, as SVG and PDF", "{} figures are in {}, as SVG and PDF",
                  written.num_drawn, request.out.string()),
          .problems = std::move(written.problems),
          .opens = request.out};
}

ActionOutcome verify_study(const fs::path& folder, WorkControl& control) {
  core::Integrity integrity;
  try {
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    integrity = core::verify(store);
    control.progress(0.9);
    control.stop_if_cancelled();
    check_replay(store, integrity);
  } catch (const core::Error& error) {
    // A study that cannot even be opened is a finding like any other.
    integrity = {.complete = false, .problems = {{0, error.what()}}};
  }
  control.progress(1.0);
  return outcome_of(integrity, folder.filename().string());
}

ActionOutcome back_up_study(const fs::path& folder, const fs::path& target,
                            WorkControl& control) {
  const core::BackupReport report =
      core::back_up(folder, target, core::SystemClock().now_ns(), [&control](double done) {
        control.progress(0.9 * done);
        control.stop_if_cancelled();
      });
  control.progress(1.0);
  ActionOutcome outcome = outcome_of(report.integrity, tr("backup in {}", target.string()));
  for (const std::string& remark : report.remarks) outcome.problems.push_back(remark);
  if (outcome.ok && report.on_one_disk) {
    outcome.caution = true;
    outcome.sentence += tr(
        "; it is on the study's own disk, and a disk that fails takes both: keep another one "
        "elsewhere");
  }
  return outcome;
}

ActionOutcome write_report(const fs::path& folder, const fs::path& target,
                           WorkControl& control) {
  const StudyReport report = write_study_report(
      {.folder = folder, .out = target, .on_progress = [&control](double done) {
         control.stop_if_cancelled();
         control.progress(done);
       }});
  const analysis::ReportOutcome& outcome = report.outcome;
  return {.sentence = outcome.pdf.empty()
                          ? trn("report.html with {} figure is in {}",
                                "report.html with {} figures is in {}",
                                std::ssize(outcome.figures), target.string())
                          : trn("report.html and report.pdf with {} figure are in {}",
                                "report.html and report.pdf with {} figures are in {}",
                                std::ssize(outcome.figures), target.string()),
          .problems = outcome.problems,
          .opens = outcome.html};
}

ActionOutcome unblind_study(const fs::path& folder, const std::string& reason) {
  core::StudyStore store(folder, core::StudyStore::Mode::kReadWrite);
  const std::vector<core::SessionRow> sessions = store.sessions();
  if (sessions.empty()) {
    throw core::Error(tr("{}: expected a session to unblind, found none", folder.string()));
  }
  const bool blind = std::any_of(sessions.begin(), sessions.end(), [&](const auto& row) {
    return stored_study(store, row.session).blinding == experiments::Blinding::kDouble;
  });
  if (!blind) {
    throw core::Error(
        tr("{}: expected a double-blind study, found one whose levels may be seen",
           folder.string()));
  }
  store.add_unblinding(core::SystemClock().now_ns(), reason);
  // Every session stores the moment, because later answers were no longer given blind.
  for (const core::SessionRow& row : sessions) {
    // An earlier run that was interrupted has already done it.
    if (is_unblinded(store, row.session)) continue;
    ReopenedSession(store, row).session().unblind(reason);
  }
  return {.sentence = trn("{1}: unblinded, and so written in the log of its {0} session",
                          "{1}: unblinded, and so written in the log of its {0} sessions",
                          std::ssize(sessions), folder.string())};
}

fs::path free_folder_beside(const fs::path& study_folder, const std::string& ending) {
  const fs::path whole = fs::absolute(study_folder).lexically_normal();
  const fs::path parent = whole.parent_path();
  const std::string name = whole.stem().string() + "-" + ending;
  fs::path folder = parent / name;
  std::error_code ignored;
  for (int number = 2; fs::exists(fs::symlink_status(folder, ignored)); ++number) {
    folder = parent / (name + "-" + std::to_string(number));
  }
  return folder;
}

}  // namespace jnd::app
