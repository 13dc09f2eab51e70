#include "chaos/door_devices.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::chaos {
namespace {

namespace fs = std::filesystem;
using test_support::ProgramOptions;
using test_support::ProgramOutcome;

/// The limits of SAFETY.md and device/network/README.md for devices that call themselves
/// simulated.
constexpr int kServerPatience_ms = 100;
constexpr int kHostPatience_ms = 250;
/// Time that is allowed in addition: a thread other than the one whose clock counts may have to
/// act, or a datagram may be on its way in the system.
constexpr int kSlack_ms = 50;

ProgramOutcome run_other(const std::string& program, const std::vector<std::string>& words) {
  try {
    return test_support::run_program(words, {.program = program});
  } catch (const std::exception&) {
    return {};
  }
}

fs::path reference(const std::string& name) {
  return test_support::source_folder() / "device/network/reference" / name;
}

/// Compiles as somebody does who has nothing of this program but a header or a file.
fs::path compiled(const std::vector<std::string>& words, const fs::path& source,
                  const fs::path& made) {
  std::vector<std::string> all = {"-std=c11", "-O2", "-Wall", "-Wextra", "-Werror"};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), {source.string(), "-lm", "-lpthread", "-o", made.string()});
  return run_other("cc", all).exit_code == 0 ? made : fs::path();
}

/// Returns 1234 for the file "forces.1234": the process that writes it. Returns -1 if the name
/// has no number.
pid_t process_of(const fs::path& log) {
  const std::string number = log.extension().string();
  return number.size() > 1 ? std::stoi(number.substr(1)) : -1;
}

bool is_running(pid_t process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(stream, text);
  const auto end_of_name = text.rfind(") ");
  return end_of_name != std::string::npos && text[end_of_name + 2] != 'Z' &&
         text.find("(jnd-device-host)") != std::string::npos;
}

}  // namespace

const DoorTools& DoorTools::here() {
  static const DoorTools tools;
  return tools;
}

DoorTools::DoorTools() {
  static const test_support::TemporaryFolder folder;
  has_program_ =
      fs::exists(test_support::program_file()) && fs::exists(test_support::device_host_file());
  if (!has_program_) return;
  has_python_ = run_other("python3", {"--version"}).exit_code == 0;
  const fs::path tree = test_support::source_folder();
  driver_ =
      compiled({"-D_GNU_SOURCE", "-shared", "-fPIC", "-I", (tree / "device/plugin").string()},
               tree / "tests/chaos/observing_driver.c", folder.path() / "observing.so");
  c_device_ = compiled({}, reference("c_device.c"), folder.path() / "c_device");
}

bool DoorTools::has(Door door) const {
  if (!has_program_) return false;
  if (door == Door::kPythonDevice) return has_python_;
  return !(has_driver(door) ? driver_ : c_device_).empty();
}

DoorDevice::DoorDevice(const DoorSchedule& schedule, fs::path folder)
    : schedule_(schedule), folder_(std::move(folder)) {
  if (schedule.has_key) draw_key();
}

ProgramOptions DoorDevice::options() const {
  // Python must not write files beside the sources.
  return {.folder = folder_,
          .environment = {{"XDG_CONFIG_HOME", (folder_ / "config").string()},
                          {"PYTHONDONTWRITEBYTECODE", "1"}}};
}

void DoorDevice::draw_key() {
  const ProgramOutcome drawn =
      test_support::run_program({"device-key", "robot", "--json"}, options());
  key_file_ = nlohmann::json::parse(drawn.out).at("file").get<std::string>();
}

std::string DoorDevice::driver_words() const {
  std::string words = "plugin:" + DoorTools::here().driver().string() +
                      ":simulated,log=" + (folder_ / "forces").string() +
                      ",plug=" + (folder_ / "unplugged").string() +
                      ",points=" + std::to_string(schedule_.points);
  if (schedule_.door == Door::kPacingDriver) words += ",paces=1";
  if (!schedule_.wrong.empty()) words += ",wrong=" + schedule_.wrong;
  return words;
}

std::string DoorDevice::words() const {
  if (!is_networked(schedule_.door)) return driver_words();
  return "network:" + place_ + ",simulated" + (schedule_.has_key ? ",key=robot" : "");
}

bool DoorDevice::serve() {
  const std::string port = place_.empty() ? "0" : place_.substr(place_.rfind(':') + 1);
  const std::string log = (folder_ / ("forces." + std::to_string(++num_servers_))).string();
  ProgramOptions how = options();
  std::vector<std::string> words = {"--port", port};
  if (schedule_.door == Door::kServedDriver) {
    words.insert(words.begin(), {"device-server", "--device", driver_words()});
    if (schedule_.has_key) words.insert(words.end(), {"--key", "robot"});
  } else {
    words.insert(words.end(), {"--log", log});
    if (schedule_.has_key) words.insert(words.end(), {"--key", key_file_});
    how.program = DoorTools::here().c_device().string();
  }
  if (schedule_.door == Door::kPythonDevice) {
    words.insert(words.begin(), reference("python_device.py").string());
    if (!schedule_.wrong.empty()) words.insert(words.end(), {"--wrong", schedule_.wrong});
    how.program = "python3";
  }
  server_.emplace(words, how);
  const std::string begin = "listening on ";
  const std::string line = server_->read_line().value_or("");
  if (!line.starts_with(begin)) {
    server_.reset();
    return false;
  }
  place_ = line.substr(begin.size());
  return true;
}

void DoorDevice::kill_server() {
  server_->send_signal(SIGKILL);
  (void)server_->wait();
  server_.reset();
}

std::optional<ProgramOutcome> DoorDevice::ended_server() {
  if (!server_ || !server_->has_ended()) return std::nullopt;
  const ProgramOutcome ended = server_->wait();
  server_.reset();
  return ended;
}

void DoorDevice::signal_server(int number) const { server_->send_signal(number); }

std::vector<fs::path> DoorDevice::log_files() const {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("forces.") && !name.ends_with(".beats")) files.push_back(entry.path());
  }
  return files;
}

pid_t DoorDevice::host() const {
  if (!has_driver(schedule_.door)) return -1;
  pid_t newest = -1;
  fs::file_time_type written;
  // The driver of a killed program lives on for a moment, so the newest file counts.
  for (const fs::path& file : log_files()) {
    if (!is_running(process_of(file))) continue;
    const fs::file_time_type at = fs::last_write_time(file);
    if (newest == -1 || at > written) {
      newest = process_of(file);
      written = at;
    }
  }
  return newest;
}

void DoorDevice::plug_in(bool is_in) const {
  const fs::path file = folder_ / "unplugged";
  if (is_in) {
    fs::remove(file);
  } else {
    std::ofstream(file).flush();
  }
}

void DoorDevice::await_force() {
  watches_.clear();
  for (const fs::path& file : log_files()) watches_[file] = ForceWatch(fs::file_size(file));
}

bool DoorDevice::has_new_force() {
  return std::ranges::any_of(
      log_files(), [&](const fs::path& file) { return watches_[file].has_new_force(file); });
}

std::vector<ForceLog> DoorDevice::logs() const {
  std::vector<ForceLog> logs;
  for (const fs::path& file : log_files()) {
    const fs::path beats =
        has_driver(schedule_.door) ? fs::path(file.string() + ".beats") : fs::path();
    logs.push_back(read_force_log(file, beats));
    logs.back().is_of_one_program = !is_networked(schedule_.door);
  }
  return logs;
}

/// These numbers are those of observing_driver.c, c_device.c and python_device.py.
Happenings DoorDevice::promised() const {
  if (!has_driver(schedule_.door)) {
    return {.most_per_point_n = 8.0, .most_in_all_n = 20.0, .most_step_n = 2.0};
  }
  return {.most_per_point_n = 6.0,
          .most_in_all_n = 15.0,
          .most_step_n = 2.0,
          .longest_standing_ms = kHostPatience_ms + kSlack_ms};
}

int DoorDevice::force_ends_within_ms() const {
  return kSlack_ms + (is_networked(schedule_.door) ? kServerPatience_ms : kHostPatience_ms);
}

int DoorDevice::driver_force_ends_within_ms() const { return kSlack_ms + kHostPatience_ms; }

int DoorDevice::longest_pause_ms() const {
  return is_networked(schedule_.door) ? kServerPatience_ms : kHostPatience_ms;
}

}  // namespace jnd::chaos
