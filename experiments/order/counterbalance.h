#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/order/cell.h"

namespace jnd::experiments {

/// Values of the study's fields for a participant of whom nobody told any: each as likely as
/// the other, drawn from (seed, participant index) alone.
[[nodiscard]] FieldValues drawn_fields(const Study& study, std::uint64_t seed,
                                       std::int64_t participant_index);

/// The cell of the next participant: of those with the fewest completed sessions, the one whose
/// arms and orders, each counterbalance taken by itself, are the rarest so far; ties are drawn
/// from (seed, participant index) alone. So drop-outs are made up for, and each counterbalance
/// stays even by itself while the cells are still filling up. What a participant brings is not
/// assigned: among all cells with these values, each counterbalance evens out within the values
/// of the field that it is stratified by, and last of all over everybody.
///
/// `completed` holds the cells of completed sessions as text; those of another version of the
/// study are left out. Throws `Error` if `fields` lacks a field of the study.
[[nodiscard]] Cell least_filled_cell(const Study& study,
                                     const std::vector<std::string>& completed,
                                     std::uint64_t seed, std::int64_t participant_index,
                                     const FieldValues& fields = {});

/// Cells of the next `num_participants`, each assigned as if all before it completed. All of
/// them bring `fields`; without any, what each brings is drawn.
[[nodiscard]] std::vector<Cell> planned_cells(
    const Study& study, std::vector<std::string> completed, std::uint64_t seed,
    std::int64_t first_participant_index, int num_participants, const FieldValues& fields = {});

/// A stage as one participant meets it.
struct StageInstance {
  const Stage* stage = nullptr;  ///< Into the study, never a counterbalance.
  std::string path;  ///< "method_order/production/magnitude_production"; unique in the list.
  std::size_t order_row = 0;  ///< Of a block's square; 0 without one.
  Levels people;              ///< See `people_levels`.
};

/// The block of a stage, as procedures draw it, for a participant who begins with this row. Its
/// levels are joined by those of `people` and by its own name, as a level of `block`.
[[nodiscard]] Block block_of(const Stage& stage, std::size_t row, const Levels& people = {});

/// The participant's own list of stages: counterbalances resolved, stages for others left out.
/// Throws `Error` if the cell is not one of this study. The study must outlive the list.
[[nodiscard]] std::vector<StageInstance> stages_of(const Study& study, const Cell& cell);

}  // namespace jnd::experiments
