#include "analysis/report/single_figure.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "analysis/report/figure_files.h"
#include "analysis/report/run_tool.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// A temporary folder that is removed with the object.
class DrawingFolder {
 public:
  DrawingFolder() {
    std::string pattern = (fs::temp_directory_path() / "jnd-figure-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw core::Error(fs::temp_directory_path().string() +
                        ": expected to make a folder to draw in, found that it cannot be made");
    }
    path_ = pattern;
  }
  ~DrawingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  DrawingFolder(const DrawingFolder&) = delete;
  DrawingFolder& operator=(const DrawingFolder&) = delete;
  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

void replace_once(std::string& text, const std::string& from, const std::string& to) {
  if (const auto at = text.find(from); at != std::string::npos)
    text.replace(at, from.size(), to);
}

/// The script for a bitmap of 200 dots per inch.
std::string script_for_png(const Figure& figure) {
  constexpr double kDotsPerInch = 200.0;
  std::string script = gnuplot_script(figure, false);
  const auto dots = [](double inches) {
    return std::to_string(std::lround(kDotsPerInch * inches));
  };
  replace_once(script, "'svg pdf'", "'png'");
  const auto from = script.find("    set terminal pdfcairo");
  const auto to = script.find("  }\n", from);
  script.replace(from, to - from,
                 "    set terminal pngcairo size " + dots(figure.width_in) + "," +
                     dots(figure.height_in) +
                     " font 'Inter,9' fontscale 2.8 linewidth 2.4 pointscale 2.2 noenhanced "
                     "background 'white'\n"
                     "    small = 'Inter,7.5'\n");
  return script;
}

}  // namespace

void require_figure_file(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".svg" && ending != ".pdf" && ending != ".png") {
    throw core::Error(file.string() +
                      ": expected a figure's name that ends in .svg, .pdf or .png");
  }
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error))) {
    throw core::Error(file.string() +
                      ": expected a name for a new figure, found a file that is there already");
  }
  const fs::path folder = file.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw core::Error(folder.string() + ": expected a folder for the figure, found none");
  }
}

void write_single_figure(const Figure& figure, const fs::path& file) {
  require_figure_file(file);
  const fs::path gnuplot = find_tool({"gnuplot"});
  if (gnuplot.empty()) {
    throw core::Error(file.string() +
                      ": expected gnuplot to draw this figure, found that it is not installed");
  }
  const DrawingFolder folder;
  const bool is_png = file.extension() == ".png";
  const std::vector<DrawnFigure> drawn =
      write_figures({figure}, folder.path(), {.gnuplot = is_png ? fs::path() : gnuplot});
  if (is_png) {
    write_text_file(folder.path() / (figure.name + ".gp"), script_for_png(figure));
    const ToolOutcome outcome = run_tool(gnuplot, {figure.name + ".gp"}, folder.path());
    if (!outcome.ok) throw core::Error(file.string() + ": gnuplot: " + outcome.problem);
  } else if (!drawn.front().problem.empty()) {
    throw core::Error(file.string() + ": " + drawn.front().problem);
  }
  std::ifstream stream(folder.path() / (figure.name + file.extension().string()),
                       std::ios::binary);
  write_text_file(file, {std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace jnd::analysis
