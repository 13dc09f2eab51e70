#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/gui/views/list_keys.h"
#include "app/gui/views/run_view.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/session_record.h"

namespace jnd::app::gui {

/// One stored session, as its page shows it.
struct RecordViewModel {
  const StudyFolder& study;
  const SessionRecord* record = nullptr;  ///< nullptr while it is being read.
  std::string problem;                    ///< Why it cannot be read; "" otherwise.
  /// Of the fault that is chosen; nullptr where there is none to show.
  const FlightRecord* flight = nullptr;
  std::string flight_problem;  ///< Why it cannot be read; "" otherwise.
  StudyWork work;
};

enum class RecordPage { kTimeline, kAnswers, kNotes, kFaults };

struct RecordViewState {
  RecordPage page = RecordPage::kTimeline;
  std::optional<std::size_t> answer, note, fault;  ///< The row that is chosen, of each page.
  std::string searched;                            ///< In notes.
  bool searches = false;                           ///< Its field takes the keyboard.
  bool unread_only = false;                        ///< Of notes.
  enum class Dialog { kNone, kExclude, kNote, kWithdraw };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  bool whole_session = false;  ///< Every trial is left out, not the one that is chosen.
  std::string typed;           ///< Reason, note, or the pseudonym once more.
  RunViewState correcting;     ///< Of the dialog that sets an answer right.
  DoubleClick clicks;
  float timeline_height = 0, detail_height = 0, notes_height = 0, faults_height = 0;
  float actions_height = 0;
};

/// What was asked. One of them in a frame.
struct RecordViewResult {
  StudyTab tab = StudyTab::kNone;
  bool resume = false;
  struct Correct {
    std::int64_t trial = 0;
    std::optional<double> value;
    std::string reason;
  };
  std::optional<Correct> correct;
  struct Exclude {
    std::vector<std::int64_t> trials;
    std::string reason;
    bool include = false;
  };
  std::optional<Exclude> exclude;
  std::optional<std::string> note, adverse_event;
  std::optional<core::ReadNote> acknowledge;
  bool withdraw = false;  ///< The pseudonym was typed once more.
  bool cancel = false;
  std::optional<std::filesystem::path> open;  ///< With another program.
};

[[nodiscard]] RecordViewResult draw_record_view(Ui& ui, const RecordViewModel& model,
                                                RecordViewState& state);

}  // namespace jnd::app::gui
