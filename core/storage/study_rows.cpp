#include "core/storage/study_rows.h"

#include <charconv>
#include <cstdint>

namespace jnd::core {

std::string insert_into(const std::string& table, const std::string& columns) {
  std::string marks = "?";
  for (const char letter : columns) {
    if (letter == ',') marks += ", ?";
  }
  return "INSERT INTO " + table + " (" + columns + ") VALUES (" + marks + ")";
}

void bind(const EventRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.sequence)
      .bind(row.kind)
      .bind(std::int64_t{row.version})
      .bind(row.time_ns)
      .bind(row.stage)
      .bind(row.trial)
      .bind(row.attempt)
      .bind(row.first_tick)
      .bind(row.last_tick)
      .bind(row.intensity)
      .bind(row.supersedes)
      .bind(row.data)
      .run();
}

void bind(const DesignRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.trial)
      .bind(row.stage)
      .bind(row.block)
      .bind(row.procedure)
      .bind(row.medium)
      .bind(row.quantity)
      .bind(row.repetition)
      .bind(row.position)
      .bind(row.intensity)
      .bind(row.reference_intensity)
      .bind(row.starting_intensity)
      .bind(row.target_percent)
      .bind(row.sequence)
      .bind(row.series)
      .bind(row.test_interval)
      .bind(std::int64_t{row.is_catch})
      .run();
}

void bind(const PresentationRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.trial)
      .bind(row.attempt)
      .bind(row.presentation)
      .bind(row.sequence)
      .bind(row.interval)
      .bind(row.intensity)
      .bind(row.first_tick)
      .bind(row.last_tick)
      .bind(row.stroke_width_m)
      .bind(row.max_speed_m_per_s)
      .bind(row.mean_height_m)
      .bind(row.num_strokes)
      .bind(row.delivered_damping_n_s_per_m)
      .bind(row.commanded_damping_n_s_per_m)
      .bind(row.limited_ticks)
      .bind(row.finger_lag_s)
      .bind(row.missed_ticks)
      .run();
}

void bind(const TrialRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.trial)
      .bind(row.attempt)
      .bind(row.sequence)
      .bind(row.block)
      .bind(row.procedure)
      .bind(row.medium)
      .bind(row.quantity)
      .bind(row.repetition)
      .bind(row.position)
      .bind(row.intensity)
      .bind(row.reference_intensity)
      .bind(row.starting_intensity)
      .bind(row.target_percent)
      .bind(row.response)
      .bind(row.response_time_s)
      .bind(row.num_presentations)
      .bind(row.num_steps)
      .bind(row.first_tick)
      .bind(row.last_tick)
      .bind(row.series)
      .bind(row.test_interval)
      .bind(std::int64_t{row.is_catch})
      .run();
}

void bind(const AnswerRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.sequence)
      .bind(row.stage)
      .bind(row.item)
      .bind(row.answer)
      .run();
}

void bind(const SessionRow& row, Statement& statement) {
  statement.bind(row.session)
      .bind(row.participant)
      .bind(row.protocol_sha256)
      .bind(std::to_string(row.seed))
      .bind(row.cells)
      .bind(std::int64_t{row.pilot})
      .bind(std::int64_t{row.simulated})
      .bind(row.device)
      .bind(row.laboratory)
      .bind(row.program_version)
      .bind(row.realtime)
      .bind(row.rate_hz)
      .bind(std::int64_t{row.recorded})
      .bind(row.started_time_ns)
      .run();
}

EventRow event_row(const Statement& rows) {
  return {.session = rows.integer(0),
          .sequence = rows.integer(1),
          .kind = rows.text(2),
          .version = static_cast<int>(rows.integer(3)),
          .time_ns = rows.integer(4),
          .stage = rows.optional_integer(5),
          .trial = rows.optional_integer(6),
          .attempt = rows.optional_integer(7),
          .first_tick = rows.optional_integer(8),
          .last_tick = rows.optional_integer(9),
          .intensity = rows.optional_number(10),
          .supersedes = rows.optional_integer(11),
          .data = rows.text(12)};
}

DesignRow design_row(const Statement& rows) {
  return {.session = rows.integer(0),
          .trial = rows.integer(1),
          .stage = rows.integer(2),
          .block = rows.text(3),
          .procedure = rows.text(4),
          .medium = rows.text(5),
          .quantity = rows.text(6),
          .repetition = rows.integer(7),
          .position = rows.integer(8),
          .intensity = rows.optional_number(9),
          .reference_intensity = rows.optional_number(10),
          .starting_intensity = rows.optional_number(11),
          .target_percent = rows.optional_number(12),
          .sequence = rows.optional_integer(13),
          .series = rows.optional_integer(14),
          .test_interval = rows.optional_integer(15),
          .is_catch = rows.optional_integer(16).value_or(0) != 0};
}

PresentationRow presentation_row(const Statement& rows) {
  return {.session = rows.integer(0),
          .trial = rows.integer(1),
          .attempt = rows.integer(2),
          .presentation = rows.integer(3),
          .sequence = rows.integer(4),
          .interval = rows.text(5),
          .intensity = rows.number(6),
          .first_tick = rows.integer(7),
          .last_tick = rows.integer(8),
          .stroke_width_m = rows.optional_number(9),
          .max_speed_m_per_s = rows.optional_number(10),
          .mean_height_m = rows.optional_number(11),
          .num_strokes = rows.integer(12),
          .delivered_damping_n_s_per_m = rows.optional_number(13),
          .commanded_damping_n_s_per_m = rows.optional_number(14),
          .limited_ticks = rows.integer(15),
          .finger_lag_s = rows.optional_number(16),
          .missed_ticks = rows.integer(17)};
}

TrialRow trial_row(const Statement& rows) {
  return {.session = rows.integer(0),
          .trial = rows.integer(1),
          .attempt = rows.integer(2),
          .sequence = rows.integer(3),
          .block = rows.text(4),
          .procedure = rows.text(5),
          .medium = rows.text(6),
          .quantity = rows.text(7),
          .repetition = rows.integer(8),
          .position = rows.integer(9),
          .intensity = rows.optional_number(10),
          .reference_intensity = rows.optional_number(11),
          .starting_intensity = rows.optional_number(12),
          .target_percent = rows.optional_number(13),
          .response = rows.optional_number(14),
          .response_time_s = rows.optional_number(15),
          .num_presentations = rows.integer(16),
          .num_steps = rows.integer(17),
          .first_tick = rows.integer(18),
          .last_tick = rows.integer(19),
          .series = rows.optional_integer(20),
          .test_interval = rows.optional_integer(21),
          .is_catch = rows.optional_integer(22).value_or(0) != 0};
}

AnswerRow answer_row(const Statement& rows) {
  return {.session = rows.integer(0),
          .sequence = rows.integer(1),
          .stage = rows.text(2),
          .item = rows.text(3),
          .answer = rows.text(4)};
}

SessionRow session_row(const Statement& rows) {
  SessionRow row;
  row.session = rows.integer(0);
  row.participant = rows.text(1);
  row.protocol_sha256 = rows.text(2);
  const std::string seed = rows.text(3);
  std::from_chars(seed.data(), seed.data() + seed.size(), row.seed);
  row.cells = rows.text(4);
  row.pilot = rows.integer(5) != 0;
  row.simulated = rows.integer(6) != 0;
  row.device = rows.text(7);
  row.laboratory = rows.text(8);
  row.program_version = rows.text(9);
  row.realtime = rows.text(10);
  row.rate_hz = rows.number(11);
  row.recorded = rows.integer(12) != 0;
  row.started_time_ns = rows.integer(13);
  return row;
}

}  // namespace jnd::core
