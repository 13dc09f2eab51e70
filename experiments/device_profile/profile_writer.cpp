#include "experiments/device_profile/profile_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/storage/files.h"
#include "experiments/device_profile/device_profile_table.h"
#include "experiments/device_profile/profile_fields.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/device_profile/profile_signature.h"

namespace jnd::experiments {
namespace {

using nlohmann::ordered_json;

// These functions turn each kind of field into JSON, or null if it was not measured.

template <class T>
requires std::is_arithmetic_v<T> || std::same_as<T, std::string> ordered_json
json_of(const T& field) {
  return field;
}

template <std::size_t N>
ordered_json json_of(const std::array<double, N>& field) {
  return field;
}

template <class T>
requires(std::is_class_v<T> && !std::same_as<T, std::string>) ordered_json
    json_of(const T& field);

template <class T>
ordered_json json_of(const std::optional<T>& field) {
  return field ? json_of(*field) : ordered_json();
}

template <class T>
ordered_json json_of(const std::vector<T>& field) {
  ordered_json all;
  for (const T& one : field) all.push_back(json_of(one));
  return all;
}

template <class T>
requires(std::is_class_v<T> && !std::same_as<T, std::string>) ordered_json
    json_of(const T& field) {
  ordered_json object;
  each_field(field, [&object](const char* key, const auto& inner) {
    if (ordered_json value = json_of(inner); !value.is_null()) object[key] = std::move(value);
  });
  return object;
}

/// Numbers of a list, and a value with its interval, are printed on one line for human readers.
void print(const ordered_json& value, std::size_t indent, std::string& text) {
  constexpr std::size_t kLongestLine = 100;
  if (!value.is_structured()) {
    text += value.dump();
    return;
  }
  const auto is_plain = [](const ordered_json& one) { return !one.is_structured(); };
  const bool is_flat =
      std::all_of(value.begin(), value.end(), [&is_plain](const ordered_json& one) {
        return is_plain(one) ||
               (one.is_array() && std::all_of(one.begin(), one.end(), is_plain));
      });
  if (is_flat) {
    std::string line;
    for (const auto& [key, one] : value.items()) {
      if (!line.empty()) line += ", ";
      if (value.is_object()) line += ordered_json(key).dump() + ": ";
      if (!one.is_array()) {
        line += one.dump();
        continue;
      }
      std::string list;
      for (const ordered_json& inner : one) list += (list.empty() ? "" : ", ") + inner.dump();
      line += '[' + list + ']';
    }
    if (indent + line.size() <= kLongestLine || value.is_array()) {
      text += value.is_object() ? '{' + line + '}' : '[' + line + ']';
      return;
    }
  }
  text += value.is_object() ? "{\n" : "[\n";
  std::size_t num_left = value.size();
  for (const auto& [key, one] : value.items()) {
    text += std::string(indent + 2, ' ');
    if (value.is_object()) text += ordered_json(key).dump() + ": ";
    print(one, indent + 2, text);
    text += --num_left > 0 ? ",\n" : "\n";
  }
  text += std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

[[noreturn]] void fail_to_write(const std::filesystem::path& file) {
  throw core::Error(file.string() +
                    ": expected to write the device's profile, found: " + std::strerror(errno));
}

/// Writes and syncs a new file. Returns false if the file exists.
bool write_new(const std::filesystem::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    if (errno == EEXIST) return false;
    fail_to_write(file);
  }
  std::size_t num_written = 0;
  while (num_written < text.size()) {
    const ssize_t more =
        ::write(descriptor, text.data() + num_written, text.size() - num_written);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) break;
    num_written += static_cast<std::size_t>(more);
  }
  const bool is_whole = num_written == text.size() && ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  if (!is_whole) {
    ::unlink(file.c_str());
    errno = error;
    fail_to_write(file);
  }
  core::sync_folder(file.parent_path());
  return true;
}

/// Holds a lock on the profiles of a folder. Other processes that want to change them wait.
class ChangingProfiles {
 public:
  explicit ChangingProfiles(const std::filesystem::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~ChangingProfiles() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ChangingProfiles(const ChangingProfiles&) = delete;
  ChangingProfiles& operator=(const ChangingProfiles&) = delete;

 private:
  int descriptor_;
};

}  // namespace

std::string device_profile_text(const DeviceProfile& profile) {
  ordered_json file = {{"$schema", std::string("./") + kDeviceProfileSchemaFileName},
                       {"format", 1}};
  file.update(json_of(profile));
  if (profile.comment.empty()) file.erase("comment");
  file["signature"] = signature_of_all(nlohmann::json::parse(file.dump()));
  std::string text;
  print(file, 0, text);
  return text + '\n';
}

std::filesystem::path write_device_profile(const DeviceProfile& profile,
                                           const std::filesystem::path& folder) {
  std::error_code ignored;
  // If this fails, opening the file fails, too.
  std::filesystem::create_directories(folder, ignored);
  const std::string text = device_profile_text(profile);
  // The schema is for editors. If there is one already, it serves as well.
  (void)write_new(folder / kDeviceProfileSchemaFileName, device_profile_schema());
  const std::string dated = profile.name + '-' + last_checked_on(profile);
  constexpr int kMostOfADay = 1000;
  for (int number = 0; number <= kMostOfADay; ++number) {
    const std::string name = number == 0   ? profile.name
                             : number == 1 ? dated
                                           : dated + '-' + std::to_string(number);
    std::filesystem::path file = folder / (name + std::string(kDeviceProfileEnding));
    if (write_new(file, text)) return file;
  }
  throw core::Error(folder.string() +
                    ": expected a free name for the device's profile, found " +
                    "none; take old ones of `" + profile.name + "` away");
}

void add_daily_check(const std::filesystem::path& file, const DailyCheck& check) {
  // If the file is a link, its target is replaced.
  std::error_code problem;
  const std::filesystem::path whole = std::filesystem::canonical(file, problem);
  if (problem) {
    throw core::Error(file.string() +
                      ": expected a device profile, found: " + problem.message());
  }
  const ChangingProfiles alone(whole.parent_path());
  // This refuses an edited profile, so that its signature stays wrong.
  (void)read_device_profile(whole);
  std::ifstream stream(whole, std::ios::binary);
  ordered_json profile =
      ordered_json::parse(std::string{std::istreambuf_iterator<char>(stream), {}});
  if (!profile.contains("checks")) {
    // The checks go before the signature, where the writer puts them.
    ordered_json signature = std::move(profile["signature"]);
    profile.erase("signature");
    profile["checks"] = ordered_json::array();
    profile["signature"] = std::move(signature);
  }
  profile["checks"].push_back(json_of(check));
  profile["signature"]["checks"] =
      signature_of(nlohmann::json::parse(profile.dump()), "checks");
  std::string text;
  print(profile, 0, text);
  text += '\n';
  (void)read_device_profile_text(text, file.string());

  std::filesystem::path fresh = whole;
  fresh += ".new";
  std::filesystem::remove(fresh, problem);  // Removes the remains of a program that died.
  if (!write_new(fresh, text)) fail_to_write(fresh);
  std::filesystem::permissions(fresh, std::filesystem::status(whole).permissions(), problem);
  if (::rename(fresh.c_str(), whole.c_str()) != 0) {
    const int error = errno;
    ::unlink(fresh.c_str());
    errno = error;
    fail_to_write(whole);
  }
  core::sync_folder(whole.parent_path());
}

}  // namespace jnd::experiments
