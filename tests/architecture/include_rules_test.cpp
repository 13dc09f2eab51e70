#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/places.h"

namespace include_rules_test {

namespace fs = std::filesystem;

// The architecture as data: the folders from the innermost to the outermost, and what each may
// include besides itself. A folder may include only folders above it in this list, so there is
// no circle.
const std::vector<std::pair<std::string, std::set<std::string>>> kFolders = {
    {"core", {}},
    {"core/safety", {"core"}},
    {"core/media", {"core", "core/safety"}},
    {"core/exchange", {"core", "core/safety", "core/media"}},
    {"core/sound", {"core", "core/exchange"}},
    {"core/storage", {"core", "core/exchange"}},
    {"core/streams", {"core", "core/storage"}},
    {"core/markers", {"core", "core/storage"}},
    {"core/controls", {"core", "core/markers"}},
    {"device", {"core", "core/safety", "core/media", "core/exchange"}},
    {"device/exoskeleton", {"core", "core/safety", "device"}},
    {"device/network", {"core", "core/safety", "core/exchange", "device"}},
    {"device/plugin", {"core", "core/safety", "device"}},
    // A driver that uses only jnd_device.h, in C.
    {"device/plugin/force_dimension", {}},
    {"device/sound", {"core", "core/sound", "device"}},
    {"device/twin", {"core", "device"}},
    {"device/check", {"core", "core/safety", "device", "device/network"}},
    {"device/registry",
     {"core", "device", "device/exoskeleton", "device/network", "device/plugin",
      "device/twin"}},
    {"experiments/study", {"core", "core/media"}},
    {"experiments/order", {"core", "experiments/study"}},
    {"experiments/adaptive", {"core"}},
    {"experiments/procedures",
     {"core", "core/media", "experiments/study", "experiments/order", "experiments/adaptive"}},
    {"experiments/protocol",
     {"core", "core/media", "core/sound", "experiments/study", "experiments/order",
      "experiments/procedures"}},
    {"experiments/device_profile",
     {"core", "core/safety", "core/storage", "experiments/study", "experiments/protocol"}},
    {"experiments/session",
     {"core", "core/storage", "experiments/study", "experiments/order",
      "experiments/procedures"}},
    {"experiments/participants",
     {"core", "core/media", "experiments/study", "experiments/order", "experiments/procedures",
      "experiments/protocol", "experiments/session"}},
    {"analysis/words", {}},
    {"analysis/data",
     {"core", "analysis/words", "core/storage", "experiments/study", "experiments/order",
      "experiments/adaptive", "experiments/procedures", "experiments/protocol"}},
    {"analysis/statistics", {"core", "analysis/data"}},
    {"analysis/fits", {"core", "analysis/data", "analysis/statistics"}},
    {"analysis/hierarchical",
     {"core", "analysis/data", "analysis/statistics", "analysis/fits"}},
    {"analysis/mixed",
     {"core", "analysis/data", "analysis/statistics", "analysis/fits",
      "analysis/hierarchical"}},
    {"analysis/results",
     {"core", "analysis/words", "experiments/study", "experiments/procedures", "analysis/data",
      "analysis/statistics", "analysis/fits", "analysis/hierarchical"}},
    {"analysis/movement",
     {"core", "core/media", "core/storage", "experiments/study", "experiments/procedures",
      "analysis/data", "analysis/statistics", "analysis/results"}},
    {"analysis/commissioning", {"core", "analysis/statistics"}},
    {"analysis/planning",
     {"core", "experiments/study", "analysis/data", "analysis/statistics", "analysis/fits",
      "analysis/hierarchical", "analysis/results"}},
    {"analysis/export",
     {"core", "core/storage", "core/streams", "experiments/study", "experiments/procedures",
      "analysis/data", "analysis/results"}},
    {"analysis/charts",
     {"core", "analysis/words", "experiments/study", "experiments/procedures", "analysis/data",
      "analysis/statistics", "analysis/fits", "analysis/results"}},
    {"analysis/report",
     {"core", "analysis/words", "core/storage", "experiments/study", "experiments/procedures",
      "analysis/data", "analysis/statistics", "analysis/fits", "analysis/results",
      "analysis/movement", "analysis/commissioning", "analysis/planning", "analysis/export",
      "analysis/charts"}},
    {"app/language", {}},
    {"app/command_line", {"core/markers", "core/streams", "experiments/study"}},
    {"app/manual", {"app/command_line"}},
    {"app/profile",
     {"core", "core/storage", "device", "device/network", "device/registry",
      "experiments/study", "experiments/procedures", "experiments/device_profile"}},
    {"app/sound",
     {"core", "core/sound", "core/storage", "device/sound", "experiments/study",
      "experiments/session", "app/language"}},
    {"app/session",
     {"core",
      "core/safety",
      "core/media",
      "core/exchange",
      "core/storage",
      "core/streams",
      "core/markers",
      "core/controls",
      "device",
      "device/exoskeleton",
      "device/registry",
      "experiments/study",
      "experiments/order",
      "experiments/procedures",
      "experiments/protocol",
      "experiments/session",
      "experiments/participants",
      "analysis/movement",
      "app/command_line",
      "app/profile",
      "app/sound"}},
    {"app/commissioning",
     {"core", "core/media", "core/safety", "core/exchange", "core/storage", "device",
      "experiments/device_profile", "analysis/commissioning", "analysis/report", "app/language",
      "app/command_line", "app/profile"}},
    {"app/preregistration",
     {"core", "core/storage", "experiments/study", "experiments/order", "analysis/data",
      "analysis/results", "analysis/report"}},
    {"app/results",
     {"core", "core/storage", "experiments/study", "experiments/participants", "analysis/data",
      "analysis/statistics", "analysis/fits", "analysis/results", "analysis/movement",
      "analysis/export", "analysis/charts", "analysis/report", "analysis/words", "app/language",
      "app/command_line", "app/profile", "app/session", "app/preregistration"}},
    {"app/planning",
     {"core", "core/storage", "experiments/study", "experiments/order",
      "experiments/procedures", "experiments/session", "experiments/participants",
      "analysis/fits", "analysis/results", "analysis/planning", "analysis/export",
      "analysis/report", "app/command_line", "app/session"}},
    {"app/curves",
     {"core", "analysis/data", "analysis/fits", "analysis/charts", "analysis/report",
      "app/command_line"}},
    {"app/operator",
     {"core",
      "core/safety",
      "core/media",
      "core/exchange",
      "core/storage",
      "core/controls",
      "device",
      "device/registry",
      "experiments/study",
      "experiments/order",
      "experiments/procedures",
      "experiments/protocol",
      "experiments/device_profile",
      "experiments/session",
      "experiments/participants",
      "analysis/data",
      "analysis/statistics",
      "analysis/fits",
      "analysis/results",
      "analysis/charts",
      "app/language",
      "app/command_line",
      "app/profile",
      "app/sound",
      "app/session",
      "app/commissioning",
      "app/preregistration",
      "app/results",
      "app/curves"}},
    {"app/gui", {"core", "device/exoskeleton", "app/language", "app/operator"}},
    {"app/gui/views",
     {"experiments/study", "analysis/charts", "app/language", "app/sound", "app/session",
      "app/commissioning", "app/curves", "app/operator", "app/gui"}},
    {"app/gui/application",
     {"core", "core/storage", "device", "device/registry", "experiments/study",
      "experiments/order", "experiments/session", "app/language", "app/command_line",
      "app/manual", "app/profile", "app/sound", "app/session", "app/operator", "app/gui",
      "app/gui/views"}},
    {"app/commands",
     {"core",
      "core/safety",
      "core/media",
      "core/sound",
      "core/storage",
      "device",
      "device/exoskeleton",
      "device/network",
      "device/plugin",
      "device/check",
      "device/registry",
      "experiments/study",
      "experiments/order",
      "experiments/protocol",
      "experiments/device_profile",
      "experiments/session",
      "experiments/participants",
      "analysis/data",
      "analysis/statistics",
      "analysis/fits",
      "analysis/hierarchical",
      "analysis/mixed",
      "analysis/results",
      "analysis/movement",
      "analysis/export",
      "analysis/report",
      "app/command_line",
      "app/manual",
      "app/profile",
      "app/sound",
      "app/session",
      "app/commissioning",
      "app/preregistration",
      "app/results",
      "app/curves",
      "app/planning",
      "app/operator"}},
    {"app", {"core", "device", "device/plugin", "app/command_line", "app/commands"}},
};

// The only places that may name a third-party library other than Eigen, as beginnings of paths.
// A library is also matched by its beginning: "imgui" covers imgui_impl_glfw.h as well.
const std::map<std::string, std::set<std::string>> kLibraryHomes = {
    {"sqlite3", {"core/storage/database."}},
    {"zstd", {"core/storage/sample_codec.", "core/storage/stream_file."}},
    {"libevdev", {"core/controls/"}},
    {"openssl", {"core/storage/sha256.", "device/network/"}},
    {"boost",
     {"analysis/statistics/distributions.", "analysis/statistics/root_finding.",
      "analysis/statistics/group_sequential."}},
    {"hdf5", {"analysis/export/hdf5_file."}},
    {"nlohmann", {"experiments/", "analysis/", "app/"}},
    {"mujoco", {"device/exoskeleton/", "app/gui/"}},
    {"ceres", {"analysis/fits/ceres_descent."}},
    {"imgui", {"app/gui/"}},
    {"GLFW", {"app/gui/window"}},
    {"alsa", {"device/sound/alsa_output."}},
    {"CLI", {"app/command_line/", "app/manual/command_tree.", "app/commands/", "app/main."}},
    {"fmt", {"analysis/", "app/", "device/check/"}},
};

struct Include {
  std::string file;  // For example "core/viscous_drag.cpp".
  int line = 0;
  std::string target;  // For example "core/storage/database", "nlohmann/json" or "sqlite3".
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

bool is_inside(const std::string& file, const std::set<std::string>& homes) {
  return std::ranges::any_of(homes,
                             [&](const std::string& home) { return file.starts_with(home); });
}

/// Returns the index of this folder in `kFolders`, or one past the end for others.
std::size_t place_of(const std::string& folder) {
  const auto found =
      std::ranges::find(kFolders, folder, [](const auto& row) { return row.first; });
  return static_cast<std::size_t>(found - kFolders.begin());
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// Returns every source file of the product.
std::vector<fs::path> sources(const fs::path& root) {
  std::vector<fs::path> found;
  for (const std::string room : {"core", "device", "experiments", "analysis", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const fs::path kind = entry.path().extension();
      if (kind == ".h" || kind == ".cpp") found.push_back(entry.path());
    }
  }
  return found;
}

TEST(IncludeRules, AFolderIncludesOnlyWhatItMay) {
  const fs::path root = jnd::test_support::source_folder();
  int includes_checked = 0;
  for (const fs::path& file : sources(root)) {
    for (const Include& include : includes_of(root, file)) {
      ++includes_checked;
      const std::string here = folder_of(include.file), there = folder_of(include.target);
      ASSERT_LT(place_of(here), kFolders.size())
          << include.file << ": give its folder a place in kFolders";
      EXPECT_TRUE(there == here || place_of(there) == kFolders.size() ||
                  kFolders[place_of(here)].second.contains(there))
          << include.file << ':' << include.line << ": " << here << "/ may not include "
          << there << '/';
      for (const auto& [library, homes] : kLibraryHomes) {
        EXPECT_TRUE(!include.target.starts_with(library) || is_inside(include.file, homes))
            << include.file << ':' << include.line << ": " << library << " is not allowed here";
      }
    }
  }
  EXPECT_GT(includes_checked, 0) << "no sources found under " << root;
}

TEST(IncludeRules, NoCircleOfFolders) {
  for (const auto& [folder, others] : kFolders) {
    for (const std::string& other : others) {
      EXPECT_LT(place_of(other), place_of(folder))
          << folder << "/ may include " << other << "/, which does not stand above it";
    }
  }
}

// An allowance that is not used would be an opening that nobody watches.
TEST(IncludeRules, EveryAllowanceIsUsed) {
  const fs::path root = jnd::test_support::source_folder();
  std::map<std::string, std::set<std::string>> used;
  for (const fs::path& file : sources(root)) {
    for (const Include& include : includes_of(root, file)) {
      used[folder_of(include.file)].insert(folder_of(include.target));
    }
  }
  for (const auto& [folder, others] : kFolders) {
    EXPECT_TRUE(fs::is_directory(root / folder)) << folder;
    for (const std::string& other : others) {
      EXPECT_TRUE(used[folder].contains(other)) << folder << "/ includes nothing of " << other;
    }
  }
}

// If no test program named a folder of tests, the tests in it would not be compiled, and nobody
// would notice.
TEST(IncludeRules, EveryFolderOfTestsIsInAProgram) {
  const fs::path tests = jnd::test_support::source_folder() / "tests";
  std::ifstream file(tests / "CMakeLists.txt");
  std::set<std::string> words;
  for (std::string word; file >> word;) {
    while (!word.empty() && word.back() == ')') word.pop_back();
    words.insert(word);
  }
  for (const auto& [folder, others] : kFolders) {
    const bool has_tests =
        fs::is_directory(tests / folder) &&
        std::ranges::any_of(fs::directory_iterator(tests / folder), [](const auto& entry) {
          return entry.path().filename().string().ends_with("_test.cpp");
        });
    EXPECT_TRUE(!has_tests || words.contains(folder))
        << "tests/" << folder << ": name it in tests/CMakeLists.txt";
  }
}

// Files of one folder are compiled in one unit. So a name that two files give to different
// things would be defined twice, or one would hide the other.
TEST(IncludeRules, NamesOfAFolderAreUniqueInItsUnits) {
  static const std::regex kName(
      R"re(^(?:(?:struct|class|enum class) (\w+)|(?:inline |static )?(?:constexpr|const) [^=;(]*?\b(k[A-Z]\w*)\b).*)re");
  const fs::path root = jnd::test_support::source_folder();
  std::map<std::string, std::string> files;  // The file of each name, by folder and name.
  for (const fs::path& file : sources(root)) {
    if (file.extension() != ".cpp") continue;
    std::ifstream source(file);
    bool is_inside_unnamed = false;
    for (std::string line; std::getline(source, line);) {
      if (line == "namespace {") is_inside_unnamed = true;
      if (line == "}  // namespace") is_inside_unnamed = false;
      std::smatch match;
      if (!is_inside_unnamed || !std::regex_match(line, match, kName)) continue;
      const std::string name = match[1].matched ? match[1] : match[2];
      const std::string here = fs::relative(file, root).generic_string();
      const auto [known, is_new] = files.emplace(folder_of(here) + " " + name, here);
      EXPECT_TRUE(is_new || known->second == here)
          << name << " is in " << known->second << " and in " << here << "; rename one";
    }
  }
  EXPECT_GT(files.size(), 100U);
}

// A device that is opened in another way would have no watchdog, no heartbeat or no stop.
TEST(IncludeRules, ADeviceIsOpenedInRealTimeInOnePlace) {
  const fs::path root = jnd::test_support::source_folder();
  const std::set<std::string> allowed = {
      "device/realtime_thread.h", "device/realtime_thread.cpp", "device/watched_loop.cpp"};
  std::set<std::string> found;
  for (const fs::path& file : sources(root)) {
    std::ifstream source(file);
    for (std::string line; std::getline(source, line);) {
      if (line.find("start_haptics(") != std::string::npos) {
        found.insert(fs::relative(file, root).generic_string());
      }
    }
  }
  EXPECT_EQ(found, allowed);
}

// A guide moves a device by its own force, which is allowed only while nobody's hand is in it.
TEST(IncludeRules, ALoopGetsAGuideInOnePlace) {
  const fs::path root = jnd::test_support::source_folder();
  std::set<std::string> found;
  for (const fs::path& file : sources(root)) {
    std::ifstream source(file);
    for (std::string line; std::getline(source, line);) {
      if (line.find(".guide =") != std::string::npos) {
        found.insert(fs::relative(file, root).generic_string());
      }
    }
  }
  EXPECT_EQ(found, (std::set<std::string>{"app/commissioning/guided_run.cpp"}));
}

}  // namespace include_rules_test
