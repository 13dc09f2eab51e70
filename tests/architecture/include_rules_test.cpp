#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

namespace include_rules_test {

namespace fs = std::filesystem;

// The architecture, as data. A room may include itself and the rooms listed here. The longest
// matching path names the room, so core/storage is a room of its own inside core.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {}},
    {"core/storage", {"core"}},
    {"device", {"core"}},
    {"experiments", {"core", "core/storage"}},
    {"analysis", {"core", "core/storage"}},
    {"app", {"core", "core/storage", "device", "experiments", "analysis"}},
};

// The only places that may name a third-party library other than Eigen. Matched as a prefix:
// "imgui" also covers imgui_impl_glfw.h.
const std::map<std::string, std::set<std::string>> kLibraryHomes = {
    {"sqlite3", {"core/storage"}},
    {"zstd", {"core/storage"}},
    {"openssl", {"core/storage", "device/network"}},
    {"boost", {"analysis"}},
    {"hdf5", {"analysis"}},
    {"nlohmann", {"experiments", "analysis", "app"}},
    {"mujoco", {"device", "app"}},
    {"ceres", {"analysis"}},
    {"imgui", {"app/gui"}},
    {"GLFW", {"app/gui"}},
    {"png", {"app/gui"}},
    {"CLI", {"app"}},
    {"fmt", {"app"}},
};

struct Include {
  std::string file;  // "core/viscous_drag.cpp"
  int line = 0;
  std::string target;  // "core/storage/database", "nlohmann/json", "sqlite3"
};

std::vector<Include> includes_of(const fs::path& root, const fs::path& file) {
  static const std::regex kPattern(R"re(^\s*#\s*include\s*["<]([A-Za-z0-9_/]+))re");
  std::vector<Include> found;
  std::ifstream source(file);
  int line = 0;
  for (std::string text; std::getline(source, text);) {
    ++line;
    std::smatch match;
    if (std::regex_search(text, match, kPattern)) {
      found.push_back({fs::relative(file, root).generic_string(), line, match[1]});
    }
  }
  return found;
}

bool is_inside(const std::string& file, const std::set<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (file.starts_with(folder + "/")) return true;
  }
  return false;
}

// The room that holds `path`, or "" for anything outside the house.
std::string room_of(const std::string& path) {
  std::string found;
  for (const auto& [room, allowed] : kMayInclude) {
    if (path.starts_with(room + "/") && room.size() > found.size()) found = room;
  }
  return found;
}

TEST(IncludeRules, DependenciesPointTowardCore) {
  const fs::path root = jnd::test_support::source_folder();
  int includes_checked = 0;
  for (const std::string folder : {"core", "device", "experiments", "analysis", "app"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      for (const Include& include : includes_of(root, entry.path())) {
        ++includes_checked;
        const std::string here = room_of(include.file);
        const std::string there = room_of(include.target);
        EXPECT_TRUE(there.empty() || there == here || kMayInclude.at(here).contains(there))
            << include.file << ':' << include.line << ": " << here << "/ may not include "
            << there << '/';
        for (const auto& [library, homes] : kLibraryHomes) {
          EXPECT_TRUE(!include.target.starts_with(library) || is_inside(include.file, homes))
              << include.file << ':' << include.line << ": " << library
              << " is not allowed here";
        }
      }
    }
  }
  EXPECT_GT(includes_checked, 0) << "no sources found under " << root;
}

// A device opened any other way would have no watchdog, no heartbeat or no stop.
TEST(IncludeRules, ADeviceIsOpenedInRealTimeInOnePlace) {
  const fs::path root = jnd::test_support::source_folder();
  const std::set<std::string> allowed = {
      "device/realtime_thread.h", "device/realtime_thread.cpp", "device/watched_loop.cpp"};
  std::set<std::string> found;
  for (const std::string folder : {"core", "device", "experiments", "analysis", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream source(entry.path());
      for (std::string line; std::getline(source, line);) {
        if (line.find("start_haptics(") != std::string::npos) {
          found.insert(fs::relative(entry.path(), root).generic_string());
        }
      }
    }
  }
  EXPECT_EQ(found, allowed);
}

}  // namespace include_rules_test
