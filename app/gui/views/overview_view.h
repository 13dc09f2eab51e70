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

/// Where a study stands, as its overview shows it.
struct OverviewModel {
  const StudyFolder& study;
  const StudyOverview* overview = nullptr;  ///< nullptr while it is being read.
  double progress = 0.0;                    ///< Of reading.
  std::string problem;                      ///< Why it cannot be read; "" otherwise.
  StudyWork work;
  std::string proposed_date;  ///< "2026-12-01", for the next appointment.
};

struct OverviewState {
  enum class List { kSessions, kSchedule };
  List list = List::kSessions;                      ///< That arrow keys go through.
  std::optional<std::size_t> session, appointment;  ///< The row that is chosen, of each.
  enum class Dialog { kNone, kPlan, kAppointment, kCancel };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  std::string number;                   ///< Of participants, typed.
  std::string participant, date, hour;  ///< Of an appointment, typed.
  std::string problem;                  ///< Why the last attempt did not work.
  bool asks_for_backup = false, backup_is_new = false;
  std::string backup_folder;  ///< Proposed by the application.
  DoubleClick clicks;
};

struct OverviewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<std::string> prepare;   ///< A session of this participant.
  std::optional<std::int64_t> session;  ///< Its page.
  bool plan = false;                    ///< `number` participants.
  bool add_appointment = false;         ///< `participant`, `date`, `hour`.
  std::optional<std::int64_t> cancel_appointment;
  bool back_up = false;  ///< Into `backup_folder`.
  bool cancel = false;
};

[[nodiscard]] OverviewResult draw_overview(Ui& ui, const OverviewModel& model,
                                           OverviewState& state);

}  // namespace jnd::app::gui
