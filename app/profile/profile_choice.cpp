#include "app/profile/profile_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "core/error.h"
#include "device/network/device_key.h"
#include "device/registry/device_registry.h"
#include "experiments/device_profile/device_profile.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/study/stage_walk.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// Every profile's file in these folders, each once, in the order of folders and names.
std::vector<fs::path> profile_files(const std::vector<fs::path>& folders) {
  std::vector<fs::path> files;
  for (const fs::path& folder : folders) {
    std::set<fs::path> here;
    std::error_code error;
    for (auto it = fs::directory_iterator(folder, error);
         !error && it != fs::directory_iterator(); it.increment(error)) {
      if (it->path().filename().string().ends_with(experiments::kDeviceProfileEnding)) {
        here.insert(it->path());
      }
    }
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

/// Orders profiles by age: the greatest is the one measured last. Among equals, the one checked
/// last is greater, because a copy of a profile contains the checks that came before.
std::tuple<std::string, std::string, std::size_t> newness(const KnownProfile& known) {
  return {known.profile.measured_on, experiments::last_checked_on(known.profile),
          known.profile.checks.size()};
}

bool is_at_rest(const core::MediumAmounts& amounts) {
  return std::ranges::all_of(core::kAmounts,
                             [&](const auto amount) { return amounts.*amount == 0.0; });
}

bool is_felt(const experiments::MediumSetting& setting) {
  return setting.medium != "free_space" || !is_at_rest(experiments::amounts_of(setting));
}

std::string without_words(const DeviceOfProfile& device) {
  return fmt::format(
      "--device {}: expected a profile of {}, as of every real device that is to give force, "
      "found none; measure it with `jnd commission {}`",
      device.name, device_words(device.identity.model, device.identity.serial), device.name);
}

}  // namespace

std::vector<fs::path> profile_folders() {
  std::vector<fs::path> folders;
  const char* path = std::getenv("JND_PROFILE_PATH");
  for (std::string rest = path == nullptr ? "" : path; !rest.empty();) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.emplace_back(rest.substr(0, colon));
    rest.erase(0, colon + 1);
  }
  const fs::path keys = device::device_keys_folder();
  if (!keys.empty()) folders.push_back(keys.parent_path() / "devices");
  return folders;
}

fs::path folder_for_profile(const fs::path& given, const fs::path& record, bool is_simulated) {
  if (!given.empty()) return given;
  const std::vector<fs::path> folders = profile_folders();
  if (is_simulated || folders.empty()) return record.parent_path() / ".";
  return folders.back();
}

DeviceOfProfile device_of_profile(const std::string& name, const device::HapticDevice& device) {
  const device::DeviceCapabilities can = device.capabilities();
  return {.name = name,
          .identity = device.identity(),
          .is_simulated = can.simulated,
          .says_simulated = can.simulated || can.says_simulated};
}

DeviceOfProfile device_of_profile(const std::string& name, double rate_hz) {
  return device_of_profile(name, *device::make_device(name, rate_hz));
}

FoundProfile find_profile(const DeviceOfProfile& device, const std::vector<fs::path>& folders,
                          const std::string& on_day) {
  FoundProfile found;
  std::vector<KnownProfile> fitting;
  for (const fs::path& file : profile_files(folders)) {
    try {
      KnownProfile known = read_known_profile(file);
      if (foreign_words(known, device.identity, device.says_simulated, false).empty()) {
        fitting.push_back(std::move(known));
      }
    } catch (const core::Error& error) {
      // The first of its problems is enough.
      const std::string words = error.what();
      found.remarks.push_back(words.substr(0, words.find('\n')));
    }
  }
  if (fitting.empty()) return found;
  const auto newest = std::ranges::max_element(fitting, {}, newness);
  const bool is_ambiguous = std::ranges::any_of(fitting, [&](const KnownProfile& one) {
    return one.profile.device.serial != newest->profile.device.serial;
  });
  if (is_ambiguous) {
    found.problem = fmt::format(
        "--device {}: expected the serial of `{}` before it is opened, for there are profiles "
        "of several, found none; say which with --profile FILE",
        device.name, device.identity.model);
    return found;
  }
  if (fitting.size() > 1) {
    found.remarks.push_back(fmt::format(
        "{}: used for {}, the one measured last of {} that fit", newest->place,
        device_words(device.identity.model, device.identity.serial), fitting.size()));
  }
  found.problem = outdated_words(*newest, on_day);
  found.known = std::move(*newest);
  return found;
}

ProfileChoice choose_profile(const DeviceOfProfile& device, const std::string& file,
                             const std::vector<fs::path>& folders, const std::string& on_day) {
  ProfileChoice choice;
  if (!file.empty()) {
    KnownProfile known = read_known_profile(file);
    std::string problem = foreign_words(known, device.identity, device.says_simulated, false);
    if (problem.empty()) problem = outdated_words(known, on_day);
    if (!problem.empty()) throw core::Error(problem);
    choice.known = std::move(known);
    return choice;
  }
  if (device.is_simulated) return choice;
  FoundProfile found = find_profile(device, folders, on_day);
  choice.remarks = std::move(found.remarks);
  choice.lack = std::move(found.problem);
  if (!found.known && choice.lack.empty()) choice.lack = without_words(device);
  if (choice.lack.empty()) choice.known = std::move(found.known);
  return choice;
}

KnownProfile profile_to_check(const DeviceOfProfile& device, const std::string& file,
                              const std::vector<fs::path>& folders, const std::string& on_day) {
  std::optional<KnownProfile> known;
  std::string problem;
  if (!file.empty()) {
    known = read_known_profile(file);
    problem = foreign_words(*known, device.identity, device.says_simulated, false);
  } else {
    FoundProfile found = find_profile(device, folders, on_day);
    known = std::move(found.known);
    if (!known) problem = std::move(found.problem);
    if (!known && problem.empty()) {
      problem = fmt::format(
          "--device {}: expected a profile of {} to check it against, found none; measure the "
          "device with `jnd commission {}`, or say which with --profile FILE",
          device.name, device_words(device.identity.model, device.identity.serial),
          device.name);
    }
  }
  if (problem.empty()) problem = ended_words(*known, on_day);
  if (!problem.empty()) throw core::Error(problem);
  return std::move(*known);
}

bool asks_for_force(const experiments::Study& study) {
  if (!is_at_rest(experiments::surroundings_of(study.device))) return true;
  bool asks = false;
  experiments::for_each_stage(study.stages, [&asks](const experiments::Stage& stage) {
    if (const auto* explore = std::get_if<experiments::Explore>(&stage.content)) {
      for (const auto& medium : explore->media) asks |= is_felt(medium.setting);
    } else if (const auto* training = std::get_if<experiments::Training>(&stage.content)) {
      for (const auto& example : training->examples) asks |= is_felt(example.setting);
    } else if (const auto* post = std::get_if<experiments::PostExperiment>(&stage.content)) {
      for (const auto& item : post->items) asks |= is_felt(item.setting);
    } else {
      // What a block asks about can be felt, whatever its levels are.
      asks |= std::holds_alternative<experiments::Block>(stage.content);
    }
  });
  return asks;
}

std::string refused_words(const DeviceOfProfile& device, const ProfileChoice& choice,
                          const experiments::Study& study) {
  if (device.is_simulated || choice.known || !asks_for_force(study)) return "";
  return choice.lack;
}

std::string refused_resume_words(const core::StudyStore& store, const core::SessionRow& session,
                                 const experiments::Study& study, const DeviceOfProfile& device,
                                 const std::string& file, const std::vector<fs::path>& folders,
                                 const std::string& on_day) {
  const std::string place =
      store.folder().string() + ": session " + std::to_string(session.session);
  if (session.device_profile_sha256.empty()) {
    if (!device.is_simulated && asks_for_force(study)) {
      return place +
             ": expected a session that was begun with a profile of its device, as every one "
             "on a real device that is to give force, found none with it; end it with "
             "`--choose end` and begin another";
    }
    if (file.empty()) return "";
    return place + ": expected no --profile, as when it was begun, found " + file +
           "; leave it away";
  }
  const KnownProfile stored = stored_profile(store, session.device_profile_sha256);
  std::string foreign = foreign_words(stored, device.identity, device.says_simulated, false);
  if (!foreign.empty()) return foreign;
  FoundProfile found;
  if (!file.empty()) {
    found.known = choose_profile(device, file, folders, on_day).known;
  } else if (!device.is_simulated) {
    found = find_profile(device, folders, on_day);
  }
  if (!found.known) {
    return found.problem.empty() ? outdated_words(stored, on_day) : found.problem;
  }
  if (!experiments::is_same_measurement(found.known->profile, stored.profile)) {
    return fmt::format(
        "{}: expected the profile that it was begun with, measured on {}, found {}, measured "
        "on {}, with other numbers; end it with `--choose end` and begin another",
        place, stored.profile.measured_on, found.known->place,
        found.known->profile.measured_on);
  }
  return found.problem;
}

}  // namespace jnd::app
