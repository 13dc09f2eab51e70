# Writes hierarchical_reference.json: answers of simulated groups with their hierarchical fits.
# Not run by the tests, which read the JSON:
#
#     Rscript data/reference/hierarchical/hierarchical_reference.R
#
# "linear" cases are fitted by lme4's glmer (probit; nAGQ nodes, 1 = Laplace), whose optimum is
# then polished by Newton's method on glmer's own deviance function, because its optimiser stops
# at about four digits. "log_slope" cases have people differ by factors, which glmer has no form
# for: their likelihood is integrated on a fine even grid (the trapezoidal rule, whose error
# falls faster than any power for such integrands) and maximised from there. Standard errors are
# of the observed information, by numDeriv.
suppressMessages({library(lme4); library(numDeriv)})
set.seed(20180)

D <- c(1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883)
E <- c(10.100, 11.580, 13.830, 14.945, 17.505, 18.950, 23.200, 29.335)
levels_of <- list(d = D, e = E)
reference_of <- c(d = 1.853, e = 16.06)

simulated <- function(conditions, people, trials, w, spread, pse_sd, own = 0) {
  rows <- NULL
  for (person in seq_len(people)) {
    shared <- rnorm(1, 0, spread)
    place <- rnorm(1, 0.05, pse_sd)
    for (name in conditions) {
      slope <- exp(-log(log1p(w[[name]])) + shared + rnorm(1, 0, own))
      u <- log(levels_of[[name]] / reference_of[[name]])
      yes <- rbinom(length(u), trials, pnorm(slope * (u - place)))
      rows <- rbind(rows, data.frame(participant = sprintf("P%02d", person), condition = name,
                                     intensity = levels_of[[name]], u = u, num_yes = yes,
                                     num_trials = trials))
    }
  }
  rows
}

newton <- function(cost, start) {
  at <- start
  for (step in 1:40) {
    h <- hessian(cost, at)
    move <- -solve(h, grad(cost, at))
    at <- at + move * min(1, 0.3 / max(abs(move)))
    if (max(abs(move)) < 1e-10) break
  }
  list(at = at, cost = cost(at), covariance = solve(hessian(cost, at)))
}

# --- linear, by glmer -----------------------------------------------------------------------

glmer_case <- function(name, rows, formula, nodes, options, read) {
  cat(name, "\n", file = stderr())
  control <- glmerControl(optimizer = "bobyqa", tolPwrss = 1e-13,
                          optCtrl = list(maxfun = 1e5, rhoend = 1e-9))
  fit <- suppressWarnings(glmer(formula, data = rows, family = binomial(link = "probit"),
                                nAGQ = nodes, control = control))
  deviance_function <- suppressWarnings(update(fit, devFunOnly = TRUE))
  start <- c(getME(fit, "theta"), fixef(fit))
  found <- newton(function(at) deviance_function(at) / 2, unname(start))
  num_theta <- length(getME(fit, "theta"))
  expected <- read(found$at[seq_len(num_theta)], found$at[-seq_len(num_theta)],
                   sqrt(diag(found$covariance))[-seq_len(num_theta)])
  list(name = name, link = "linear", nodes = nodes, options = options, rows = rows,
       expected = expected)
}

# --- ln slope, on a grid --------------------------------------------------------------------

b <- seq(-7, 7, by = 0.2)
log_phi <- dnorm(b, log = TRUE) + log(0.2)

cell_likelihood <- function(cell, slope, place) {
  z <- outer(slope, cell$u, function(s, u) s * u) - slope * place
  drop(pnorm(z, log.p = TRUE) %*% cell$num_yes +
         pnorm(-z, log.p = TRUE) %*% (cell$num_trials - cell$num_yes))
}
log_sum <- function(x) max(x) + log(sum(exp(x - max(x))))

log_slope_case <- function(name, rows, options, start, person_likelihood, read) {
  cat(name, "\n", file = stderr())
  people <- lapply(split(rows, rows$participant), function(r) split(r, r$condition))
  cost <- function(at) -sum(vapply(people, function(p) person_likelihood(p, at), 0))
  rough <- optim(start, cost, method = "BFGS", control = list(reltol = 1e-12))$par
  found <- newton(cost, rough)
  expected <- read(found$at, sqrt(diag(found$covariance)))
  expected$log_likelihood <- -found$cost
  list(name = name, link = "log_slope", nodes = 0, options = options, rows = rows,
       expected = expected)
}

w <- c(d = 0.7, e = 0.3)
one <- simulated("d", 13, 5, w, 0.35, 0)
many <- simulated("d", 9, 20, w, 0.4, 0.1)
both <- simulated(c("d", "e"), 13, 5, w, 0.35, 0.05, 0.1)
shared <- simulated(c("d", "e"), 13, 5, w, 0.35, 0)
both$d <- both$u * (both$condition == "d"); both$e <- both$u * (both$condition == "e")
shared$d <- shared$u * (shared$condition == "d"); shared$e <- shared$u * (shared$condition == "e")

answer <- quote(cbind(num_yes, num_trials - num_yes))
cases <- list()
add <- function(case) cases[[length(cases) + 1]] <<- case

one_slope <- function(theta, beta, se)
  list(slope = beta, slope_standard_error = se, slope_sd = abs(theta))
for (nodes in c(1, 25)) {
  add(glmer_case(sprintf("one condition, pse at the reference, %d", nodes), one,
                 cbind(num_yes, num_trials - num_yes) ~ 0 + u + (0 + u | participant), nodes,
                 list(pse = "reference", slopes = "shared"), one_slope))
  add(glmer_case(sprintf("one condition, common pse, %d", nodes), many,
                 cbind(num_yes, num_trials - num_yes) ~ 1 + u + (0 + u | participant), nodes,
                 list(pse = "common", slopes = "shared"),
                 function(theta, beta, se)
                   list(slope = beta[2], slope_standard_error = se[2], slope_sd = abs(theta),
                        place = beta[1], place_standard_error = se[1])))
  add(glmer_case(sprintf("two conditions, shared slopes, %d", nodes), shared,
                 cbind(num_yes, num_trials - num_yes) ~ 0 + d + e + (0 + u | participant),
                 nodes, list(pse = "reference", slopes = "shared"),
                 function(theta, beta, se)
                   list(slope = beta, slope_standard_error = se,
                        slope_sd = rep(abs(theta), 2))))
}
add(glmer_case("two conditions, correlated slopes, Laplace", both,
               cbind(num_yes, num_trials - num_yes) ~ 0 + d + e + (0 + d + e | participant), 1,
               list(pse = "reference", slopes = "correlated"),
               function(theta, beta, se)
                 list(slope = beta, slope_standard_error = se,
                      slope_sd = c(abs(theta[1]), sqrt(theta[2]^2 + theta[3]^2)),
                      correlation = sign(theta[1]) * theta[2] /
                        sqrt(theta[2]^2 + theta[3]^2))))
add(glmer_case("one condition, personal pse, Laplace", many,
               cbind(num_yes, num_trials - num_yes) ~ 1 + u + (0 + u | participant) +
                 (1 | participant), 1,
               list(pse = "personal", slopes = "shared"),
               function(theta, beta, se)
                 list(slope = beta[2], slope_standard_error = se[2], slope_sd = abs(theta[1]),
                      place = beta[1], place_standard_error = se[1], place_sd = abs(theta[2]))))

# Here the places differ in each condition on their own.
apart <- simulated(c("d", "e"), 13, 20, w, 0.35, 0, 0.1)
set.seed(20181)
shift <- data.frame(participant = rep(sprintf("P%02d", 1:13), 2),
                    condition = rep(c("d", "e"), each = 13), shift = rnorm(26, 0, 0.5),
                    slope = rep(2.5 * exp(rnorm(13, 0, 0.4)), 2) * exp(rnorm(26, 0, 0.3)))
apart <- merge(apart, shift, sort = FALSE)
apart <- apart[order(apart$participant, apart$condition, apart$u), ]
apart$num_yes <- rbinom(nrow(apart), 20, pnorm(apart$slope * apart$u + apart$shift))
apart$shift <- NULL
apart$in_d <- as.numeric(apart$condition == "d"); apart$in_e <- 1 - apart$in_d
apart$d <- apart$u * apart$in_d; apart$e <- apart$u * apart$in_e
add(glmer_case("two conditions, correlated slopes, personal pse in each, Laplace", apart,
               cbind(num_yes, num_trials - num_yes) ~ 0 + in_d + in_e + d + e +
                 (0 + d + e | participant) + (0 + in_d | participant) + (0 + in_e | participant),
               1, list(pse = "personal", slopes = "correlated"),
               function(theta, beta, se)
                 list(slope = beta[3:4], slope_standard_error = se[3:4],
                      slope_sd = c(abs(theta[1]), sqrt(theta[2]^2 + theta[3]^2)),
                      correlation = sign(theta[1]) * theta[2] / sqrt(theta[2]^2 + theta[3]^2),
                      place = beta[1:2], place_standard_error = se[1:2],
                      place_sd = abs(theta[4:5]))))

add(log_slope_case("ln slope, one condition, pse at the reference", one,
                   list(pse = "reference", slopes = "shared"), c(0.6, 0.3),
                   function(p, at)
                     log_sum(cell_likelihood(p$d, exp(at[1] + at[2] * b), 0) + log_phi),
                   function(at, se)
                     list(slope = at[1], slope_standard_error = se[1], slope_sd = abs(at[2]))))
add(log_slope_case("ln slope, one condition, common pse", many,
                   list(pse = "common", slopes = "shared"), c(0.6, 0.05, 0.3),
                   function(p, at)
                     log_sum(cell_likelihood(p$d, exp(at[1] + at[3] * b), at[2]) + log_phi),
                   function(at, se)
                     list(slope = at[1], slope_standard_error = se[1], slope_sd = abs(at[3]),
                          place = at[2], place_standard_error = se[2])))
add(log_slope_case("ln slope, one condition, personal pse", many,
                   list(pse = "personal", slopes = "shared"), c(0.6, 0.05, 0.3, 0.1),
                   function(p, at) {
                     slope <- rep(exp(at[1] + at[3] * b), times = length(b))
                     place <- rep(at[2] + at[4] * b, each = length(b))
                     log_sum(cell_likelihood(p$d, slope, place) +
                               rep(log_phi, times = length(b)) + rep(log_phi, each = length(b)))
                   },
                   function(at, se)
                     list(slope = at[1], slope_standard_error = se[1], slope_sd = abs(at[3]),
                          place = at[2], place_standard_error = se[2], place_sd = abs(at[4]))))
add(log_slope_case("ln slope, two conditions, correlated", both,
                   list(pse = "reference", slopes = "correlated"), c(0.6, 1.3, 0.3, 0.25, 0.15),
                   function(p, at) {
                     first <- cell_likelihood(p$d, exp(at[1] + at[3] * b), 0) + log_phi
                     inner <- vapply(seq_along(b), function(i)
                       log_sum(cell_likelihood(
                         p$e, exp(at[2] + at[4] * b[i] + at[5] * b), 0) + log_phi), 0)
                     log_sum(first + inner)
                   },
                   function(at, se)
                     list(slope = at[1:2], slope_standard_error = se[1:2],
                          slope_sd = c(abs(at[3]), sqrt(at[4]^2 + at[5]^2)),
                          correlation = sign(at[3]) * at[4] / sqrt(at[4]^2 + at[5]^2))))

# --- JSON -----------------------------------------------------------------------------------

number <- function(x) if (length(x) == 1) sprintf("%.17g", x) else
  paste0("[", paste(sprintf("%.17g", x), collapse = ", "), "]")
object <- function(x, value) paste0("{", paste0('"', names(x), '": ', vapply(x, value, ""),
                                                collapse = ", "), "}")
quoted <- function(x) paste0('"', x, '"')
case_json <- function(case) {
  rows <- paste0('["', case$rows$participant, '", "', case$rows$condition, '", ',
                 sprintf("%.17g", case$rows$intensity), ", ", case$rows$num_yes, ", ",
                 case$rows$num_trials, "]", collapse = ", ")
  paste0('  {"name": ', quoted(case$name), ', "link": ', quoted(case$link), ', "nodes": ',
         case$nodes, ', "options": ', object(case$options, quoted), ', "expected": ',
         object(case$expected, number), ',\n   "rows": [', rows, "]}")
}
versions <- c(R = paste(R.version$major, R.version$minor, sep = "."),
              lme4 = as.character(packageVersion("lme4")),
              numDeriv = as.character(packageVersion("numDeriv")))
file <- file("data/reference/hierarchical/hierarchical_reference.json", "w")
writeLines(c("{",
             '"generated_by": "data/reference/hierarchical/hierarchical_reference.R",',
             paste0('"versions": ', object(versions, quoted), ","),
             paste0('"reference": ', object(reference_of, number), ","), '"cases": ['), file)
writeLines(paste(vapply(cases, case_json, ""), collapse = ",\n"), file)
writeLines(c("]", "}"), file)
close(file)
