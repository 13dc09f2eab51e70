#include "app/preregistration/deviations.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "analysis/results/number_words.h"
#include "app/preregistration/preregistration.h"
#include "core/error.h"
#include "core/storage/sha256.h"

namespace jnd::app {
namespace {

using Json = nlohmann::ordered_json;
using analysis::Deviation;

std::string words(const Json& value) {
  if (value.is_null()) return "nothing";
  if (value.is_string()) {
    const auto text = value.get<std::string>();
    return text.empty() ? "nothing" : text;
  }
  if (value.is_array() && value.empty()) return "none";
  std::string text = value.dump();
  std::erase(text, '"');
  return text;
}

/// The word for one item of a list, such as "contrast" for "contrasts".
std::string one_word_of(const std::string& list) {
  return list.ends_with('s') ? list.substr(0, list.size() - 1) : list;
}

std::string key_words(std::string key) {
  std::ranges::replace(key, '_', ' ');
  return key;
}

bool are_named(const Json& list) {
  return list.is_array() && !list.empty() && std::ranges::all_of(list, [](const Json& one) {
           return one.is_object() && one.contains("name");
         });
}

const Json* named(const Json& list, const Json& name) {
  for (const Json& one : list) {
    if (one.at("name") == name) return &one;
  }
  return nullptr;
}

/// Finds where two designs differ. Each difference is told once, at the innermost place that
/// says what it is about.
void compare(const std::string& topic, const Json& planned, const Json& found,
             std::vector<Deviation>& deviations) {
  if (planned == found) return;
  if (planned.is_object() && found.is_object() && planned.contains("name")) {
    for (const auto& [key, value] : planned.items()) {
      compare(topic + ", " + key_words(key), value, found.value(key, Json()), deviations);
    }
    return;
  }
  if (are_named(planned) || are_named(found)) {
    const std::string one = one_word_of(topic);
    for (const Json& entry : planned) {
      const auto name = entry.at("name").get<std::string>();
      const Json* other = named(found, entry.at("name"));
      if (other == nullptr) {
        deviations.push_back({one + " " + name, "planned", "left out"});
      } else {
        compare(one + " " + name, entry, *other, deviations);
      }
    }
    for (const Json& entry : found) {
      if (named(planned, entry.at("name")) != nullptr) continue;
      deviations.push_back(
          {one + " " + entry.at("name").get<std::string>(), "not planned", "added"});
    }
    return;
  }
  deviations.push_back({topic, words(planned), words(found)});
}

void compare_designs(const Json& plan, const analysis::StudyData& data,
                     const std::set<std::string>& protocols,
                     std::vector<Deviation>& deviations) {
  const auto registered = plan.at("study_sha256").get<std::string>();
  const bool is_changed = std::ranges::any_of(
      protocols, [&](const std::string& hash) { return hash != registered; });
  if (!is_changed) return;
  const std::size_t num_before = deviations.size();
  Json found = planned_design(data.written);
  // If neither design plans looks, nothing differs.
  if (!found.contains("sequential")) found["sequential"] = nullptr;
  if (!found.contains("interleaved")) found["interleaved"] = Json::array();
  for (const auto& [key, value] : found.items()) {
    const Json nothing = key == "interleaved" ? Json::array() : Json();
    compare(key_words(key), plan.value(key, nothing), value, deviations);
  }
  if (deviations.size() > num_before) return;
  std::string hashes;
  for (const std::string& hash : protocols) {
    if (hash != registered) hashes += (hashes.empty() ? "" : ", ") + hash.substr(0, 12);
  }
  deviations.push_back({"study file", "SHA-256 " + registered.substr(0, 12),
                        "SHA-256 " + hashes + ", with the same design"});
}

std::string names_words_of(const std::set<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// What the sessions of the study say about how it was run.
class Conduct {
 public:
  Conduct(const core::StudyStore& store, const Json& plan, bool with_pilots) : store_(store) {
    const auto registered_ns = plan.at("registered_time_ns").get<std::int64_t>();
    std::map<std::string, int> sessions_of;
    for (const core::SessionOverview& overview : store.overview()) {
      const core::SessionRow session = store.session(overview.session);
      if (session.pilot && !with_pilots) continue;
      look_at_events(session);
      if (overview.is_set_aside) continue;  // What is told of it is that it is.
      protocols.insert(session.protocol_sha256);
      devices.insert(session.device);
      versions.insert(session.program_version);
      num_complete += overview.counts() ? 1 : 0;
      if (overview.ended_early) ended_early.insert(session.participant);
      if (!overview.completed && !overview.ended_early) open.insert(session.participant);
      if (++sessions_of[session.participant] > 1) came_again.insert(session.participant);
      // A simulated session has no real date.
      if (!session.simulated && session.started_time_ns < registered_ns) {
        before.insert(session.participant);
      }
    }
  }

  std::set<std::string> protocols, devices, versions;
  std::set<std::string> ended_early, open, came_again, before;
  int num_complete = 0;
  std::optional<std::int64_t> unblinded_ns;
  std::int64_t last_ns = 0;

 private:
  void look_at_events(const core::SessionRow& session) {
    for (const core::EventRow& event : store_.events(session.session)) {
      if (event.kind == "unblinded") {
        if (!unblinded_ns || event.time_ns < *unblinded_ns) unblinded_ns = event.time_ns;
      } else if (event.kind == "trial_answered" && !session.simulated) {
        last_ns = std::max(last_ns, event.time_ns);
      }
    }
  }

  const core::StudyStore& store_;
};

void compare_conduct(const Json& plan, const Conduct& conduct, const analysis::StudyData& data,
                     const core::StudyStore& store, std::vector<Deviation>& deviations) {
  int planned = plan.at("num_participants");
  if (data.ended_by_rule()) {
    // The rule has decided the number.
    planned = 0;
    for (const analysis::TakenLook& look : data.looks) planned += look.num_sessions;
  }
  for (const core::UnsealingRow& unsealing : data.unsealings) {
    deviations.push_back(
        {"looks", "sealed until the rule ends the study",
         "unsealed on " + analysis::date_words(unsealing.time_ns) + " with " +
             analysis::counted_words(unsealing.num_complete, "complete session") + ": " +
             unsealing.reason});
  }
  if (conduct.num_complete != planned) {
    deviations.push_back({"number of participants",
                          analysis::counted_words(planned, "complete session"),
                          analysis::counted_words(conduct.num_complete, "complete session")});
  }
  const auto tell = [&](const std::set<std::string>& who, const char* topic,
                        const char* expected, const std::string& what) {
    if (!who.empty()) deviations.push_back({topic, expected, what + names_words_of(who)});
  };
  tell(conduct.before, "time of registration", "no session before it", "a session before it: ");
  tell(conduct.ended_early, "sessions", "all to their end", "ended early: ");
  tell(conduct.open, "sessions", "all to their end", "still open: ");
  tell(conduct.came_again, "participants", "one session each", "more than one: ");
  std::set<std::string> set_aside;
  std::size_t num_set_aside = 0;
  for (const analysis::ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.excluded_trials) {
      if (participant.left_out.contains(trial.block))
        continue;  // By the analysis, not by hand.
      ++num_set_aside;
      set_aside.insert(participant.participant);
    }
  }
  const std::string exclusions = plan.value("exclusions", "");
  tell(set_aside, "exclusions", exclusions.empty() ? "none" : exclusions.c_str(),
       analysis::counted_words(static_cast<std::int64_t>(num_set_aside), "trial") +
           " set aside by hand, of ");
  const std::vector<core::WithdrawalRow> withdrawals = store.withdrawals();
  if (!withdrawals.empty()) {
    deviations.push_back(
        {"participants", "all in the data", std::to_string(withdrawals.size()) + " withdrew"});
  }
  const auto registered_version = plan.at("program_version").get<std::string>();
  std::set<std::string> others = conduct.versions;
  others.erase(registered_version);
  if (!others.empty()) {
    deviations.push_back(
        {"program", "jnd " + registered_version, "jnd " + names_words_of(others)});
  }
  const std::string device = plan.value("device", "");
  std::set<std::string> other_devices = conduct.devices;
  other_devices.erase(device);
  if (!device.empty() && !other_devices.empty()) {
    deviations.push_back({"device", device, names_words_of(other_devices)});
  } else if (conduct.devices.size() > 1) {
    deviations.push_back({"device", "one for all", names_words_of(conduct.devices)});
  }
  if (conduct.unblinded_ns && *conduct.unblinded_ns < conduct.last_ns) {
    deviations.push_back(
        {"blinding", "until the last answer",
         "unblinded on " + analysis::date_words(*conduct.unblinded_ns) + ", before it"});
  }
}

void compare_choices(const AnalysisChoices& choices, std::vector<Deviation>& deviations) {
  if (choices.delivered) {
    deviations.push_back({"analysis", "intensities as commanded", "as delivered"});
  }
  if (choices.inverted_out) {
    deviations.push_back(
        {"analysis", "everybody's answers", "without people who answer the wrong way round"});
  }
  if (choices.with_pilots) {
    deviations.push_back({"analysis", "no pilot sessions", "pilot sessions among the others"});
  }
  if (!choices.compared.empty()) {
    deviations.push_back(
        {"analysis", "the planned contrasts", "blocks compared besides: " + choices.compared});
  }
}

}  // namespace

analysis::PreregisteredStudy preregistered_study(const core::StudyStore& store,
                                                 const analysis::StudyData& data,
                                                 const AnalysisChoices& choices) {
  const std::optional<std::string> text = kept_preregistration(store);
  if (!text) return {};
  const Json plan = Json::parse(*text, nullptr, /*allow_exceptions=*/false);
  const bool is_sound = plan.is_object() && plan.value("format", 0) == 1 &&
                        plan.contains("study_sha256") && plan.contains("num_participants") &&
                        plan.contains("registered_time_ns");
  if (!is_sound) {
    throw core::Error(store.folder().string() +
                      ": expected a preregistration of this program, found another text");
  }
  analysis::PreregisteredStudy study{.registered_on = plan.value("registered_on", ""),
                                     .sha256 = core::sha256(*text)};
  const Conduct conduct(store, plan, choices.with_pilots);
  compare_designs(plan, data, conduct.protocols, study.deviations);
  compare_conduct(plan, conduct, data, store, study.deviations);
  compare_choices(choices, study.deviations);
  return study;
}

}  // namespace jnd::app
