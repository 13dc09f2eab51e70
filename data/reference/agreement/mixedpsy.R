# Fits the two mixed models that MixedPsy's help shows, with lme4's glmer, and computes PSE and JND as its MixDelta does: for
# a probit with intercept a and slope b, PSE = -a / b and JND = qnorm(0.75) / b, standard errors by the delta method. The rows
# are those of ../curves/answers.csv. Writes them as one table (mixedpsy_rows.csv) and the numbers (mixedpsy.csv):
# `Rscript mixedpsy.R`, in this folder. R 4.2.2 and lme4 1.1.31.
suppressMessages(library(lme4))

answers <- read.csv("../curves/answers.csv", stringsAsFactors = FALSE)
rows <- answers[startsWith(answers$data_set, "MixedPsy"), ]
words <- strsplit(rows$group, " ")
rows$person <- vapply(words, `[`, "", 1)
rows$vibration <- vapply(words, function(w) if (length(w) > 1) paste0("v", w[2]) else "none", "")
rows$study <- sub("MixedPsy ", "", rows$data_set)
rows <- rows[, c("study", "person", "vibration", "intensity", "num_yes", "num_trials")]
write.csv(rows, "mixedpsy_rows.csv", row.names = FALSE, quote = FALSE)

# Its optimum to the last digits that its deviance has.
control <- glmerControl(optimizer = "bobyqa", tolPwrss = 1e-13, optCtrl = list(maxfun = 1e5, rhoend = 1e-9))
out <- list()
tell <- function(model, condition, quantity, value, error) {
  out[[length(out) + 1]] <<- data.frame(model, condition, quantity, value = sprintf("%.12g", value), standard_error = if (is.na(error)) "" else sprintf("%.12g", error))
}
of_line <- function(model, condition, line, covariance) {
  a <- line[1]
  b <- line[2]
  error <- function(slope) sqrt(drop(t(slope) %*% covariance %*% slope))
  tell(model, condition, "pse", -a / b, error(c(-1 / b, a / b^2)))
  tell(model, condition, "jnd", qnorm(0.75) / b, error(c(0, -qnorm(0.75) / b^2)))
}

simulated <- rows[rows$study == "simul_data", ]
fit <- glmer(cbind(num_yes, num_trials - num_yes) ~ intensity + (1 | person), simulated, binomial("probit"), control = control)
tell("simul_data", "", "log_likelihood", as.numeric(logLik(fit)), NA)
of_line("simul_data", "", fixef(fit), as.matrix(vcov(fit)))

vibro <- rows[rows$study == "vibro_exp3", ]
fit <- glmer(cbind(num_yes, num_trials - num_yes) ~ intensity * vibration + (1 + intensity | person), vibro, binomial("probit"), control = control)
tell("vibro_exp3", "", "log_likelihood", as.numeric(logLik(fit)), NA)
covariance <- as.matrix(vcov(fit))
first <- rbind(c(1, 0, 0, 0), c(0, 1, 0, 0))
second <- rbind(c(1, 0, 1, 0), c(0, 1, 0, 1))
of_line("vibro_exp3", "v0", drop(first %*% fixef(fit)), first %*% covariance %*% t(first))
of_line("vibro_exp3", "v32", drop(second %*% fixef(fit)), second %*% covariance %*% t(second))
write.csv(do.call(rbind, out), "mixedpsy.csv", row.names = FALSE, quote = FALSE)
