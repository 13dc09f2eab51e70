# Fits a line with random intercept and slope with lme4's lmer: sleepstudy, which lme4 brings (Belenky et al. 2003), and
# simulated magnitudes in logarithms (balanced, unbalanced, many people, slopes that do not differ). Writes
# people_lines.json, which the tests read. In this folder:
#
#     Rscript people_lines.R
#
# lmer's optimiser gets tight tolerances. Intervals are those of the profile of the full likelihood, as confint() has
# them, but by a root of the deviance of lmer(y - b x ~ 1 + (x | person)), as confint() interpolates.
suppressMessages(library(lme4))
set.seed(17)
control <- lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-10, maxfun = 1e5), calc.derivs = FALSE,
                       check.conv.singular = "ignore")

magnitudes <- function(num_people, x, a_sd, drop = 0) {
  rows <- expand.grid(x = log(x), repetition = 1:2, person = seq_len(num_people))
  u <- rnorm(num_people, 0, 0.5); v <- rnorm(num_people, 0, a_sd) + 0.2 * (a_sd > 0) * u
  rows$y <- round(2 + u[rows$person] + (0.7 + v[rows$person]) * rows$x + rnorm(nrow(rows), 0, 0.25), 4)
  rows$x <- round(rows$x, 12)
  rows[sort(sample(nrow(rows), nrow(rows) - drop)), c("person", "x", "y")]
}
sleep <- data.frame(person = as.integer(sleepstudy$Subject), x = sleepstudy$Days, y = sleepstudy$Reaction)
sets <- list(sleepstudy = sleep, balanced = magnitudes(8, c(1, 2, 4, 8, 16), 0.15),
             unbalanced = magnitudes(10, c(0.5, 1, 3, 10), 0.2, drop = 27),
             many = magnitudes(40, c(1, 3, 9, 27), 0.1, drop = 31))
repeat {  # Slopes that the rows do not show to differ: at the bound.
  sets$alike <- magnitudes(6, c(1, 2, 4), 0)
  if (isSingular(lmer(y ~ x + (x | person), sets$alike, control = control))) break
}

profile_of <- function(data, of) {
  held <- function(b) {
    data$z <- if (of == "slope") data$y - b * data$x else data$y - b
    formula <- if (of == "slope") z ~ 1 + (x | person) else z ~ 0 + x + (x | person)
    as.numeric(-2 * logLik(lmer(formula, data, REML = FALSE, control = control)))
  }
  full <- lmer(y ~ x + (x | person), data, REML = FALSE, control = control)
  at <- unname(fixef(full)[[if (of == "slope") "x" else "(Intercept)"]])
  error <- sqrt(vcov(full)[if (of == "slope") 2 else 1, if (of == "slope") 2 else 1])
  excess <- function(b) held(b) - as.numeric(-2 * logLik(full)) - qchisq(0.95, 1)
  c(uniroot(excess, at - c(5, 1) * error, tol = 1e-10)$root, uniroot(excess, at + c(1, 5) * error, tol = 1e-10)$root)
}

number <- function(x) formatC(x, digits = 15, format = "g")
text <- vapply(names(sets), function(name) {
  data <- sets[[name]]
  fit <- lmer(y ~ x + (x | person), data, control = control)
  spread <- as.data.frame(VarCorr(fit))
  errors <- sqrt(diag(as.matrix(vcov(fit))))
  people <- coef(fit)$person
  slope <- profile_of(data, "slope"); intercept <- profile_of(data, "intercept")
  correlation <- spread$sdcor[3]
  one <- c(intercept = fixef(fit)[[1]], slope = fixef(fit)[[2]], intercept_standard_error = errors[[1]],
           slope_standard_error = errors[[2]], intercept_sd = spread$sdcor[1], slope_sd = spread$sdcor[2],
           residual_sd = sigma(fit), log_likelihood = as.numeric(logLik(fit)), slope_profile_low = slope[1],
           slope_profile_high = slope[2], intercept_profile_low = intercept[1], intercept_profile_high = intercept[2])
  paste0("{\"name\": \"", name, "\", ", paste0("\"", names(one), "\": ", number(one), collapse = ", "),
         ", \"correlation\": ", if (is.finite(correlation)) number(correlation) else "null",
         ",\n   \"people\": [", paste0("{\"intercept\": ", number(people[, 1]), ", \"slope\": ", number(people[, 2]), "}",
                                    collapse = ", "),
         "],\n   \"person\": [", paste(data$person - 1, collapse = ", "), "],\n   \"x\": [",
         paste(number(data$x), collapse = ", "), "],\n   \"y\": [", paste(number(data$y), collapse = ", "), "]}")
}, "")
writeLines(paste0("{\n\"generated_by\": \"data/reference/mixed/people_lines.R\",\n\"versions\": {\"R\": \"",
                  getRversion(), "\", \"lme4\": \"", packageVersion("lme4"), "\"},\n\"sets\": [\n  ",
                  paste(text, collapse = ",\n  "), "\n]}"), "people_lines.json")
