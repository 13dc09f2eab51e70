#include "experiments/protocol/study_builder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Reads one object: values by key, with defaults from the table. A key that is absent without
/// a default gives 0, false or empty. In a checked study this happens only to keys that may be
/// absent.
class ObjectReader {
 public:
  ObjectReader(const json& object, const ParameterTable& table)
      : object_(object), table_(table) {}

  [[nodiscard]] double number(const std::string& key) const { return get<double>(key); }
  [[nodiscard]] int integer(const std::string& key) const {
    constexpr double kLargest = 1e9;
    const double number = get<double>(key);
    if (!(std::abs(number) <= kLargest)) {
      throw core::Error(table_.name + '.' + key + ": expected a number of at most a billion");
    }
    return static_cast<int>(number);
  }
  [[nodiscard]] bool boolean(const std::string& key) const { return get<bool>(key); }
  [[nodiscard]] std::string string(const std::string& key) const {
    return get<std::string>(key);
  }
  [[nodiscard]] std::optional<double> optional_number(const std::string& key) const {
    const json found = value(key);
    return found.is_null() ? std::nullopt : std::optional<double>(found.get<double>());
  }
  [[nodiscard]] std::vector<double> numbers(const std::string& key) const {
    return get<std::vector<double>>(key);
  }
  [[nodiscard]] std::vector<std::string> strings(const std::string& key) const {
    return get<std::vector<std::string>>(key);
  }
  [[nodiscard]] Text text(const std::string& key) const { return to_text(value(key)); }
  [[nodiscard]] std::map<std::string, std::string> names(const std::string& key) const {
    return to_text(value(key));
  }
  [[nodiscard]] std::map<std::string, std::map<std::string, double>> weights(
      const std::string& key) const {
    std::map<std::string, std::map<std::string, double>> found;
    const json written = value(key);
    for (const auto& [factor, levels] : written.items()) {
      if (factor == "comment") continue;
      for (const auto& [level, weight] : levels.items()) {
        if (level != "comment") found[factor][level] = weight.get<double>();
      }
    }
    return found;
  }
  [[nodiscard]] bool has(const std::string& key) const { return object_.contains(key); }
  /// Returns nothing for texts, and for a key that is absent and has no default.
  [[nodiscard]] std::optional<Settings::Value> setting(const std::string& key) const {
    const json found = value(key);
    if (found.is_null()) return std::nullopt;
    switch (parameter(key).kind) {
      case ValueKind::kNumber:
      case ValueKind::kInteger:
        return found.get<double>();
      case ValueKind::kBoolean:
        return found.get<bool>();
      case ValueKind::kString:
        return found.get<std::string>();
      case ValueKind::kNumbers:
        return found.get<std::vector<double>>();
      case ValueKind::kStrings:
        return found.get<std::vector<std::string>>();
      default:
        return std::nullopt;
    }
  }

  /// Calls `read(object reader, index)` for every object of a list, or never if it is absent.
  template <typename Read>
  void each_object(const std::string& key, Read read) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    for (std::size_t i = 0; i < found->size(); ++i) {
      read(ObjectReader((*found)[i], nested(key)), i);
    }
  }
  [[nodiscard]] ObjectReader object(const std::string& key) const {
    static const json kEmpty = json::object();
    const auto found = object_.find(key);
    return {found == object_.end() ? kEmpty : *found, nested(key)};
  }
  [[nodiscard]] json list(const std::string& key) const {
    return object_.contains(key) ? object_.at(key) : json::array();
  }

  static Text to_text(const json& words) {
    Text text;
    for (const auto& [language, sentence] : words.items()) {
      if (language != "comment") text[language] = sentence.get<std::string>();
    }
    return text;
  }

 private:
  [[nodiscard]] const ParameterTable& nested(const std::string& key) const {
    return *parameter(key).nested;
  }
  [[nodiscard]] const Parameter& parameter(const std::string& key) const {
    const Parameter* found = table_.find(key);
    // Asking for a key that is in no table is a mistake of the program, not of the file.
    if (found == nullptr) throw std::logic_error(table_.name + ": no parameter " + key);
    return *found;
  }
  template <typename T>
  [[nodiscard]] T get(const std::string& key) const {
    const json found = value(key);
    return found.is_null() ? T{} : found.get<T>();
  }
  [[nodiscard]] json value(const std::string& key) const {
    const Parameter& known = parameter(key);
    const auto found = object_.find(key);
    if (found != object_.end()) return *found;
    return known.default_json.empty() ? json() : json::parse(known.default_json);
  }

  const json& object_;
  const ParameterTable& table_;
};

MediumDetails details(const ObjectReader& in) {
  MediumDetails given;
  for (const Parameter& detail : medium_details()) {
    const double value = in.number(detail.key);
    if (value != detail_of({}, detail.key)) given[detail.key] = value;
  }
  return given;
}

MediumSetting setting(const ObjectReader& in) {
  MediumSetting setting = {
      .medium = in.string("medium"), .quantity = "", .intensity = 0.0, .details = details(in)};
  setting.quantity = quantity_of(setting.medium);
  if (!setting.quantity.empty()) setting.intensity = in.number(setting.quantity);
  return setting;
}

std::vector<Exploration> explorations(const ObjectReader& in, const std::string& key) {
  std::vector<Exploration> found;
  in.each_object(key, [&](const ObjectReader& item, std::size_t) {
    found.push_back({.setting = setting(item),
                     .duration_s = item.number("duration_s"),
                     .say = item.text("say")});
  });
  return found;
}

Checklist checklist(const ObjectReader& in) {
  Checklist checklist;
  in.each_object("items", [&](const ObjectReader& item, std::size_t) {
    checklist.items.push_back({.text = item.text("text"), .say = item.text("say")});
  });
  return checklist;
}

Consent consent(const ObjectReader& in) {
  Consent consent = {.paragraphs = {}, .agreement = in.text("agreement")};
  for (const json& paragraph : in.list("paragraphs")) {
    consent.paragraphs.push_back(ObjectReader::to_text(paragraph));
  }
  return consent;
}

Practice practice(const ObjectReader& in) {
  return {.min_correct_ratio = in.number("min_correct_ratio"),
          .num_trials_judged = in.integer("num_trials_judged"),
          .max_trials = in.integer("max_trials")};
}

StimulusOrder stimulus_order(const ObjectReader& in) {
  using Method = StimulusOrder::Method;
  const std::string method = in.string("method");
  StimulusOrder order;
  order.method = method == "mixed"      ? Method::kMixed
                 : method == "latin"    ? Method::kLatin
                 : method == "williams" ? Method::kWilliams
                                        : Method::kShuffled;
  if (in.has("max_in_a_row")) order.max_in_a_row = in.integer("max_in_a_row");
  order.min_distance = in.integer("min_distance");
  if (in.has("not_first")) order.not_first = in.numbers("not_first");
  return order;
}

std::vector<Option> options(const ObjectReader& in) {
  std::vector<Option> found;
  in.each_object("options", [&](const ObjectReader& option, std::size_t) {
    found.push_back({.value = option.string("value"), .label = option.text("label")});
  });
  return found;
}

std::vector<QuestionnaireItem> questions(const ObjectReader& in, const std::string& key) {
  std::vector<QuestionnaireItem> found;
  in.each_object(key, [&](const ObjectReader& item, std::size_t) {
    QuestionnaireItem read;
    read.name = item.string("name");
    read.kind = item.string("kind");
    read.question = item.text("question");
    read.required = item.boolean("required");
    read.unit = item.string("unit");
    read.minimum = item.optional_number("minimum");
    read.maximum = item.optional_number("maximum");
    read.options = options(item);
    read.num_steps = item.integer("num_steps");
    read.low_label = item.text("low_label");
    read.high_label = item.text("high_label");
    if (item.has("high_is_good")) read.high_is_good = item.boolean("high_is_good");
    found.push_back(std::move(read));
  });
  return found;
}

SoundLevel sound_level(const ObjectReader& in) {
  return {.level_db_spl = in.optional_number("level_db_spl"),
          .level_dbfs = in.optional_number("level_dbfs")};
}

MaskingNoise masking_noise(const ObjectReader& in) {
  using Kind = MaskingNoise::Kind;
  const std::string kind = in.string("kind");
  return {.kind = kind == "white"  ? Kind::kWhite
                  : kind == "pink" ? Kind::kPink
                  : kind == "band" ? Kind::kBand
                                   : Kind::kNone,
          .level = sound_level(in),
          .low_hz = in.number("low_hz"),
          .high_hz = in.number("high_hz"),
          .ramp_s = in.number("ramp_s"),
          .required = in.boolean("required")};
}

std::vector<Cue> cues(const ObjectReader& in) {
  std::vector<Cue> found;
  in.each_object("cues", [&](const ObjectReader& cue, std::size_t) {
    Cue read{.frequency_hz = cue.number("frequency_hz"),
             .duration_s = cue.number("duration_s"),
             .level = sound_level(cue),
             .required = cue.boolean("required")};
    for (const CueMoment moment : kCueMoments) {
      if (name(moment) == cue.string("moment")) read.moment = moment;
    }
    found.push_back(read);
  });
  return found;
}

Block block(const ObjectReader& in) {
  Block block;
  block.procedure = in.string("procedure");
  block.medium = in.string("medium");
  block.quantity = quantity_of(block.medium);
  block.details = details(in);
  block.instruction = in.text("instruction");
  block.question = in.text("question");
  block.yes_label = in.text("yes_label");
  block.no_label = in.text("no_label");
  block.first_label = in.text("first_label");
  block.second_label = in.text("second_label");
  block.third_label = in.text("third_label");
  block.low_label = in.text("low_label");
  block.high_label = in.text("high_label");
  const std::vector<BlockKey> keys = procedure_named(block.procedure).keys();
  if (std::ranges::any_of(keys, &BlockKey::of_standard)) {
    block.standard_medium = in.string("standard_medium");
    if (block.standard_medium == "none") block.standard_medium.clear();
  }
  const std::string standard_quantity = quantity_of(block.standard_medium);
  for (const BlockKey& key : keys) {
    // Without a medium there is no amount of it.
    if (key.of_standard && standard_quantity.empty()) continue;
    if (key.of_quantity && block.quantity.empty()) continue;
    if (auto value =
            in.setting(key.name_for(key.of_standard ? standard_quantity : block.quantity))) {
      block.settings.set(key.parameter.key, std::move(*value));
    }
  }
  block.intensities = block.settings.numbers("");
  block.free_space_between_s = in.number("free_space_between_s");
  block.expected_trial_s = in.number("expected_trial_s");
  block.min_stimulus_s = in.number("min_stimulus_s");
  block.max_stimulus_s = in.optional_number("max_stimulus_s");
  block.answer_deadline_s = in.optional_number("answer_deadline_s");
  if (in.has("max_returns")) block.max_returns = in.integer("max_returns");
  if (in.has("order")) block.order = stimulus_order(in.object("order"));
  if (in.has("repetitions")) block.repetitions = in.integer("repetitions");
  block.standards = block.settings.numbers("standard");
  block.target_percent = block.settings.numbers("target_percent");
  block.coarse_step = block.settings.number("coarse_step", 0.0);
  block.fine_step = block.settings.number("fine_step", 0.0);
  block.max_intensity = block.settings.optional_number("max");
  block.reference_intensity = block.settings.optional_number("reference");
  block.feedback = in.boolean("feedback");
  block.cannot_tell = in.boolean("cannot_tell");
  if (in.has("practice")) block.practice = practice(in.object("practice"));
  block.participant_answers = in.string("answered_by") == "participant";
  block.levels = in.names("levels");
  block.questions = questions(in, "questions");
  if (in.has("masking_noise")) block.masking_noise = masking_noise(in.object("masking_noise"));
  if (in.has("cues")) block.cues = cues(in);
  return block;
}

PostExperiment post_experiment(const ObjectReader& in) {
  PostExperiment stage;
  in.each_object("items", [&](const ObjectReader& item, std::size_t) {
    stage.items.push_back({.name = item.string("name"),
                           .setting = setting(item),
                           .instruction = item.text("instruction"),
                           .question = item.text("question"),
                           .answer = item.string("answer"),
                           .num_words = item.has("num_words") ? item.integer("num_words") : 0});
  });
  return stage;
}

Questionnaire questionnaire(const ObjectReader& in) {
  return {.instruction = in.text("instruction"), .items = questions(in, "items")};
}

class StageBuilder {
 public:
  explicit StageBuilder(const LocatedJson& file) : file_(file) {}

  [[nodiscard]] std::vector<Stage> stages(const json& list, const std::string& pointer) const {
    std::vector<Stage> built;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string here = pointer + '/' + std::to_string(i);
      if (list[i].at("kind") == interleaved_table().name) {
        std::ranges::move(interleaved(ObjectReader(list[i], interleaved_table()), here),
                          std::back_inserter(built));
      } else {
        built.push_back(stage(list[i], here));
      }
    }
    return built;
  }

 private:
  /// Returns the blocks of a group, each of which knows its group.
  [[nodiscard]] std::vector<Stage> interleaved(const ObjectReader& in,
                                               const std::string& pointer) const {
    const Interleaving group = {
        .name = in.string("name"),
        .title = in.text("title"),
        .turns = in.string("turns") == "random" ? Turns::kRandom : Turns::kRounds};
    std::vector<Stage> blocks = stages(in.list("blocks"), pointer + "/blocks");
    for (Stage& block : blocks) {
      // Only in a study that is not valid.
      if (!std::holds_alternative<Block>(block.content)) continue;
      block.interleaving = group;
      block.only_for = in.names("only_for");
    }
    return blocks;
  }

  [[nodiscard]] Stage stage(const json& object, const std::string& pointer) const {
    const std::string kind = object.at("kind").get<std::string>();
    const ParameterTable* table = stage_table(kind);
    if (table == nullptr) {
      throw core::Error(pointer + "/kind: expected a kind of stage, found `" + kind + "`");
    }
    const ObjectReader in(object, *table);
    Stage stage;
    stage.name = in.string("name");
    stage.title = in.text("title");
    if (kind != "counterbalance") stage.only_for = in.names("only_for");
    stage.line = file_.value_position(pointer).line;
    if (kind == "checklist") stage.content = checklist(in);
    if (kind == "consent") stage.content = consent(in);
    if (kind == "explore") {
      stage.content = Explore{in.text("instruction"), explorations(in, "media")};
    }
    if (kind == "training") {
      stage.content = Training{in.text("instruction"), explorations(in, "examples")};
    }
    if (kind == "block") stage.content = block(in);
    if (kind == "break") stage.content = Break{in.text("instruction"), in.number("duration_s")};
    if (kind == "post_experiment") stage.content = post_experiment(in);
    if (kind == "questionnaire") stage.content = questionnaire(in);
    if (kind == "counterbalance") stage.content = counterbalance(in, pointer);
    return stage;
  }

  [[nodiscard]] Counterbalance counterbalance(const ObjectReader& in,
                                              const std::string& pointer) const {
    Counterbalance content;
    using Method = Counterbalance::Method;
    const std::string method = in.string("method");
    content.method = method == "order"   ? Method::kOrder
                     : method == "latin" ? Method::kLatin
                                         : Method::kOneOf;
    content.stratify_by = in.string("stratify_by");
    in.each_object("arms", [&](const ObjectReader& arm, std::size_t index) {
      const std::string at = pointer + "/arms/" + std::to_string(index) + "/stages";
      content.arms.push_back({arm.string("name"), stages(arm.list("stages"), at)});
    });
    content.between = stages(in.list("between"), pointer + "/between");
    return content;
  }

  const LocatedJson& file_;
};

DeviceNeeds device_needs(const ObjectReader& in) {
  DeviceNeeds needs;
  needs.min_contact_points = in.integer("min_contact_points");
  needs.rate_hz = in.number("rate_hz");
  needs.ramp_s = in.number("ramp_s");
  needs.max_missed_ratio = in.number("max_missed_ratio");
  const ObjectReader immersion = in.object("immersion");
  if (const auto radius_m = immersion.optional_number("radius_m")) {
    needs.immersion.radius_m = *radius_m;
  }
  if (const auto depth_m = immersion.optional_number("depth_m")) {
    needs.immersion.depth_m = *depth_m;
  }
  needs.immersion.origin_x_m = immersion.number("origin_x_m");
  needs.immersion.origin_y_m = immersion.number("origin_y_m");
  needs.immersion.origin_z_m = immersion.number("origin_z_m");
  needs.wall_stiffness_n_per_m =
      immersion.optional_number("wall_stiffness_n_per_m").value_or(0.0);
  needs.wall_friction_ratio = immersion.number("wall_friction_ratio");
  in.each_object("force_map", [&](const ObjectReader& row, std::size_t) {
    needs.force_map.push_back({.angle_of_attack_rad = row.number("angle_of_attack_rad"),
                               .speed_m_per_s = row.number("speed_m_per_s"),
                               .drag_coefficient = row.number("drag_coefficient"),
                               .lift_coefficient = row.number("lift_coefficient")});
  });
  return needs;
}

PlannedContrast planned_contrast(const ObjectReader& in) {
  PlannedContrast contrast{.name = in.string("name"),
                           .hypothesis = in.text("hypothesis"),
                           .question = in.string("question"),
                           .weights = in.weights("of"),
                           .primary = in.string("role") == "primary",
                           .smallest_effect = in.optional_number("smallest_effect"),
                           .alpha = in.number("alpha"),
                           .family = in.string("family")};
  for (const ContrastMeasure measure : contrast_measures()) {
    if (to_string(measure) == in.string("measure")) contrast.measure = measure;
  }
  const std::string direction = in.string("direction");
  contrast.direction = direction == "greater" ? ContrastDirection::kGreater
                       : direction == "less"  ? ContrastDirection::kLess
                                              : ContrastDirection::kEither;
  const std::string correction = in.string("correction");
  contrast.correction = correction == "none"         ? Correction::kNone
                        : correction == "bonferroni" ? Correction::kBonferroni
                                                     : Correction::kHolm;
  if (contrast.family.empty()) contrast.family = in.string("role");
  return contrast;
}

SequentialPlan sequential_plan(const ObjectReader& in) {
  SequentialPlan plan{.contrast = in.string("contrast")};
  for (const double look : in.numbers("looks")) plan.looks.push_back(static_cast<int>(look));
  if (in.string("spending") == to_string(AlphaSpending::kPocock)) {
    plan.spending = AlphaSpending::kPocock;
  }
  return plan;
}

}  // namespace

Study build_study(const LocatedJson& file, std::string text) {
  const ObjectReader in(file.root(), study_table());
  Study study;
  study.format = in.integer("format");
  study.name = in.string("name");
  study.languages = in.strings("languages");
  study.title = in.text("title");
  study.description = in.text("description");
  study.authors = in.strings("authors");
  study.citation = in.string("citation");
  study.device = device_needs(in.object("device"));
  const std::string blinding = in.string("blinding");
  study.blinding = blinding == "double"        ? Blinding::kDouble
                   : blinding == "participant" ? Blinding::kParticipant
                                               : Blinding::kNone;
  const ObjectReader limits = in.object("session_limits");
  study.session_limits.max_duration_s = limits.optional_number("max_duration_s");
  study.session_limits.max_force_time_n_s = limits.optional_number("max_force_time_n_s");
  study.session_limits.max_under_force_s = limits.optional_number("max_under_force_s");
  if (limits.has("max_trials_without_break")) {
    study.session_limits.max_trials_without_break = limits.integer("max_trials_without_break");
  }
  if (in.has("masking_noise")) {
    study.sound.masking_noise = masking_noise(in.object("masking_noise"));
  }
  study.sound.cues = cues(in);
  const ObjectReader markers = in.object("markers");
  for (std::size_t kind = 0; kind < core::kNumMarkerKinds; ++kind) {
    study.markers.codes[kind] = markers.integer(std::string(core::kMarkerNames[kind]));
  }
  in.each_object("participant_fields", [&](const ObjectReader& field, std::size_t) {
    study.participant_fields.push_back({.name = field.string("name"),
                                        .question = field.text("question"),
                                        .options = options(field)});
  });
  in.each_object("factors", [&](const ObjectReader& factor, std::size_t) {
    study.factors.push_back(
        {.name = factor.string("name"), .levels = factor.strings("levels")});
  });
  in.each_object("contrasts", [&](const ObjectReader& contrast, std::size_t) {
    study.contrasts.push_back(planned_contrast(contrast));
  });
  if (in.has("sequential")) study.sequential = sequential_plan(in.object("sequential"));
  study.stages = StageBuilder(file).stages(in.list("stages"), "/stages");
  study.text = std::move(text);
  return study;
}

}  // namespace jnd::experiments
