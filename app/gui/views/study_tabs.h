#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// A screen that tabs and views ask for, by its name.
struct StudyTab {
  std::string_view screen;  ///< "" for none.
  bool operator==(const StudyTab&) const = default;

  static const StudyTab kNone, kStart, kSessions, kResults, kStudy, kDevice, kData, kOverview;
};
inline constexpr StudyTab StudyTab::kNone{""};
inline constexpr StudyTab StudyTab::kStart{"start"};
inline constexpr StudyTab StudyTab::kSessions{"sessions"};
inline constexpr StudyTab StudyTab::kResults{"results"};
inline constexpr StudyTab StudyTab::kStudy{"study"};
inline constexpr StudyTab StudyTab::kDevice{"device"};
inline constexpr StudyTab StudyTab::kData{"data"};
inline constexpr StudyTab StudyTab::kOverview{"overview"};

/// A tab in the headers of studies. The view that it leads to has it as a function
/// `StudyTabLook tab_of_NAME()` in its own file, where the build finds it.
struct StudyTabLook {
  StudyTab tab;
  const char *name, *label;
  char digit;  ///< The tab's key, with Ctrl.
};
/// Every tab, from the right: the larger digits first.
[[nodiscard]] std::vector<StudyTabLook> study_tabs();

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
