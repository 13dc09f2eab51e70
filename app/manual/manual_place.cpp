#include "app/manual/manual_place.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// Pages of the manual outside of docs.
constexpr std::array kOtherPages = {"README.md",
                                    "ARCHITECTURE.md",
                                    "CHANGELOG.md",
                                    "CONTRIBUTING.md",
                                    "SAFETY.md",
                                    "protocols/README.md",
                                    "protocols/device_profile.md"};

fs::path installed_documents(const fs::path& shipped) {
  return (shipped / ".." / "doc" / "jnd").lexically_normal();
}

/// The folders that may contain Markdown pages; the first one is preferred.
std::array<fs::path, 2> markdown_folders(const fs::path& shipped) {
  return {installed_documents(shipped), shipped};
}

/// The page's file in the site: mkdocs makes index.html of a README.
std::string site_file(const std::string& page) {
  const fs::path path(page);
  const bool is_index = path.filename() == "README.md";
  const std::string name = is_index ? "index.html" : path.stem().string() + ".html";
  return (path.parent_path() / name).string();
}

std::string small_letters(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

ManualPlace manual_place(const fs::path& shipped, const std::string& page) {
  std::error_code ignored;
  for (const fs::path& site :
       {installed_documents(shipped) / "html", shipped / "build" / "docs"}) {
    const fs::path file = site / site_file(page);
    if (fs::is_regular_file(file, ignored)) return {page, file, true};
  }
  for (const fs::path& folder : markdown_folders(shipped)) {
    const fs::path file = folder / page;
    if (fs::is_regular_file(file, ignored)) return {page, file, false};
  }
  return {.page = page, .file = {}, .is_site = false};
}

std::vector<std::string> manual_pages(const fs::path& shipped) {
  std::error_code ignored;
  std::vector<std::string> pages;
  for (const fs::path& folder : markdown_folders(shipped)) {
    if (!fs::is_regular_file(folder / kFirstManualPage, ignored)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "docs", ignored)) {
      if (entry.path().extension() == ".md") {
        pages.push_back(entry.path().lexically_relative(folder).string());
      }
    }
    for (const char* page : kOtherPages) {
      if (fs::is_regular_file(folder / page, ignored)) pages.emplace_back(page);
    }
    break;
  }
  std::ranges::sort(pages);
  return pages;
}

std::string manual_page_named(const std::vector<std::string>& pages, const std::string& name) {
  std::string found;
  const std::string wanted = small_letters(name);
  for (const std::string& page : pages) {
    const std::string stem = small_letters(fs::path(page).stem().string());
    if (page == name) return page;
    const bool is_meant = stem == wanted || stem + ".md" == wanted;
    if (is_meant && (found.empty() || page.size() < found.size())) found = page;
  }
  return found;
}

}  // namespace jnd::app
