#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/study_folder.h"
#include "core/storage/schedule.h"

namespace jnd::app {

/// An appointment as a row of a list. Lists leave out cancelled appointments.
struct ScheduleLine {
  std::int64_t appointment = 0;
  std::string participant;  ///< The pseudonym.
  std::string when;         ///< In the machine's time zone, such as "tomorrow at 14:30".
  enum class State {
    kComing,
    kCame,    ///< There is a session under this pseudonym.
    kMissed,  ///< The time is over, and nobody has come.
  };
  State state = State::kComing;
};

/// The appointments in the order of their times. Somebody who is up to 15 minutes late has not
/// missed theirs.
[[nodiscard]] std::vector<ScheduleLine> schedule_of(
    const std::vector<core::AppointmentRow>& appointments, const StudyFolder& study,
    std::int64_t now_ns);

/// Who comes next: among the appointments without a session, from today on, the one whose time
/// is nearest. If there is none, the first pseudonym that is neither taken nor has an
/// appointment.
[[nodiscard]] std::string next_participant(
    const core::StudyStore& store, const std::vector<core::AppointmentRow>& appointments,
    std::int64_t now_ns);
/// The first pseudonym that is neither taken nor has an appointment.
[[nodiscard]] std::string free_pseudonym(const core::StudyStore& store,
                                         const std::vector<core::AppointmentRow>& appointments);

/// The day and the time in the machine's time zone: "2026-12-01" and "14:30".
[[nodiscard]] std::string date_text(std::int64_t time_ns);
[[nodiscard]] std::string hour_text(std::int64_t time_ns);
/// The time of such a day and hour. None if one of them does not exist, or if a change of
/// clocks leaves that hour out.
[[nodiscard]] std::optional<std::int64_t> time_of_texts(const std::string& date,
                                                        const std::string& hour);

}  // namespace jnd::app
