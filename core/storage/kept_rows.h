#pragma once

namespace jnd::core {

/// Rows that are never changed, and how a withdrawal, which alone deletes any, is known.
struct KeptRows {
  const char* table;
  const char* meaning;
  const char* gone_with = "";  ///< Column by which the study tells whose rows were deleted.
};
inline constexpr KeptRows kKeptRows[] = {
    {"session", "a session", "session"},
    {"protocol", "a study file"},
    {"device_profile", "a device profile"},
    {"adverse_event", "an adverse event"},
    {"sequential_look", "a look at the study"},
    {"sequential_look_session", "a session of a look"},
    {"unsealing", "an unsealing"},
    {"unblinding", "an unblinding"},
    {"planned_number", "a planned number of people"},
    {"appointment", "an appointment", "participant"},
    {"acknowledgement", "a note that was read", "session"}};

}  // namespace jnd::core
