#include "app/session/machine_fixes.h"

#include <grp.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

#include "app/command_line/shell_word.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// The loop asks for 80, and the thread that watches it for more.
constexpr int kWantedRealtimePriority = 95;

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The files of these folders with this ending, sorted by path.
std::vector<fs::path> files_in(const std::vector<fs::path>& folders,
                               const std::string& ending) {
  std::vector<fs::path> files;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ending) files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

bool is_this_machine(const FixedSystem& system) { return system.root == "/"; }

/// The fields of the line with this name in etc/passwd or etc/group; none if there is no such
/// line.
std::optional<std::vector<std::string>> entry_of(const fs::path& file,
                                                 const std::string& name) {
  for (const std::string& line : lines_of(file)) {
    if (!line.starts_with(name + ":")) continue;
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ':');) fields.push_back(field);
    return fields;
  }
  return std::nullopt;
}

std::optional<std::vector<std::string>> group_entry(const FixedSystem& system) {
  return entry_of(system.root / "etc/group", kSessionGroup);
}

/// A tool of the system, with the words that make it work on another root.
std::string tool(const FixedSystem& system, const std::string& name) {
  if (is_this_machine(system)) return name;
  return name + " --prefix " + shell_word(system.root.string());
}

std::string installed(const FixedSystem& system, const char* shipped, const fs::path& file) {
  // A file that exists already is kept beside it, with a ~ after its name.
  return "install -D -b -m 0644 " + shell_word((system.shipped / shipped).string()) + " " +
         shell_word(file.string());
}

MachineFix group_fix(const FixedSystem& system) {
  const std::string group = kSessionGroup;
  const bool known = is_this_machine(system) && ::getgrnam(kSessionGroup) != nullptr;
  if (known || group_entry(system)) {
    return {.name = "group", .ok = true, .found = "there is a group " + group};
  }
  return {.name = "group",
          .found = "there is no group " + group,
          .commands = {tool(system, "groupadd") + " --system " + group}};
}

bool lists_member(const FixedSystem& system) {
  const auto entry = group_entry(system);
  if (!entry || entry->size() < 4) return false;
  std::istringstream members((*entry)[3]);
  for (std::string member; std::getline(members, member, ',');) {
    if (member == system.user) return true;
  }
  return false;
}

/// Whether this process has the group, which it would have got when its user logged in.
bool process_has_group() {
  const group* entry = ::getgrnam(kSessionGroup);
  if (entry == nullptr) return false;
  const int count = ::getgroups(0, nullptr);
  std::vector<gid_t> groups(static_cast<std::size_t>(std::max(count, 0)));
  if (count > 0 && ::getgroups(count, groups.data()) < 0) return false;
  return ::getegid() == entry->gr_gid ||
         std::ranges::find(groups, entry->gr_gid) != groups.end();
}

bool is_own_name(const std::string& user) {
  const passwd* entry = ::getpwuid(::getuid());
  return entry != nullptr && user == entry->pw_name;
}

MachineFix member_fix(const FixedSystem& system) {
  const std::string group = kSessionGroup;
  MachineFix fix{.name = "member"};
  if (system.user.empty()) {
    fix.found = "nobody is named who runs sessions";
    fix.remedy = "name who does, with --user NAME";
    return fix;
  }
  const bool is_ours = is_this_machine(system) && is_own_name(system.user);
  fix.ok = lists_member(system) || (is_ours && process_has_group());
  if (!fix.ok) {
    fix.found = system.user + " is not in the group " + group;
    fix.commands = {tool(system, "usermod") + " -aG " + group + " " + shell_word(system.user)};
    return fix;
  }
  fix.found = system.user + " is in the group " + group;
  if (is_ours && !process_has_group()) {
    fix.found += ", but was not at the last login";
    fix.remedy = "log out and in again";
  }
  return fix;
}

/// A rule of pam_limits for the group or the user that applies without a program's request.
struct LimitRule {
  std::string domain, type, item, value;
};

std::vector<LimitRule> limit_rules(const FixedSystem& system) {
  const fs::path folder = system.root / "etc/security";
  std::vector<fs::path> files = files_in({folder / "limits.d"}, ".conf");
  files.insert(files.begin(), folder / "limits.conf");
  std::vector<LimitRule> rules;
  for (const fs::path& file : files) {
    for (const std::string& line : lines_of(file)) {
      LimitRule rule;
      std::istringstream words(line.substr(0, line.find('#')));
      if (words >> rule.domain >> rule.type >> rule.item >> rule.value) rules.push_back(rule);
    }
  }
  return rules;
}

bool gives(const std::vector<LimitRule>& rules, const FixedSystem& system,
           const std::string& item, int at_least) {
  return std::ranges::any_of(rules, [&](const LimitRule& rule) {
    const bool is_meant = rule.domain == std::string("@") + kSessionGroup ||
                          rule.domain == "*" ||
                          (!system.user.empty() && rule.domain == system.user);
    if (!is_meant || rule.item != item || rule.type == "hard") return false;
    if (rule.value == "unlimited" || rule.value == "infinity" || rule.value == "-1")
      return true;
    return at_least > 0 && std::atoi(rule.value.c_str()) >= at_least;
  });
}

MachineFix limits_fix(const FixedSystem& system) {
  const std::vector<LimitRule> rules = limit_rules(system);
  std::string lacking;
  if (!gives(rules, system, "rtprio", kWantedRealtimePriority)) lacking = "rtprio 95";
  if (!gives(rules, system, "memlock", 0)) {
    lacking += std::string(lacking.empty() ? "" : " and ") + "memlock unlimited";
  }
  if (lacking.empty()) {
    return {.name = "limits", .ok = true, .found = "rtprio 95 and memlock unlimited are given"};
  }
  return {.name = "limits",
          .found = "no rule gives " + lacking + " to the group " + kSessionGroup,
          .commands = {installed(system, "jnd.limits.conf",
                                 system.root / "etc/security/limits.d/jnd.conf")}};
}

MachineFix devices_fix(const FixedSystem& system) {
  const fs::path& root = system.root;
  const auto files = files_in({root / "etc/udev/rules.d", root / "run/udev/rules.d",
                               root / "usr/lib/udev/rules.d", root / "lib/udev/rules.d"},
                              ".rules");
  const std::string group = std::string("GROUP=\"") + kSessionGroup + "\"";
  for (const fs::path& file : files) {
    bool has_group = false, has_ports = false;
    for (const std::string& line : lines_of(file)) {
      if (line.starts_with('#')) continue;
      has_group |= line.find("cpu_dma_latency") != std::string::npos &&
                   line.find(group) != std::string::npos;
      has_ports |= line.find("ttyUSB") != std::string::npos;
    }
    // An old file of ours is replaced; a file that an administrator wrote instead is left as it
    // is.
    const bool is_old = file.filename() == "60-jnd.rules" && !has_ports;
    if (has_group && !is_old) {
      return {.name = "devices", .ok = true, .found = "the rules are in " + file.string()};
    }
  }
  MachineFix fix{
      .name = "devices",
      .found =
          "no rule of udev lets the group keep processors awake, open devices and use ports",
      .commands = {installed(system, "60-jnd.rules", root / "etc/udev/rules.d/60-jnd.rules")}};
  std::error_code ignored;
  if (is_this_machine(system) && fs::exists("/run/udev/control", ignored)) {
    fix.commands.emplace_back("udevadm control --reload");
    fix.commands.emplace_back(
        "udevadm trigger --subsystem-match=misc --subsystem-match=usb --subsystem-match=input "
        "--subsystem-match=tty --subsystem-match=ppdev");
  }
  return fix;
}

MachineFix clock_fix(const FixedSystem& system) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(system.root / "sys/devices/system/cpu/cpufreq", ignored)) {
    const fs::path file = entry.path() / "scaling_governor";
    const std::vector<std::string> lines = lines_of(file);
    if (!lines.empty() && lines.front() != "performance") files.push_back(file);
  }
  if (files.empty()) {
    return {.name = "clocks", .ok = true, .found = "no processor is known to save power"};
  }
  std::ranges::sort(files);
  std::string command = "echo performance | tee";
  for (const fs::path& file : files) command += " " + shell_word(file.string());
  const std::string governor = lines_of(files.front()).front();
  return {.name = "clocks",
          .found = "processors change their clocks (governor " + governor + ")",
          .commands = {command + " >/dev/null"},
          .remedy = "it holds until the machine starts again"};
}

}  // namespace

std::vector<MachineFix> machine_fixes(const FixedSystem& system) {
  return {group_fix(system), member_fix(system), limits_fix(system), devices_fix(system),
          clock_fix(system)};
}

bool has_user(const FixedSystem& system, const std::string& user) {
  if (user.empty() || user.find_first_of(":\n") != std::string::npos) return false;
  if (is_this_machine(system) && ::getpwnam(user.c_str()) != nullptr) return true;
  return entry_of(system.root / "etc/passwd", user).has_value();
}

}  // namespace jnd::app
