#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/gui/views/sessions_view.h"
#include "app/operator/background_task.h"
#include "app/operator/export_actions.h"
#include "app/operator/study_folder.h"
#include "experiments/study/study.h"

namespace jnd::app::gui {

/// The study folder that is open in the window, if any, and the work on it in the background.
/// Only one such work runs at a time.
class OpenStudy {
 public:
  explicit OpenStudy(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Opens a folder. Throws `Error`; the folder that was open stays open then.
  void open(const std::filesystem::path& folder);
  void close();
  /// Reads the folder again, if one is open.
  void reload();
  [[nodiscard]] bool is_open() const noexcept { return folder_.has_value(); }
  [[nodiscard]] const StudyFolder& folder() const { return folder_.value(); }
  /// The study as it is stored in the folder.
  [[nodiscard]] const experiments::Study& study() const { return study_.value(); }

  /// Begins work in the background; does nothing while other work runs. `name` says what the
  /// work is, such as "Verifying".
  void begin_work(const char* name, std::function<ActionOutcome(WorkControl&)> work);
  void cancel_work();
  /// Returns true once when the work has ended.
  bool collect_work();
  [[nodiscard]] bool works() const noexcept { return work_ && work_->running(); }
  [[nodiscard]] StudyWork work() const;
  void set_outcome(ActionOutcome outcome) { outcome_ = std::move(outcome); }

 private:
  std::function<void()> wake_;
  std::optional<StudyFolder> folder_;
  std::optional<experiments::Study> study_;
  std::string work_name_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> work_;
  ActionOutcome outcome_;
};

/// The seed of a study folder, always the same for one folder: the orders that are shown are
/// those that its sessions will draw.
[[nodiscard]] std::uint64_t seed_of(const core::StudyStore& store);

}  // namespace jnd::app::gui
