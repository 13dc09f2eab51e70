#include "analysis/export/export_options.h"

namespace jnd::analysis {

std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                const ExportOptions& options) {
  std::vector<core::SessionRow> sessions;
  for (core::SessionRow& row : store.sessions()) {
    if (!row.pilot || options.pilot) sessions.push_back(std::move(row));
  }
  return sessions;
}

}  // namespace jnd::analysis
