#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/curves/curve_analysis.h"
#include "app/operator/background_task.h"
#include "app/operator/data_preview.h"
#include "app/operator/data_results.h"
#include "app/operator/export_actions.h"

namespace jnd::app {

/// What is shown of somebody's table.
struct DataView {
  std::filesystem::path file;  ///< "" while none is open.
  bool is_reading = false;
  std::string problem;  ///< Why the file is no table; "" otherwise.
  std::optional<DataPreview> preview;
  CurveRequest request;  ///< Which columns, and what is fitted.
  bool is_computing = false;
  double progress = 0.0;
  std::string fit_problem;  ///< Why there are no fits: the reader's or the engine's sentence.
  std::shared_ptr<const DataResults> results;  ///< Of `request`, once they are there.
  bool can_compare = false;                    ///< There are two curves or more.
  bool is_comparing = false;
  std::string compare_problem;  ///< Why the comparison failed.
  std::shared_ptr<const DataComparison> comparison;
  std::string command;  ///< The command line that does the same.
  bool is_saving = false;
  ActionOutcome outcome;  ///< Of what was saved last.
};

/// A table of anybody's answers that is looked at and fitted in the window, by the reader and
/// the engine of `jnd fit psychometric`. All that takes time goes on beside the window. The
/// file is read and never changed. One thread, that of the window.
class OpenData {
 public:
  /// `wake`: draws another frame; called from any thread.
  explicit OpenData(std::function<void()> wake = {});

  /// Reads another file, guesses its columns and fits. What goes wrong stands in the view.
  void open(const std::filesystem::path& file);
  /// Other columns or another curve: fitted at once, once nothing is missing.
  void ask(const CurveRequest& request);
  /// Compares the groups. A few are compared without being asked.
  void compare();
  /// Into new files; nothing while there are no fits, or something is saved.
  void save_picture(const std::filesystem::path& file);
  void save_table(const std::filesystem::path& file);

  /// Takes what has come, and begins what is next: before each frame.
  void collect();
  /// Something goes on beside the window.
  [[nodiscard]] bool works() const noexcept;
  [[nodiscard]] const DataView& view() const noexcept { return view_; }
  /// Until nothing goes on any more: for tests.
  void wait();

 private:
  struct Computed {
    std::shared_ptr<const CurveAnalysis> curves;
    std::shared_ptr<const DataResults> results;
  };
  using Comparing = BackgroundTask<DataComparison>;

  void forget_results();
  void collect_preview();
  void collect_fits();
  void collect_comparison();
  void begin_fits();
  void save(std::function<ActionOutcome(WorkControl&)> work);

  std::function<void()> wake_;
  DataView view_;
  std::shared_ptr<const CurveAnalysis> curves_;  ///< Of the results shown.
  bool fits_are_due_ = false;
  CurveRequest computing_request_;  ///< Of `computing_`.
  std::unique_ptr<BackgroundTask<DataPreview>> reading_;
  std::unique_ptr<BackgroundTask<Computed>> computing_;
  std::unique_ptr<Comparing> comparing_;
  /// Nobody waits for these any more, and they cannot be interrupted.
  std::vector<std::unique_ptr<Comparing>> abandoned_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> saving_;
};

/// Whether it says which columns the intensities and the answers are.
[[nodiscard]] bool names_its_columns(const CurveRequest& request) noexcept;

/// Beside the table: "NAME-curves.svg", or "NAME-curves-2.svg" and so on, whichever does not
/// exist yet.
[[nodiscard]] std::filesystem::path free_file_beside(const std::filesystem::path& table,
                                                     const std::string& ending);

}  // namespace jnd::app
