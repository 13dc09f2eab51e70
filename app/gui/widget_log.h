#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// What was drawn, as JSON with places in the window's pixels:
///     {"view": "run", "frame": 12, "scale": 1, "widgets": [{"name": "yes", "label": "Thicker",
///      "key": "Y", "x": 1, "y": 2, "width": 3, "height": 4, "enabled": true}], "texts":
///      ["..."]}
[[nodiscard]] std::string widgets_json(const Drawn& drawn, float scale);

/// Writes each frame that shows something new into the file, and replaces the file as a whole.
/// Beside it, FILE.texts collects every text that was on the screen, however shortly, once and
/// one on a line, and a sentence for each key that two controls share.
class WidgetLog {
 public:
  /// An empty path switches the log off.
  explicit WidgetLog(std::filesystem::path file) : file_(std::move(file)) {}
  /// Throws `core::Error` if the file cannot be written.
  void write(const Drawn& drawn, float scale);
  /// Collects the texts of another window, and nothing else of it.
  void keep_texts(const Drawn& drawn);

 private:
  std::filesystem::path file_;
  std::set<std::string> texts_;
  Drawn last_;
  float last_scale_ = 0.0f;
};

}  // namespace jnd::app::gui
