#pragma once

#include <filesystem>
#include <vector>

#include "app/gui/application/screen.h"
#include "app/gui/views/data_view.h"
#include "app/operator/open_data.h"

namespace jnd::app::gui {

/// Somebody's own table of answers, fitted without a study. It keeps its contents while other
/// screens are shown.
class DataScreen final : public Screen {
 public:
  explicit DataScreen(ScreenHost& host) : host_(host), data_(host.wake()) {}
  [[nodiscard]] const char* name() const noexcept override { return "data"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/from_my_csv_to_a_figure.md";
  }
  /// A file to be shown next.
  void open(const std::filesystem::path& file);
  /// Asks for a file if none is open.
  void show() override;
  void update(Ui&) override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return data_.works(); }

 private:
  ScreenHost& host_;
  OpenData data_;
  DataViewState state_;
  bool was_saving_ = false;
};

/// What a folder offers to somebody who looks for a table: tables first, then other folders.
[[nodiscard]] std::vector<FolderEntry> tables_of(const std::filesystem::path& folder);

/// Whether a file is a table of answers rather than a study. Its ending decides; a JSON file is
/// a table if it is a list.
[[nodiscard]] bool is_table(const std::filesystem::path& file);

}  // namespace jnd::app::gui
