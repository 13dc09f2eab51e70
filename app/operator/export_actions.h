#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/background_task.h"
#include "app/results/study_figures.h"

namespace jnd::app {

/// What came of something a button began.
struct ActionOutcome {
  bool ok = true;
  bool caution = false;  ///< It is done, but the sentence says what is not as it should be.
  std::string sentence;  ///< "13 sessions and 1040 answers are in ..."
  std::vector<std::string> problems;  ///< Of a verification, a sentence each.
  std::filesystem::path opens{};      ///< What it wrote, a file or a folder; "" for nothing.
};

// Each is for a `BackgroundTask`. All throw `core::Error` where it cannot be done, and leave
// the study as it is. Not real time.

struct ExportChoice {
  std::string format;       ///< "csv", "bids", "hdf5", "xdf"
  bool recordings = false;  ///< Every sample as well; hdf5 always has them.
};
/// A data set as `jnd export` writes it. `target` must not exist or be empty. Refused for a
/// double-blind study that nobody has unblinded.
[[nodiscard]] ActionOutcome export_study(const std::filesystem::path& folder,
                                         const std::filesystem::path& target,
                                         const ExportChoice& choice, WorkControl& control);

/// Charts or boxes as SVG and PDF, by the code of `jnd report`. Refused like `export_study`.
[[nodiscard]] ActionOutcome save_figures(StudyFiguresRequest request, WorkControl& control);

/// Reads everything back and compares it with what should be there.
[[nodiscard]] ActionOutcome verify_study(const std::filesystem::path& folder,
                                         WorkControl& control);

/// A copy, or an earlier copy brought up to date, read back.
[[nodiscard]] ActionOutcome back_up_study(const std::filesystem::path& folder,
                                          const std::filesystem::path& target,
                                          WorkControl& control);

/// The report of `jnd report`: HTML, PDF where a browser is installed, figures with their data.
/// `target` must not exist or be empty. Refused like `export_study`.
[[nodiscard]] ActionOutcome write_report(const std::filesystem::path& folder,
                                         const std::filesystem::path& target,
                                         WorkControl& control);

/// Levels, orders and results may be seen from now on; when and why is stored with the study
/// and in the log of every session. Throws `core::Error` for a study that is not double-blind
/// or has no session yet.
[[nodiscard]] ActionOutcome unblind_study(const std::filesystem::path& folder,
                                          const std::string& reason);

/// Beside the study: "NAME-csv", or "NAME-csv-2" and so on, whichever does not exist yet.
[[nodiscard]] std::filesystem::path free_folder_beside(
    const std::filesystem::path& study_folder, const std::string& ending);

}  // namespace jnd::app
