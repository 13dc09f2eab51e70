#include "app/results/noted_export.h"

#include "analysis/export/export_options.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/storage/export_note.h"

namespace jnd::app {

std::string noted_export(const core::StudyStore& store, const std::filesystem::path& out,
                         const std::string& kind, bool pilot) try {
  core::ExportNote note{
      .place = out, .kind = kind, .time_ns = core::SystemClock().now_ns(), .sessions = {}};
  for (const core::SessionRow& row : analysis::exported_sessions(store, {.pilot = pilot})) {
    note.sessions.push_back(row.session);
  }
  if (note.sessions.empty() || !core::is_free_place(out)) return "";
  core::note_export(store.folder(), note);
  return "";
} catch (const core::Error& error) {
  return "the study does not remember that it was written to " + out.string() +
         ", so a withdrawal will not name that place: " + error.what();
}

}  // namespace jnd::app
