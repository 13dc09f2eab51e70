#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::core {

/// An appointment of a participant, who is named by a pseudonym.
struct AppointmentRow {
  std::int64_t appointment = 0;  ///< Counted from 1.
  std::string participant;
  std::int64_t starts_time_ns = 0;  ///< Since 1970-01-01 UTC.
  bool cancelled = false;
};

// Each of these functions adds a row and changes none. A study of an older layout is brought up
// to date first. They throw `Error`, also if another program writes to the study, and for a
// backup. Not real time.

/// Adds an appointment and returns its number. It is on disk when the function returns.
std::int64_t add_appointment(const std::filesystem::path& folder,
                             const std::string& participant, std::int64_t starts_time_ns,
                             std::int64_t time_ns);
/// Cancels the appointment; its earlier rows stay. Throws `Error` for an appointment that does
/// not exist or is cancelled already.
void cancel_appointment(const std::filesystem::path& folder, std::int64_t appointment,
                        std::int64_t time_ns);
/// Sets how many complete sessions the study is to have, > 0.
void plan_number(const std::filesystem::path& folder, std::int64_t num_participants,
                 std::int64_t time_ns);

/// Returns every appointment in its latest state, also the cancelled ones, ordered by start.
[[nodiscard]] std::vector<AppointmentRow> appointments(const std::filesystem::path& folder);
/// Returns the latest planned number, or none if there is none.
[[nodiscard]] std::optional<std::int64_t> planned_number(const std::filesystem::path& folder);

}  // namespace jnd::core
