#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::core {

/// Somebody who comes to take part, by pseudonym.
struct AppointmentRow {
  std::int64_t appointment = 0;  ///< From 1.
  std::string participant;
  std::int64_t starts_time_ns = 0;  ///< Since 1970-01-01 UTC.
  bool cancelled = false;
};

// Each writes a row more and changes none. A study of an older layout is brought up to date
// first. All throw `Error`, also where another program writes to the study, and for a backup.
// Not real time.

/// Writes down who comes when. Returns the number of the appointment; on disk by then.
std::int64_t add_appointment(const std::filesystem::path& folder,
                             const std::string& participant, std::int64_t starts_time_ns,
                             std::int64_t time_ns);
/// It is cancelled; what was written down stays. Throws `Error` for one that does not stand.
void cancel_appointment(const std::filesystem::path& folder, std::int64_t appointment,
                        std::int64_t time_ns);
/// How many complete sessions the study is to have, > 0.
void plan_number(const std::filesystem::path& folder, std::int64_t num_participants,
                 std::int64_t time_ns);

/// Every appointment as its last row has it, those cancelled as well, by when they begin.
[[nodiscard]] std::vector<AppointmentRow> appointments(const std::filesystem::path& folder);
/// The last one written down; none before.
[[nodiscard]] std::optional<std::int64_t> planned_number(const std::filesystem::path& folder);

}  // namespace jnd::core
