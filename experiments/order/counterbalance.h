#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// What one counterbalance gives a participant: all of its arms in an order, or one of them.
struct Assignment {
  std::string counterbalance;     ///< Name of its stage.
  std::vector<std::string> arms;  ///< Names, in the order in which they are run.

  bool operator==(const Assignment&) const = default;
};

/// One assignment for each counterbalance of a study, in the order of its stages.
using Cell = std::vector<Assignment>;

/// "priming=primed;method_order=estimation,production"; "" without a counterbalance. This form
/// is what is stored and shown.
[[nodiscard]] std::string to_string(const Cell& cell);

/// Reads that form back. Throws `Error` if it is not a cell of this study.
[[nodiscard]] Cell cell_from_text(const Study& study, const std::string& text);

/// Every cell, the counterbalances crossed. `order` gives all orders of two or three arms; of
/// more, the rows of a Williams square (1949), in which every arm stands equally often in every
/// place and follows every other arm equally often. One empty cell for a study without.
[[nodiscard]] std::vector<Cell> cells_of(const Study& study);

/// The cell of the next participant: of those with the fewest completed sessions, the one whose
/// arms and orders, each counterbalance taken by itself, are the rarest so far; ties are drawn
/// from (seed, participant index) alone. So drop-outs are made up for, and each counterbalance
/// stays even by itself while the cells are still filling up.
///
/// `completed` holds the cells of completed sessions as text; those of another version of the
/// study are left out.
[[nodiscard]] Cell least_filled_cell(const Study& study,
                                     const std::vector<std::string>& completed,
                                     std::uint64_t seed, std::int64_t participant_index);

/// Cells of the next `num_participants`, each assigned as if all before it completed.
[[nodiscard]] std::vector<Cell> planned_cells(const Study& study,
                                              std::vector<std::string> completed,
                                              std::uint64_t seed,
                                              std::int64_t first_participant_index,
                                              int num_participants);

/// A stage as one participant meets it.
struct StageInstance {
  const Stage* stage = nullptr;  ///< Into the study, never a counterbalance.
  std::string path;  ///< "method_order/production/magnitude_production"; unique in the list.
};

/// The participant's own list of stages: counterbalances resolved, stages for others left out.
/// Throws `Error` if the cell is not one of this study. The study must outlive the list.
[[nodiscard]] std::vector<StageInstance> stages_of(const Study& study, const Cell& cell);

}  // namespace jnd::experiments
