#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/order/cell.h"

namespace jnd::experiments {

/// Draws the study's fields for a participant of whom nothing is known. All values are equally
/// likely, and depend on (seed, participant index) alone.
[[nodiscard]] FieldValues drawn_fields(const Study& study, std::uint64_t seed,
                                       std::int64_t participant_index);

/// Returns the cell of the next participant. Of the cells with the fewest completed sessions,
/// it takes the one whose arms and orders, each counterbalance by itself, are the rarest so
/// far. Ties are drawn from (seed, participant index) alone. So drop-outs are replaced, and
/// each counterbalance stays balanced even before all cells are filled. A participant's fields
/// are not assigned. Among all cells with these fields, each counterbalance is balanced within
/// the values of the field by which it is stratified, and last of all over everybody.
///
/// `completed` holds the cells of completed sessions as text. Cells of another version of the
/// study are ignored. Throws `Error` if `fields` lacks a field of the study.
[[nodiscard]] Cell least_filled_cell(const Study& study,
                                     const std::vector<std::string>& completed,
                                     std::uint64_t seed, std::int64_t participant_index,
                                     const FieldValues& fields = {});

/// Returns the cells of the next `num_participants`, each assigned as if all before it had
/// completed. All have these `fields`; if there are none, the fields are drawn for each.
[[nodiscard]] std::vector<Cell> planned_cells(
    const Study& study, std::vector<std::string> completed, std::uint64_t seed,
    std::int64_t first_participant_index, int num_participants, const FieldValues& fields = {});

/// A stage as one participant meets it.
struct StageInstance {
  const Stage* stage = nullptr;  ///< Points into the study; never a counterbalance.
  /// Such as "method_order/production/magnitude_production"; unique in the list.
  std::string path;
  std::size_t order_row = 0;  ///< Row of a block's square; 0 without one.
  Levels people;              ///< As returned by `people_levels`.
};

/// Returns the block of a stage as procedures draw it, for a participant who begins with this
/// row. Its levels are extended by `people` and by its own name, as a level of `block`.
[[nodiscard]] Block block_of(const Stage& stage, std::size_t row, const Levels& people = {});

/// Returns the participant's own list of stages: counterbalances are resolved and stages for
/// others left out. Throws `Error` if the cell is not one of this study. The study must outlive
/// the list.
[[nodiscard]] std::vector<StageInstance> stages_of(const Study& study, const Cell& cell);

}  // namespace jnd::experiments
