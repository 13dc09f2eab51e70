#include "app/preregistration/deviations.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "app/interleaved_study.h"
#include "app/preregistration/preregistration.h"
#include "core/error.h"
#include "experiments/designed_study.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace deviations_test {

using analysis::Deviation;

constexpr std::int64_t kRegistered_ns = 1'000'000'000'000;

/// How the study is conducted. Unchanged, everything is as it was registered.
struct Conducted {
  std::string text;  ///< The study file of the sessions.
  int num_participants = 4;
  std::int64_t started_ns = kRegistered_ns + 1;
  std::string device = "lumped";
  std::string version{};  ///< The version of the program, or "" for this one.
  /// The event that ends the last session, or "" to leave it open.
  std::string last_ends = "session_completed";
  bool first_comes_again = false;
  bool sets_a_trial_aside = false;
  bool unblinds = false;
  AnalysisChoices choices{};
};

std::string planned_text() {
  return experiments::designed_study(experiments::fluid_contrast(
      R"(, "smallest_effect": 1.25, "direction": "greater", "alpha": 0.01)"));
}

Conducted as_planned() { return {.text = planned_text()}; }

std::string registered(const std::string& text) {
  const experiments::Study study = experiments::read_study_text(text, "designed.json");
  return preregistration_of(study, "designed.json", {.num_participants = 4, .device = "lumped"},
                            nullptr, kRegistered_ns)
             .dump(2) +
         "\n";
}

class Folder {
 public:
  explicit Folder(const Conducted& run)
      : store_(temporary_.path() / "x.study", core::StudyStore::Mode::kCreate,
               core::Durability::kAtClose) {
    const std::string plan = registered(planned_text());
    version_ = Preregistration::parse(plan).at("program_version");
    keep_preregistration(store_, plan);
    const std::string hash = store_.add_protocol("designed.json", run.text);
    for (int i = 0; i < run.num_participants; ++i) {
      const bool is_last = i + 1 == run.num_participants;
      add("P0" + std::to_string(i + 1), hash, run,
          is_last ? run.last_ends : "session_completed", is_last && run.sets_a_trial_aside);
    }
    if (run.first_comes_again) add("P01", hash, run, "session_completed", false);
  }

  [[nodiscard]] std::vector<Deviation> deviations(const AnalysisChoices& choices) const {
    return preregistered_study(store_, analysis::load_study(store_, choices.with_pilots),
                               choices)
        .deviations;
  }
  [[nodiscard]] core::StudyStore& store() { return store_; }

 private:
  void add(const std::string& participant, const std::string& hash, const Conducted& run,
           const std::string& end, bool sets_aside) {
    sequence_ = 0;
    const std::int64_t session =
        store_.add_session({.participant = participant,
                            .protocol_sha256 = hash,
                            .cells = "priming=primed",
                            .device = run.device,
                            .program_version = run.version.empty() ? version_ : run.version,
                            .rate_hz = 1000.0,
                            .started_time_ns = run.started_ns});
    core::Commit drawn = event(session, "trials_drawn", run.started_ns);
    drawn.design.push_back({.session = session,
                            .trial = 1,
                            .block = "thin_a",
                            .procedure = "constant_stimuli",
                            .quantity = "viscosity_pa_s",
                            .intensity = 6.0});
    store_.append(drawn);
    core::Commit answered = event(session, "trial_answered", run.started_ns + 10);
    answered.event.trial = 1;
    answered.trial = core::TrialRow{.session = session,
                                    .trial = 1,
                                    .attempt = 1,
                                    .sequence = sequence_,
                                    .block = "thin_a",
                                    .procedure = "constant_stimuli",
                                    .quantity = "viscosity_pa_s",
                                    .intensity = 6.0,
                                    .reference_intensity = 4.0,
                                    .response = 1.0};
    store_.append(answered);
    if (run.unblinds && participant == "P01") {
      store_.append(event(session, "unblinded", run.started_ns + 5));
    }
    if (!end.empty()) store_.append(event(session, end, run.started_ns + 20));
    if (!sets_aside) return;
    core::Commit excluded = event(session, "trial_excluded", run.started_ns + 30);
    excluded.event.trial = 1;
    store_.append(excluded);
  }

  core::Commit event(std::int64_t session, const std::string& kind, std::int64_t time_ns) {
    core::Commit commit;
    commit.event.session = session;
    commit.event.sequence = ++sequence_;
    commit.event.time_ns = time_ns;
    commit.event.kind = kind;
    return commit;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  core::StudyStore store_;
  std::string version_;
  std::int64_t sequence_ = 0;
};

std::string told(const std::vector<Deviation>& deviations) {
  std::string all;
  for (const Deviation& one : deviations) {
    all += one.topic + ": " + one.planned + " -> " + one.found + "\n";
  }
  return all;
}

TEST(Preregistration, SaysWhichBlocksAreMixedAndHow) {
  const experiments::Study study = experiments::read_study_text(kInterleavedStudy, "x.json");
  const Preregistration plan = preregistration_of(
      study, "x.json", {.num_participants = 4, .device = "lumped"}, nullptr, kRegistered_ns);
  ASSERT_EQ(plan.at("interleaved").size(), 2U);
  EXPECT_EQ(plan.at("interleaved")[0].dump(),
            R"({"name":"two_kinds","turns":"random","blocks":["constant","adaptive"]})");
  EXPECT_EQ(plan.at("interleaved")[1].at("turns"), "rounds");
  const std::string text = preregistration_markdown(plan);
  EXPECT_NE(text.find("- two kinds: trials of constant, adaptive are mixed; the next trial is "
                      "drawn from all that are left."),
            std::string::npos)
      << text;
}

TEST(Deviations, NoneIsInvented) {
  const Conducted run = as_planned();
  EXPECT_EQ(told(Folder(run).deviations({})), "");
}

/// One change to the planned conduct, and the deviation that must be reported.
struct Seeded {
  std::string topic;  ///< The beginning of the one deviation.
  std::function<void(Conducted&)> change;
};

std::function<void(Conducted&)> text_with(const std::string& from, const std::string& to) {
  return [from, to](Conducted& run) {
    const std::size_t at = run.text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    run.text.replace(at, from.size(), to);
  };
}

void mixes_the_last_blocks(Conducted& run) {
  text_with(R"({"kind": "block", "name": "thick_b")",
            R"({"kind": "interleaved", "name": "mixed", "blocks": [
               {"kind": "block", "name": "thick_b")")(run);
  text_with("\n  ]\n}\n", "\n  ]}]\n}\n")(run);
}

const std::vector<Seeded>& seeded() {
  static const std::vector<Seeded> kAll = {
      // Changes of the design.
      {"contrast fluids, alpha", text_with("\"alpha\": 0.01", "\"alpha\": 0.05")},
      {"contrast fluids, direction",
       text_with(R"("direction": "greater")", R"("direction": "less")")},
      {"contrast fluids, smallest effect", text_with("1.25", "1.5")},
      {"contrast fluids, measure", text_with("weber_fraction", "pse")},
      {"contrast fluids, role", text_with(R"("role": "primary", "of")",
                                          R"("role": "secondary", "family": "primary", "of")")},
      {"contrast fluids, of",
       text_with(R"("thin": 1, "thick": -1)", R"("thin": -1, "thick": 1)")},
      {"contrast fluids, family",
       text_with(R"("alpha": 0.01)", R"("alpha": 0.01, "family": "own")")},
      {"contrast fluids, correction",
       text_with(R"("alpha": 0.01)", R"("alpha": 0.01, "correction": "none")")},
      {"contrast again", text_with(R"("contrasts": [)",
                                   R"("contrasts": [{"name": "again", "measure": "pse",
                                   "role": "secondary", "family": "other",
                                   "of": {"fluid": {"thin": 1, "thick": -1}}}, )")},
      {"block thin_a, intensities", text_with("1.000000, 2.000000", "1.500000, 2.000000")},
      {"block thin_a, repetitions", text_with("\"repetitions\": 4", "\"repetitions\": 5")},
      {"block thin_a, question", text_with("Thicker?", "Is it thicker?")},
      {"blinding",
       text_with("\"authors\": [", "\"blinding\": \"participant\", \"authors\": [")},
      {"study file", text_with("Stir.", "Stir it.")},
      {"interleaved mixed", mixes_the_last_blocks},
      // Changes of the conduct.
      {"number of participants", [](Conducted& run) { run.num_participants = 3; }},
      {"number of participants", [](Conducted& run) { run.num_participants = 5; }},
      {"time of registration", [](Conducted& run) { run.started_ns = kRegistered_ns - 1000; }},
      {"device", [](Conducted& run) { run.device = "exoskeleton"; }},
      {"program", [](Conducted& run) { run.version = "0.0.9"; }},
      {"exclusions", [](Conducted& run) { run.sets_a_trial_aside = true; }},
      {"blinding", [](Conducted& run) { run.unblinds = true; }},
      // Changes of the analysis.
      {"analysis", [](Conducted& run) { run.choices.delivered = true; }},
      {"analysis", [](Conducted& run) { run.choices.inverted_out = true; }},
      {"analysis", [](Conducted& run) { run.choices.with_pilots = true; }},
      {"analysis", [](Conducted& run) { run.choices.compared = "thin_a, thick_b"; }},
  };
  return kAll;
}

TEST(Deviations, EachThatIsSeededIsFoundAndNoOther) {
  for (const Seeded& one : seeded()) {
    Conducted run = as_planned();
    one.change(run);
    const std::vector<Deviation> found = Folder(run).deviations(run.choices);
    ASSERT_EQ(found.size(), 1U) << one.topic << "\n" << told(found);
    EXPECT_TRUE(found[0].topic.starts_with(one.topic)) << one.topic << "\n" << told(found);
    EXPECT_NE(found[0].planned, found[0].found);
  }
}

TEST(Deviations, ResultsThatWereUnsealedBeforeTheEndAreTold) {
  Folder folder(as_planned());
  folder.store().add_unsealing(
      {.time_ns = kRegistered_ns + 30, .num_complete = 2, .reason = "the device broke"});
  const std::vector<Deviation> found = folder.deviations({});
  ASSERT_EQ(found.size(), 1U) << told(found);
  EXPECT_EQ(found[0].topic, "looks");
  EXPECT_TRUE(found[0].found.ends_with("with 2 complete sessions: the device broke"))
      << found[0].found;
}

TEST(Deviations, WhereLooksEndedTheStudyTheySayHowMany) {
  Conducted run = as_planned();
  run.num_participants = 3;
  Folder folder(run);
  folder.store().add_look({.look = 1, .decision = "go_on", .sessions = {1, 2}});
  EXPECT_TRUE(told(folder.deviations({})).starts_with("number of participants: 4 "));
  folder.store().add_look({.look = 2, .decision = "stop", .sessions = {3}});
  EXPECT_EQ(told(folder.deviations({})), "");
}

TEST(Deviations, ARuleThatIsPlannedAfterwardsIsOne) {
  Conducted run = as_planned();
  const std::string at = "\"factors\":";
  run.text.replace(run.text.find(at), at.size(),
                   R"("sequential": {"contrast": "fluids", "looks": [4, 6]}, "factors":)");
  EXPECT_EQ(told(Folder(run).deviations({})),
            "sequential: nothing -> {contrast:fluids,looks:[4,6],spending:obrien_fleming}\n");
}

TEST(Deviations, SessionsThatDidNotEndAreTold) {
  Conducted run = as_planned();
  run.last_ends = "session_ended_early";
  EXPECT_NE(told(Folder(run).deviations({}))
                .find("sessions: all to their end -> ended early: "
                      "P04"),
            std::string::npos);
  run.last_ends = "";
  EXPECT_NE(told(Folder(run).deviations({})).find("still open: P04"), std::string::npos);
  run = as_planned();
  run.num_participants = 3;
  run.first_comes_again = true;
  EXPECT_EQ(told(Folder(run).deviations({})),
            "participants: one session each -> more than one: P01\n");
}

TEST(Preregistration, IsKeptOnceAndBeforeTheFirstSession) {
  Folder folder(as_planned());
  const std::string text = registered(planned_text());
  EXPECT_EQ(kept_preregistration(folder.store()), text);
  EXPECT_NO_THROW(keep_preregistration(folder.store(), text)) << "the same again";
  EXPECT_THROW(keep_preregistration(folder.store(), text + " "), core::Error);
  const test_support::TemporaryFolder temporary{test_support::memory_folder()};
  core::StudyStore begun(temporary.path() / "y.study", core::StudyStore::Mode::kCreate);
  const std::string hash = begun.add_protocol("designed.json", planned_text());
  begun.add_session({.participant = "P01", .protocol_sha256 = hash, .rate_hz = 1000.0});
  EXPECT_THROW(keep_preregistration(begun, text), core::Error);
}

TEST(Preregistration, SaysInWordsWhatIsPlanned) {
  const experiments::Study study =
      experiments::read_study_text(planned_text(), "designed.json");
  const Preregistration plan = preregistration_of(
      study, "designed.json",
      {.num_participants = 24, .rationale = "As many as come.", .exclusions = "Nobody."},
      nullptr, kRegistered_ns);
  const std::string markdown = preregistration_markdown(plan);
  for (const char* part :
       {"# Preregistration: Designed", "### Hypotheses",
        "- fluids (primary): weber fraction of fluid: thick -1, thin +1, one-sided (greater), "
        "alpha 0.01, smallest effect of interest 1.25, holm correction in the family primary.",
        "24 participants with a complete session.", "As many as come.", "Nobody.",
        "- fluid: thin, thick", "### Stopping rule", "SHA-256 "}) {
    EXPECT_NE(markdown.find(part), std::string::npos) << part << "\n" << markdown;
  }
  EXPECT_NE(preregistration_html(plan).find("<h1>Preregistration: Designed</h1>"),
            std::string::npos);
}

}  // namespace deviations_test
}  // namespace jnd::app
