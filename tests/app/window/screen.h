#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// What the window shows, as it says itself.
struct Screen {
  struct Widget {
    std::string name, label;
    std::string key;                          ///< As printed on it: "Ctrl Z".
    int x = 0, y = 0, width = 0, height = 0;  ///< Pixels of the window.
    bool enabled = false;
  };
  std::string view;
  std::uint64_t frame = 0;
  std::vector<Widget> widgets;
  std::vector<std::string> texts;

  [[nodiscard]] const Widget* find(std::string_view name) const;
  /// It is there, to be seen and enabled.
  [[nodiscard]] bool offers(std::string_view name) const;
  /// Some text contains it.
  [[nodiscard]] bool shows(std::string_view part) const;
  /// The first text that begins with this; "" if none does.
  [[nodiscard]] std::string text_after(std::string_view beginning) const;
};

/// What the program wrote for its last frame that showed anything new; empty before the first.
[[nodiscard]] Screen read_screen(const std::filesystem::path& file);

/// The same in words, for whoever waited for something else.
[[nodiscard]] std::string described(const Screen& screen);

}  // namespace jnd::app
