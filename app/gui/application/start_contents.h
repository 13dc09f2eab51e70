#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/gui/views/start_view.h"
#include "app/operator/background_task.h"
#include "app/operator/recent_studies.h"

namespace jnd::app::gui {

/// Collects what the start view shows: recent studies, shipped studies, the machine, and the
/// proposed device with its profile. It reads every study, so call it outside the window's
/// thread.
[[nodiscard]] StartModel look_around(const RecentStudies& recent, const std::string& device,
                                     const std::string& profile, WorkControl& control);

/// The folders and study files in a folder: folders of studies first, then their backups. Empty
/// if the folder cannot be read.
[[nodiscard]] std::vector<FolderEntry> entries_of(const std::filesystem::path& folder);

}  // namespace jnd::app::gui
