#pragma once

#include "core/clock.h"
#include "core/storage/study_store.h"
#include "experiments/session/session.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// A stored session that is open for an act after its visits: a trial is excluded, or levels
/// are unblinded.
class ReopenedSession final : private experiments::EventLog {
 public:
  /// Throws `Error` for a damaged log or protocol. The store must outlive this object.
  ReopenedSession(core::StudyStore& store, const core::SessionRow& row);

  [[nodiscard]] experiments::Session& session() noexcept { return session_; }

 private:
  void append(const core::Commit& commit) override { store_.append(commit); }

  core::StudyStore& store_;
  experiments::Study study_;
  core::SystemClock clock_;
  experiments::Session session_;
};

}  // namespace jnd::app
