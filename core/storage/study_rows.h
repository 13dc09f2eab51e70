#pragma once

#include <string>

#include "core/storage/database.h"
#include "core/storage/study_store.h"

namespace jnd::core {

// The rows of study.sqlite as SQL: columns in one order for writing and reading. The words are
// those of data/database.

inline constexpr char kEventColumns[] =
    "session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick, last_tick, "
    "intensity, supersedes, data";
inline constexpr char kDesignColumns[] =
    "session, trial, stage, block, procedure, medium, quantity, repetition, position, "
    "intensity, "
    "reference_intensity, starting_intensity, target_percent, sequence, series, "
    "test_interval, is_catch";
inline constexpr char kPresentationColumns[] =
    "session, trial, attempt, presentation, sequence, interval, intensity, first_tick, "
    "last_tick, "
    "stroke_width_m, max_speed_m_per_s, mean_height_m, num_strokes, "
    "delivered_damping_n_s_per_m, "
    "commanded_damping_n_s_per_m, limited_ticks, finger_lag_s, missed_ticks";
inline constexpr char kTrialColumns[] =
    "session, trial, attempt, sequence, block, procedure, medium, quantity, repetition, "
    "position, "
    "intensity, reference_intensity, starting_intensity, target_percent, response, "
    "response_time_s, num_presentations, num_steps, first_tick, last_tick, series, "
    "test_interval, "
    "is_catch";
inline constexpr char kAnswerColumns[] = "session, sequence, stage, item, answer";
inline constexpr char kSessionColumns[] =
    "session, participant, protocol_sha256, seed, cells, pilot, simulated, device, laboratory, "
    "program_version, realtime, rate_hz, recorded, started_time_ns";

/// "INSERT INTO table (columns) VALUES (?, ...)".
[[nodiscard]] std::string insert_into(const std::string& table, const std::string& columns);

/// Carries out an insert with the columns of the row.
void bind(const EventRow& row, Statement& statement);
void bind(const DesignRow& row, Statement& statement);
void bind(const PresentationRow& row, Statement& statement);
void bind(const TrialRow& row, Statement& statement);
void bind(const AnswerRow& row, Statement& statement);
void bind(const SessionRow& row, Statement& statement);

/// The row that the statement stands on; selected with all its columns, in their order.
[[nodiscard]] EventRow event_row(const Statement& rows);
[[nodiscard]] DesignRow design_row(const Statement& rows);
[[nodiscard]] PresentationRow presentation_row(const Statement& rows);
[[nodiscard]] TrialRow trial_row(const Statement& rows);
[[nodiscard]] AnswerRow answer_row(const Statement& rows);
[[nodiscard]] SessionRow session_row(const Statement& rows);

}  // namespace jnd::core
