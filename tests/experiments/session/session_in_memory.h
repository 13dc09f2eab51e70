#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "experiments/session/session.h"

// What a session needs that is played without a disk or a device.

namespace jnd::experiments {

/// Keeps what a session commits, and can refuse it as a full disk does.
class MemoryLog final : public EventLog {
 public:
  void append(const core::Commit& commit) override {
    if (refuses) throw core::Error("disk full");
    commits.push_back(commit);
    events.push_back(commit.event);
    design.insert(design.end(), commit.design.begin(), commit.design.end());
    if (commit.trial) trials.push_back(*commit.trial);
  }

  std::vector<core::Commit> commits;
  /// The events of the commits, from which a session is resumed.
  std::vector<core::EventRow> events;
  std::vector<core::DesignRow> design;
  std::vector<core::TrialRow> trials;
  bool refuses = false;
};

/// Adds a whole presentation of 100 ticks, without strokes.
inline void present(Session& session, const std::string& interval) {
  const std::int64_t tick = session.state().last_tick + 1;
  session.begin_presentation(interval, tick);
  session.end_presentation(tick + 99, {});
}

}  // namespace jnd::experiments
