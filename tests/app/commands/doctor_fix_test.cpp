#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "support/places.h"

namespace jnd::app {
namespace doctor_fix_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

/// Imitates in a folder a system on which nobody has set anything up.
class DoctorFixTest : public CommandTest {
 protected:
  void SetUp() override {
    write("etc/group", "root:x:0:\naudio:x:29:anna\n");
    write("etc/passwd", "root:x:0:0::/root:/bin/sh\nanna:x:1000:1000::/home/anna:/bin/sh\n");
    write("etc/security/limits.conf", "# nothing\n@audio - rtprio 99\n@jnd hard rtprio 99\n");
    write("sys/devices/system/cpu/cpufreq/policy0/scaling_governor", "powersave\n");
    write("sys/devices/system/cpu/cpufreq/policy1/scaling_governor", "performance\n");
  }

  [[nodiscard]] fs::path root() const { return path("a system"); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root() / name).parent_path());
    std::ofstream(root() / name) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(root() / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] ProgramOutcome fix(std::vector<std::string> more) const {
    std::vector<std::string> words = {"doctor", "--fix", "--root", root().string()};
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  }
  /// Returns whether the test can run as root and has the system's groupadd and usermod.
  static bool has_tools() {
    return ::geteuid() == 0 && ::access("/usr/sbin/groupadd", X_OK) == 0;
  }
};

TEST_F(DoctorFixTest, ADryRunSaysEveryCommandAndChangesNothing) {
  const ProgramOutcome outcome = fix({"--dry-run", "--user", "anna"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string where = "'" + root().string();
  for (const std::string& command :
       {"groupadd --prefix " + where + "' --system jnd",
        "usermod --prefix " + where + "' -aG jnd anna",
        where + "/etc/security/limits.d/jnd.conf'", where + "/etc/udev/rules.d/60-jnd.rules'",
        std::string("echo performance | tee '")}) {
    EXPECT_NE(outcome.out.find(command), std::string::npos) << command << '\n' << outcome.out;
  }
  EXPECT_NE(outcome.out.find("would run: "), std::string::npos);
  EXPECT_NE(outcome.out.find("Nothing was changed."), std::string::npos);
  EXPECT_EQ(outcome.out.find("policy1"), std::string::npos) << "it is at performance already";
  EXPECT_EQ(read("etc/group"), "root:x:0:\naudio:x:29:anna\n");
  EXPECT_FALSE(fs::exists(root() / "etc/security/limits.d"));
  EXPECT_EQ(read("sys/devices/system/cpu/cpufreq/policy0/scaling_governor"), "powersave\n");
}

TEST_F(DoctorFixTest, WhoMayGivesItAllAndFindsItGivenTheNextTime) {
  if (!has_tools()) GTEST_SKIP() << "needs root and groupadd";
  const ProgramOutcome outcome = fix({"--user", "anna"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("runs: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("log out and in again"), std::string::npos);
  EXPECT_NE(read("etc/group").find("jnd:x:"), std::string::npos);
  EXPECT_NE(read("etc/group").find(":anna\n", read("etc/group").find("jnd:x:")),
            std::string::npos);
  EXPECT_NE(read("etc/security/limits.d/jnd.conf").find("@jnd - memlock unlimited"),
            std::string::npos);
  EXPECT_NE(read("etc/udev/rules.d/60-jnd.rules").find("GROUP=\"jnd\""), std::string::npos);
  EXPECT_EQ(read("sys/devices/system/cpu/cpufreq/policy0/scaling_governor"), "performance\n");
  // Everybody may read these files, because udev, the login and a person who looks for a cause
  // read them.
  EXPECT_EQ(fs::status(root() / "etc/udev").permissions() & fs::perms::others_exec,
            fs::perms::others_exec);

  const ProgramOutcome again = fix({"--user", "anna"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out.find("lacks"), std::string::npos) << again.out;
  EXPECT_EQ(again.out.find("runs:"), std::string::npos) << again.out;
}

TEST_F(DoctorFixTest, WithoutTheRightItPrintsTheCommandsAndSaysSo) {
  if (::geteuid() != 0 || ::access("/usr/bin/setpriv", X_OK) != 0) {
    GTEST_SKIP() << "needs root, and setpriv to be somebody else";
  }
  // The program runs as another user, who must be able to reach the folder and the program.
  fs::permissions(temporary_.path(), fs::perms::all);
  const fs::path program = path("jnd");
  fs::copy_file(test_support::program_file(), program);
  const ProgramOutcome outcome = test_support::run_program(
      {"--reuid=65534", "--regid=65534", "--clear-groups", program.string(), "doctor", "--fix",
       "--root", root().string(), "--user", "anna"},
      {.folder = temporary_.path(),
       .environment = {{"JND_SHARE", test_support::source_folder().string()}},
       .program = "setpriv"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.out.find("as root: groupadd"), std::string::npos) << outcome.out;
  EXPECT_EQ(
      sentence_flaw(outcome.err, {"expected the rights of root", "sudo jnd doctor --fix"}), "");
  EXPECT_FALSE(fs::exists(root() / "etc/security/limits.d"));
}

TEST_F(DoctorFixTest, WhatAnAdministratorWroteInstead) {
  write("etc/group", "root:x:0:\njnd:x:998:carl,anna\n");
  write("etc/security/limits.d/lab.conf", "anna - rtprio 98 # for the robot\n* - memlock -1\n");
  write("etc/udev/rules.d/lab.rules",
        "KERNEL==\"cpu_dma_latency\", GROUP=\"jnd\", MODE=\"0664\"\n");
  write("sys/devices/system/cpu/cpufreq/policy0/scaling_governor", "performance\n");
  const ProgramOutcome outcome = fix({"--user", "anna"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("lacks"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Nothing is left"), std::string::npos) << outcome.out;
  // The rule for anna does not count for another member.
  EXPECT_NE(fix({"--user", "root", "--dry-run"}).out.find("no rule gives rtprio 95 to"),
            std::string::npos);
}

// Older versions wrote rules without ports and pedals.
TEST_F(DoctorFixTest, RulesOfAnOlderVersionAreReplaced) {
  write("etc/udev/rules.d/60-jnd.rules",
        "KERNEL==\"cpu_dma_latency\", GROUP=\"jnd\", MODE=\"0660\"\n");
  EXPECT_NE(fix({"--user", "anna", "--dry-run"}).out.find("no rule of udev lets the group"),
            std::string::npos);
  fs::copy_file(test_support::source_folder() / "data/system/60-jnd.rules",
                root() / "etc/udev/rules.d/60-jnd.rules", fs::copy_options::overwrite_existing);
  EXPECT_NE(fix({"--user", "anna", "--dry-run"}).out.find("the rules are in"),
            std::string::npos);
}

TEST_F(DoctorFixTest, AFileThatIsThereIsKeptBesideTheNewOne) {
  if (!has_tools()) GTEST_SKIP() << "needs root and groupadd";
  write("etc/security/limits.d/jnd.conf", "@jnd - rtprio 50\n");
  EXPECT_EQ(fix({"--user", "anna"}).exit_code, 0);
  EXPECT_EQ(read("etc/security/limits.d/jnd.conf~"), "@jnd - rtprio 50\n");
}

TEST_F(DoctorFixTest, ACommandThatFailsIsTold) {
  if (!has_tools()) GTEST_SKIP() << "needs root and groupadd";
  fs::remove(root() / "etc/passwd");
  fs::create_directory(root() / "etc/passwd");
  const ProgramOutcome outcome = fix({});
  // Root has to name the user for whom the system is set up.
  EXPECT_NE(outcome.out.find("--user NAME"), std::string::npos) << outcome.out;
  fs::remove_all(root() / "etc/security");
  write("etc/security", "a file where a folder is due");
  const ProgramOutcome failed = fix({});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.err.find("doctor: limits: expected `install "), std::string::npos)
      << failed.err;
}

TEST_F(DoctorFixTest, TellsTheSameAsOneDocument) {
  const ProgramOutcome outcome = fix({"--dry-run", "--json", "--user", "anna"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["fixes"].size(), 5u);
  for (const auto& one : json["fixes"]) {
    EXPECT_EQ(one["ok"].get<bool>(), one["commands"].empty()) << one;
    EXPECT_FALSE(one["run"].get<bool>());
  }
}

TEST_F(DoctorFixTest, WrongUsageIsTold) {
  EXPECT_EQ(fix({"--user", "nobody-of-this-name"}).exit_code, 2);
  EXPECT_EQ(jnd({"doctor", "--dry-run"}).exit_code, 2);
  EXPECT_EQ(jnd({"doctor", "--user", "anna"}).exit_code, 2);
  EXPECT_EQ(jnd({"doctor", "--fix", "--root", "/none"}).exit_code, 2);
}

}  // namespace doctor_fix_test
}  // namespace jnd::app
