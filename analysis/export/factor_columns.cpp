#include "analysis/export/factor_columns.h"

#include <algorithm>
#include <set>

#include "analysis/data/cell_arms.h"

namespace jnd::analysis {

FactorColumns::FactorColumns(const core::StudyStore& store,
                             const std::vector<core::SessionRow>& sessions,
                             const std::vector<CsvColumn>& table)
    : studies_(store), columns_(table) {
  std::vector<std::string> taken;
  for (const CsvColumn& column : table) taken.emplace_back(column.name);
  std::set<std::string> seen;
  for (const core::SessionRow& session : sessions) {
    if (!seen.insert(session.protocol_sha256).second) continue;
    for (const experiments::DesignFactor& factor :
         studies_.study(session.protocol_sha256).factors) {
      if (std::ranges::find(factors_, factor.name, &Factor::name) != factors_.end()) continue;
      std::string levels;
      for (const std::string& level : factor.levels) {
        levels += (levels.empty() ? "" : ", ") + level;
      }
      factors_.push_back({.name = factor.name,
                          .column = field_column(factor.name, taken),
                          .meaning = "Level of this factor of the study: " + levels +
                                     "; empty where the trial has none"});
    }
  }
  for (const Factor& factor : factors_) {
    columns_.push_back({factor.column.c_str(), "", factor.meaning.c_str()});
  }
}

void FactorColumns::put(TableWriter& table, const core::SessionRow& session,
                        const ExportedTrial& trial) {
  if (factors_.empty()) return;
  const experiments::Levels& levels =
      studies_.block(session.protocol_sha256, trial.row.block).levels;
  const std::map<std::string, std::string> arms = arms_of(session.cells);
  for (const Factor& factor : factors_) {
    if (const auto level = levels.find(factor.name); level != levels.end()) {
      table.cell(level->second);
    } else if (const auto arm = arms.find(factor.name); arm != arms.end()) {
      table.cell(arm->second);
    } else {
      table.cell("");
    }
  }
}

}  // namespace jnd::analysis
