#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/export/export_options.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// The formats in which a study can be exported.
inline constexpr std::array<const char*, 4> kExportFormats = {"csv", "bids", "hdf5", "xdf"};

struct StudyExportRequest {
  std::string format;            ///< One of `kExportFormats`.
  std::filesystem::path out;     ///< A new or empty folder.
  analysis::ExportOptions data;  ///< `write_study_export` adds program, stage names, plan.
};

struct StudyExport {
  std::string what;  ///< What the data set consists of, in words for people.
  std::vector<std::string> problems;
  /// A sentence that the study does not remember the export; "" if it does.
  std::string forgotten;
};

/// Writes a study as a data set for other programs, and makes the study remember where. Refuses
/// a double-blind study that nobody has unblinded. Throws `core::Error`. Not real time.
[[nodiscard]] StudyExport write_study_export(const core::StudyStore& store,
                                             const StudyExportRequest& request);

}  // namespace jnd::app
