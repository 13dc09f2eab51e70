#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include "analysis/fits/bounded_interval.h"
#include "analysis/results/number_words.h"
#include "analysis/results/test_families.h"
#include "app/results/published_words.h"
#include "app/results/results_output.h"
#include "app/results/statistic_words.h"

namespace jnd::app {
namespace {

using analysis::counted_words;
using analysis::Estimate;
using analysis::Interval;

std::string text(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.4f}", *value) : "-";
}

/// True for numbers such as "match.num_zeros" and "criterion_met": they are whole, or means of
/// whole numbers.
bool is_count(const std::string& name) {
  const std::string last = name.substr(name.rfind('.') + 1);
  return last.starts_with("num_") || last == "criterion_met";
}

/// The text of the number with this name; a whole count has no decimals.
std::string text_of(const std::string& name, const std::optional<double>& value) {
  const bool is_whole = value && std::isfinite(*value) && *value == std::floor(*value);
  return is_whole && is_count(name) ? fmt::format("{:.0f}", *value) : text(value);
}

std::string text(const Interval& ci95) {
  if (!ci95.low && !ci95.high) return "-";
  return fmt::format("{} .. {}", ci95.low ? text(ci95.low) : "open",
                     ci95.high ? text(ci95.high) : "open");
}

std::string text(const Interval& whole, const std::optional<double>& value) {
  return text(analysis::bounded_by_data(whole, value));
}

/// The interval of an estimate, or of a participant's own estimate.
template <typename AnyEstimate>
std::string interval_text(const AnyEstimate& one) {
  return text(analysis::told_interval(one.name, one.ci95, one.value));
}

std::string p_text(const std::optional<double>& p_value) {
  if (!p_value) return "p undefined";
  return *p_value < 0.0001 ? "p < 0.0001" : fmt::format("p = {:.4f}", *p_value);
}

std::string published_text(const Estimate& estimate) {
  if (estimate.published_positive) return "> 0";
  if (!estimate.published) return "-";
  std::string value = analysis::shortest_words(*estimate.published);
  if (!estimate.published_sd) return value;
  return value + " (sd " + analysis::shortest_words(*estimate.published_sd) + ")";
}

/// Such as "2 sessions open: P13, P14"; "" if there are none.
std::string named_sessions(const std::vector<std::string>& participants,
                           const std::string& how) {
  if (participants.empty()) return "";
  return fmt::format("{} {}: {}", counted_words(std::ssize(participants), "session"), how,
                     fmt::join(participants, ", "));
}

/// A line about sessions that were not completed or are left out; "" if there are none.
std::string missing_words(const analysis::MissingSessions& sessions) {
  std::vector<std::string> parts = {named_sessions(sessions.open, "open"),
                                    named_sessions(sessions.ended_early, "ended early")};
  if (sessions.num_pilots > 0) {
    parts.push_back(counted_words(sessions.num_pilots, "pilot session") + " left out");
  }
  if (sessions.num_withdrawn > 0) {
    parts.push_back(counted_words(sessions.num_withdrawn, "session") +
                    " of participants who withdrew left no data");
  }
  std::erase(parts, "");
  return parts.empty() ? "" : fmt::format("{}\n", fmt::join(parts, "; "));
}

std::string heading(const analysis::StudyResults& results) {
  std::string line =
      results.study + ": " + counted_words(results.num_participants, "participant");
  if (results.simulated) {
    line += fmt::format(", SIMULATED (laboratory \"{}\"{})", results.laboratory,
                        results.laboratory_changed ? ", CHANGED from the shipped one" : "");
  }
  return line + "\n" + missing_words(results.sessions);
}

constexpr char kRow[] = "  {:<45} {:>8}  {:>26}  {:>4}  {:>19}  {}\n";

std::string comparison_header(bool has_simulated) {
  return fmt::format(kRow, "", has_simulated ? "this run" : "value",
                     has_simulated ? "simulated studies" : "95 % interval", "unit", "published",
                     has_simulated ? "tail" : "z") +
         "  " + std::string(121, '-') + "\n";
}

/// The median and the middle 95 %, such as "0.7013 (0.4434 .. 1.0189)".
std::string simulated_text(const Estimate& estimate) {
  if (!estimate.predictive) return "-";
  const analysis::PredictiveTail& of = *estimate.predictive;
  const auto end = [&](double value) {
    return std::isfinite(value) ? text_of(estimate.name, value) : std::string("no bound");
  };
  return fmt::format("{} ({} .. {})", end(of.median), end(of.low), end(of.high));
}

std::string published_row(const Estimate& estimate, const analysis::Predictive& predictive) {
  const bool has_simulated = predictive.num_studies > 0;
  const std::string z =
      estimate.published_z ? fmt::format("{:.1f}", *estimate.published_z) : "";
  return fmt::format(kRow, estimate.name, text_of(estimate.name, estimate.value),
                     has_simulated ? simulated_text(estimate) : interval_text(estimate),
                     estimate.unit == "1" ? "" : estimate.unit, published_text(estimate),
                     has_simulated ? tail_words(estimate, predictive) : z);
}

/// True for people without answers, and for values that do not exist. Nobody is left out of a
/// published statistic for lacking a fit of their own with another pse.
bool bears_on_published(const analysis::ResultsSection& section,
                        const analysis::ExcludedParticipant& one) {
  return section.name == "as_published" || one.participant == "everyone" ||
         one.reason.starts_with("no answers in ");
}

/// A line such as "all, 15 together: as far out are 0.012 of the simulated studies (standard
/// error 0.004)"; "" if there is no joint tail.
std::string joint_text(const std::optional<analysis::JointTail>& joint,
                       const std::string& which) {
  if (!joint) return "";
  return fmt::format(
      "  {}, {} together: as far out are {:.3f} of the simulated studies "
      "(standard error {:.3f})\n",
      which, joint->num_statistics, joint->p_value, joint->standard_error);
}

/// The width of the column of names: that of the longest name, but very long names do not
/// count.
int name_width(const analysis::StudyResults& results) {
  constexpr std::size_t kUsual = 46, kMost = 72;
  std::size_t width = kUsual;
  const auto widen = [&width](std::size_t size) {
    if (size <= kMost) width = std::max(width, size);
  };
  for (const analysis::ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) widen(estimate.name.size());
    for (const auto& own : section.participants) {
      widen(own.participant.size() + 1 + own.name.size());
    }
  }
  return static_cast<int>(width);
}

/// One line for each caution, below the number that it is about.
std::string caution_lines(const std::vector<std::string>& cautions) {
  std::string lines;
  for (const std::string& caution : cautions) {
    lines += fmt::format("      caution: {}\n", caution);
  }
  return lines;
}

/// A row of `jnd results`: the number, what it means, and what was published, if anything.
std::string explained_row(const Estimate& estimate, int width,
                          const analysis::Predictive& predictive) {
  std::string line =
      fmt::format("  {:<{}} {:>10}  {:>20}  {:>5}  n {:>3}  {}", estimate.name, width,
                  text_of(estimate.name, estimate.value), interval_text(estimate),
                  estimate.unit == "1" ? "" : estimate.unit, estimate.n, estimate.meaning);
  if (estimate.is_published()) line += "; published " + published_text(estimate);
  if (const std::string tail = tail_words(estimate, predictive); !tail.empty()) {
    line += ", tail " + tail;
  }
  if (!estimate.reason.empty()) line += "; no value: " + estimate.reason;
  return line + "\n" + caution_lines(estimate.cautions);
}

/// The effect size with its name, such as "d 0.50 (0.10 .. 0.90)"; "" if there is none.
std::string effect_text(const analysis::Comparison& c) {
  const std::tuple<const char*, std::optional<double>, Interval> kEffects[] = {
      {"dz", c.cohen_dz, c.cohen_dz_ci95},
      {"g", c.cohen_dz ? std::nullopt : c.hedges_g, c.hedges_g_ci95},
      {"rank-biserial r", c.rank_biserial, Interval{}}};
  for (const auto& [name, value, ci95] : kEffects) {
    if (!value) continue;
    if (!ci95.low && !ci95.high) return fmt::format(", {} {}", name, text(value));
    return fmt::format(", {} {} ({})", name, text(value), text(ci95, value));
  }
  return "";
}

std::string comparison_row(const analysis::NamedComparison& named) {
  using Kind = analysis::Comparison::Kind;
  const analysis::Comparison& c = named.comparison;
  if (c.status != analysis::FitStatus::kOk) {
    return fmt::format("  {}: {}\n", named.name, c.reason);
  }
  std::string line = fmt::format("  {}: ", named.name);
  if (!named.family.empty()) line = fmt::format("  {} [{}]: ", named.name, named.family);
  if (c.hodges_lehmann) {
    line += fmt::format("Hodges-Lehmann {} ({}), ", text(c.hodges_lehmann),
                        text(c.hodges_lehmann_ci95, c.hodges_lehmann));
  } else if (c.kind == Kind::kDispersion) {
    line += fmt::format("mean z^2 {}, ", text(c.estimate));
  } else {
    const bool correlation = c.kind == Kind::kPearson || c.kind == Kind::kSpearman;
    const char* what = correlation ? "r" : c.kind == Kind::kOneSample ? "mean" : "difference";
    line += fmt::format("{} {} ({}), ", what, text(c.estimate), text(c.ci95, c.estimate));
  }
  if (named.ratio()) {
    line += fmt::format("{} {} times as large ({}), ", named.ratio_of, text(named.ratio()),
                        text(named.ratio_ci95(), named.ratio()));
  }
  line += statistic_words(c) + ", ";
  line += p_text(c.p_value) + effect_text(c);
  if (named.p_value_holm) line += fmt::format(", Holm {}", p_text(named.p_value_holm));
  return line + "\n" + caution_lines(named.cautions);
}

/// The primary value of each block, which comes before all other numbers.
std::string in_short(const analysis::StudyResults& results, int width) {
  std::string table;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (!estimate.primary) continue;
      table += fmt::format("  {:<{}} {:>10}  {:>20}  {:>5}  n {:>3}\n", estimate.name, width,
                           text_of(estimate.name, estimate.value), interval_text(estimate),
                           estimate.unit == "1" ? "" : estimate.unit, estimate.n);
      table += caution_lines(estimate.cautions);
    }
  }
  std::string note;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::NamedComparison& named : section.comparisons) {
      if (!named.primary) continue;
      table += comparison_row(named);
      note = analysis::family_note(named);
    }
  }
  if (!note.empty()) table += "  " + note + "\n";
  return table.empty() ? "" : "\nin short: the primary values, explained below\n" + table;
}

/// The planned contrasts, one sentence each, which come before everything else.
std::string planned(const analysis::StudyResults& results) {
  if (results.contrasts.empty()) return "";
  std::string table = "\nplanned contrasts\n";
  for (const analysis::ContrastResult& one : results.contrasts) {
    table += fmt::format("  {} ({}): {}\n", one.plan.name,
                         one.plan.primary ? "primary" : "secondary",
                         one.sentence.empty() ? "no value, " + one.test.reason : one.sentence);
    table += fmt::format("    of {} by {}\n", fmt::join(one.conditions, ", "), one.test.method);
    table += caution_lines(one.cautions);
    for (const analysis::ExcludedParticipant& left_out : one.excluded) {
      table += fmt::format("    left out of people's own contrasts: {}: {}\n",
                           left_out.participant, left_out.reason);
    }
  }
  return table;
}

/// What deviates from the preregistration; "" if nothing was registered.
std::string deviations(const analysis::PreregisteredStudy& plan) {
  if (plan.registered_on.empty()) return "";
  std::string table = fmt::format(
      "\npreregistered on {}: {}\n", plan.registered_on,
      plan.deviations.empty() ? "nothing deviates from it"
                              : counted_words(std::ssize(plan.deviations), "deviation"));
  for (const analysis::Deviation& one : plan.deviations) {
    table += fmt::format("  {}: planned {}, found {}\n", one.topic, one.planned, one.found);
  }
  return table;
}

/// Names of numbers for which nobody has an interval, a reason or a caution, so that they fit
/// into columns.
std::vector<std::string> plain_names(const analysis::ResultsSection& section) {
  std::vector<std::string> names;
  for (const analysis::ParticipantEstimate& own : section.participants) {
    if (std::ranges::find(names, own.name) == names.end()) names.push_back(own.name);
  }
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::any_of(section.participants, [&](const auto& own) {
      return own.name == name &&
             (own.ci95.low || own.ci95.high || !own.reason.empty() || !own.cautions.empty());
    });
  });
  return names;
}

/// The title of a column: a question without its prefix, any other name as it is.
std::string title_of(const std::string& name) {
  constexpr std::string_view kPrefix = "questionnaire.";
  return name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name;
}

std::size_t width_of(const std::string& name) {
  return 2 + std::max<std::size_t>(8, title_of(name).size());
}

/// Some numbers in columns, with one row for each participant.
std::string columns_of(const analysis::ResultsSection& section,
                       std::span<const std::string> names) {
  std::vector<std::string> participants;
  std::map<std::pair<std::string, std::string>, std::optional<double>> values;
  for (const analysis::ParticipantEstimate& own : section.participants) {
    if (std::ranges::find(names, own.name) == names.end()) continue;
    if (std::ranges::find(participants, own.participant) == participants.end()) {
      participants.push_back(own.participant);
    }
    values[{own.participant, own.name}] = own.value;
  }
  std::string table = fmt::format("  {:<12}", "");
  for (const std::string& name : names) {
    table += fmt::format("{:>{}}", title_of(name), width_of(name));
  }
  for (const std::string& participant : participants) {
    table += fmt::format("\n  {:<12}", participant);
    for (const std::string& name : names) {
      table +=
          fmt::format("{:>{}}", text_of(name, values[{participant, name}]), width_of(name));
    }
  }
  return table + "\n";
}

std::string participants_rows(const analysis::ResultsSection& section, int column) {
  constexpr std::size_t kWidth = 100;
  const std::vector<std::string> plain = plain_names(section);
  std::string table;
  for (const analysis::ParticipantEstimate& own : section.participants) {
    if (std::ranges::find(plain, own.name) != plain.end()) continue;
    table += fmt::format("  {:<{}} {:>10}  {:>20}  {}\n", own.participant + " " + own.name,
                         column, text_of(own.name, own.value), interval_text(own), own.reason);
    table += caution_lines(own.cautions);
  }
  for (std::size_t first = 0; first < plain.size();) {
    std::size_t end = first + 1;
    std::size_t width = width_of(plain[first]);
    while (end < plain.size() && width + width_of(plain[end]) <= kWidth) {
      width += width_of(plain[end++]);
    }
    table += columns_of(section, std::span(plain).subspan(first, end - first));
    first = end;
  }
  return table;
}

/// The place of a loss, such as "group_d, 1.853", "group_d, catch trials" or "matching".
std::string level_text(const analysis::LevelLoss& loss) {
  if (loss.is_catch) return loss.block + ", catch trials";
  return loss.block + (loss.level ? fmt::format(", {:.4g}", *loss.level) : "");
}

/// Trials that did not go as planned, by level; "" if there are none.
std::string losses_table(const std::vector<analysis::LevelLoss>& losses, int width) {
  const auto row = [width](const std::string& name, const auto&... counts) {
    std::string line = fmt::format("  {:<{}}", name, width);
    ((line += fmt::format(" {:>9}", counts)), ...);
    return line + "\n";
  };
  std::string rows;
  for (const analysis::LevelLoss& one : losses) {
    if (!one.is_any()) continue;
    rows += row(level_text(one), one.num_drawn, one.num_answered, one.num_set_aside,
                one.num_repeated, one.num_discarded, one.num_faulted, one.num_limited,
                one.num_strokeless);
  }
  if (rows.empty()) return "";
  return "\nlosses: trials of every level at which one has no answer, or was repeated, "
         "faulted,\n"
         "limited in force or without a whole stroke\n" +
         row("", "drawn", "answered", "set aside", "repeated", "discarded", "faulted",
             "limited", "no stroke") +
         rows;
}

/// Explains what an open end means, if the table has one.
std::string note_of(const std::string& table) {
  const bool any = table.find("open .. ") != std::string::npos ||
                   table.find(" .. open") != std::string::npos;
  return any ? fmt::format("\nopen: an end that is {}\n", analysis::kNotBounded) : "";
}

}  // namespace

std::string to_table(const analysis::StudyResults& results) {
  const int width = name_width(results);
  std::string table = heading(results) + deviations(results.preregistration) +
                      planned(results) + in_short(results, width) +
                      losses_table(results.losses, width);
  for (const analysis::ResultsSection& section : results.sections) {
    table += fmt::format("\n{}\n", section.name);
    for (const Estimate& estimate : section.estimates) {
      table += explained_row(estimate, width, results.predictive);
    }
    table += participants_rows(section, width);
    for (const analysis::NamedComparison& named : section.comparisons) {
      table += comparison_row(named);
    }
    for (const analysis::FreeAnswer& one : section.free_answers) {
      table += fmt::format("  {} {}: {}\n", one.participant, one.item, one.answer);
    }
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      table += fmt::format("  left out: {}: {}\n", one.participant, one.reason);
    }
    for (const analysis::Caution& one : section.cautions) {
      table += fmt::format("  caution: {}: {}\n", one.participant, one.caution);
    }
  }
  return table + note_of(table);
}

std::string to_comparison_table(const analysis::StudyResults& results) {
  std::string table = heading(results) + comparison_header(results.predictive.num_studies > 0);
  const std::pair<const char*, const char*> kBases[] = {
      {"calibrated", "calibrated: the laboratory was fitted to the published value"},
      {"implied", "held out, but implied: follows nearly from what was calibrated"},
      {"held out", "held out: the laboratory knows nothing of the published value"}};
  for (const auto& [basis, title] : kBases) {
    bool first = true;
    for (const analysis::ResultsSection& section : results.sections) {
      for (const Estimate& estimate : section.estimates) {
        if (!estimate.is_published() || basis_of(estimate) != basis) continue;
        // Such a value does not exist, for example, for a stiff hand, whose fingers cannot
        // trail.
        if (!estimate.value && estimate.published_positive) continue;
        if (first && results.simulated) {
          table += std::string("  ") + title +
                   (results.laboratory_changed ? ", before it was changed\n" : "\n");
        }
        first = false;
        table += published_row(estimate, results.predictive) + caution_lines(estimate.cautions);
      }
    }
  }
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      if (!bears_on_published(section, one)) continue;
      table += fmt::format("  left out: {}: {}\n", one.participant, one.reason);
    }
  }
  table += joint_text(results.predictive.joint, "all");
  table += joint_text(results.predictive.joint_held_out, "those held out, not implied");
  if (!results.predictive.reason.empty()) {
    table += fmt::format("  without simulated studies: {}\n", results.predictive.reason);
  }
  return table + note_of(table);
}

}  // namespace jnd::app
