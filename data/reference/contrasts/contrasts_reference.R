# What lme4 and emmeans make of contrasts, for tests/analysis/results/contrast_reference_test.cpp.
# Run in this folder: Rscript contrasts_reference.R
# Debian 12: r-cran-lme4 1.1-31, r-cran-emmeans, r-cran-pbkrtest. The data are drawn here.
library(lme4)
library(emmeans)
set.seed(20261126)

people <- 16
trials <- 5
fluids <- c("thin", "medium", "thick")
data <- expand.grid(trial = 1:trials, fluid = fluids, person = 1:people)
data$priming <- ifelse(data$person %% 2 == 0, "primed", "control")
own <- rnorm(people, 0, 0.3)
own_by_fluid <- matrix(rnorm(people * 3, 0, 0.2), people, 3)
effect <- c(thin = 0.4, medium = 0.1, thick = 0)
data$log_time <- 0.5 + effect[as.character(data$fluid)] +
  ifelse(data$priming == "primed" & data$fluid == "thin", 0.25, 0) +
  own[data$person] + own_by_fluid[cbind(data$person, as.integer(factor(data$fluid, fluids)))] +
  rnorm(nrow(data), 0, 0.4)
# Kept with the digits that the test reads, so that both see the same numbers.
data$log_time <- round(data$log_time, 6)
data$fluid <- factor(data$fluid, fluids)
data$priming <- factor(data$priming)

contrast_of <- function(weights, by = NULL, subset = NULL) {
  # A person's own weighted sum, as a mixed model in which people differ in this contrast has it:
  # lmer with a random effect of the contrast and of the rest of the condition means.
  means <- aggregate(log_time ~ person + priming + fluid, data, mean)
  wide <- reshape(means, idvar = c("person", "priming"), timevar = "fluid", direction = "wide")
  score <- as.matrix(wide[, paste0("log_time.", fluids)]) %*% weights
  list(score = score, priming = wide$priming)
}

# 1. Fluids within people, over both groups: condition means in a mixed model in which people
# differ in every condition (saturated), contrasts by emmeans with Kenward and Roger's degrees
# of freedom.
means <- aggregate(log_time ~ person + priming + fluid, data, mean)
results <- list()
add <- function(name, estimate, se, df = NA) {
  results[[name]] <<- list(estimate = estimate, standard_error = se, df = df)
}

# Of all people as one group: the contrast itself is what varies between people.
one <- contrast_of(c(1, 0, -1))
fit <- lm(one$score ~ 1)
add("thin_thick_one_group", coef(fit)[[1]], sqrt(vcov(fit)[1, 1]), fit$df.residual)
trend <- contrast_of(c(-1, 0.5, 0.5))
fit <- lm(trend$score ~ 1)
add("thin_against_both_one_group", coef(fit)[[1]], sqrt(vcov(fit)[1, 1]), fit$df.residual)

# The same by lmer of the single trials and emmeans: thin and thick alone, people differing in both.
two <- droplevels(subset(data, fluid != "medium"))
mixed <- lmer(log_time ~ fluid + (1 + fluid | person), two, REML = TRUE)
grid <- emmeans(mixed, ~fluid, lmer.df = "kenward-roger")
pair <- summary(contrast(grid, list(thin_thick = c(1, -1))))
add("thin_thick_lmer", pair$estimate, pair$SE, pair$df)

# Interaction of two groups: lmer with the groups, and emmeans.
mixed <- lmer(log_time ~ fluid * priming + (1 + fluid | person), two, REML = TRUE)
grid <- emmeans(mixed, ~ fluid * priming, lmer.df = "kenward-roger")
interaction <- summary(contrast(grid, interaction = list(
  fluid = list(thin_thick = c(1, -1)), priming = list(primed_control = c(-1, 1)))))
add("interaction_lmer", interaction$estimate, interaction$SE, interaction$df)
average <- summary(contrast(emmeans(mixed, ~fluid, lmer.df = "kenward-roger"),
                            list(thin_thick = c(1, -1))))
add("thin_thick_two_groups_lmer", average$estimate, average$SE, average$df)

# Welch's test of both groups' contrasts.
thin_thick <- contrast_of(c(1, 0, -1))
welch <- t.test(thin_thick$score[thin_thick$priming == "primed"],
                thin_thick$score[thin_thick$priming == "control"])
add("interaction_welch", unname(diff(rev(welch$estimate))), unname(welch$stderr),
    unname(welch$parameter))

number <- function(x) if (is.na(x)) "null" else sprintf("%.12g", x)
entry <- function(name) {
  one <- results[[name]]
  sprintf('    "%s": {"estimate": %s, "standard_error": %s, "df": %s}', name,
          number(one$estimate), number(one$standard_error), number(one$df))
}
rows <- sprintf('    [%d, "%s", "%s", %s]', data$person, data$priming, data$fluid,
                sprintf("%.6f", data$log_time))
writeLines(c("{", sprintf('  "made_with": "R %s, lme4 %s, emmeans %s",', getRversion(),
                          packageVersion("lme4"), packageVersion("emmeans")),
             '  "contrasts": {', paste(sapply(names(results), entry), collapse = ",\n"), "  },",
             '  "columns": ["person", "priming", "fluid", "log_time"],', '  "trials": [',
             paste(rows, collapse = ",\n"), "  ]", "}"), "contrasts_reference.json")
