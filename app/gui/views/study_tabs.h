#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// The views that tabs lead to. `kData` has no tab in the headers of studies, because it
/// belongs to no study. `kOverview` has none, because it is reached from the sessions.
enum class StudyTab { kNone, kStart, kSessions, kResults, kStudy, kDevice, kData, kOverview };

struct StudyTabLook {
  StudyTab tab;
  const char *name, *label;
  char digit;  ///< The tab's key, with Ctrl.
};
/// The tabs, from the right.
inline constexpr std::array kStudyTabs = {
    StudyTabLook{StudyTab::kDevice, "tab_device", tr_later("Device"), '4'},
    StudyTabLook{StudyTab::kStudy, "tab_study", tr_later("Study"), '3'},
    StudyTabLook{StudyTab::kResults, "tab_results", tr_later("Results"), '2'},
    StudyTabLook{StudyTab::kSessions, "tab_sessions", tr_later("Sessions"), '1'},
    StudyTabLook{StudyTab::kStart, "tab_start", tr_later("Start"), '0'}};

/// Draws tabs at the right end of a header's strip and shortens the strip; `kept` of it stays
/// free. If there is too little room, keys are left out, then words are smaller. Returns the
/// tab that was chosen.
[[nodiscard]] StudyTab draw_tabs(Ui& ui, Rect& strip, const std::vector<StudyTabLook>& tabs,
                                 StudyTab current, float kept);

/// The result of the header that every view of a study has: its name, its marks, and the tabs.
/// `own_buttons` is the rectangle at the right for the view's own buttons.
struct StudyHeader {
  StudyTab chosen = StudyTab::kNone;
  Rect own_buttons;
  bool shows_marks = false;  ///< There was room to say that the data are simulated.
};
/// Draws the header. `own_width` is the width of all of the view's own buttons.
[[nodiscard]] StudyHeader draw_study_header(Ui& ui, const Rect& place, const StudyFolder& study,
                                            StudyTab current, float own_width = 0);

/// Draws the footer of these views: `left`, which says how the last work ended, and `right`.
/// `is_path` tells that `right` is a path.
void draw_study_footer(Ui& ui, const Rect& place, const std::string& left,
                       const std::string& right, bool is_path = false);

}  // namespace jnd::app::gui
