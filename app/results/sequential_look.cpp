#include "app/results/sequential_look.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "analysis/data/study_data.h"
#include "analysis/results/sequential_results.h"
#include "app/session/stored_session.h"
#include "core/clock.h"
#include "core/error.h"

namespace jnd::app {
namespace {

/// A complete session that counts: the first one of its participant of which anything does.
struct CompleteSession {
  std::int64_t session = 0;
  std::string participant;
};

std::vector<CompleteSession> complete_sessions(const core::StudyStore& store) {
  std::map<std::int64_t, bool> is_complete;
  for (const core::SessionOverview& one : store.overview()) {
    is_complete[one.session] = one.counts();
  }
  std::vector<CompleteSession> complete;
  std::set<std::string> known;
  for (const core::SessionRow& row : store.sessions()) {
    if (row.pilot || !is_complete[row.session] || !known.insert(row.participant).second) {
      continue;
    }
    complete.push_back({row.session, row.participant});
  }
  return complete;
}

/// The looks of a study that were taken, and those that are due.
class Looks {
 public:
  explicit Looks(core::StudyStore& store)
      : store_(store), taken_(store.looks()), complete_(complete_sessions(store)) {
    std::set<std::int64_t> used;
    for (const core::SequentialLookRow& look : taken_) {
      used.insert(look.sessions.begin(), look.sessions.end());
      num_used_ += look.sessions.size();
    }
    for (const CompleteSession& one : complete_) {
      if (!used.contains(one.session)) further_.push_back(one);
    }
  }

  [[nodiscard]] bool has_ended() const {
    return !taken_.empty() && taken_.back().decision == "stop";
  }
  [[nodiscard]] std::size_t num_taken() const { return taken_.size(); }
  /// People who withdrew after a look remain counted if the look included them.
  [[nodiscard]] std::size_t num_complete() const { return num_used_ + further_.size(); }

  /// True if enough people are there for the next look of the rule.
  [[nodiscard]] bool is_due(const analysis::SequentialRule& rule) const {
    return !has_ended() && taken_.size() < rule.looks.size() &&
           num_complete() >= static_cast<std::size_t>(rule.looks[taken_.size()]);
  }

  void take_next(const analysis::StudyData& data,
                 const analysis::SequentialBoundaries& boundaries) {
    const auto planned = static_cast<std::size_t>(boundaries.rule.looks[taken_.size()]);
    const auto num_new = static_cast<std::ptrdiff_t>(planned - num_used_);
    core::SequentialLookRow row{.look = static_cast<std::int64_t>(taken_.size()) + 1,
                                .time_ns = core::SystemClock().now_ns(),
                                .program_version = JND_VERSION};
    std::vector<std::vector<std::string>> people = people_of_taken();
    people.emplace_back();
    for (auto one = further_.begin(); one != further_.begin() + num_new; ++one) {
      row.sessions.push_back(one->session);
      people.back().push_back(one->participant);
    }
    // The earlier looks decided to go on, and this holds even if trials were set aside since.
    const bool ends = analysis::crosses(boundaries, taken_.size(),
                                        analysis::estimates_at_looks(data, people).back());
    const bool is_last = taken_.size() + 1 == boundaries.rule.looks.size();
    row.decision = ends || is_last ? "stop" : "go_on";
    store_.add_look(row);
    further_.erase(further_.begin(), further_.begin() + num_new);
    num_used_ = planned;
    taken_.push_back(std::move(row));
  }

 private:
  [[nodiscard]] std::vector<std::vector<std::string>> people_of_taken() const {
    std::vector<std::vector<std::string>> people;
    for (const core::SequentialLookRow& look : taken_) {
      std::vector<std::string>& of_look = people.emplace_back();
      for (const CompleteSession& one : complete_) {
        if (std::ranges::find(look.sessions, one.session) != look.sessions.end()) {
          of_look.push_back(one.participant);
        }
      }
    }
    return people;
  }

  core::StudyStore& store_;
  std::vector<core::SequentialLookRow> taken_;
  std::vector<CompleteSession> complete_, further_;
  std::size_t num_used_ = 0;  ///< How many sessions the earlier looks have used.
};

}  // namespace

StudyProgress take_due_looks(core::StudyStore& store) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  if (sessions.empty()) {
    throw core::Error(store.folder().string() +
                      ": expected a study with sessions to look at, found none yet");
  }
  const experiments::Study study = stored_study(store, sessions.back().session);
  if (!study.sequential) {
    throw core::Error(store.folder().string() +
                      ": expected a study that plans looks, found none in its file: its key "
                      "`sequential` says when, and is written before the first session");
  }
  const analysis::SequentialBoundaries boundaries =
      analysis::boundaries_of(analysis::sequential_rule(study));
  const std::vector<int>& planned = boundaries.rule.looks;
  Looks looks(store);
  if (looks.is_due(boundaries.rule)) {
    const analysis::StudyData data = analysis::load_study(store);
    while (looks.is_due(boundaries.rule)) looks.take_next(data, boundaries);
  }
  return {.ended = looks.has_ended(),
          .num_complete = static_cast<int>(looks.num_complete()),
          .max_participants = planned.back(),
          .next_look = looks.has_ended() ? 0 : planned[looks.num_taken()],
          .simulated = sessions.back().simulated};
}

void unseal_study(core::StudyStore& store, const StudyProgress& progress,
                  const std::string& reason) {
  if (progress.ended) {
    throw core::Error(store.folder().string() +
                      ": expected a study that is still sealed, found one that its rule has "
                      "ended; `jnd results` shows it");
  }
  store.add_unsealing({.time_ns = core::SystemClock().now_ns(),
                       .num_complete = progress.num_complete,
                       .reason = reason});
}

}  // namespace jnd::app
