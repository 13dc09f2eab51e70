#include "app/gui/application/data_screen.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <utility>

#include "app/language/words.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

bool is_table(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".json") {
    std::ifstream in(file, std::ios::binary);
    char first = ' ';
    in >> first;
    return in && first == '[';
  }
  static constexpr std::array<std::string_view, 8> kEndings = {".csv", ".tsv", ".txt", ".dat",
                                                               ".tab", ".CSV", ".TSV", ".TXT"};
  return std::ranges::find(kEndings, ending) != kEndings.end();
}

std::vector<FolderEntry> tables_of(const fs::path& folder) {
  std::vector<FolderEntry> entries;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with(".")) continue;
    std::error_code ignored;
    if (entry.is_directory(ignored)) {
      entries.push_back({entry.path(), FolderEntry::Kind::kFolder});
    } else if (is_table(entry.path())) {
      entries.push_back({entry.path(), FolderEntry::Kind::kTable});
    }
  }
  std::ranges::sort(entries, {}, [](const FolderEntry& entry) {
    return std::pair(entry.kind == FolderEntry::Kind::kFolder, entry.path);
  });
  return entries;
}

void DataScreen::open(const fs::path& file) {
  // The dialog keeps the folder that was browsed, because the next file is often beside this
  // one.
  FileDialogState opening = std::move(state_.opening);
  state_ = {};
  state_.opening = std::move(opening);
  data_.open(fs::absolute(file).lexically_normal());
}

void DataScreen::show() {
  if (!data_.view().file.empty()) return;
  state_.dialog = DataViewState::Dialog::kFile;
  begin_file_dialog(state_.opening, {});
}

/// If saving fails, tells so in a message that nobody overlooks.
void DataScreen::update(Ui&) {
  data_.collect();
  const DataView& view = data_.view();
  if (std::exchange(was_saving_, view.is_saving) && !view.is_saving && !view.outcome.ok) {
    host_.tell(tr("It cannot be saved"), view.outcome.sentence);
  }
}

void DataScreen::draw(Ui& ui) {
  const DataViewResult result = draw_data_view(ui, data_.view(), tables_of, state_);
  if (result.open) open(*result.open);
  if (result.request) data_.ask(*result.request);
  if (result.compare) data_.compare();
  if (result.save_picture) data_.save_picture(*result.save_picture);
  if (result.save_table) data_.save_table(*result.save_table);
  // Saving may be over before the next look, so it is remembered here.
  was_saving_ |= result.save_picture || result.save_table;
  if (result.tab != StudyTab::kNone) host_.go_to(result.tab);
}

}  // namespace jnd::app::gui
