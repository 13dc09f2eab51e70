#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/gui/views/start_view.h"
#include "app/operator/background_task.h"
#include "app/operator/recent_studies.h"

namespace jnd::app::gui {

/// What the start view shows: the studies opened lately, the shipped ones, the machine, the
/// device that waits and its profile. Reads every study, so not on the thread of the window.
[[nodiscard]] StartModel look_around(const RecentStudies& recent, const std::string& device,
                                     const std::string& profile, WorkControl& control);

/// Folders and study files in a folder, folders of studies first and their backups next;
/// nothing of one that cannot be read.
[[nodiscard]] std::vector<FolderEntry> entries_of(const std::filesystem::path& folder);

}  // namespace jnd::app::gui
