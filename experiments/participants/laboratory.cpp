#include "experiments/participants/laboratory.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "experiments/protocol/structure_check.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns a value as a message shows it: short, whatever it is.
std::string in_words(const json& value) {
  return value.is_string() ? '"' + shown_text(value.get<std::string>()) + '"'
                           : found_words(value);
}

/// Reads one object key by key and collects its problems.
class Section {
 public:
  /// Reads the object at `key`. `path` is its place in messages.
  Section(const json& parent, const std::string& key, const std::string& path,
          std::vector<std::string>& problems)
      : path_(path), problems_(problems) {
    if (parent.is_object() && parent.contains(key) && parent.at(key).is_object()) {
      object_ = &parent.at(key);
    } else {
      problems_.push_back(path + ": expected an object, found none");
    }
  }

  /// Reads the object at this index of a list.
  Section(const json& list, std::size_t index, const std::string& path,
          std::vector<std::string>& problems)
      : path_(path), problems_(problems) {
    if (list.at(index).is_object()) {
      object_ = &list.at(index);
    } else {
      problems_.push_back(path + ": expected an object, found none");
    }
  }

  /// Like `number`, for a key that may be absent.
  void optional_number(const char* key, double& value, double low, double high) {
    if (has(key)) {
      number(key, value, low, high);
    } else {
      known_.insert(key);
    }
  }

  /// Reads an object that assigns names to names, with at least one of them.
  void words(const char* key, std::map<std::string, std::string>& words) {
    known_.insert(key);
    if (object_ == nullptr) return;
    const bool is_there = has(key) && object_->at(key).is_object() && !object_->at(key).empty();
    if (is_there) {
      for (const auto& [name, value] : object_->at(key).items()) {
        if (value.is_string()) words[name] = value.get<std::string>();
      }
    }
    if (is_there && words.size() == object_->at(key).size()) return;
    problems_.push_back(path_ + "/" + key +
                        R"(: expected names of factors and levels such as {"fluid": "thin"}, )"
                        "found " +
                        (has(key) ? in_words(object_->at(key)) : "none"));
  }

  /// Reads a number, or {"value": number, "basis": ..., "source": ...}, with low <= value <=
  /// high.
  void number(const char* key, double& value, double low, double high) {
    known_.insert(key);
    if (object_ == nullptr) return;
    const json* found = object_->contains(key) ? &object_->at(key) : nullptr;
    if (found != nullptr && found->is_object()) {
      check_annotated(key, *found);
      found = found->contains("value") ? &found->at("value") : nullptr;
    }
    const std::string range = "expected a number from " + rounded(low) + " to " + rounded(high);
    if (found == nullptr) {
      problems_.push_back(path_ + "/" + key + ": " + range + ", found none");
    } else if (!found->is_number() ||
               !(found->get<double>() >= low && found->get<double>() <= high)) {
      problems_.push_back(path_ + "/" + key + ": " + range + ", found " + in_words(*found));
    } else {
      value = found->get<double>();
    }
  }

  [[nodiscard]] bool has(const char* key) const {
    return object_ != nullptr && object_->contains(key);
  }
  void positive(const char* key, double& value) { number(key, value, 1e-9, 1e9); }
  void not_negative(const char* key, double& value) { number(key, value, 0.0, 1e9); }

  void word(const char* key, std::string& value, const std::set<std::string>& allowed) {
    known_.insert(key);
    if (object_ == nullptr) return;
    const json* found = object_->contains(key) ? &object_->at(key) : nullptr;
    if (found != nullptr && found->is_object()) {
      check_annotated(key, *found);
      found = found->contains("value") ? &found->at("value") : nullptr;
    }
    if (found == nullptr || !found->is_string() ||
        !allowed.contains(found->get<std::string>())) {
      std::string names;
      for (const std::string& name : allowed) names += (names.empty() ? "" : ", ") + name;
      problems_.push_back(path_ + "/" + key + ": expected one of " + names + ", found " +
                          (found == nullptr ? "none" : in_words(*found)));
      return;
    }
    value = found->get<std::string>();
  }

  void finish() {
    if (object_ == nullptr) return;
    for (const auto& [key, value] : object_->items()) {
      if (key != "comment" && !known_.contains(key)) {
        problems_.push_back(path_ + "/" + shown_text(key) + ": unknown key" +
                            did_you_mean(key, {known_.begin(), known_.end()}));
      }
    }
  }

 private:
  static std::string rounded(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  void check_annotated(const char* key, const json& found) {
    static const std::set<std::string> kKeys = {"value", "basis", "source"};
    static const std::set<std::string> kBases = {"thesis", "calibrated", "assumption"};
    for (const auto& [name, value] : found.items()) {
      if (!kKeys.contains(name)) {
        problems_.push_back(path_ + "/" + key + "/" + shown_text(name) + ": unknown key");
      }
    }
    if (found.contains("basis") &&
        (!found.at("basis").is_string() || !kBases.contains(found.at("basis")))) {
      problems_.push_back(path_ + "/" + key +
                          "/basis: expected thesis, calibrated or assumption, found " +
                          in_words(found.at("basis")));
    }
  }

  std::string path_;
  std::vector<std::string>& problems_;
  const json* object_ = nullptr;
  std::set<std::string> known_;
};

void read_device(const json& file, Laboratory::Device& device,
                 std::vector<std::string>& problems) {
  Section in(file, "device", "/device", problems);
  in.positive("mass_kg", device.mass_kg);
  in.not_negative("mechanical_viscosity_n_s_per_m", device.mechanical_viscosity_n_s_per_m);
  in.not_negative("dry_friction_n", device.dry_friction_n);
  in.positive("max_force_per_point_n", device.max_force_per_point_n);
  in.positive("max_total_force_n", device.max_total_force_n);
  in.positive("max_slew_n_per_s", device.max_slew_n_per_s);
  in.finish();
}

void read_arm(const json& file, Laboratory::Arm& arm, std::vector<std::string>& problems) {
  Section in(file, "arm", "/arm", problems);
  in.not_negative("stiffness_n_per_m", arm.stiffness_n_per_m);
  in.not_negative("damping_n_s_per_m", arm.damping_n_s_per_m);
  in.positive("home_s", arm.home_s);
  in.finish();
}

void read_movement(const json& file, Laboratory::Movement& movement,
                   std::vector<std::string>& problems) {
  Section in(file, "movement", "/movement", problems);
  in.positive("max_speed_m_per_s", movement.max_speed_m_per_s);
  in.number("max_speed_sd_ln", movement.max_speed_sd_ln, 0.0, 1.0);
  in.number("stroke_amplitude_sd_ratio", movement.stroke_amplitude_sd_ratio, 0.0, 0.3);
  in.number("stroke_speed_sd_ratio", movement.stroke_speed_sd_ratio, 0.0, 0.3);
  in.number("stroke_height_sd_m", movement.stroke_height_sd_m, 0.0, 0.1);
  in.number("lift_m", movement.lift_m, 0.0, 0.2);
  in.number("body_height_m", movement.body_height_m, 1.0, 2.5);
  in.number("body_height_sd_m", movement.body_height_sd_m, 0.0, 0.3);
  in.number("hand_height_ratio", movement.hand_height_ratio, 0.1, 1.0);
  in.number("hand_height_sd_ratio", movement.hand_height_sd_ratio, 0.0, 0.2);
  in.number("surface_height_m", movement.surface_height_m, 0.0, 3.0);
  in.finish();
}

void read_strokes(const json& file, std::map<std::string, Laboratory::Strokes>& strokes,
                  std::vector<std::string>& problems) {
  if (!file.contains("strokes") || !file.at("strokes").is_object() ||
      !file.at("strokes").contains("default")) {
    problems.emplace_back("/strokes: expected an object with the key default, found none");
    return;
  }
  for (const auto& [procedure, value] : file.at("strokes").items()) {
    if (procedure == "comment") continue;
    Section in(file.at("strokes"), procedure, "/strokes/" + shown_text(procedure), problems);
    Laboratory::Strokes& read = strokes[procedure];
    in.positive("amplitude_m", read.amplitude_m);
    in.number("amplitude_sd_ln", read.amplitude_sd_ln, 0.0, 1.0);
    double num_strokes = 1.0;
    in.number("strokes_per_presentation", num_strokes, 1.0, 50.0);
    read.strokes_per_presentation = static_cast<int>(std::lround(num_strokes));
    in.finish();
  }
}

void read_perceiver(const json& file, Laboratory::Perceiver& perceiver,
                    std::vector<std::string>& problems) {
  Section in(file, "perceiver", "/perceiver", problems);
  in.positive("weber_fraction", perceiver.weber_fraction);
  in.number("weber_fraction_sd_ln", perceiver.weber_fraction_sd_ln, 0.0, 2.0);
  in.word("noise", perceiver.noise, {"normal", "weibull"});
  in.number("criterion_sd_ln", perceiver.criterion_sd_ln, 0.0, 2.0);
  in.number("criterion_drift_per_trial_ln", perceiver.criterion_drift_per_trial_ln, 0.0, 1.0);
  in.number("lapse_rate", perceiver.lapse_rate, 0.0, 0.499);
  in.number("exponent", perceiver.exponent, 0.05, 5.0);
  in.number("exponent_sd", perceiver.exponent_sd, 0.0, 1.0);
  in.positive("unit", perceiver.unit);
  in.number("unit_sd_ln", perceiver.unit_sd_ln, 0.0, 2.0);
  in.positive("standard_damping_n_s_per_m", perceiver.standard_damping_n_s_per_m);
  in.number("shrink", perceiver.shrink, 0.05, 1.0);
  in.number("shrink_sd_ln", perceiver.shrink_sd_ln, 0.0, 2.0);
  in.positive("centre_ratio", perceiver.centre_ratio);
  in.number("anchor_ratio", perceiver.anchor_ratio, 0.0, 0.99);
  in.number("assimilation_ratio", perceiver.assimilation_ratio, -0.99, 0.99);
  in.number("learning_ratio", perceiver.learning_ratio, 0.0, 10.0);
  in.positive("learning_trials", perceiver.learning_trials);
  in.number("fatigue_ratio_per_trial", perceiver.fatigue_ratio_per_trial, 0.0, 1.0);
  in.number("look_again_probability", perceiver.look_again_probability, 0.0, 0.99);
  in.optional_number("cannot_tell_certainty", perceiver.cannot_tell_certainty, 0.0, 1.0);
  in.positive("match_tolerance_ln", perceiver.match_tolerance_ln);
  in.positive("coarse_step_ln", perceiver.coarse_step_ln);
  if (in.has("free_modulus")) {
    in.positive("free_modulus", perceiver.free_modulus.emplace());
    in.number("free_modulus_sd_ln", perceiver.free_modulus_sd_ln, 0.0, 3.0);
  }
  in.finish();
}

/// Older laboratories do not have this part.
void read_pressing(const json& file, std::optional<Laboratory::Pressing>& pressing,
                   std::vector<std::string>& problems) {
  if (!file.contains("pressing")) return;
  Section in(file, "pressing", "/pressing", problems);
  Laboratory::Pressing& read = pressing.emplace();
  in.positive("weber_fraction", read.weber_fraction);
  in.number("weber_fraction_sd_ln", read.weber_fraction_sd_ln, 0.0, 2.0);
  in.positive("detection_threshold_n_per_m", read.detection_threshold_n_per_m);
  in.positive("standard_stiffness_n_per_m", read.standard_stiffness_n_per_m);
  in.number("depth_m", read.depth_m, 0.001, 0.2);
  in.number("lift_m", read.lift_m, 0.001, 0.2);
  in.number("period_s", read.period_s, 0.1, 10.0);
  in.number("sideways_m", read.sideways_m, 0.001, 0.1);
  in.finish();
}

void read_answers(const json& file, Laboratory::Answers& answers,
                  std::vector<std::string>& problems) {
  Section in(file, "answers", "/answers", problems);
  in.number("age_years", answers.age_years, 18.0, 100.0);
  in.number("age_sd_years", answers.age_sd_years, 0.0, 30.0);
  in.number("right_handed_probability", answers.right_handed_probability, 0.0, 1.0);
  in.number("yes_probability", answers.yes_probability, 0.0, 1.0);
  in.number("solid_probability", answers.solid_probability, 0.0, 1.0);
  in.number("scale_step_ratio", answers.scale_step_ratio, 0.0, 1.0);
  in.number("scale_step_sd_ratio", answers.scale_step_sd_ratio, 0.0, 1.0);
  in.finish();
}

void read_effects(const json& file, std::vector<Laboratory::Effect>& effects,
                  std::vector<std::string>& problems) {
  if (!file.contains("effects")) return;
  const json& list = file.at("effects");
  if (!list.is_array()) {
    problems.emplace_back("/effects: expected a list of objects, found " + in_words(list));
    return;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    Laboratory::Effect& effect = effects.emplace_back();
    const std::string path = "/effects/" + std::to_string(i);
    Section in(list, i, path, problems);
    in.words("levels", effect.levels);
    in.optional_number("weber_fraction_factor", effect.weber_fraction_factor, 1e-3, 1e3);
    in.optional_number("weber_fraction_sd_ln", effect.weber_fraction_sd_ln, 0.0, 2.0);
    in.optional_number("pse_factor", effect.pse_factor, 1e-3, 1e3);
    in.optional_number("pse_sd_ln", effect.pse_sd_ln, 0.0, 2.0);
    in.optional_number("exponent_difference", effect.exponent_difference, -5.0, 5.0);
    in.optional_number("exponent_sd", effect.exponent_sd, 0.0, 1.0);
    in.optional_number("magnitude_factor", effect.magnitude_factor, 1e-3, 1e3);
    in.optional_number("magnitude_sd_ln", effect.magnitude_sd_ln, 0.0, 2.0);
    in.optional_number("rating_difference", effect.rating_difference, -100.0, 100.0);
    in.optional_number("rating_sd", effect.rating_sd, 0.0, 100.0);
    in.finish();
  }
}

/// A laboratory may have no questions.
void read_questions(const json& file, std::map<std::string, Laboratory::Question>& questions,
                    std::vector<std::string>& problems) {
  if (!file.contains("questions")) return;
  if (!file.at("questions").is_object()) {
    problems.emplace_back("/questions: expected an object, found something else");
    return;
  }
  for (const auto& [name, value] : file.at("questions").items()) {
    if (name == "comment") continue;
    Section in(file.at("questions"), name, "/questions/" + shown_text(name), problems);
    Laboratory::Question& read = questions[name];
    in.word("follows", read.follows, {"certainty", "magnitude"});
    in.number("noise_sd_ratio", read.noise_sd_ratio, 0.0, 10.0);
    in.finish();
  }
}

/// Reads a list of names of estimates, which is empty if the key is absent.
void read_names(const json& file, const char* key, std::vector<std::string>& names,
                std::vector<std::string>& problems) {
  if (!file.contains(key)) return;
  if (!file.at(key).is_array()) {
    problems.push_back(std::string("/") + key + ": expected a list of texts");
    return;
  }
  for (const json& name : file.at(key)) {
    if (!name.is_string()) {
      problems.push_back(std::string("/") + key + ": expected a list of texts");
      return;
    }
    names.push_back(name.get<std::string>());
  }
}

}  // namespace

const Laboratory::Strokes& Laboratory::strokes_for(const std::string& procedure) const {
  const auto found = strokes.find(procedure);
  return found != strokes.end() ? found->second : strokes.at("default");
}

Laboratory parse_laboratory(const std::string& text, const std::string& place) {
  const json file = json::parse(text, nullptr, /*allow_exceptions=*/false);
  // The library takes a zero byte for the end of the text.
  if (!file.is_object() || text.find('\0') != std::string::npos) {
    throw core::Error(place +
                      ": expected a laboratory as one JSON object, found something else");
  }
  std::vector<std::string> problems;
  Laboratory laboratory{.text = text};
  static const std::set<std::string> kKeys = {
      "format",   "name",    "title",    "comment", "calibrated_on",
      "device",   "arm",     "movement", "strokes", "perceiver",
      "pressing", "answers", "implied",  "effects", "questions"};
  for (const auto& [key, value] : file.items()) {
    if (kKeys.contains(key)) continue;
    problems.push_back("/" + shown_text(key) + ": unknown key" +
                       did_you_mean(key, {kKeys.begin(), kKeys.end()}));
  }
  if (!file.contains("format") || file.at("format") != 1) {
    problems.emplace_back("/format: expected 1");
  }
  for (auto [key, value] :
       {std::pair{"name", &laboratory.name}, {"title", &laboratory.title}}) {
    if (file.contains(key) && file.at(key).is_string()) {
      *value = file.at(key).get<std::string>();
    } else {
      problems.push_back(std::string("/") + key + ": expected a text");
    }
  }
  read_names(file, "calibrated_on", laboratory.calibrated_on, problems);
  read_names(file, "implied", laboratory.implied, problems);
  read_device(file, laboratory.device, problems);
  read_arm(file, laboratory.arm, problems);
  read_movement(file, laboratory.movement, problems);
  read_strokes(file, laboratory.strokes, problems);
  read_perceiver(file, laboratory.perceiver, problems);
  read_pressing(file, laboratory.pressing, problems);
  read_answers(file, laboratory.answers, problems);
  read_effects(file, laboratory.effects, problems);
  read_questions(file, laboratory.questions, problems);
  if (!problems.empty()) {
    std::string message = place + ": " + std::to_string(problems.size()) + " problem(s)";
    constexpr std::size_t kMostTold = 100;
    for (std::size_t i = 0; i < problems.size() && i < kMostTold; ++i) {
      message += "\n  " + problems[i];
    }
    if (problems.size() > kMostTold) message += "\n  ...";
    throw core::Error(message);
  }
  return laboratory;
}

Laboratory read_laboratory(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw core::Error(file.string() +
                      ": expected a laboratory file, found none that can be read");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_laboratory(text.str(), file.string());
}

}  // namespace jnd::experiments
