#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// One column of the data that a stage writes, by its name in `jnd export csv`.
struct WrittenColumn {
  std::string file;  ///< "trials.csv".
  std::string column;
  std::string unit;  ///< "" if it has no unit.
  std::string meaning;
  /// Conditions on the stage; empty if the column is always written.
  std::vector<Condition> only_where{};
};

/// Returns what a stage of this kind writes, besides the identifying columns of every row
/// (`session`, `participant`, `stage`). A procedure without columns of its own has the common
/// ones of all blocks.
[[nodiscard]] std::vector<WrittenColumn> written_columns(const ParameterTable& stage);

}  // namespace jnd::experiments
