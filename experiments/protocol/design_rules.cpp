#include "experiments/protocol/design_rules.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "experiments/procedures/contrast_conditions.h"
#include "experiments/procedures/rating.h"
#include "experiments/protocol/structure_check.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

Names strings_of(const json& list) {
  Names found;
  for (const json& one : list) {
    if (one.is_string()) found.push_back(one.get<std::string>());
  }
  return found;
}

class DesignRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    collect();
    check_factors();
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") == "block") check_block(stage, pointer);
    });
    check_levels_are_used();
    check_contrasts();
  }

 private:
  /// Collects the factors between people, by name, with their levels.
  void collect() {
    for (const json& field : list(file_.root(), "participant_fields")) {
      if (!field.is_object()) continue;
      Names& values = of_people_[word(field, "name")];
      for (const json& option : list(field, "options")) {
        if (option.is_object()) values.push_back(word(option, "value"));
      }
    }
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string&) {
      if (word(stage, "kind") == "block") {
        blocks_.push_back(word(stage, "name"));
        collect_questions(stage);
      }
      if (word(stage, "kind") != "counterbalance" || word(stage, "method") != "one_of") return;
      Names& arms = of_people_[word(stage, "name")];
      for (const json& arm : list(stage, "arms")) {
        if (arm.is_object()) arms.push_back(word(arm, "name"));
      }
    });
    for (const json& factor : list(file_.root(), "factors")) {
      if (!factor.is_object()) continue;
      const std::string name = word(factor, "name");
      levels_[name] = strings_of(list(factor, "levels"));
      if (!of_people_.contains(name) && name != kBlockFactor) within_.push_back(name);
    }
  }

  void collect_questions(const json& block) {
    for (const json& item : list(block, "questions")) {
      const std::string name = item.is_object() ? word(item, "name") : "";
      if (!name.empty() && !contains(questions_, name)) questions_.push_back(name);
    }
  }

  void check_factors() {
    std::set<std::string> known;
    const json& factors = list(file_.root(), "factors");
    for (std::size_t i = 0; i < factors.size(); ++i) {
      if (!factors[i].is_object()) continue;
      const std::string at = "/factors/" + std::to_string(i);
      const std::string name = word(factors[i], "name");
      if (name == kBlockFactor) {
        report(at + "/name",
               "expected a name of its own, found `block`, a factor that every study has");
      } else if (!name.empty() && !known.insert(name).second) {
        report(at + "/name",
               "expected each factor once, found `" + shown_text(name) + "` a second time");
      }
      check_levels_of(factors[i], name, at + "/levels");
    }
  }

  void check_levels_of(const json& factor, const std::string& name, const std::string& at) {
    std::set<std::string> known;
    const json& levels = list(factor, "levels");
    const auto people = of_people_.find(name);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      if (!levels[i].is_string()) continue;
      const auto level = levels[i].get<std::string>();
      const std::string pointer = at + '/' + std::to_string(i);
      if (!is_name(level)) {
        report(pointer,
               "expected a name of at most 64 lower-case letters, digits and _, found `" +
                   shown_text(level) + "`");
      } else if (!known.insert(level).second) {
        report(pointer, "expected each level once, found `" + level + "` a second time");
      } else if (people != of_people_.end() && !contains(people->second, level)) {
        report(pointer, "expected one of what people are in `" + shown_text(name) +
                            "`: " + names_words(people->second) + ", found `" + level + "`" +
                            did_you_mean(level, people->second));
      }
    }
    if (people == of_people_.end()) return;
    for (const std::string& value : people->second) {
      if (value.empty() || known.contains(value) || known.empty()) continue;
      report(at, "expected all that people are in `" + shown_text(name) + "`, found no `" +
                     shown_text(value) + "`");
    }
  }

  void check_block(const json& block, const std::string& pointer) {
    const json& own = object_at(block, "levels");
    if (own.empty()) return;
    if (block.contains("practice")) {
      report(pointer + "/levels",
             "expected no levels in a block that is `practice`, which is no data, found some");
    }
    for (const auto& [factor, level] : own.items()) {
      if (factor == "comment" || !level.is_string()) continue;
      const std::string at = pointer + "/levels/" + pointer_token(factor);
      const auto known = levels_.find(factor);
      if (factor == kBlockFactor) {
        report(at,
               "expected a factor of the study, found `block`, of which every block is a "
               "level already");
      } else if (of_people_.contains(factor)) {
        report(at, "expected a factor that blocks differ in, found `" + shown_text(factor) +
                       "`, in which people differ");
      } else if (known == levels_.end()) {
        report(at, "expected one of the study's `factors`" +
                       (within_.empty() ? std::string(", of which there is none")
                                        : ": " + names_words(within_)) +
                       ", found `" + shown_text(factor) + "`" + did_you_mean(factor, within_));
      } else if (const auto name = level.get<std::string>(); !contains(known->second, name)) {
        report(at, "expected a level of `" + factor + "`: " + names_words(known->second) +
                       ", found `" + shown_text(name) + "`" +
                       did_you_mean(name, known->second));
      } else {
        used_.insert({factor, name});
      }
    }
    for (const std::string& factor : within_) {
      if (factor.empty() || own.contains(factor)) continue;
      report(pointer + "/levels", "expected a level of `" + shown_text(factor) +
                                      "` too, as the block has levels of other factors, "
                                      "found none");
    }
  }

  void check_levels_are_used() {
    const json& factors = list(file_.root(), "factors");
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const std::string name = factors[i].is_object() ? word(factors[i], "name") : "";
      if (name.empty() || name == kBlockFactor || of_people_.contains(name)) continue;
      const json& levels = list(factors[i], "levels");
      for (std::size_t j = 0; j < levels.size(); ++j) {
        if (!levels[j].is_string() || !is_name(levels[j].get<std::string>()) ||
            used_.contains({name, levels[j].get<std::string>()})) {
          continue;
        }
        report("/factors/" + std::to_string(i) + "/levels/" + std::to_string(j),
               "expected a block with this level in its `levels`, found none; a factor in "
               "which people differ has the name of a `one_of` counterbalance or of a "
               "participant field");
      }
    }
  }

  void check_contrasts() {
    std::set<std::string> known;
    std::map<std::string, std::string> corrections;
    const json& contrasts = list(file_.root(), "contrasts");
    for (std::size_t i = 0; i < contrasts.size(); ++i) {
      const json& contrast = contrasts[i];
      if (!contrast.is_object()) continue;
      const std::string at = "/contrasts/" + std::to_string(i);
      const std::string name = word(contrast, "name");
      if (!name.empty() && !known.insert(name).second) {
        report(at + "/name",
               "expected each contrast once, found `" + shown_text(name) + "` a second time");
      }
      check_weights(object_at(contrast, "of"), at + "/of");
      const json* smallest = number(contrast, "smallest_effect");
      const std::string measure = word(contrast, "measure");
      if (measure == to_string(ContrastMeasure::kQuestion)) {
        check_question(word(contrast, "question"), at + "/question");
      }
      const bool is_of_ratios =
          std::ranges::any_of(contrast_measures(), [&](ContrastMeasure known) {
            return to_string(known) == measure && is_ratio(known);
          });
      if (smallest != nullptr && is_of_ratios && !(smallest->get<double>() > 1.0)) {
        report(at + "/smallest_effect",
               "expected a ratio above 1, as 1.25 for a quarter more or a fifth less, found " +
                   smallest->dump());
      }
      check_correction(contrast, at, corrections);
    }
  }

  void check_question(const std::string& name, const std::string& at) {
    if (name.empty() || contains(questions_, name)) return;
    report(at, "expected the name of one of the `questions` after the trials of a block" +
                   (questions_.empty() ? std::string(", of which there is none")
                                       : ": " + names_words(questions_)) +
                   ", found `" + shown_text(name) + "`" + did_you_mean(name, questions_));
  }

  void check_correction(const json& contrast, const std::string& at,
                        std::map<std::string, std::string>& corrections) {
    std::string family = word(contrast, "family");
    if (family.empty()) family = word(contrast, "role");
    std::string correction = word(contrast, "correction");
    if (correction.empty()) correction = "holm";
    const auto [first, is_new] = corrections.emplace(family, correction);
    if (is_new || first->second == correction) return;
    report(at + (contrast.contains("correction") ? "/correction" : "/name"),
           "expected the correction of its family `" + shown_text(family) + "`, `" +
               first->second + "`, found `" + shown_text(correction) + "`");
  }

  void check_weights(const json& of, const std::string& pointer) {
    bool compares = false, is_sound = !of.empty();
    for (const auto& [factor, weights] : of.items()) {
      if (factor == "comment") continue;
      if (!weights.is_object() || weights.empty()) {
        is_sound = false;
        continue;
      }
      const std::string at = pointer + '/' + pointer_token(factor);
      const Names* levels = levels_of(factor);
      if (levels == nullptr) {
        Names names = {kBlockFactor};
        for (const auto& [name, its] : levels_) names.push_back(name);
        report(at, "expected one of the study's `factors` or `block`: " + names_words(names) +
                       ", found `" + shown_text(factor) + "`" + did_you_mean(factor, names));
        is_sound = false;
        continue;
      }
      double sum = 0.0, size = 0.0;
      bool are_numbers = true;
      for (const auto& [level, weight] : weights.items()) {
        if (level == "comment") continue;
        are_numbers &= weight.is_number();
        if (!weight.is_number()) continue;
        sum += weight.get<double>();
        size += std::abs(weight.get<double>());
        if (contains(*levels, level)) continue;
        report(at + '/' + pointer_token(level),
               "expected a level of `" + factor + "`: " + names_words(*levels) + ", found `" +
                   shown_text(level) + "`" + did_you_mean(level, *levels));
        is_sound = false;
      }
      if (!are_numbers) {
        is_sound = false;
        continue;
      }
      constexpr double kRounding = 1e-9;
      const bool is_zero_sum = std::abs(sum) <= kRounding * size;
      compares |= is_zero_sum && size > 0.0;
      if (size == 0.0) {
        report(at, "expected a weight other than 0, found none");
        is_sound = false;
      } else if (!is_zero_sum && sum < size) {
        report(at,
               "expected weights that add up to 0, to compare levels, or weights above 0 "
               "alone, to restrict the contrast to levels, found weights of both signs that "
               "add up to " +
                   plain_number(sum));
        is_sound = false;
      }
    }
    if (compares || !is_sound) return;
    report(pointer,
           "expected a factor with weights that add up to 0, such as "
           R"({"thin": 1, "thick": -1}, found none, so that nothing is compared)");
  }

  [[nodiscard]] const Names* levels_of(const std::string& factor) const {
    if (factor == kBlockFactor) return &blocks_;
    const auto found = levels_.find(factor);
    return found == levels_.end() ? nullptr : &found->second;
  }

  std::map<std::string, Names> of_people_;  ///< Factors between people, with their levels.
  std::map<std::string, Names> levels_;     ///< Levels of the study's factors.
  Names within_;                            ///< Those of the factors that are within people.
  Names blocks_;
  Names questions_;  ///< Questions that any block asks after its trials.
  /// Factors and levels that some block has.
  std::set<std::pair<std::string, std::string>> used_;
};

class ContrastRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run(const Study& study) {
    std::map<std::string, const Block*> blocks;
    for_each_stage(study.stages, [&](const Stage& stage) {
      if (const auto* block = std::get_if<Block>(&stage.content)) blocks[stage.name] = block;
    });
    for (std::size_t i = 0; i < study.contrasts.size(); ++i) {
      const PlannedContrast& contrast = study.contrasts[i];
      const std::string at = "/contrasts/" + std::to_string(i) + "/of";
      const ContrastConditions found = contrast_conditions(study, contrast);
      if (!found.problem.empty()) {
        report(at, found.problem);
        continue;
      }
      for (const ContrastCondition& condition : found.conditions) {
        check_alike(condition, blocks, at);
      }
      check_one_quantity(contrast, found, blocks, at);
      check_one_scale(contrast, found, blocks, at);
    }
  }

 private:
  using Blocks = std::map<std::string, const Block*>;

  /// Blocks whose answers are combined must be alike.
  void check_alike(const ContrastCondition& condition, const Blocks& blocks,
                   const std::string& at) {
    const auto told = [](const Block& block) {
      return std::tuple(block.medium, block.quantity, block.reference_intensity,
                        block.standard_medium, task_key_of(block));
    };
    const Block& first = *blocks.at(condition.blocks.front());
    for (const std::string& name : condition.blocks) {
      if (told(*blocks.at(name)) == told(first)) continue;
      report(at,
             "expected blocks with the same levels to have the same medium, reference, "
             "standard and task, for their answers are taken together, found others in `" +
                 condition.blocks.front() + "` and `" + name +
                 "`; tell them apart by a factor, or name blocks with `block`");
      return;
    }
  }

  static std::string task_key_of(const Block& block) {
    return block.settings.has("task") ? block.settings.word("task") : "";
  }

  /// A ratio of a viscosity and a stiffness has no meaning. Times and pure numbers do not
  /// depend on the medium.
  void check_one_quantity(const PlannedContrast& contrast, const ContrastConditions& found,
                          const Blocks& blocks, const std::string& at) {
    if (contrast.measure != ContrastMeasure::kMatch) return;
    const Block& first = *blocks.at(found.conditions.front().blocks.front());
    for (const ContrastCondition& condition : found.conditions) {
      const Block& other = *blocks.at(condition.blocks.front());
      if (other.quantity == first.quantity) continue;
      report(at, "expected matches of one quantity, found " + first.quantity + " in `" +
                     found.conditions.front().name + "` and " + other.quantity + " in `" +
                     condition.name + "`");
      return;
    }
  }

  /// Steps of different scales, and numbers in different units, cannot be subtracted.
  void check_one_scale(const PlannedContrast& contrast, const ContrastConditions& found,
                       const Blocks& blocks, const std::string& at) {
    if (contrast.measure != ContrastMeasure::kRating &&
        contrast.measure != ContrastMeasure::kQuestion) {
      return;
    }
    const std::string first = found.conditions.front().blocks.front();
    const std::string scale = scale_words(contrast, *blocks.at(first));
    for (const ContrastCondition& condition : found.conditions) {
      for (const std::string& name : condition.blocks) {
        const std::string other = scale_words(contrast, *blocks.at(name));
        if (other == scale) continue;
        report(at, "expected the answers of all blocks on one scale, found " + scale + " in `" +
                       first + "` and " + other + " in `" + name +
                       "`; give them the same scale, or compare them in `response_time`");
        return;
      }
    }
  }

  /// Returns "7 steps", "a number in s" or "yes or no".
  static std::string scale_words(const PlannedContrast& contrast, const Block& block) {
    if (contrast.measure == ContrastMeasure::kRating) {
      return std::to_string(num_steps_of(block)) + " steps";
    }
    const auto item =
        std::ranges::find(block.questions, contrast.question, &QuestionnaireItem::name);
    if (item->kind == "scale") return std::to_string(item->num_steps) + " steps";
    if (item->kind == "yes_no") return "yes or no";
    return item->unit.empty() ? "a number" : "a number in " + shown_text(item->unit);
  }
};

}  // namespace

void check_design_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  DesignRules(file, problems).run();
}

void check_contrasts(const LocatedJson& file, const Study& study,
                     std::vector<StudyProblem>& problems) {
  ContrastRules(file, problems).run(study);
}

}  // namespace jnd::experiments
