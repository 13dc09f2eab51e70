#include "analysis/report/recording_conditions.h"

#include "analysis/report/plot_parts.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

bool has_strokes(const ConditionMovement& condition) {
  return condition.curves.num_strokes > 0 && !condition.curves.stroke_percent.empty();
}

std::string quantity_of(const FigureSource& source, const ConditionMovement& condition) {
  for (const BlockDesign& block : source.data.blocks) {
    if (block.block == condition.block) return block.quantity;
  }
  return experiments::quantity_of(condition.medium);
}

}  // namespace

ShownCondition shown_condition(const FigureSource& source, const ConditionMovement& condition) {
  ShownCondition one{.name = condition.block.empty() ? condition.medium : condition.block,
                     .title = condition.block.empty()
                                  ? said_of(in_words(condition.medium))
                                  : source.titles.short_title_of(condition.block),
                     .movement = &condition};
  if (!condition.intensity || condition.medium == "free_space") return one;
  const std::string amount = shortest_words(*condition.intensity);
  const std::string unit = experiments::quantity_unit(quantity_of(source, condition));
  one.name = file_word(one.name + "_" + amount);
  one.title += unit.empty() ? said(", scale {}", amount) : ", " + amount + " " + unit;
  return one;
}

std::string selection_words(std::size_t num_shown, std::size_t num_there,
                            const std::string& of_what) {
  if (num_shown >= num_there) return "";
  return said(" A selection: the first {} of {} {}.", std::to_string(num_shown),
              std::to_string(num_there), of_what);
}

std::string person_selection_words(const MovementAnalysis& movement) {
  std::size_t num_recorded = 0;
  for (const ParticipantMovement& person : movement.participants) {
    num_recorded += person.num_samples > 0 ? 1 : 0;
  }
  if (num_recorded < 2) return "";
  return said(" (one of {} with recordings)", std::to_string(num_recorded));
}

std::vector<ShownCondition> whole_conditions(const FigureSource& source,
                                             const ParticipantMovement& person) {
  std::vector<ShownCondition> blocks;
  std::vector<ShownCondition> explored;
  for (const ConditionMovement& condition : person.conditions) {
    if (!has_strokes(condition)) continue;
    if (condition.block.empty()) {
      explored.push_back(shown_condition(source, condition));
    } else if (!condition.intensity) {
      blocks.push_back(shown_condition(source, condition));
    }
  }
  return blocks.empty() ? explored : blocks;
}

std::vector<ShownCondition> each_intensity(const FigureSource& source,
                                           const ParticipantMovement& person) {
  std::vector<ShownCondition> explored;
  std::vector<ShownCondition> inside;
  for (const ConditionMovement& condition : person.conditions) {
    if (!has_strokes(condition)) continue;
    if (condition.block.empty()) explored.push_back(shown_condition(source, condition));
    if (!condition.block.empty() && condition.intensity) {
      inside.push_back(shown_condition(source, condition));
    }
  }
  return explored.size() >= 3 || inside.empty() ? explored : inside;
}

const ParticipantMovement* shown_participant(const FigureSource& source,
                                             const MovementAnalysis& movement) {
  const ParticipantMovement* best = nullptr;
  std::size_t most = 0;
  for (const ParticipantMovement& person : movement.participants) {
    std::size_t points = 0;
    for (const ShownCondition& condition : whole_conditions(source, person)) {
      points += condition.movement->curves.has_joints ? 100 : 1;
    }
    if (points > most) {
      most = points;
      best = &person;
    }
  }
  return best;
}

std::string turn_lines(const StrokeCurves& curves) {
  std::string lines;
  int number = 10;
  for (const std::optional<double>& turn :
       {curves.turn_forward_percent, curves.turn_back_percent}) {
    const std::string arrow = "  unset arrow " + std::to_string(number) + "\n";
    lines += arrow;
    if (turn) {
      const std::string x = plot_number(*turn);
      lines += "  set arrow " + std::to_string(number) + " from " + x + ",graph 0 to " + x +
               ",graph 1 nohead ls 12\n";
    }
    ++number;
  }
  return lines;
}

}  // namespace jnd::analysis
