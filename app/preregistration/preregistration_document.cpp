#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/html_text.h"
#include "app/preregistration/preregistration.h"

namespace jnd::app {
namespace {

using Json = nlohmann::ordered_json;

/// A field of the template: its title, and paragraphs or points.
struct Field {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<std::string> points{};
};

struct Chapter {
  std::string title;
  std::vector<Field> fields;
};

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string list_words(const Json& list) {
  std::string words;
  for (const Json& one : list) {
    const std::string word = one.is_string() ? one.get<std::string>() : one.dump();
    words += (words.empty() ? "" : ", ") + word;
  }
  return words;
}

std::string weights_words(const Json& of) {
  std::string words;
  for (const auto& [factor, weights] : of.items()) {
    std::string levels;
    for (const auto& [level, weight] : weights.items()) {
      levels += (levels.empty() ? "" : ", ") +
                fmt::format("{} {:+g}", spaced(level), weight.get<double>());
    }
    words += (words.empty() ? "" : "; ") + spaced(factor) + ": " + levels;
  }
  return words;
}

std::string contrast_words(const Json& contrast) {
  std::string words =
      fmt::format("{} ({}): {}{} of {}, ", spaced(contrast.at("name")),
                  contrast.at("role").get<std::string>(), spaced(contrast.at("measure")),
                  contrast.contains("question") ? " " + spaced(contrast.at("question")) : "",
                  weights_words(contrast.at("of")));
  const std::string direction = contrast.at("direction");
  words += direction == "either" ? "two-sided" : "one-sided (" + direction + ")";
  words += fmt::format(", alpha {:g}", contrast.at("alpha").get<double>());
  if (!contrast.at("smallest_effect").is_null()) {
    words += fmt::format(", smallest effect of interest {:g}",
                         contrast.at("smallest_effect").get<double>());
  }
  words +=
      fmt::format(", {} correction in the family {}.",
                  contrast.at("correction").get<std::string>(), spaced(contrast.at("family")));
  const std::string hypothesis = contrast.at("hypothesis");
  return hypothesis.empty() ? words : hypothesis + " " + words;
}

std::string block_words(const Json& block) {
  std::string words = fmt::format("{}: {} of {} ({}), ", spaced(block.at("name")),
                                  spaced(block.at("procedure")), spaced(block.at("medium")),
                                  block.at("quantity").get<std::string>());
  if (!block.at("intensities").empty()) {
    words += "stimuli " + list_words(block.at("intensities")) + ", ";
  }
  if (!block.at("reference").is_null()) {
    words += "reference " + block.at("reference").dump() + ", ";
  }
  words += fmt::format("repetitions {}", block.at("repetitions").dump());
  if (block.at("practice").get<bool>()) words += "; practice, no data";
  const std::string question = block.at("question");
  return words + "." + (question.empty() ? "" : " Question: " + question);
}

std::string counterbalance_words(const Json& one) {
  const std::string method = one.at("method");
  const std::string how = method == "one_of" ? "each participant gets one of"
                          : method == "latin"
                              ? "everybody gets all, in the order of a Latin square, of"
                              : "everybody gets all, in counterbalanced order, of";
  std::string words =
      spaced(one.at("name")) + ": " + how + " " + spaced(list_words(one.at("arms")));
  const std::string field = one.at("stratify_by");
  return words + (field.empty() ? "" : ", balanced within " + spaced(field)) + ".";
}

std::vector<std::string> each(const Json& list, std::string (*words)(const Json&)) {
  std::vector<std::string> points;
  for (const Json& one : list) points.push_back(words(one));
  return points;
}

std::string interleaved_words(const Json& group) {
  return spaced(group.at("name")) + ": trials of " + spaced(list_words(group.at("blocks"))) +
         (group.at("turns") == "random"
              ? " are mixed; the next trial is drawn from all that are left."
              : " are mixed; in every round each block that has trials left comes once, in an "
                "order drawn anew.");
}

std::vector<std::string> randomization_points(const Json& plan) {
  std::vector<std::string> points = each(plan.at("counterbalances"), counterbalance_words);
  if (!plan.contains("interleaved")) return points;
  for (const Json& group : plan.at("interleaved")) points.push_back(interleaved_words(group));
  return points;
}

std::string or_words(const Json& plan, const char* key, const std::string& otherwise) {
  const std::string text = plan.value(key, "");
  return text.empty() ? otherwise : text;
}

std::string blinding_words(const std::string& blinding) {
  if (blinding == "double") {
    return "Neither participant nor experimenter sees which stimulus is presented.";
  }
  return blinding == "participant" ? "The participant does not see which stimulus is presented."
                                   : "Nobody is blind to the stimuli.";
}

/// When a study with planned looks ends; "" if no looks are planned.
std::string looks_words(const Json& plan) {
  if (!plan.contains("sequential")) return "";
  const Json& rule = plan.at("sequential");
  const Json* decides = nullptr;
  for (const Json& contrast : plan.at("contrasts")) {
    if (contrast.at("name") == rule.at("contrast")) decides = &contrast;
  }
  const double alpha = decides == nullptr ? 0.05 : decides->at("alpha").get<double>();
  return fmt::format(
      "The study is looked at after {} complete sessions, by the contrast {}. It ends at the "
      "first look at which the p value of the t test of people's own contrasts is below that "
      "look's nominal level, and at {} complete sessions in any case. The nominal levels spend "
      "alpha {:g} over the looks as by {} (Lan and DeMets 1983). Whoever runs the study is "
      "told "
      "only to go on or to stop; results are sealed until then, and the estimate of the "
      "contrast is adjusted for the looks (median unbiased, in the stage-wise order).",
      list_words(rule.at("looks")), spaced(rule.at("contrast")), rule.at("looks").back().dump(),
      alpha, rule.at("spending") == "pocock" ? "Pocock" : "O'Brien and Fleming");
}

std::vector<std::string> stopping_paragraphs(const Json& plan) {
  const std::string looks = looks_words(plan);
  if (looks.empty()) {
    return {or_words(plan, "stopping",
                     "The study ends when " + plan.at("num_participants").dump() +
                         " sessions are complete, whatever they show.")};
  }
  std::vector<std::string> paragraphs = {looks};
  const std::string more = plan.value("stopping", "");
  if (!more.empty()) paragraphs.push_back(more);
  return paragraphs;
}

std::string sample_words(const Json& plan) {
  const std::string num = plan.at("num_participants").dump();
  return plan.contains("sequential")
             ? "At most " + num +
                   " participants with a complete session; see the stopping rule."
             : num + " participants with a complete session.";
}

std::string power_words(const Json& power) {
  if (power.contains("expected_participants")) {
    return fmt::format(
        "{}, by the looks: power {:.1f} % (95 % {:.1f} to {:.1f} %) at alpha {:g} with {:.1f} "
        "participants expected and at most {}, in {} simulated studies of the laboratory {}.",
        spaced(power.at("test")), 100.0 * power.at("power").get<double>(),
        100.0 * power.at("power_ci95").at(0).get<double>(),
        100.0 * power.at("power_ci95").at(1).get<double>(), power.at("alpha").get<double>(),
        power.at("expected_participants").get<double>(), power.at("participants").dump(),
        power.at("runs").dump(), power.at("laboratory").get<std::string>());
  }
  return fmt::format(
      "{} with {} participants: {:.1f} % (95 % {:.1f} to {:.1f} %) at alpha "
      "{:g}, in {} simulated studies of the laboratory {}.",
      spaced(power.at("test")), power.at("participants").dump(),
      100.0 * power.at("power").get<double>(),
      100.0 * power.at("power_ci95").at(0).get<double>(),
      100.0 * power.at("power_ci95").at(1).get<double>(), power.at("alpha").get<double>(),
      power.at("runs").dump(), power.at("laboratory").get<std::string>());
}

std::vector<Chapter> chapters_of(const Json& plan) {
  std::vector<std::string> factors;
  for (const Json& factor : plan.at("factors")) {
    factors.push_back(spaced(factor.at("name")) + ": " + list_words(factor.at("levels")));
  }
  const bool has_contrasts = !plan.at("contrasts").empty();
  return {
      {"Study information",
       {{"Title", {plan.at("title")}},
        {"Authors", {list_words(plan.at("authors"))}},
        {"Description", {or_words(plan, "description", "Not described in the study file.")}},
        {"Hypotheses",
         has_contrasts ? std::vector<std::string>{}
                       : std::vector<std::string>{"The study file plans no contrast."},
         each(plan.at("contrasts"), contrast_words)}}},
      {"Design plan",
       {{"Study type",
         {"Experiment: stimuli are assigned by the program, which renders them and keeps every "
          "answer."}},
        {"Blinding", {blinding_words(plan.at("blinding"))}},
        {"Study design",
         {"The blocks, in the order of the study file:"},
         each(plan.at("blocks"), block_words)},
        {"Randomization",
         {"Orders of stimuli are drawn from random streams of a seed that is kept with each "
          "session. A new participant gets the combination of arms that the fewest have "
          "completed."},
         randomization_points(plan)}}},
      {"Sampling plan",
       {{"Existing data", {"No session of this study was run before the registration."}},
        {"Data collection procedures",
         {"Device: " + or_words(plan, "device", "not said") + "."}},
        {"Sample size", {sample_words(plan)}},
        {"Sample size rationale",
         {or_words(plan, "sample_rationale", "Not said.")},
         each(plan.at("power"), power_words)},
        {"Stopping rule", stopping_paragraphs(plan)}}},
      {"Variables",
       {{"Manipulated variables",
         factors.empty() ? std::vector<std::string>{"The blocks of the study file."}
                         : std::vector<std::string>{},
         std::move(factors)},
        {"Measured variables",
         {"Every answer with its response time, and how the hand moved in every "
          "presentation."}}}},
      {"Analysis plan",
       {{"Statistical models",
         {has_contrasts
              ? "The contrasts above as jnd computes them: Weber fractions and points "
                "of subjective equality by a hierarchical probit model, everything "
                "else by t tests of people's own contrasts."
              : "Estimates of every block as jnd computes them; comparisons are "
                "exploratory."}},
        {"Transformations", {"Ratios are tested on their logarithms; exponents as they are."}},
        {"Inference criteria",
         {"p values below the alpha of a contrast after the correction in its family. "
          "Equivalence by two one-sided tests where a smallest effect of interest is "
          "stated."}},
        {"Data exclusion", {or_words(plan, "exclusions", "No data are excluded.")}},
        {"Missing data",
         {"Who lacks a condition is left out of people's own contrasts and named; the "
          "hierarchical fit uses every answer there is."}},
        {"Exploratory analysis",
         {"Every comparison that is not listed above is exploratory and called so."}}}},
      {"Other",
       {{"What identifies this plan",
         {"Registered on " + plan.at("registered_on").get<std::string>() + ".",
          "Study file " + plan.at("study_file").get<std::string>() + ", SHA-256 " +
              plan.at("study_sha256").get<std::string>() + ".",
          "jnd " + plan.at("program_version").get<std::string>() + "."}}}}};
}

std::string title_of(const Json& plan) {
  return "Preregistration: " + plan.at("title").get<std::string>();
}

}  // namespace

std::string preregistration_markdown(const Preregistration& plan) {
  std::string text = "# " + title_of(plan) + "\n";
  for (const Chapter& chapter : chapters_of(plan)) {
    text += "\n## " + chapter.title + "\n";
    for (const Field& field : chapter.fields) {
      text += "\n### " + field.title + "\n";
      for (const std::string& paragraph : field.paragraphs) text += "\n" + paragraph + "\n";
      if (!field.points.empty()) text += "\n";
      for (const std::string& point : field.points) text += "- " + point + "\n";
    }
  }
  return text;
}

std::string preregistration_html(const Preregistration& plan) {
  analysis::HtmlText html;
  for (const Chapter& chapter : chapters_of(plan)) {
    html.heading(2, chapter.title);
    for (const Field& field : chapter.fields) {
      html.heading(3, field.title);
      for (const std::string& paragraph : field.paragraphs) html.paragraph(paragraph);
      if (!field.points.empty()) html.list(field.points);
    }
  }
  return analysis::html_document(
      title_of(plan), "",
      "<h1>" + analysis::html_escaped(title_of(plan)) + "</h1>\n" + html.text());
}

}  // namespace jnd::app
