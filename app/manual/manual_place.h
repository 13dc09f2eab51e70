#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// Where a page of the manual is on this machine.
struct ManualPlace {
  std::string page;            ///< "docs/how-to/run_a_session.md", as the source tree has it.
  std::filesystem::path file;  ///< That exists: of the site, else the Markdown; "" for nowhere.
  bool is_site = false;        ///< A page of the site, which a browser shows.
};

/// Where the manual begins.
inline constexpr std::string_view kFirstManualPage = "docs/README.md";

/// The place of this page. `shipped` is the folder of the shipped files (`shipped_folder`): an
/// installed manual stands at ../doc/jnd beside it, with the site in html; that of a source
/// tree in the tree itself, with the site in build/docs. A site comes before Markdown, an
/// installed one before a tree's. Not real time.
[[nodiscard]] ManualPlace manual_place(const std::filesystem::path& shipped,
                                       const std::string& page);

/// Every page of the manual that is there as Markdown, sorted.
[[nodiscard]] std::vector<std::string> manual_pages(const std::filesystem::path& shipped);

/// The page of these that somebody means by "run_a_session", "safety" or its path; "" for none.
/// Of several of one name it is the shortest path, and then the first.
[[nodiscard]] std::string manual_page_named(const std::vector<std::string>& pages,
                                            const std::string& name);

}  // namespace jnd::app
