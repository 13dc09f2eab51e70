#include "analysis/report/report_pdf.h"

#include <unistd.h>

#include <cstdlib>
#include <vector>

#include "analysis/report/figure_files.h"
#include "analysis/report/run_tool.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// A folder for what a browser stores. It is removed when the browser has finished.
class ProfileFolder {
 public:
  ProfileFolder() {
    std::error_code ignored;
    std::string pattern = (fs::temp_directory_path(ignored) / "jnd-report-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~ProfileFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ProfileFolder(const ProfileFolder&) = delete;
  ProfileFolder& operator=(const ProfileFolder&) = delete;

  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

/// A path as a URL for a browser.
std::string file_url(const fs::path& file) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string url = "file://";
  for (const char letter : fs::absolute(file).lexically_normal().string()) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') || letter == '/' || letter == '.' ||
                       letter == '-' || letter == '_';
    if (plain) {
      url += letter;
    } else {
      const auto byte = static_cast<unsigned char>(letter);
      url += '%';
      url += kDigits[byte >> 4];
      url += kDigits[byte & 15];
    }
  }
  return url;
}

}  // namespace

std::string print_as_pdf(const fs::path& browser, const fs::path& html, const fs::path& pdf,
                         std::int64_t time_ns) {
  const std::string name = browser.filename().string();
  const fs::path target = fs::absolute(pdf);
  const ProfileFolder profile;
  if (profile.path().empty()) return "no temporary folder for " + name;
  std::vector<std::string> arguments;
  if (name.starts_with("wkhtmltopdf")) {
    arguments = {"--quiet", "--print-media-type", fs::absolute(html).string(), target.string()};
  } else {
    arguments = {"--headless",
                 "--disable-gpu",
                 "--disable-extensions",
                 "--disable-background-networking",
                 "--no-first-run",
                 "--no-pdf-header-footer",
                 "--user-data-dir=" + profile.path().string(),
                 "--print-to-pdf=" + target.string()};
    // The sandbox does not start for root. The page is our own and has no script.
    if (::geteuid() == 0) arguments.insert(arguments.begin() + 1, "--no-sandbox");
    arguments.push_back(file_url(html));
  }
  constexpr std::chrono::seconds kTimeLimit(120);
  const ToolOutcome outcome = run_tool(browser, arguments, profile.path(), kTimeLimit);
  std::error_code ignored;
  if (!outcome.ok || !fs::exists(target, ignored) || fs::file_size(target, ignored) == 0) {
    fs::remove(target, ignored);
    return name + ": " + (outcome.ok ? "wrote no file" : outcome.problem);
  }
  set_pdf_dates(target, time_ns);
  return "";
}

}  // namespace jnd::analysis
