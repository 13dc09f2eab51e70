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

/// What the page of a stored session shows.
struct RecordViewModel {
  const StudyFolder& study;
  const SessionRecord* record = nullptr;  ///< nullptr while the session is being read.
  std::string problem;                    ///< Why the session cannot be read; "" otherwise.
  /// The flight record of the chosen fault; nullptr if there is none to show.
  const FlightRecord* flight = nullptr;
  std::string flight_problem;  ///< Why the flight record cannot be read; "" otherwise.
  StudyWork work;
};

enum class RecordPage { kTimeline, kAnswers, kNotes, kFaults };

struct RecordViewState {
  RecordPage page = RecordPage::kTimeline;
  std::optional<std::size_t> answer, note, fault;  ///< The chosen row of each page.
  std::string searched;                            ///< The words searched for in the notes.
  bool searches = false;                           ///< The search field gets the keyboard.
  bool unread_only = false;  ///< Only notes that nobody has acknowledged are shown.
  enum class Dialog { kNone, kExclude, kNote, kWithdraw };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  bool whole_session = false;  ///< The dialog leaves out every trial, not only the chosen one.
  std::string typed;           ///< The reason, the note, or the pseudonym typed once more.
  RunViewState correcting;     ///< The state of the dialog that corrects an answer.
  DoubleClick clicks;
  float timeline_height = 0, detail_height = 0, notes_height = 0, faults_height = 0;
  float actions_height = 0;
};

/// What was asked for; one thing in a frame.
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
  bool withdraw = false;  ///< Withdraws the participant, whose pseudonym was typed once more.
  bool cancel = false;
  std::optional<std::filesystem::path> open;  ///< Opens this file with another program.
};

[[nodiscard]] RecordViewResult draw_record_view(Ui& ui, const RecordViewModel& model,
                                                RecordViewState& state);

}  // namespace jnd::app::gui
