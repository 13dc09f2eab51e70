#include "app/operator/remembered_language.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// True for a code such as "de", "pt_BR" or "sr@latin". The code becomes a part of a path and
/// the value of an environment variable.
bool is_code_of_language(const std::string& code) {
  constexpr std::size_t kMost = 32;
  return !code.empty() && code.size() <= kMost &&
         std::ranges::all_of(code, [](unsigned char letter) {
           return std::isalpha(letter) != 0 || letter == '_' || letter == '@';
         });
}

fs::path file_of_language(const fs::path& folder) { return folder / "language"; }

}  // namespace

void remember_language(const fs::path& folder, const std::string& code) {
  if (folder.empty() || !is_code_of_language(code)) return;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  // The new file is written beside the old one and then replaces it, so a reader finds one or
  // the other.
  const fs::path fresh = file_of_language(folder).string() + "." + std::to_string(::getpid());
  std::ofstream stream(fresh, std::ios::trunc);
  stream << code << '\n';
  stream.close();
  if (stream) fs::rename(fresh, file_of_language(folder), ignored);
  fs::remove(fresh, ignored);
}

std::string remembered_language(const fs::path& folder) {
  if (folder.empty()) return "";
  std::ifstream stream(file_of_language(folder));
  std::string code;
  std::getline(stream, code);
  return is_code_of_language(code) ? code : "";
}

}  // namespace jnd::app
