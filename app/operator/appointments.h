#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/study_folder.h"
#include "core/storage/schedule.h"

namespace jnd::app {

/// An appointment as a row of a list. Those that were cancelled are in none.
struct ScheduleLine {
  std::int64_t appointment = 0;
  std::string participant;  ///< Pseudonym.
  std::string when;         ///< "tomorrow at 14:30", where the machine is.
  enum class State {
    kComing,
    kCame,    ///< There is a session under this pseudonym.
    kMissed,  ///< The time is over, and nobody has come.
  };
  State state = State::kComing;
};

/// In the order of their times. Who is ten minutes late has not missed it.
[[nodiscard]] std::vector<ScheduleLine> schedule_of(
    const std::vector<core::AppointmentRow>& appointments, const StudyFolder& study,
    std::int64_t now_ns);

/// Who comes next: of those without a session the one whose time is nearest, from this day on;
/// without any the first pseudonym that is neither taken nor written down for somebody.
[[nodiscard]] std::string next_participant(
    const core::StudyStore& store, const std::vector<core::AppointmentRow>& appointments,
    std::int64_t now_ns);
/// The first that nobody has and nobody comes under.
[[nodiscard]] std::string free_pseudonym(const core::StudyStore& store,
                                         const std::vector<core::AppointmentRow>& appointments);

/// "2026-12-01" and "14:30", where the machine is.
[[nodiscard]] std::string date_text(std::int64_t time_ns);
[[nodiscard]] std::string hour_text(std::int64_t time_ns);
/// And back; none where it is no day or no time of day, and for an hour that a change of clocks
/// leaves out.
[[nodiscard]] std::optional<std::int64_t> time_of_texts(const std::string& date,
                                                        const std::string& hour);

}  // namespace jnd::app
