// Tests the whole way of a laboratory with its own driver: it is built with the header alone,
// used by the program, and lost in the middle of a session.
#include <signal.h>

#include <fstream>
#include <iterator>
#include <optional>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "device/plugin/plugin_fixture.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::app {
namespace plugin_command_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

class PluginCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    (void)device::built_driver(device::example_source(), temporary_.path(), "example");
    options_.environment.emplace_back("JND_DEVICE_PATH", temporary_.path().string());
  }
  [[nodiscard]] fs::path hostile(const std::string& definition = "") const {
    return device::built_driver(
        test_support::source_folder() / "tests" / "device" / "plugin" / "hostile_driver.c",
        temporary_.path(), "hostile" + definition, definition);
  }
  /// The example with one line of it changed, as a wrong driver of somebody else's.
  void build_changed(const std::string& name, const std::string& from, const std::string& to) {
    std::string source = test_support::read_file(device::example_source());
    const std::size_t at = source.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    source.replace(at, from.size(), to);
    test_support::write_file(path(name + ".c"), source);
    (void)device::built_driver(path(name + ".c"), temporary_.path(), name);
  }
  static std::vector<std::string> run_words(const std::string& device) {
    return {"run",    "short_tour", "--study",    "tour.study", "--participant", "P01",
            "--seed", "7",          "--headless", "--device",   device};
  }
  /// Returns the process in which this test's driver runs, or -1.
  [[nodiscard]] pid_t host() const {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream stream(entry.path() / "cmdline", std::ios::binary);
      const std::string line{std::istreambuf_iterator<char>(stream), {}};
      if (line.starts_with("jnd-device-host") &&
          line.find(temporary_.path().string()) != std::string::npos) {
        return std::stoi(entry.path().filename());
      }
    }
    return -1;
  }
};

TEST_F(PluginCommandTest, AWholeStudyRunsThroughTheExample) {
  const ProgramOutcome outcome = jnd(run_words("plugin:example:simulated"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(opened("tour.study").completed(1));
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);
  EXPECT_EQ(host(), -1) << "its process is gone";
  // Simulated people feel what the driver lets through: thicker fluids feel stronger.
  const auto results = jnd({"results", "tour.study", "--json"});
  EXPECT_EQ(results.exit_code, 0) << results.err;
}

TEST_F(PluginCommandTest, TheDiscriminationOfTheThesisRunsThroughTheExample) {
  const std::vector<std::string> run = {"run",
                                        "viscosity_discrimination",
                                        "--study",
                                        "d.study",
                                        "--participant",
                                        "P01",
                                        "--seed",
                                        "7",
                                        "--headless",
                                        "--device",
                                        "plugin:example:simulated"};
  const ProgramOutcome refused = jnd(run);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("expected a device that holds 5 points of the hand"),
            std::string::npos)
      << refused.err;
  std::string study = test_support::read_file(test_support::source_folder() /
                                              "protocols/viscosity_discrimination.json");
  const std::string five = "\"min_contact_points\": 5";
  ASSERT_NE(study.find(five), std::string::npos);
  study.replace(study.find(five), five.size(), "\"min_contact_points\": 1");
  test_support::write_file(path("of_one_point.json"), study);
  std::vector<std::string> of_one_point = run;
  of_one_point[1] = "of_one_point.json";
  const ProgramOutcome outcome = jnd(of_one_point);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(opened("d.study").completed(1));
  EXPECT_EQ(opened("d.study").trials(1).size(), 80U);
  EXPECT_EQ(jnd({"verify", "d.study"}).exit_code, 0);
}

TEST_F(PluginCommandTest, ASessionSurvivesTheDeathOfTheDriver) {
  std::vector<std::string> words = run_words("plugin:example:simulated");
  words.emplace_back("--acknowledge");
  RunningProgram session(words, options_);
  int num_answers = 0, num_events = 0;
  while (const std::optional<std::string> line = session.read_line()) {
    ++num_events;
    num_answers += line->find("trial_answered") != std::string::npos ? 1 : 0;
    if (num_answers == 3) break;
  }
  ASSERT_EQ(num_answers, 3);
  const pid_t driver = host();
  ASSERT_GT(driver, 0);
  ASSERT_EQ(::kill(driver, SIGKILL), 0);
  const ProgramOutcome ended = session.wait();
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("The device could not be read"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("jnd resume"), std::string::npos) << ended.err;
  EXPECT_FALSE(opened("tour.study").finished(1));
  EXPECT_GE(static_cast<int>(opened("tour.study").events(1).size()), num_events);
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);

  const ProgramOutcome resumed = jnd({"resume", "tour.study", "--headless"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_TRUE(opened("tour.study").completed(1));
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);
}

TEST_F(PluginCommandTest, TheLoopAndThePlanTakeItToo) {
  const ProgramOutcome loop =
      jnd({"loop", "--device", "plugin:./example.so:simulated", "--seconds", "0.3", "--json"});
  EXPECT_EQ(loop.exit_code, 0) << loop.err;
  EXPECT_GT(document(loop.out)["num_ticks"], 100);
  const ProgramOutcome plan =
      jnd({"plan", "short_tour", "--device", "plugin:example:simulated", "--json"});
  // The device says 30 N, but no more than 10 N are rendered at one point.
  EXPECT_EQ(plan.exit_code, 1) << plan.err << plan.out;
  EXPECT_NE(plan.err.find("too strong"), std::string::npos) << plan.err;
  EXPECT_NE(plan.err.find("this program renders at most 10 N at a point"), std::string::npos)
      << plan.err;
}

/// The example says 30 N, and no session gives more than 10 N at a point.
TEST_F(PluginCommandTest, APlanKeepsToWhatTheProgramRendersWhateverTheDeviceSays) {
  const ProgramOutcome plan =
      jnd({"plan", "short_tour", "--device", "plugin:example:simulated", "--json"});
  const auto limits = document(plan.out)["limits"];
  EXPECT_EQ(limits["max_force_per_point_n"], 10.0);
  EXPECT_EQ(limits["device_max_force_per_point_n"], 30.0);
  const std::string said =
      "this program renders at most 10 N at a point and 30 N in all, although "
      "`plugin:example:simulated` says 30 N and 30 N";
  EXPECT_EQ(limits["remark"], said);
  const ProgramOutcome table =
      jnd({"plan", "short_tour", "--device", "plugin:example:simulated"});
  EXPECT_NE(table.out.find("Note: " + said + "."), std::string::npos) << table.out;
  const ProgramOutcome valid =
      jnd({"validate", "short_tour", "--device", "plugin:example:simulated"});
  EXPECT_NE((valid.out + valid.err).find(said), std::string::npos) << valid.out << valid.err;
  EXPECT_EQ(document(jnd({"plan", "short_tour", "--json"}).out)["limits"]["remark"], "");
}

TEST_F(PluginCommandTest, ASessionInWhichNoForceActedSaysSoAndKeepsIt) {
  build_changed("loose", "state->attached_bits = 1;", "state->attached_bits = 0;");
  const ProgramOutcome run = jnd(run_words("plugin:loose:simulated"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string cause = "the device tells of no point that it holds the hand";
  EXPECT_NE(run.err.find("CAUTION, trial 1: no force acted in 1 presentation of stimuli that "
                         "ask for one: " +
                         cause),
            std::string::npos)
      << run.err;
  const std::size_t last = run.err.rfind("CAUTION, no force acted in ");
  ASSERT_NE(last, std::string::npos) << run.err;
  EXPECT_NE(run.err.find(cause, last), std::string::npos) << run.err;
  const ProgramOutcome verified = jnd({"verify", "tour.study"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  EXPECT_NE(verified.out.find("CAUTION, no force acted in "), std::string::npos)
      << verified.out;
  const ProgramOutcome reported = jnd({"report", "tour.study", "--out", "report"});
  std::string report;
  for (const auto& entry : fs::recursive_directory_iterator(path("report"))) {
    if (entry.path().extension() == ".html") report += test_support::read_file(entry.path());
  }
  EXPECT_NE(report.find("CAUTION, no force acted in "), std::string::npos) << reported.err;
}

TEST_F(PluginCommandTest, ADeviceWhoseSensorsMeasureNoForceDeliversNone) {
  build_changed("weak", "JND_DEVICE_HAS_DEVICE_TIME |",
                "JND_DEVICE_HAS_DEVICE_TIME | JND_DEVICE_MEASURES_FORCE |");
  const ProgramOutcome run = jnd(run_words("plugin:weak:simulated"));
  EXPECT_NE(run.err.find("forces were sent, and the device tells or measures that none acted"),
            std::string::npos)
      << run.err;
  const ProgramOutcome good =
      jnd({"run", "short_tour", "--study", "good.study", "--participant", "P01", "--seed", "7",
           "--headless", "--device", "plugin:example:simulated"});
  EXPECT_EQ(good.err.find("no force acted"), std::string::npos) << good.err;
  EXPECT_EQ(jnd({"verify", "good.study"}).out.find("CAUTION"), std::string::npos);
}

TEST_F(PluginCommandTest, TheLoopSaysWhatItDidNotMeasure) {
  build_changed("stuck",
                "memcpy(state->position_m[0], device->position_m, sizeof device->position_m);",
                "");
  const auto stuck = document(
      jnd({"loop", "--device", "plugin:stuck:simulated", "--seconds", "0.3", "--json"}).out);
  EXPECT_EQ(stuck["num_moved_samples"], 0);
  ASSERT_GE(stuck["not_measured"].size(), 1U);
  EXPECT_TRUE(stuck["not_measured"][0].get<std::string>().starts_with("movement ("));
  EXPECT_NE(stuck["verdict"].get<std::string>().find("Not measured: movement ("),
            std::string::npos)
      << stuck["verdict"];
  EXPECT_EQ(stuck["verdict"].get<std::string>().find("Fit for a person"), std::string::npos);
  build_changed("loose", "state->attached_bits = 1;", "state->attached_bits = 0;");
  const auto loose = document(
      jnd({"loop", "--device", "plugin:loose:simulated", "--seconds", "0.3", "--json"}).out);
  EXPECT_EQ(loose["num_ticks_with_force"], 0);
  EXPECT_EQ(loose["not_measured"], nlohmann::json::array({"force (none acted)"}));
  const auto good = document(jnd({"loop", "--seconds", "0.3", "--json"}).out);
  EXPECT_TRUE(good["not_measured"].empty()) << good["not_measured"];
}

TEST_F(PluginCommandTest, ADriverThatCannotBeUsedIsALackOfThisMachine) {
  const std::string bad = hostile().string() + ":simulated,trouble=";
  for (const std::string& device :
       {std::string("plugin:nowhere:simulated"), "plugin:" + temporary_.path().string(),
        "plugin:" + device::example_source().string() + ":simulated",
        "plugin:" + hostile("WRONG_ABI").string() + ":simulated",
        "plugin:" + hostile("LACKS_CLOSE").string() + ":simulated",
        "plugin:" + hostile("ABORTS_IN_LOAD").string() + ":simulated",
        "plugin:" + bad + "crash_in_open", "plugin:" + bad + "hang_in_open"}) {
    const ProgramOutcome loop = jnd({"loop", "--device", device, "--seconds", "0.1"});
    EXPECT_EQ(loop.exit_code, 3) << device << loop.err;
    EXPECT_EQ(sentence_flaw(loop.err), "") << device;
  }
  const ProgramOutcome run = jnd(run_words("plugin:" + bad + "crash_in_describe"));
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(sentence_flaw(run.err, {"crashed (Aborted) while loading it"}), "");
  EXPECT_FALSE(fs::exists(path("tour.study"))) << "nothing is stored for it";
  EXPECT_EQ(jnd({"loop", "--device", "plugin:example:quick"}).exit_code, 2);
  EXPECT_EQ(jnd({"loop", "--device", "plugin"}).exit_code, 2);
}

TEST_F(PluginCommandTest, DevicesListsWhatIsInTheFolders) {
  const ProgramOutcome outcome = jnd({"devices", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["plugins"].size(), 1U) << json;
  EXPECT_EQ(json["plugins"][0], path("example.so").string());
  const ProgramOutcome text = jnd({"devices"});
  EXPECT_NE(text.out.find("plugin:example"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("not tried on hardware"), std::string::npos) << text.out;
}

TEST_F(PluginCommandTest, DevicesTellsWhatADriverSaysOfItself) {
  const ProgramOutcome outcome =
      jnd({"devices", "--device", "plugin:example:simulated", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["name"], "example hand");
  EXPECT_EQ(json["own_mass_kg"], 1.0);
  EXPECT_EQ(json["workspace_half_width_m"][2], 1.0);
  EXPECT_EQ(json["has"], nlohmann::json({"own_movement", "acted_force", "device_time"}));
  EXPECT_EQ(jnd({"devices", "--device", "plugin:nowhere:simulated"}).exit_code, 3);
  EXPECT_EQ(jnd({"devices", "--device", "lumped"}).exit_code, 2);
}

/// A laboratory with a driver on one machine and the window on another.
class ServedPluginTest : public PluginCommandTest {
 protected:
  /// Starts to serve the example and returns its address.
  std::string serve(const std::string& as) {
    server_.emplace(std::vector<std::string>{"device-server", "--device",
                                             "plugin:example:" + as, "--port", "0"},
                    options_);
    const std::string line = server_->read_line().value_or("");
    EXPECT_TRUE(line.starts_with("listening on ")) << line;
    return "network:" + line.substr(line.rfind(' ') + 1);
  }
  std::optional<RunningProgram> server_;
};

TEST_F(ServedPluginTest, KeepsTheRulesOfADeviceAcrossTheNetwork) {
  const std::string at = serve("simulated");
  ProgramOutcome told = jnd({"device-check", at + ",simulated"});
  // A busy machine may delay either side, so the check is repeated.
  for (int i = 0; i < 2 && told.exit_code != 0; ++i) {
    told = jnd({"device-check", at + ",simulated"});
  }
  EXPECT_EQ(told.exit_code, 0) << told.out << told.err;
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait().exit_code, 0);
}

TEST_F(ServedPluginTest, ASimulatorServesNoDriverThatMayBeReal) {
  const ProgramOutcome refused =
      jnd({"device-simulator", "--device", "plugin:example:real", "--port", "0"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("expected a simulated device"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("device-server"), std::string::npos) << refused.err;
}

TEST_F(PluginCommandTest, TheExampleKeepsTheRulesOfDrivers) {
  const ProgramOutcome told = jnd({"device-check", "plugin:example:simulated", "--json"});
  EXPECT_EQ(told.exit_code, 0) << told.out << told.err;
  EXPECT_EQ(document(told.out)["num_passed"].get<int>(), 16) << told.out;
}

}  // namespace plugin_command_test
}  // namespace jnd::app
