#include "experiments/protocol/sound_rules.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

constexpr const char* kSoundKeys[] = {"masking_noise", "cues"};

/// Returns the value without comments.
json without_comments(json value) {
  if (value.is_object()) value.erase("comment");
  for (json& inner : value) {
    if (inner.is_structured()) inner = without_comments(inner);
  }
  return value;
}

class SoundRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    check_sounds(file_.root(), "");
    const bool is_blind =
        !word(file_.root(), "blinding").empty() && word(file_.root(), "blinding") != "none";
    const json* first = nullptr;
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      const std::string kind = word(stage, "kind");
      if (kind == "interleaved" && !is_blind) check_group(stage, pointer + "/blocks/");
      if (kind != "block") return;
      check_sounds(stage, pointer);
      if (first == nullptr) first = &stage;
      if (is_blind) {
        check_alike(*first, stage, pointer,
                    "somebody who is to be blind would hear which block it is");
      }
    });
  }

 private:
  void check_sounds(const json& object, const std::string& at) {
    const json& noise = object_at(object, "masking_noise");
    const std::string here = at + "/masking_noise";
    if (!noise.empty() && word(noise, "kind") != "none") check_level(noise, here);
    const json* low = number(noise, "low_hz");
    const json* high = number(noise, "high_hz");
    if (low != nullptr && high != nullptr && !(low->get<double>() < high->get<double>())) {
      report(here + "/low_hz", "expected a frequency below `high_hz` (" + high->dump() +
                                   " Hz), found " + low->dump());
    }
    std::set<std::string> moments;
    const json& cues = list(object, "cues");
    for (std::size_t i = 0; i < cues.size(); ++i) {
      if (!cues[i].is_object()) continue;
      const std::string cue = at + "/cues/" + std::to_string(i);
      check_level(cues[i], cue);
      const std::string moment = word(cues[i], "moment");
      if (!moment.empty() && !moments.insert(moment).second) {
        report(cue + "/moment", "expected one cue for a moment, found a second one for `" +
                                    shown_text(moment) + "`; leave one of them out");
      }
    }
  }

  void check_level(const json& sound, const std::string& at) {
    const bool has_spl = sound.contains("level_db_spl"),
               has_dbfs = sound.contains("level_dbfs");
    if (has_spl != has_dbfs) return;
    report(at, std::string("expected either `level_db_spl` or `level_dbfs`, found ") +
                   (has_spl ? "both" : "neither") +
                   "; the first needs an output that is calibrated, the second is as loud as "
                   "the machine makes it");
  }

  void check_group(const json& group, const std::string& at) {
    const json& blocks = list(group, "blocks");
    const json* first = nullptr;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!blocks[i].is_object() || word(blocks[i], "kind") != "block") continue;
      if (first == nullptr) first = &blocks[i];
      check_alike(*first, blocks[i], at + std::to_string(i),
                  "the sound would tell whose trial comes");
    }
  }

  void check_alike(const json& first, const json& block, const std::string& at,
                   const std::string& why) {
    for (const char* key : kSoundKeys) {
      if (heard(first, key) == heard(block, key)) continue;
      // The problem is reported at the key in the file: the block's own, or that of the first
      // block.
      report(block.contains(key) ? at + '/' + key : at,
             std::string("expected the same `") + key + "` as in `" +
                 shown_text(word(first, "name")) + "`, found other ones; " + why +
                 ", so write it once, beside `stages`");
    }
  }

  [[nodiscard]] json heard(const json& block, const char* key) const {
    const auto own = block.find(key);
    if (own != block.end()) return without_comments(*own);
    const auto all = file_.root().find(key);
    return all == file_.root().end() ? json() : without_comments(*all);
  }
};

}  // namespace

void check_sound_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  SoundRules(file, problems).run();
}

}  // namespace jnd::experiments
