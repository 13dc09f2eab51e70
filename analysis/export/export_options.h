#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/results/deviation.h"
#include "core/progress.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// A part of a study; nothing chosen is all of it.
struct ExportSelection {
  std::vector<std::string> participants;  ///< Pseudonyms.
  std::vector<std::string> blocks;        ///< Their trials and samples; events stay whole.
  /// Of samples, by `core::SampleColumn::array`, as "position_m"; ticks and flags are always
  /// there.
  std::vector<std::string> channels;
  /// Of samples: each row is the mean of those that it stands for. 0: the rate of the loop.
  double rate_hz = 0.0;
};

/// What goes into a data set besides what always does.
struct ExportOptions {
  ExportSelection selection{};
  bool recordings = false;        ///< Whether every sample is written as well.
  bool pilot = false;             ///< Whether pilot sessions are written as well.
  std::string program_version{};  ///< Of the program that exports; "": it is not said.
  /// How the study came out beside what it registered before; nothing where it did not.
  PreregisteredStudy preregistration{};
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

/// The sessions of the data set, by number. Participants who withdrew have none. Throws
/// `core::Error` for a participant or a block that is chosen and has none.
[[nodiscard]] std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                              const ExportOptions& options);

/// How large samples will be, told before they are written.
struct ExpectedSize {
  std::int64_t num_sessions = 0;  ///< With a recording.
  std::int64_t num_rows = 0;      ///< Of samples.
  double bytes = 0.0;             ///< About, in text or in HDF5.
};
/// Of the samples of these sessions; `is_text`: as CSV or BIDS have them. Blocks are not told
/// apart: it is the most that there will be. Not real time.
[[nodiscard]] ExpectedSize expected_size(const core::StudyStore& store,
                                         const ExportOptions& options, bool is_text);

/// Whether that block is in the data set.
[[nodiscard]] bool is_exported(const ExportSelection& selection, const std::string& block);

}  // namespace jnd::analysis
