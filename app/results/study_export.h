#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/export/export_options.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// What a study can be exported as.
inline constexpr std::array<const char*, 4> kExportFormats = {"csv", "bids", "hdf5", "xdf"};

struct StudyExportRequest {
  std::string format;         ///< One of `kExportFormats`.
  std::filesystem::path out;  ///< New or empty.
  analysis::ExportOptions
      data;  ///< Program, names of stages and preregistration are filled in.
};

struct StudyExport {
  std::string what;  ///< What the data set consists of, for a person.
  std::vector<std::string> problems;
  std::string forgotten;  ///< That the study does not remember it; "" where it does.
};

/// Writes a study as a data set for other programs, and has the study remember where. Refuses a
/// double-blind study that nobody has unblinded. Throws `core::Error`. Not real time.
[[nodiscard]] StudyExport write_study_export(const core::StudyStore& store,
                                             const StudyExportRequest& request);

}  // namespace jnd::app
