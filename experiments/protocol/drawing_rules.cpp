#include "experiments/protocol/drawing_rules.h"

#include <map>
#include <string>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class Drawing : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run(const Study& study, bool with_check) {
    with_check_ = with_check;
    std::map<std::string, const Block*> blocks;
    for_each_stage(study.stages, [&](const Stage& stage) {
      if (const auto* block = std::get_if<Block>(&stage.content)) blocks[stage.name] = block;
    });
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      const auto block = blocks.find(word(stage, "name"));
      if (block != blocks.end()) draw(stage, *block->second, pointer);
    });
  }

 private:
  void draw(const json& written, const Block& block, const std::string& pointer) {
    core::RandomStream stream(1, "order");
    try {
      const Procedure& procedure = procedure_named(block.procedure);
      if (with_check_) procedure.check(block);
      (void)procedure.draw_next(block, {}, stream);
    } catch (const core::Error& error) {
      tell(written, pointer, error.what());
    }
  }

  /// Reports "staircase.start: expected ..." at the key of that name, with or without its
  /// quantity.
  void tell(const json& written, const std::string& pointer, const std::string& words) {
    const std::size_t colon = words.find(": ");
    const std::size_t dot = words.find('.');
    if (colon == std::string::npos || dot == std::string::npos || dot > colon) {
      return report(pointer, words);
    }
    const std::string name = words.substr(dot + 1, colon - dot - 1);
    const std::string message = words.substr(colon + 2);
    for (const auto& [key, value] : written.items()) {
      if (key == name || key.starts_with(name + '_'))
        return report(pointer + '/' + key, message);
    }
    report(pointer, words);
  }

  bool with_check_ = true;
};

}  // namespace

void check_drawing(const LocatedJson& file, const Study& study,
                   std::vector<StudyProblem>& problems, bool with_check) {
  Drawing(file, problems).run(study, with_check);
}

}  // namespace jnd::experiments
