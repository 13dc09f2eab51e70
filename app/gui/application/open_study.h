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

/// The study folder that is open in the window, if one is, and the work on it that goes on
/// beside the window, one at a time.
class OpenStudy {
 public:
  explicit OpenStudy(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Throws `Error`; the last one stays open then.
  void open(const std::filesystem::path& folder);
  void close();
  /// Reads the folder again, where one is open.
  void reload();
  [[nodiscard]] bool is_open() const noexcept { return folder_.has_value(); }
  [[nodiscard]] const StudyFolder& folder() const { return folder_.value(); }
  /// As it is in the folder.
  [[nodiscard]] const experiments::Study& study() const { return study_.value(); }

  /// Nothing while other work goes on. `name` says what it is: "Verifying".
  void begin_work(const char* name, std::function<ActionOutcome(WorkControl&)> work);
  void cancel_work();
  /// True once when work has come to its end.
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

/// One for each study folder, so that the orders shown are those its sessions will draw.
[[nodiscard]] std::uint64_t seed_of(const core::StudyStore& store);

}  // namespace jnd::app::gui
