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

/// What the window shows of somebody's table.
struct DataView {
  std::filesystem::path file;  ///< "" while no file is open.
  bool is_reading = false;
  std::string problem;  ///< Why the file is no table; "" otherwise.
  std::optional<DataPreview> preview;
  CurveRequest request;  ///< The columns, and what is fitted.
  bool is_computing = false;
  double progress = 0.0;
  /// Why there are no fits, in a sentence of the reader or the engine.
  std::string fit_problem;
  /// The results of `request`, as soon as there are any.
  std::shared_ptr<const DataResults> results;
  bool can_compare = false;  ///< There are at least two curves.
  bool is_comparing = false;
  std::string compare_problem;  ///< Why the comparison failed.
  std::shared_ptr<const DataComparison> comparison;
  std::string command;  ///< The command line that does the same.
  bool is_saving = false;
  ActionOutcome outcome;  ///< How the last saving ended.
};

/// A table of anybody's answers that is shown and fitted in the window, by the reader and the
/// engine of `jnd fit psychometric`. Whatever takes time runs in the background. The file is
/// read and never changed. Only the window's thread uses it.
class OpenData {
 public:
  /// `wake` requests another frame; any thread may call it.
  explicit OpenData(std::function<void()> wake = {});

  /// Reads another file, guesses its columns and fits. Problems are told in the view.
  void open(const std::filesystem::path& file);
  /// Takes other columns or another curve, and fits at once if nothing is missing.
  void ask(const CurveRequest& request);
  /// Compares the groups. A few groups are compared without being asked for.
  void compare();
  /// Saves into a new file. Does nothing while there are no fits, or while something is being
  /// saved.
  void save_picture(const std::filesystem::path& file);
  void save_table(const std::filesystem::path& file);

  /// Takes what has been computed and begins what is next; called before each frame.
  void collect();
  /// True while something goes on in the background.
  [[nodiscard]] bool works() const noexcept;
  [[nodiscard]] const DataView& view() const noexcept { return view_; }
  /// Waits until nothing goes on any more; for tests.
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
  /// The curves of the results that are shown.
  std::shared_ptr<const CurveAnalysis> curves_;
  bool fits_are_due_ = false;
  CurveRequest computing_request_;  ///< The request that `computing_` works on.
  std::unique_ptr<BackgroundTask<DataPreview>> reading_;
  std::unique_ptr<BackgroundTask<Computed>> computing_;
  std::unique_ptr<Comparing> comparing_;
  /// Comparisons that nobody waits for any more, and that cannot be interrupted.
  std::vector<std::unique_ptr<Comparing>> abandoned_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> saving_;
};

/// Whether the request names the columns of the intensities and of the answers.
[[nodiscard]] bool names_its_columns(const CurveRequest& request) noexcept;

/// A file beside the table that does not exist yet: "NAME-curves.svg", or else
/// "NAME-curves-2.svg" and so on.
[[nodiscard]] std::filesystem::path free_file_beside(const std::filesystem::path& table,
                                                     const std::string& ending);

}  // namespace jnd::app
