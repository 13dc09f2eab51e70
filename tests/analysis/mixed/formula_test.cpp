#include "analysis/mixed/formula.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jnd::analysis {
namespace formula_test {

/// Returns the parsed terms by the names of their variables, for example "1 u c u:c".
std::string terms_of(const std::string& text) {
  const Formula formula = parse_formula(text);
  std::string words = formula.has_intercept ? "1" : "0";
  for (const std::vector<std::size_t>& term : formula.terms) {
    std::string name;
    for (const std::size_t variable : term) {
      name += (name.empty() ? "" : ":") + formula.variables[variable].name;
    }
    words += " " + name;
  }
  return words;
}

// The expected terms are what R says: attr(terms(~ ...), "term.labels").
TEST(Formula, IsTakenApartAsRDoes) {
  EXPECT_EQ(terms_of("1"), "1");
  EXPECT_EQ(terms_of("u"), "1 u");
  EXPECT_EQ(terms_of("u * c"), "1 u c u:c");
  EXPECT_EQ(terms_of("u:c + c"), "1 c u:c");
  EXPECT_EQ(terms_of("c:u + c"), "1 c c:u");
  EXPECT_EQ(terms_of("c + u:c"), "1 c c:u");
  EXPECT_EQ(terms_of("0 + u"), "0 u");
  EXPECT_EQ(terms_of("u - 1"), "0 u");
  EXPECT_EQ(terms_of("-1 + u"), "0 u");
  EXPECT_EQ(terms_of("0 + u + 1"), "1 u");
  EXPECT_EQ(terms_of("a * b * c"), "1 a b c a:b a:c b:c a:b:c");
  EXPECT_EQ(terms_of("a * b * c - a:b:c"), "1 a b c a:b a:c b:c");
  EXPECT_EQ(terms_of("(a + b + c)^2"), "1 a b c a:b a:c b:c");
  EXPECT_EQ(terms_of("(a + b):c"), "1 a:c b:c");
  EXPECT_EQ(terms_of("a / b"), "1 a a:b");
  EXPECT_EQ(terms_of("a + a + a:a"), "1 a");
  EXPECT_EQ(terms_of("u*(a+b)"), "1 u a b u:a u:b");
  EXPECT_EQ(terms_of("  log( u )*`my col` "), "1 log(u) my col log(u):my col");
  EXPECT_EQ(terms_of("scale(log(u))"), "1 scale(log(u))");
  EXPECT_EQ(terms_of("größe.2 + _x"), "1 größe.2 _x");
}

TEST(Formula, KnowsTheColumnsAndTheirFunctions) {
  const Formula formula = parse_formula("scale(log(u)) + factor(day)");
  ASSERT_EQ(formula.variables.size(), 2U);
  EXPECT_EQ(formula.variables[0].column, "u");
  EXPECT_EQ(formula.variables[0].functions, (std::vector<std::string>{"log", "scale"}));
  EXPECT_EQ(formula.variables[1].at, 16U);
}

/// Expects an error with the caret at this place and with these words.
void expect_error(const std::string& text, std::size_t at, const std::string& words,
                  bool is_random = false) {
  try {
    if (is_random) {
      static_cast<void>(parse_random_terms(text));
    } else {
      static_cast<void>(parse_formula(text));
    }
    FAIL() << text << " is read";
  } catch (const FormulaError& error) {
    EXPECT_EQ(error.picture, "  " + text + "\n  " + std::string(at, ' ') + "^") << text;
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Formula, PointsAtWhatIsWrong) {
  expect_error("u * ", 4, "found the end");
  expect_error("", 0, "found the end");
  expect_error("u + + c", 4, "expected the name of a column, found `+`");
  expect_error("u c", 2, "expected an operator such as + or *, found `c`");
  expect_error("u + (a * b", 10, ") or an operator");
  expect_error("u + 2", 4, "0 or 1 for the intercept, found the number 2");
  expect_error("poly(u)", 0, "expected one of the functions log,");
  expect_error("u + log(a + b)", 10, "which is one column");
  expect_error("(a + b)^x", 8, "a whole number from 1 to 9");
  expect_error("u + (1 | p)", 7, "random terms go to --random");
  expect_error("a + `b", 4, "a closing backquote");
  expect_error("y ~ u", 2, "expected an operator");
}

TEST(Formula, RefusesWhatNoDesignCanHoldBeforeItIsBuilt) {
  std::string product = "a", sum = "a0*b0";
  for (char letter = 'b'; letter <= 'z'; ++letter) product += std::string("*") + letter;
  for (int i = 1; i < 30; ++i) {
    const std::string number = std::to_string(i);
    sum += " + a" + number + "*b" + number;
  }
  EXPECT_THROW((void)parse_formula(product), FormulaError);
  EXPECT_THROW((void)parse_formula("(a+b+c+d+e+f+g+h+i+j+k+l+m)^9"), FormulaError);
  EXPECT_EQ(parse_formula(sum).terms.size(), 90U);
  const auto within = [](int depth) {
    const auto times = static_cast<std::size_t>(depth);
    return std::string(times, '(') + "a" + std::string(times, ')');
  };
  EXPECT_EQ(parse_formula(within(90)).terms.size(), 1U);
  EXPECT_THROW((void)parse_formula(within(200'000)), FormulaError);
}

TEST(Formula, ItsMessagesHaveNoControlCharacters) {
  try {
    (void)parse_formula("a + \x1b[2J");
    FAIL() << "nothing was refused";
  } catch (const FormulaError& error) {
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
    EXPECT_EQ(error.picture.find('\x1b'), std::string::npos);
  }
}

TEST(Formula, TheCaretCountsLettersAndNotBytes) {
  try {
    static_cast<void>(parse_formula("größe * "));
    FAIL();
  } catch (const FormulaError& error) {
    EXPECT_EQ(error.picture, "  größe * \n  " + std::string(8, ' ') + "^");
  }
}

TEST(Formula, RandomTermsStandAloneOrInParentheses) {
  const std::vector<RandomTerm> alone = parse_random_terms("1 + u | participant");
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone[0].group, "participant");
  EXPECT_TRUE(alone[0].is_correlated);
  EXPECT_TRUE(alone[0].effects.has_intercept);
  ASSERT_EQ(alone[0].effects.terms.size(), 1U);

  const std::vector<RandomTerm> both = parse_random_terms("(0 + u || person) + (1 | item)");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_FALSE(both[0].is_correlated);
  EXPECT_FALSE(both[0].effects.has_intercept);
  EXPECT_EQ(both[1].group, "item");

  const std::vector<RandomTerm> with_parentheses = parse_random_terms("(a + b):c | item");
  ASSERT_EQ(with_parentheses.size(), 1U);
  EXPECT_EQ(with_parentheses[0].effects.terms.size(), 2U);
}

TEST(Formula, GroupsWithinGroupsAreNamedAsLme4NamesThem) {
  const std::vector<RandomTerm> nested = parse_random_terms("1 | school/class");
  ASSERT_EQ(nested.size(), 2U);
  EXPECT_EQ(nested[0].group, "school");
  EXPECT_EQ(nested[1].group, "class:school");
  EXPECT_EQ(nested[1].group_columns, (std::vector<std::string>{"school", "class"}));
  const std::vector<RandomTerm> crossed = parse_random_terms("(1 | a:b)");
  ASSERT_EQ(crossed.size(), 1U);
  EXPECT_EQ(crossed[0].group, "a:b");
}

TEST(Formula, PointsAtWhatIsWrongOfRandomTerms) {
  expect_error("1 + u", 5, "expected | and the column of the groups", true);
  expect_error("1 | ", 4, "the name of a column", true);
  expect_error("(1 | a", 6, ") behind the groups, found the end", true);
  expect_error("(1 | a) (1 | b)", 8, "+ between random terms", true);
  expect_error("1 | a + b", 6, "terms with a bar stand in parentheses", true);
  expect_error("1 | a:b/c", 7, "either : or /", true);
}

}  // namespace formula_test
}  // namespace jnd::analysis
