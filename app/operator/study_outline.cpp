#include "app/operator/study_outline.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "analysis/results/block_words.h"
#include "app/language/words.h"
#include "app/session/pseudonym.h"
#include "core/error.h"
#include "core/storage/study_store.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// The values with the quantity's name if it has no unit, such as "scale 0.5, 2".
std::string of_quantity(const std::string& quantity, const std::string& values) {
  if (!experiments::quantity_unit(quantity).empty()) return values;
  return quantity == "scale" ? tr("scale {}", values) : name_words(quantity) + " " + values;
}

std::string starting_values(std::size_t count) {
  return trn("{} starting value", "{} starting values", static_cast<std::int64_t>(count));
}

std::string questions_words(std::size_t count) {
  return trn("{} question", "{} questions", static_cast<std::int64_t>(count));
}

/// Writes the lines of a study's stages; those in counterbalances are indented.
class Outliner {
 public:
  Outliner(const Study& study, StudyOutline& outline)
      : language_(shown_language(study.languages)),
        hides_(outline.hides_levels),
        stages_(outline.stages) {}

  double add(const std::vector<Stage>& stages, int depth) {
    double duration_s = 0.0;
    // The index of the group's line.
    std::size_t group = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const bool is_mixed = stages[i].interleaving.has_value();
      const bool is_next =
          is_mixed && i > 0 && stages[i].interleaving == stages[i - 1].interleaving;
      if (is_mixed && !is_next) group = add_group(*stages[i].interleaving, depth);
      const double its_s = add(stages[i], is_mixed ? depth + 1 : depth);
      if (is_mixed) stages_[group].duration_s += its_s;
      duration_s += its_s;
    }
    return duration_s;
  }

 private:
  std::size_t add_group(const Interleaving& group, int depth) {
    stages_.push_back(
        {.title = hides_ ? tr("Interleaved blocks") : title_of(group, language_),
         .kind = tr("Interleaved"),
         .depth = depth,
         .what = group.turns == Turns::kRandom
                     ? tr("trials of the blocks below, mixed at random")
                     : tr("trials of the blocks below, mixed in rounds of one trial each")});
    return stages_.size() - 1;
  }

  double add(const Stage& stage, int depth) {
    const std::size_t place = stages_.size();
    OutlineStage line{.title = title(stage), .depth = depth, .line = stage.line};
    line.duration_s = expected_duration_s(stage);
    line.only_for = only_for(stage);
    std::visit([&](const auto& content) { describe(content, line); }, stage.content);
    stages_.push_back(std::move(line));
    if (const auto* counterbalance = std::get_if<Counterbalance>(&stage.content)) {
      stages_[place].duration_s = add_arms(*counterbalance, depth + 1);
    }
    return stages_[place].duration_s;
  }

  double add_arms(const Counterbalance& counterbalance, int depth) {
    double sum_s = 0.0;
    double longest_s = 0.0;
    int number = 0;
    for (const Counterbalance::Arm& arm : counterbalance.arms) {
      ++number;
      const std::size_t place = stages_.size();
      stages_.push_back(
          {.title = hides_ ? tr("Arm {}", number) : name_words(arm.name, /*as_title=*/true),
           .kind = tr("Arm"),
           .is_arm = true,
           .depth = depth});
      const double arm_s = add(arm.stages, depth + 1);
      stages_[place].duration_s = arm_s;
      sum_s += arm_s;
      longest_s = std::max(longest_s, arm_s);
    }
    if (counterbalance.method == Counterbalance::Method::kOneOf) return longest_s;
    if (counterbalance.between.empty()) return sum_s;
    const std::size_t place = stages_.size();
    stages_.push_back(
        {.title = tr("Between two arms"), .kind = tr("Arm"), .is_arm = true, .depth = depth});
    const double between_s = add(counterbalance.between, depth + 1);
    stages_[place].duration_s = between_s;
    return sum_s + between_s * static_cast<double>(counterbalance.arms.size() - 1);
  }

  std::string title(const Stage& stage) {
    if (hides_ && std::holds_alternative<Block>(stage.content)) {
      return tr("Block {}", ++num_blocks_);
    }
    if (hides_ && std::holds_alternative<Counterbalance>(stage.content)) {
      return tr("Counterbalance");
    }
    return title_of(stage, language_);
  }

  std::string only_for(const Stage& stage) const {
    std::string conditions;
    for (const auto& [counterbalance, arm] : stage.only_for) {
      const std::string where = name_words(counterbalance, false);
      const std::string is = name_words(arm, false);
      if (!conditions.empty()) conditions += "; ";
      conditions += where == is ? tr("only in the arm “{}”", is)
                                : tr("only in the arm “{}” of “{}”", is, where);
    }
    return hides_ && !conditions.empty() ? tr("only for some participants") : conditions;
  }

  void describe_media(const std::vector<Exploration>& media, OutlineStage& line) const {
    for (const Exploration& medium : media) {
      const bool hidden = hides_ && medium.setting.medium != "free_space";
      line.details.push_back((hidden ? std::string(tr("a fluid")) : words_of(medium.setting)) +
                             ", " + duration_words(medium.duration_s));
    }
  }

  // These describe the kinds of stages, one overload each.

  void describe(const Checklist& checklist, OutlineStage& line) const {
    line.kind = tr("Checklist");
    line.what = trn("{} item", "{} items", checklist.items.size());
  }
  void describe(const Consent& consent, OutlineStage& line) const {
    line.kind = tr("Consent");
    line.what = trn("{} paragraph", "{} paragraphs", consent.paragraphs.size());
  }
  void describe(const Explore& explore, OutlineStage& line) const {
    line.kind = tr("Exploration");
    line.what = trn("{} medium", "{} media", explore.media.size());
    describe_media(explore.media, line);
  }
  void describe(const Training& training, OutlineStage& line) const {
    line.kind = tr("Training");
    line.what = trn("{} example", "{} examples", training.examples.size());
    describe_media(training.examples, line);
  }
  static void describe_answering(const Block& block, OutlineStage& line) {
    if (block.cannot_tell) line.details.emplace_back(tr("\"cannot tell\" is an answer, too"));
    if (block.answer_deadline_s) {
      line.details.push_back(
          tr("an answer has {:g} s, or it is missed and the trial comes again",
             *block.answer_deadline_s));
    }
    if (block.min_stimulus_s > 0.0) {
      line.details.push_back(
          tr("a stimulus is felt for {:g} s at least", block.min_stimulus_s));
    }
    if (block.max_stimulus_s) {
      line.details.push_back(
          tr("a stimulus is felt for {:g} s at most", *block.max_stimulus_s));
    }
    if (block.max_returns) {
      line.details.push_back(trn("a trial allows {} return to a stimulus",
                                 "a trial allows {} returns to a stimulus",
                                 *block.max_returns));
    }
  }
  void describe(const Block& block, OutlineStage& line) const {
    line.kind = procedure_words(block.procedure);
    const Procedure& procedure = procedure_named(block.procedure);
    const int num_trials = expected_trials(block);
    const bool adjusts = procedure.form(block).adjustable;
    const std::string trials = trn("{1} trial", "{1} trials", num_trials,
                                   analysis::trials_to_expect(block, num_trials));
    const std::size_t count = block.intensities.size();
    if (analysis::length_is_expected(block)) {
      line.what = analysis::adaptive_words(block) + ": " + trials;
    } else if (adjusts && !block.standards.empty()) {
      line.what = tr("{} for {}: {}", starting_values(count),
                     trn("{} standard", "{} standards", block.standards.size()), trials);
    } else if (block.target_percent.empty()) {
      line.what = trn(
          "{} stimulus, {}: {}", "{} stimuli, {}: {}", count,
          block.repetitions == 1 ? std::string(tr("once")) : tr("{} times", block.repetitions),
          trials);
    } else {
      line.what = tr("{} for {}: {}", starting_values(count),
                     trn("{} target", "{} targets", block.target_percent.size()), trials);
    }
    if (block.practice) {
      line.details.push_back(
          tr("practice, until {:.0f} % of the last {} answers are right, at most {} trials",
             100.0 * block.practice->min_correct_ratio, block.practice->num_trials_judged,
             block.practice->max_trials));
    }
    if (block.feedback)
      line.details.emplace_back(tr("right or wrong is told after each answer"));
    describe_answering(block, line);
    if (!block.questions.empty()) {
      line.details.push_back(trn("{} more question after each trial",
                                 "{} more questions after each trial",
                                 static_cast<std::int64_t>(block.questions.size())));
    }
    if (block.masking_noise || block.cues) {
      line.details.emplace_back(tr("with noise or cues of its own"));
    }
    if (hides_) {
      line.details.emplace_back(tr("levels hidden: double-blind"));
      return;
    }
    const std::string unit = experiments::quantity_unit(block.quantity);
    if (analysis::length_is_expected(block)) {
      for (const std::string& words : analysis::adaptive_level_words(block, unit)) {
        line.details.push_back(medium_words(block.medium) + ", " +
                               of_quantity(block.quantity, words));
      }
    } else {
      line.details.push_back(
          medium_words(block.medium) + ", " +
          of_quantity(block.quantity, analysis::list_of(block.intensities, unit)));
    }
    if (block.reference_intensity) {
      line.details.push_back(tr(
          "reference {}",
          of_quantity(block.quantity, analysis::list_of({*block.reference_intensity}, unit))));
    }
    if (!block.standards.empty()) {
      const std::string quantity = quantity_of(block.standard_medium);
      const std::string its_unit = experiments::quantity_unit(quantity);
      line.details.push_back(
          tr("standard {}, {}", medium_words(block.standard_medium),
             of_quantity(quantity, analysis::list_of(block.standards, its_unit))));
    }
    if (!block.target_percent.empty()) {
      line.details.push_back(tr("targets {}", analysis::list_of(block.target_percent, "%")));
    }
    if (adjusts) {
      line.details.push_back(
          tr("steps of {}", analysis::list_of({block.coarse_step, block.fine_step}, unit)));
    }
  }
  void describe(const Break& rest, OutlineStage& line) const {
    line.kind = tr("Break");
    line.what = tr("at least {}", duration_words(rest.duration_s));
  }
  void describe(const PostExperiment& post, OutlineStage& line) const {
    line.kind = tr("After the experiment");
    line.what = questions_words(post.items.size());
    if (hides_) return;
    for (const PostExperimentItem& item : post.items) {
      line.details.push_back(words_of(item.setting));
    }
  }
  void describe(const Questionnaire& questionnaire, OutlineStage& line) const {
    line.kind = tr("Questionnaire");
    line.what = questions_words(questionnaire.items.size());
  }
  void describe(const Counterbalance& counterbalance, OutlineStage& line) const {
    const bool order = counterbalance.method != Counterbalance::Method::kOneOf;
    line.kind = order ? tr("Order") : tr("Choice");
    line.what = order ? trn("{} arm, their order balanced", "{} arms, their order balanced",
                            counterbalance.arms.size())
                      : trn("one of {} arm", "one of {} arms", counterbalance.arms.size());
  }

  std::string language_;
  bool hides_;
  std::vector<OutlineStage>& stages_;
  int num_blocks_ = 0;
};

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all;
}

std::string blinding_words(Blinding blinding) {
  switch (blinding) {
    case Blinding::kNone:
      return tr("not blind");
    case Blinding::kParticipant:
      return tr("the participant is blind to the levels");
    case Blinding::kDouble:
      return tr("double-blind");
  }
  return "";
}

/// The order of a block, such as "Group D: 2.1, 1.2 Pa s". In a production, each target begins
/// a new part. If the answers decide, it says how they do.
std::string order_line(const PlannedBlock& planned, const std::string& language) {
  const auto& block = std::get<Block>(planned.stage->content);
  std::string line = title_of(*planned.stage, language) + ": ";
  if (block.practice) {
    return line + tr("practice, at most {} trials", planned.num_trials);
  }
  if (analysis::length_is_expected(block)) {
    return line + tr("{} trials, {}", analysis::trials_to_expect(block, planned.num_trials),
                     analysis::adaptive_words(block));
  }
  double target = -1.0;
  bool first = true;
  for (const PlannedTrial& trial : planned.trials) {
    if (trial.target_percent && *trial.target_percent != target) {
      target = *trial.target_percent;
      line += (first ? "" : "; ") + tr("to {:g} % from ", target);
      first = true;
    }
    line += (first ? "" : ", ") + analysis::stimulus_words(trial);
    first = false;
  }
  const std::string unit = experiments::quantity_unit(block.quantity);
  return line + (unit.empty() ? "" : " " + unit);
}

/// Which blocks a group mixes, and their turns by their places in the group.
std::string group_line(const PlannedGroup& group, const std::string& language) {
  std::string blocks, turns;
  for (std::size_t i = 0; i < group.blocks.size(); ++i) {
    blocks += (i == 0 ? "" : ", ") + std::to_string(i + 1) + " " +
              title_of(*group.blocks[i], language);
  }
  for (const std::size_t index : group.order) turns += " " + std::to_string(index + 1);
  const std::string title = title_of(*group.blocks.front()->interleaving, language);
  const std::string mixed =
      group.turns == Turns::kRandom ? tr("mixed at random") : tr("mixed in rounds");
  return turns.empty() ? tr("{}: {}, {}", title, blocks, mixed)
                       : tr("{}: {}, {}:{}", title, blocks, mixed, turns);
}

}  // namespace

StudyOutline outline_of(const Study& study, bool shows_levels) {
  const std::string& language = shown_language(study.languages);
  StudyOutline outline{.name = study.name,
                       .title = title_of(study),
                       .description = in_language(study.description, language),
                       .authors = joined(study.authors),
                       .languages = joined(study.languages),
                       .blinding = blinding_words(study.blinding),
                       .citation = study.citation};
  outline.device =
      trn("{} point of the hand or more, {:g} Hz", "{} points of the hand or more, {:g} Hz",
          study.device.min_contact_points, study.device.rate_hz);
  outline.sound = !has_sound(study)       ? tr("nothing is played")
                  : requires_sound(study) ? tr("noise or cues, without which no session begins")
                                          : tr("noise or cues");
  outline.hides_levels = study.blinding == Blinding::kDouble && !shows_levels;
  Outliner(study, outline).add(study.stages, 0);
  bool first = true;
  for (const Cell& cell : cells_of(study)) {
    double duration_s = 0.0;
    int num_trials = 0;
    for (const StageInstance& instance : stages_of(study, cell)) {
      duration_s += expected_duration_s(*instance.stage);
      const auto* block = std::get_if<Block>(&instance.stage->content);
      if (block == nullptr) continue;
      num_trials += expected_trials(*block);
    }
    outline.shortest_s = first ? duration_s : std::min(outline.shortest_s, duration_s);
    outline.longest_s = std::max(outline.longest_s, duration_s);
    outline.num_trials = std::max(outline.num_trials, num_trials);
    first = false;
  }
  return outline;
}

StudyOutline read_outline(const std::filesystem::path& file) {
  StudyWatch watch(file);
  return watch.outline();
}

double longest_session_s(const Study& study) { return outline_of(study).longest_s; }

std::vector<PlannedOrder> planned_orders(const Study& study, const OrdersRequest& request) {
  PlanRequest plan{.seed = request.seed};
  bool unblinded = false;
  if (request.folder.empty()) {
    plan.participants = next_participants({}, request.num_participants);
  } else {
    const core::StudyStore store(request.folder, core::StudyStore::Mode::kReadOnly);
    plan.num_earlier_sessions = static_cast<std::int64_t>(store.sessions().size());
    plan.participants = next_participants(store, request.num_participants);
    plan.completed = completed_cells(store);
    unblinded = store.unblinded();
  }
  if (study.blinding == Blinding::kDouble && !unblinded) return {};
  std::vector<PlannedOrder> orders;
  for (const ParticipantPlan& planned : plan_participants(study, plan)) {
    PlannedOrder order{.participant = planned.participant,
                       .cells = cell_words(study, planned.cell),
                       .duration_s = planned.duration_s};
    for (const PlannedBlock& block : planned.blocks) {
      order.blocks.push_back(order_line(block, shown_language(study.languages)));
    }
    for (const PlannedGroup& group : planned.groups) {
      order.blocks.push_back(group_line(group, shown_language(study.languages)));
    }
    orders.push_back(std::move(order));
  }
  return orders;
}

}  // namespace jnd::app
