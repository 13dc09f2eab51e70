#include "app/gui/widget_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "core/error.h"

namespace jnd::app::gui {
namespace {

/// Writes a JSON string. Drawn texts are valid UTF-8, because they come from JSON.
std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(byte));
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string pixel_text(float logical, float scale) {
  return std::to_string(std::lround(logical * scale));
}

std::string widget_json(const Drawn::Widget& widget, float scale) {
  return "{\"name\": " + json_string(widget.name) +
         ", \"label\": " + json_string(widget.label) + ", \"key\": " + json_string(widget.key) +
         ", \"x\": " + pixel_text(widget.place.x, scale) +
         ", \"y\": " + pixel_text(widget.place.y, scale) +
         ", \"width\": " + pixel_text(widget.place.width, scale) +
         ", \"height\": " + pixel_text(widget.place.height, scale) +
         ", \"enabled\": " + (widget.enabled ? "true" : "false") + "}";
}

bool shows_the_same(const Drawn& a, const Drawn& b) {
  return a.view == b.view && a.widgets == b.widgets && a.texts == b.texts;
}

}  // namespace

std::string widgets_json(const Drawn& drawn, float scale) {
  std::array<char, 32> scale_words{};
  std::snprintf(scale_words.data(), scale_words.size(), "%.6g", static_cast<double>(scale));
  std::string json = "{\"view\": " + json_string(drawn.view) +
                     ", \"frame\": " + std::to_string(drawn.frame) +
                     ", \"scale\": " + scale_words.data() + ",\n \"widgets\": [";
  const char* separator = "\n  ";
  for (const Drawn::Widget& widget : drawn.widgets) {
    json += separator + widget_json(widget, scale);
    separator = ",\n  ";
  }
  json += "],\n \"texts\": [";
  separator = "\n  ";
  for (const std::string& text : drawn.texts) {
    json += separator + json_string(text);
    separator = ",\n  ";
  }
  return json + "]}\n";
}

void WidgetLog::keep_texts(const Drawn& drawn) {
  if (file_.empty()) return;
  std::filesystem::path kept = file_;
  kept += ".texts";
  std::ofstream out;
  std::vector<std::string> texts = drawn.texts;
  for (const std::string& key : drawn.shared_keys) {
    texts.push_back("more than one control of " + drawn.view + " has the key " + key);
  }
  for (std::string text : texts) {
    std::ranges::replace(text, '\n', ' ');
    if (!texts_.insert(text).second) continue;
    if (!out.is_open()) out.open(kept, std::ios::app);
    out << text << '\n';
  }
}

void WidgetLog::write(const Drawn& drawn, float scale) {
  if (file_.empty() || (scale == last_scale_ && shows_the_same(drawn, last_))) return;
  keep_texts(drawn);
  std::filesystem::path unfinished = file_;
  unfinished += ".tmp";
  std::ofstream out(unfinished, std::ios::trunc);
  out << widgets_json(drawn, scale);
  out.close();
  std::error_code problem;
  if (out) std::filesystem::rename(unfinished, file_, problem);
  if (!out || problem) {
    throw core::Error(file_.string() +
                      ": expected a file that can be written, as JND_WIDGETS "
                      "names it; choose another one");
  }
  last_ = drawn;
  last_scale_ = scale;
}

}  // namespace jnd::app::gui
