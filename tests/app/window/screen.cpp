#include "app/window/screen.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace jnd::app {

const Screen::Widget* Screen::find(std::string_view name) const {
  const auto found = std::ranges::find(widgets, name, &Widget::name);
  return found == widgets.end() ? nullptr : &*found;
}

bool Screen::offers(std::string_view name) const {
  const Widget* widget = find(name);
  return widget != nullptr && widget->enabled && widget->width > 0 && widget->height > 0;
}

bool Screen::shows(std::string_view part) const {
  return std::ranges::any_of(
      texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

std::string Screen::text_after(std::string_view beginning) const {
  for (const std::string& text : texts) {
    if (text.starts_with(beginning)) return text.substr(beginning.size());
  }
  return "";
}

Screen read_screen(const std::filesystem::path& file) {
  Screen screen;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return screen;
  screen.view = json.at("view");
  screen.frame = json.at("frame");
  screen.texts = json.at("texts");
  for (const auto& widget : json.at("widgets")) {
    screen.widgets.push_back({.name = widget.at("name"),
                              .label = widget.at("label"),
                              .key = widget.at("key"),
                              .x = widget.at("x"),
                              .y = widget.at("y"),
                              .width = widget.at("width"),
                              .height = widget.at("height"),
                              .enabled = widget.at("enabled")});
  }
  return screen;
}

std::string described(const Screen& screen) {
  std::string words =
      "the view " + screen.view + " shows in frame " + std::to_string(screen.frame) + ":\n";
  for (const Screen::Widget& widget : screen.widgets) {
    words += (widget.enabled ? " [" : " (") + widget.name + (widget.enabled ? "]" : ")");
  }
  words += "\n";
  for (const std::string& text : screen.texts) words += "  " + text + "\n";
  return words;
}

}  // namespace jnd::app
