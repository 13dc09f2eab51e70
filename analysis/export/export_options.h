#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What goes into a data set besides what always does.
struct ExportOptions {
  bool recordings = false;        ///< Whether every sample is written as well.
  bool pilot = false;             ///< Whether pilot sessions are written as well.
  std::string program_version{};  ///< Of the program that exports; "": it is not said.
  /// Names of a session's stages, in the order of the participant's list; may be empty, then
  /// stages are named by their numbers.
  std::function<std::vector<std::string>(const core::SessionRow&)> stage_names = {};
  /// Called every now and then; what it throws ends the export. May be empty.
  std::function<void()> keep_going = {};
  core::Progress on_progress = {};  ///< By sessions.
};

/// What became of a data set that was written.
struct ExportOutcome {
  /// Recordings that lack ticks of which their session's events speak, a sentence each. The
  /// rest is written, and the data set tells of them, too.
  std::vector<std::string> problems;
  bool samples = false;  ///< There are any in it.
};

/// The sessions of the data set, by number. Participants who withdrew have none.
[[nodiscard]] std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                              const ExportOptions& options);

}  // namespace jnd::analysis
