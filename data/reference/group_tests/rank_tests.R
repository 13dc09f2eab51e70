# Writes rank_tests.json: rank tests with ties and zeros, by R and its package coin.
#
# Independent of the C++: wilcox.test and cor.test of R; exact p values with ties by coin (Debian:
# r-cran-coin), whose one-sided ones are doubled, the smaller of both, as R does without ties; of
# Spearman's by trying every pairing. Not run by the tests:
#
#     Rscript data/reference/group_tests/rank_tests.R > data/reference/group_tests/rank_tests.json

suppressMessages(library(coin))
set.seed(20261123)
quiet <- suppressWarnings
doubled <- function(less, greater) min(1, 2 * min(less, greater))

signed <- function(a, b) {
  # R ranks 1.3 - 1.2 and 0.5 - 0.4 apart, for rounding makes them differ in their last bits.
  d <- round(a - b, 9)
  x <- quiet(wilcox.test(d, correct = TRUE, exact = FALSE))
  num <- sum(d != 0)
  v <- unname(x$statistic)
  if (num > 50) return(list(p_value = x$p.value, v = v, exact = FALSE))
  tail <- function(alternative) as.numeric(pvalue(wilcoxsign_test(
    d ~ rep(0, length(d)), distribution = "exact", zero.method = "Wilcoxon", alternative = alternative)))
  list(p_value = doubled(tail("less"), tail("greater")), v = v, exact = TRUE,
       p_value_normal = x$p.value)
}

sums <- function(a, b) {
  x <- quiet(wilcox.test(a, b, correct = TRUE, exact = FALSE))
  if (length(a) + length(b) > 50) {
    return(list(p_value = x$p.value, u = unname(x$statistic), exact = FALSE))
  }
  group <- factor(rep(c("a", "b"), c(length(a), length(b))))
  tail <- function(alternative) as.numeric(pvalue(wilcox_test(
    c(a, b) ~ group, distribution = "exact", alternative = alternative)))
  list(p_value = doubled(tail("less"), tail("greater")), u = unname(x$statistic), exact = TRUE,
       p_value_normal = x$p.value)
}

pairings <- function(n) {
  if (n == 1) return(matrix(1L, 1, 1))
  shorter <- pairings(n - 1)
  do.call(rbind, lapply(1:n, function(i) cbind(i, shorter + (shorter >= i))))
}

spearman <- function(a, b) {
  n <- length(a)
  x <- quiet(cor.test(a, b, method = "spearman", exact = FALSE))
  result <- list(estimate = unname(x$estimate), s = unname(x$statistic), p_value = x$p.value,
                 exact = n <= 14)
  if (n > 10) return(if (n > 14) result else result[c("estimate", "s", "exact")])
  ra <- rank(a)
  products <- numeric(0)
  # In parts, for 10! rows are many.
  rest <- pairings(n - 1)
  for (first in 1:n) {
    others <- (1:n)[-first]
    products <- c(products, ra[1] * rank(b)[first] +
                    as.vector(matrix(rank(b)[others][rest], ncol = n - 1) %*% ra[-1]))
  }
  found <- sum(ra * rank(b))
  result$p_value <- doubled(mean(products <= found + 1e-9), mean(products >= found - 1e-9))
  # R: exact to 9 pairs without ties, then an Edgeworth series (Best and Roberts 1975).
  result$p_value_r <- quiet(cor.test(a, b, method = "spearman")$p.value)
  result
}

number <- function(x) {
  if (is.logical(x)) return(tolower(as.character(x)))
  sprintf("%.15g", round(x + 0, 14))
}
rows <- c()
add <- function(test, name, a, b) {
  of <- switch(test, wilcoxon = signed, ranksum = sums, spearman = spearman)
  found <- of(a, b)
  list_of <- function(x) paste0("[", paste(sapply(x, number), collapse = ", "), "]")
  rows <<- c(rows, sprintf(
    '  {"test": "%s", "name": "%s", "a": %s, "b": %s, "expected": {%s}}', test, name, list_of(a),
    list_of(b), paste(sprintf('"%s": %s', names(found), sapply(found, number)), collapse = ", ")))
}

first <- sleep$extra[sleep$group == 1]
second <- sleep$extra[sleep$group == 2]
add("wilcoxon", "five equal differences", c(2, 3, 4, 5, 6), c(1, 2, 3, 4, 5))
add("wilcoxon", "equal but for rounding", c(1.3, 1.5, 0.6, 2.3, 0.4), c(1.2, 1.4, 0.5, 2.2, 0.3))
add("wilcoxon", "sleep, drug 1 against drug 2", first, second)
add("ranksum", "three against three, tied", c(1, 1, 1), c(2, 2, 2))
add("ranksum", "sleep, as two groups", first, second)
add("spearman", "sleep, drug 1 and drug 2", first, second)
add("spearman", "r = 1", c(1, 2, 3, 4, 5), c(1, 8, 27, 64, 125))
add("spearman", "r = -1, tied", c(1, 2, 2, 4, 5, 6), c(9, 7, 7, 3, 2, 1))
for (n in c(4, 7, 13, 25, 50)) {
  a <- round(rnorm(n, 0.4), 1)
  b <- round(rnorm(n), 1)
  add("wilcoxon", paste(n, "pairs, one decimal"), a, b)
  add("wilcoxon", paste(n, "pairs, whole numbers"), round(2 * a), round(2 * b))
}
for (sizes in list(c(2, 3), c(5, 2), c(4, 9), c(13, 12), c(30, 20))) {
  a <- round(rnorm(sizes[1], 1), 0)
  b <- round(rnorm(sizes[2]), 0)
  add("ranksum", paste(sizes[1], "and", sizes[2], "whole numbers"), a, b)
}
a <- round(rnorm(80, 0.3), 1)
b <- round(rnorm(80), 1)
add("wilcoxon", "eighty pairs, one decimal", a, b)
add("ranksum", "forty and thirty, one decimal", a[1:40], b[1:30])
add("spearman", "eighty pairs, one decimal", a, b)
for (n in c(3, 4, 5, 6, 7, 8, 9, 10)) {
  a <- round(rnorm(n), 1)
  b <- round(a + rnorm(n), 1)
  add("spearman", paste(n, "pairs"), a, b)
  add("spearman", paste(n, "pairs, whole numbers"), round(2 * a), round(2 * b))
}
cat("{\n\"generated_by\": \"data/reference/group_tests/rank_tests.R\",\n")
cat(sprintf("\"versions\": {\"r\": \"%s\", \"coin\": \"%s\"},\n", getRversion(),
            packageVersion("coin")))
cat("\"tests\": [\n", paste(rows, collapse = ",\n"), "\n]\n}\n", sep = "")
