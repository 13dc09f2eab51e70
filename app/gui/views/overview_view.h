#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/gui/ui.h"
#include "app/gui/views/list_keys.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/study_overview.h"

namespace jnd::app::gui {

/// What a study's overview shows.
struct OverviewModel {
  const StudyFolder& study;
  const StudyOverview* overview = nullptr;  ///< nullptr while the study is being read.
  double progress = 0.0;                    ///< How far reading is, from 0 to 1.
  std::string problem;                      ///< Why the study cannot be read; "" otherwise.
  StudyWork work;
  std::string proposed_date;  ///< The day proposed for the next appointment: "2026-12-01".
};

struct OverviewState {
  enum class List { kSessions, kSchedule };
  /// The list through which the arrow keys move.
  List list = List::kSessions;
  /// The chosen row of either list.
  std::optional<std::size_t> session, appointment;
  enum class Dialog { kNone, kPlan, kAppointment, kCancel };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  std::string number;                   ///< The number of participants, as typed.
  std::string participant, date, hour;  ///< An appointment, as typed.
  std::string problem;                  ///< Why the last attempt failed.
  bool asks_for_backup = false, backup_is_new = false;
  std::string backup_folder;  ///< The application proposes it.
  DoubleClick clicks;
};

struct OverviewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<std::string> prepare;   ///< Prepares a session of this participant.
  std::optional<std::int64_t> session;  ///< Shows this session's page.
  bool plan = false;                    ///< Stores that `number` participants are planned.
  /// Adds an appointment of `participant` at `date` and `hour`.
  bool add_appointment = false;
  std::optional<std::int64_t> cancel_appointment;
  bool back_up = false;  ///< Backs the study up into `backup_folder`.
  bool cancel = false;
};

[[nodiscard]] OverviewResult draw_overview(Ui& ui, const OverviewModel& model,
                                           OverviewState& state);

}  // namespace jnd::app::gui
