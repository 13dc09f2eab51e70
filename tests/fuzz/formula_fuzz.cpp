#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "analysis/mixed/formula.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using namespace jnd::analysis;

void check_effects(const Formula& formula) {
  fuzz::property(formula.terms.size() <= 500, "a formula has at most 500 terms");
  std::set<std::vector<std::size_t>> seen;
  std::size_t last = 0;
  for (const std::vector<std::size_t>& term : formula.terms) {
    fuzz::property(seen.insert(term).second, "a term comes once");
    fuzz::property(!term.empty() && term.size() >= last, "terms of fewer variables come first");
    last = term.size();
    for (std::size_t i = 0; i < term.size(); ++i) {
      fuzz::property(term[i] < formula.variables.size(), "a term names variables");
      fuzz::property(i == 0 || term[i - 1] < term[i], "the variables of a term ascend");
    }
  }
}

/// Formulas come from a command line, which is UTF-8.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, std::min<std::size_t>(size, 2000));
  if (!is_utf8(text)) return 0;
  // A sentence may contain a name that is as long as the formula.
  constexpr std::size_t kMost = 5000;
  try {
    check_effects(parse_formula(text));
  } catch (const FormulaError& error) {
    fuzz::check_sentence(error.what(), kMost);
  }
  try {
    for (const RandomTerm& term : parse_random_terms(text)) {
      check_effects(term.effects);
      fuzz::property(!term.group_columns.empty(), "a random term has groups");
    }
  } catch (const FormulaError& error) {
    fuzz::check_sentence(error.what(), kMost);
  }
  return 0;
}
