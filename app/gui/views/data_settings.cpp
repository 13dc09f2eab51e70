// The settings: what the columns are, and which curve is fitted. Each has a row, which a click
// or a key changes.

#include <algorithm>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/operator/curve_choices.h"

namespace jnd::app::gui {
namespace {

using DataDialog = DataViewState::Dialog;

constexpr float kSettingRow = 40;

struct Setting {
  const char* name;
  const char* label;
  std::string value;
  char key;
  /// With `kNone`, the setting changes without a dialog.
  DataDialog dialog = DataDialog::kNone;
  bool is_lacking = false;  ///< Nothing can be fitted without this setting.
};

std::string joined_words(const std::vector<std::string>& words, const std::string& none) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? none : text;
}

std::string filters_words(const CurveRequest& request) {
  std::vector<std::string> words;
  for (const std::string& where : request.where) {
    const RowFilter filter = filter_of(where);
    words.push_back(filter.column + " = " + filter.cell);
  }
  return joined_words(words, tr("all"));
}

std::string task_words(const CurveRequest& request) {
  if (request.guess == "free") return tr("guess rate fitted");
  if (!request.guess.empty()) return tr("guess rate {}", request.guess);
  const std::string forced = "mafc:";
  if (request.task.starts_with(forced)) {
    return tr("right ones among {}", request.task.substr(forced.size()));
  }
  return tr("yes or no");
}

std::string levels_words(const CurveRequest& request) {
  std::vector<std::string> words;
  for (const double at : request.at) words.push_back(formatted("%.4g", at));
  return joined_words(words, "");
}

std::vector<Setting> column_settings(const CurveRequest& request) {
  std::vector<Setting> all;
  const bool no_intensity = request.intensity.empty(), no_answers = request.yes.empty();
  all.push_back({"set_intensity", tr("Intensity"),
                 no_intensity ? tr("choose a column") : request.intensity, 'I',
                 DataDialog::kIntensity, no_intensity});
  all.push_back({"set_yes", tr("Answers"), no_answers ? tr("choose a column") : request.yes,
                 'Y', DataDialog::kYes, no_answers});
  if (request.trials.empty()) {
    all.push_back({"set_yes_value", tr("A yes is"),
                   request.yes_value.empty() ? tr("1, true or yes") : request.yes_value, 'V',
                   DataDialog::kYesValue});
  }
  all.push_back({"set_trials", tr("Trials"),
                 request.trials.empty() ? tr("each row is one") : request.trials, 'N',
                 DataDialog::kTrials});
  all.push_back({"set_groups", tr("A curve for each"),
                 joined_words(request.group_by, tr("one for all rows")), 'G',
                 DataDialog::kGroups});
  all.push_back({"set_filters", tr("Rows"), filters_words(request), 'W', DataDialog::kFilters});
  return all;
}

std::vector<Setting> curve_settings(const CurveRequest& request) {
  const bool is_log = request.axis == "log";
  return {{"set_family", tr("Family"), request.family, 'F', DataDialog::kFamily},
          {"set_axis", tr("Axis"), is_log ? tr("logarithm") : tr("linear"), 'X'},
          {"set_task", tr("Answers are"), task_words(request), 'T', DataDialog::kTask},
          {"set_lapse", tr("Lapse rate"),
           request.lapse == "free" ? tr("fitted") : request.lapse, 'L', DataDialog::kLapse},
          {"set_levels", tr("Thresholds at"), levels_words(request), 'A', DataDialog::kLevels},
          {"set_interval", tr("95 % intervals"), chosen_label(interval_choices(), request), 'B',
           DataDialog::kInterval},
          {"set_goodness", tr("Goodness of fit"), chosen_label(goodness_choices(), request),
           'D', DataDialog::kGoodness}};
}

/// Draws the setting's name at the left, and its value in a frame with its key.
bool draw_setting(Ui& ui, Rect line, const Setting& setting, float label_width) {
  ui.text(line.take_left(label_width, 8), setting.label,
          {.font = Font::kSmall, .colour = Colour::kSoft});
  const Rect box = line.middle(line.width, kSettingRow - 6);
  const Chord key{letter(setting.key)};
  ui.outline(box, setting.is_lacking ? Colour::kAmber : Colour::kLine, 8,
             setting.is_lacking ? 1.5f : 1.0f);
  const bool is_used = ui.row(setting.name, box, setting.label, key);
  Rect inside = box;
  inside.take_left(10);
  inside.take_right(8);
  const Rect cap = inside.take_right(ui.key_cap_width(key), 8);
  ui.key_cap(cap.x, cap.y + (cap.height - Ui::kKeyCapHeight) / 2, key);
  ui.text(inside, setting.value,
          {.font = Font::kSmallStrong,
           .colour = setting.is_lacking ? Colour::kAmber : Colour::kInk,
           .any_length = !setting.is_lacking});
  return is_used;
}

float settings_card_height(std::size_t num_settings) {
  return 28 + kSettingRow * static_cast<float>(num_settings) + 2 * kPadding;
}

/// Returns the setting that was used, or nullptr.
const Setting* draw_settings_card(Ui& ui, const Rect& place, const char* heading,
                                  const std::vector<Setting>& settings) {
  Rect inside = draw_card(ui, place, heading);
  const Setting* used = nullptr;
  // Names take less than half of the width; they may stand on two lines.
  float label_width = 0;
  for (const Setting& setting : settings) {
    label_width = std::max(label_width, ui.text_width(setting.label, Font::kSmall) + 2);
  }
  label_width = std::clamp(label_width, 90.0f, 0.44f * inside.width);
  for (const Setting& setting : settings) {
    if (draw_setting(ui, inside.take_top(kSettingRow), setting, label_width)) used = &setting;
  }
  return used;
}

}  // namespace

std::string role_words(ColumnRole role) {
  switch (role) {
    case ColumnRole::kIntensity:
      return tr("intensity");
    case ColumnRole::kYes:
      return tr("answers");
    case ColumnRole::kTrials:
      return tr("trials");
    case ColumnRole::kGroup:
      return tr("a curve for each");
    case ColumnRole::kNone:
      break;
  }
  return "";
}

void draw_data_settings(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                        DataViewResult& result) {
  const std::vector<Setting> columns = column_settings(data.request);
  const std::vector<Setting> curve = curve_settings(data.request);
  const float of_columns = settings_card_height(columns.size());
  const float of_curve = settings_card_height(curve.size());
  // If room is short, the cards first move closer together before they scroll.
  const float gap = std::clamp(place.height - of_columns - of_curve, 8.0f, kGap);
  Rect inside = ui.begin_scroll("settings", place, of_columns + gap + of_curve);
  const Setting* used =
      draw_settings_card(ui, inside.take_top(of_columns, gap), tr("Columns"), columns);
  const Setting* of_fit = draw_settings_card(ui, inside.take_top(of_curve), tr("Curve"), curve);
  ui.end_scroll();
  if (used == nullptr) used = of_fit;
  if (used == nullptr) return;
  if (used->dialog != DataDialog::kNone) {
    open_data_dialog(state, used->dialog,
                     used->dialog == DataDialog::kLevels ? levels_words(data.request) : "");
    return;
  }
  CurveRequest request = data.request;
  request.axis = request.axis == "log" ? "linear" : "log";
  result.request = request;
}

}  // namespace jnd::app::gui
