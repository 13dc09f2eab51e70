#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// `kData` has no tab in the headers of studies: it is of none. Nor has `kOverview`, which is
/// reached from the sessions.
enum class StudyTab { kNone, kStart, kSessions, kResults, kStudy, kDevice, kData, kOverview };

struct StudyTabLook {
  StudyTab tab;
  const char *name, *label;
  char digit;  ///< Its key, with Ctrl.
};
/// From the right.
inline constexpr std::array kStudyTabs = {
    StudyTabLook{StudyTab::kDevice, "tab_device", tr_later("Device"), '4'},
    StudyTabLook{StudyTab::kStudy, "tab_study", tr_later("Study"), '3'},
    StudyTabLook{StudyTab::kResults, "tab_results", tr_later("Results"), '2'},
    StudyTabLook{StudyTab::kSessions, "tab_sessions", tr_later("Sessions"), '1'},
    StudyTabLook{StudyTab::kStart, "tab_start", tr_later("Start"), '0'}};

/// At the right end of a header's strip, which it shortens; `kept` of it stays free. Where
/// there is too little room, keys give way, then words are smaller. Returns the tab that was
/// chosen.
[[nodiscard]] StudyTab draw_tabs(Ui& ui, Rect& strip, const std::vector<StudyTabLook>& tabs,
                                 StudyTab current, float kept);

/// The header of every view of a study: its name, its marks, and the tabs. Leaves room at the
/// right for a view's own buttons: `own_buttons` is that rectangle. Returns the tab that was
/// chosen.
struct StudyHeader {
  StudyTab chosen = StudyTab::kNone;
  Rect own_buttons;
  bool shows_marks = false;  ///< There was room to say that the data are simulated.
};
/// `own_width`: how wide the view's own buttons are together.
[[nodiscard]] StudyHeader draw_study_header(Ui& ui, const Rect& place, const StudyFolder& study,
                                            StudyTab current, float own_width = 0);

/// The footer of these views: `left`, what came of the last work, and `right` in words.
/// `is_path`: what is at the right is one.
void draw_study_footer(Ui& ui, const Rect& place, const std::string& left,
                       const std::string& right, bool is_path = false);

}  // namespace jnd::app::gui
