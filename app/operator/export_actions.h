#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/background_task.h"
#include "app/results/study_figures.h"

namespace jnd::app {

/// How an act that a button began has ended.
struct ActionOutcome {
  bool ok = true;
  /// The act is done, but the sentence says what is not as it should be.
  bool caution = false;
  std::string sentence;  ///< Such as "13 sessions and 1040 answers are in ..."
  /// The problems that a verification found, one sentence each.
  std::vector<std::string> problems;
  /// The file or folder that was written; "" for none.
  std::filesystem::path opens{};
};

// Each of these functions is for a `BackgroundTask`. They throw `core::Error` if the act is
// impossible, and then leave the study as it is. Not real time.

struct ExportChoice {
  std::string format;  ///< "csv", "bids", "hdf5" or "xdf".
  /// Exports every sample as well; hdf5 always does.
  bool recordings = false;
};
/// Writes a data set as `jnd export` does. `target` must not exist, or must be empty. Refuses a
/// double-blind study that nobody has unblinded.
[[nodiscard]] ActionOutcome export_study(const std::filesystem::path& folder,
                                         const std::filesystem::path& target,
                                         const ExportChoice& choice, WorkControl& control);

/// Writes charts or boxes as SVG and PDF, by the code of `jnd report`. Refuses what
/// `export_study` refuses.
[[nodiscard]] ActionOutcome save_figures(StudyFiguresRequest request, WorkControl& control);

/// Reads everything back and compares it with what should be there.
[[nodiscard]] ActionOutcome verify_study(const std::filesystem::path& folder,
                                         WorkControl& control);

/// Makes a backup, or brings an earlier one up to date, and reads it back.
[[nodiscard]] ActionOutcome back_up_study(const std::filesystem::path& folder,
                                          const std::filesystem::path& target,
                                          WorkControl& control);

/// Writes the report of `jnd report`: HTML, PDF if a browser is installed, and figures with
/// their data. `target` must not exist, or must be empty. Refuses what `export_study` refuses.
[[nodiscard]] ActionOutcome write_report(const std::filesystem::path& folder,
                                         const std::filesystem::path& target,
                                         WorkControl& control);

/// Reveals levels, orders and results from now on. The time and the reason are stored with the
/// study and in the log of every session. Throws `core::Error` for a study that is not
/// double-blind or has no session yet.
[[nodiscard]] ActionOutcome unblind_study(const std::filesystem::path& folder,
                                          const std::string& reason);

/// A folder beside the study that does not exist yet: "NAME-csv", or else "NAME-csv-2" and so
/// on.
[[nodiscard]] std::filesystem::path free_folder_beside(
    const std::filesystem::path& study_folder, const std::string& ending);

}  // namespace jnd::app
