#pragma once

#include <string>

#include "app/gui/ui.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// Returns a study with two completed sessions and one that was interrupted.
inline StudyFolder some_study() {
  StudyFolder study{.folder = "/data/honey.study",
                    .name = "honey",
                    .title = "Honey",
                    .study_file = "/data/honey.json",
                    .num_participants_done = 2,
                    .num_sessions = 3,
                    .num_open = 1,
                    .last_session = "today"};
  using Status = SessionLine::Status;
  study.sessions = {{.session = 1,
                     .participant = "P01",
                     .status = Status::kCompleted,
                     .device = "lumped",
                     .cells = "low, then high",
                     .num_answers = 80,
                     .num_trials = 80,
                     .when = "yesterday"},
                    {.session = 2,
                     .participant = "P02",
                     .status = Status::kCompleted,
                     .device = "lumped",
                     .cells = "high, then low",
                     .num_answers = 80,
                     .num_trials = 80,
                     .when = "today"},
                    {.session = 3,
                     .participant = "P03",
                     .status = Status::kOpen,
                     .pilot = true,
                     .device = "mouse",
                     .cells = "low, then high",
                     .num_answers = 22,
                     .num_trials = 40,
                     .when = "today"}};
  study.interrupted = {{.session = 3,
                        .participant = "P03",
                        .stage = "Group D",
                        .trial = 23,
                        .num_trials = 40,
                        .num_answers = 22,
                        .recorded_min = 12.5,
                        .when = "today"}};
  return study;
}

/// Returns every text of a frame, each on its own line.
inline std::string all_texts(const Drawn& drawn) {
  std::string all;
  for (const std::string& text : drawn.texts) all += text + "\n";
  return all;
}

/// Returns whether every named widget lies inside the window and has a size.
inline bool all_on_screen(const Drawn& drawn, float width, float height) {
  for (const Drawn::Widget& widget : drawn.widgets) {
    const Rect& place = widget.place;
    if (place.width * place.height == 0) continue;  // The widget is scrolled away.
    if (place.x < 0 || place.y < 0 || place.right() > width + 0.5f ||
        place.bottom() > height + 0.5f) {
      return false;
    }
  }
  return true;
}

}  // namespace jnd::app::gui
