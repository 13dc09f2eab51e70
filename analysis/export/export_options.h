#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/results/deviation.h"
#include "core/progress.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// A part of a study. If nothing is chosen it is the whole study.
struct ExportSelection {
  std::vector<std::string> participants;  ///< The pseudonyms.
  /// Selects trials and samples of these blocks. Events are always complete.
  std::vector<std::string> blocks;
  /// The channels of samples by `core::SampleColumn::array`, such as "position_m". Ticks and
  /// flags are always included.
  std::vector<std::string> channels;
  /// The rate of samples. Each row is the mean of the samples that it represents. 0 means the
  /// rate of the loop.
  double rate_hz = 0.0;
};

/// The optional content of a data set.
struct ExportOptions {
  ExportSelection selection{};
  bool recordings = false;  ///< Whether every sample is written as well.
  bool pilot = false;       ///< Whether pilot sessions are written as well.
  /// The version of the exporting program; if it is "", the data set does not state it.
  std::string program_version{};
  /// How the study differs from its preregistration; empty without one.
  PreregisteredStudy preregistration{};
  /// Returns the names of a session's stages, in the order of the participant's list. If it is
  /// empty, stages are named by their numbers.
  std::function<std::vector<std::string>(const core::SessionRow&)> stage_names = {};
  /// Called from time to time. An exception from it ends the export. It may be empty.
  std::function<void()> keep_going = {};
  core::Progress on_progress = {};  ///< The progress by sessions.
};

/// The outcome of writing a data set.
struct ExportOutcome {
  /// Recordings that lack ticks which their session's events mention, one sentence each. The
  /// rest is written, and the data set mentions the loss too.
  std::vector<std::string> problems;
  bool samples = false;  ///< Whether it has any samples.
};

/// The sessions of the data set, by number. Participants who withdrew have none. Throws
/// `core::Error` for a chosen participant or block without sessions.
[[nodiscard]] std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                              const ExportOptions& options);

/// The expected size of the samples before they are written.
struct ExpectedSize {
  std::int64_t num_sessions = 0;  ///< The number of sessions with a recording.
  std::int64_t num_rows = 0;      ///< The number of rows of samples.
  double bytes = 0.0;             ///< The approximate size as text or in HDF5.
};
/// The expected size of the samples of these sessions. `is_text` stands for CSV and BIDS. It is
/// an upper limit, because blocks are ignored. Not real time.
[[nodiscard]] ExpectedSize expected_size(const core::StudyStore& store,
                                         const ExportOptions& options, bool is_text);

/// Whether the block is in the data set.
[[nodiscard]] bool is_exported(const ExportSelection& selection, const std::string& block);

}  // namespace jnd::analysis
