#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// Where a page of the manual is on this machine.
struct ManualPlace {
  /// The page's path in the source tree, such as "docs/how-to/run_a_session.md".
  std::string page;
  /// An existing file: of the site, or else the Markdown; "" if there is neither.
  std::filesystem::path file;
  bool is_site = false;  ///< A page of the site, which a browser shows.
};

/// Where the manual begins.
inline constexpr std::string_view kFirstManualPage = "docs/README.md";

/// Finds this page. `shipped` is the folder of the shipped files (`shipped_folder`). An
/// installed manual is in ../doc/jnd beside that folder, with its site in html; the manual of a
/// source tree is in the tree, with its site in build/docs. A site is preferred to Markdown,
/// and an installed one to that of a tree. Not real time.
[[nodiscard]] ManualPlace manual_place(const std::filesystem::path& shipped,
                                       const std::string& page);

/// Every page of the manual that exists as Markdown, sorted.
[[nodiscard]] std::vector<std::string> manual_pages(const std::filesystem::path& shipped);

/// The page that somebody means by "run_a_session", "safety" or its path; "" for none. If
/// several pages have the name, it is the one with the shortest path, and then the first.
[[nodiscard]] std::string manual_page_named(const std::vector<std::string>& pages,
                                            const std::string& name);

}  // namespace jnd::app
