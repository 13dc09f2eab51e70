#include "app/session/shipped_files.h"

#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

bool is_share(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "protocols", ignored) &&
         fs::is_directory(folder / "data", ignored);
}

}  // namespace

fs::path shipped_folder() {
  if (const char* named = std::getenv("JND_SHARE"); named != nullptr) return named;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  fs::path installed = program.parent_path().parent_path() / "share" / "jnd";
  // A program that was built to be installed knows no source tree.
  const fs::path source = JND_SOURCE_SHARE;
  return is_share(installed) || source.empty() ? installed : source;
}

fs::path languages_folder() {
  std::error_code ignored;
  fs::path built = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "languages";
  const bool is_built = std::getenv("JND_SHARE") == nullptr && fs::is_directory(built, ignored);
  return is_built ? built : shipped_folder() / "languages";
}

fs::path user_or_shipped(const std::string& name, const std::string& folder, bool keep_near) {
  std::error_code ignored;
  if (fs::exists(name, ignored)) return name;
  const fs::path file_name = fs::path(name).filename();
  for (const fs::path& candidate :
       {shipped_folder() / folder / file_name,
        shipped_folder() / folder / (file_name.string() + ".json")}) {
    if (fs::exists(candidate, ignored)) return candidate;
  }
  if (keep_near || name.find('/') != std::string::npos) return name;
  std::vector<std::string> shipped;
  for (const auto& entry : fs::directory_iterator(shipped_folder() / folder, ignored)) {
    const fs::path& file = entry.path();
    const bool is_schema = file.stem().extension() == ".schema";
    if (file.extension() == ".json" && !is_schema) shipped.push_back(file.stem().string());
  }
  const std::string near = experiments::nearest_word(name, shipped);
  if (near.empty()) return name;
  throw core::Error(name +
                    ": expected a file or the name of a shipped one, found neither; did "
                    "you mean `" +
                    near + "`?");
}

}  // namespace jnd::app
