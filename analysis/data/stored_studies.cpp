#include "analysis/data/stored_studies.h"
#include "analysis/words/said.h"

#include <variant>

#include "experiments/protocol/study_reader.h"
#include "experiments/study/stage_walk.h"

namespace jnd::analysis {

using experiments::Block;
using experiments::Stage;
using experiments::Study;

const Study& StoredStudies::study(const std::string& protocol_sha256) & {
  const auto known = studies_.find(protocol_sha256);
  if (known != studies_.end()) return known->second;
  const std::string text = store_.protocol(protocol_sha256).text;
  const Study& study = studies_[protocol_sha256] =
      experiments::study_as_written(text, store_.folder().string() + ": protocol");
  for_each_stage(study.stages, [&](const Stage& stage) {
    const Block* block = std::get_if<Block>(&stage.content);
    if (block != nullptr) blocks_[protocol_sha256][stage.name] = block;
  });
  return study;
}

const Block& StoredStudies::block(const std::string& protocol_sha256,
                                  const std::string& name) & {
  static const Block kNone;
  (void)study(protocol_sha256);
  const std::map<std::string, const Block*>& blocks = blocks_[protocol_sha256];
  const auto found = blocks.find(name);
  return found == blocks.end() ? kNone : *found->second;
}

std::string in_spoken_language(const experiments::Text& text) {
  const auto found = text.find(spoken().code);
  return found == text.end() ? in_english(text) : found->second;
}

std::string in_english(const experiments::Text& text) {
  const auto english = text.find("en");
  if (english != text.end()) return english->second;
  return text.empty() ? "" : text.begin()->second;
}

}  // namespace jnd::analysis
