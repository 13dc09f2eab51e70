#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/export/table_rows.h"
#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// The factors of the studies as columns of a table of trials, so that each trial tells its
/// condition. Not real time.
class FactorColumns {
 public:
  /// Of the studies of these sessions. `table`: what its rows have besides; the level of a
  /// factor whose name is taken is in `field_FACTOR`.
  FactorColumns(const core::StudyStore& store, const std::vector<core::SessionRow>& sessions,
                const std::vector<CsvColumn>& table);

  /// Those of the table, then those of the factors. Lives as long as this does.
  [[nodiscard]] const std::vector<CsvColumn>& columns() const noexcept { return columns_; }
  /// The trial's level of each factor: its block's, or the arm that the participant is in;
  /// empty where it has none. The row is not ended.
  void put(TableWriter& table, const core::SessionRow& session, const ExportedTrial& trial);

 private:
  struct Factor {
    std::string name, column, meaning;
  };

  StoredStudies studies_;
  std::vector<Factor> factors_;
  std::vector<CsvColumn> columns_;
};

}  // namespace jnd::analysis
