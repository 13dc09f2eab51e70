# Fits mixed models with lme4's glmer: data sets that lme4 brings (cbpp, VerbAgg) and simulated ones. Writes the rows of
# each set (*.csv) and mixed_reference.json, which the tests read. In this folder:
#
#     Rscript mixed_reference.R
#
# glmer's optimiser stops at four digits or so. Its optimum is therefore polished by Newton's method on glmer's own
# deviance function, by numDeriv, and the polished one is kept where its likelihood is higher; not so for VerbAgg, where a
# second derivative takes minutes. Standard errors are of the observed information of theta and fixed effects together,
# as glmer's own. What its defaults come to is kept beside: there the modes are found to 1e-7 alone, so that the value may
# be too large as well as too small. With nAGQ > 1 glmer leaves the likelihood of
# the saturated model out, which is added here.
suppressMessages({library(lme4); library(numDeriv)})
set.seed(31)
number <- function(x) formatC(x, digits = 15, format = "g")

# --- Data ---------------------------------------------------------------------------------------------------------

people <- expand.grid(u = seq(-2, 2, by = 0.5), condition = c("A", "B", "C"), participant = sprintf("P%02d", 1:12),
                      stringsAsFactors = FALSE)
i <- as.integer(factor(people$participant))
place <- rnorm(12, 0, 0.5); slope <- rnorm(12, 0, 0.25) + 0.3 * place
shift <- c(A = 0, B = 0.4, C = -0.3)
steep <- c(A = 1, B = 1.3, C = 0.8)
people$n <- 12
people$yes <- rbinom(nrow(people), 12, pnorm(0.2 + place[i] + shift[people$condition] +
                                               (steep[people$condition] + slope[i]) * people$u))
people$right <- rbinom(nrow(people), 12, 0.5 + 0.48 * pnorm(0.3 + place[i] + people$u))
people <- people[, c("participant", "condition", "u", "yes", "right", "n")]

crossed <- expand.grid(item = sprintf("i%02d", 1:15), person = sprintf("s%02d", 1:30), stringsAsFactors = FALSE)
s <- as.integer(factor(crossed$person)); t <- as.integer(factor(crossed$item))
crossed$x <- round(rnorm(nrow(crossed)), 3)
crossed$session <- ifelse(t <= 7, "m", "n")
crossed$y <- rbinom(nrow(crossed), 1, plogis(rnorm(30, 0, 0.9)[s] + rnorm(15, 0, 0.7)[t] + 0.8 * crossed$x +
                                               rnorm(30, 0, 0.4)[s] * crossed$x))

cows <- transform(cbpp, herd = as.character(herd), period = paste0("p", period))
names(cows) <- c("herd", "incidence", "size", "period")

verbal <- VerbAgg
verbal$y <- as.integer(verbal$r2 == "Y")
for (column in c("Gender", "item", "id", "btype", "situ")) verbal[[column]] <- as.character(verbal[[column]])

# VerbAgg is written by person and by item, which it is crossed of.
items <- unique(verbal$item)
by_item <- verbal[match(items, verbal$item), c("item", "btype", "situ")]
ids <- unique(verbal$id)
by_person <- verbal[match(ids, verbal$id), c("id", "Anger", "Gender")]
by_person$answers <- vapply(ids, function(one) {
  of_one <- verbal[verbal$id == one, ]
  paste(of_one$y[match(items, of_one$item)], collapse = "")
}, "")
write.csv(people, "people.csv", row.names = FALSE, quote = FALSE)
write.csv(crossed, "crossed.csv", row.names = FALSE, quote = FALSE)
write.csv(cows, "cbpp.csv", row.names = FALSE, quote = FALSE)
write.csv(by_person, "verbagg_people.csv", row.names = FALSE, quote = FALSE)
write.csv(by_item, "verbagg_items.csv", row.names = FALSE, quote = FALSE)
sets <- list(people = people, crossed = crossed, cbpp = cows, verbagg = verbal)

# --- Models -------------------------------------------------------------------------------------------------------

# P = 0.5 + 0.48 Phi(eta), of right answers among two with 2 % lapses.
guessing <- structure(list(
  linkfun = function(mu) qnorm(pmin(pmax((mu - 0.5) / 0.48, 1e-12), 1 - 1e-12)),
  linkinv = function(eta) 0.5 + 0.48 * pnorm(eta), mu.eta = function(eta) 0.48 * dnorm(eta),
  valideta = function(eta) TRUE, name = "guess"), class = "link-glm")

model <- function(data, yes, trials, fixed, random, link, nodes = 1, contrasts = "treatment", guess = 0, lapse = 0)
  list(data = data, yes = yes, trials = trials, fixed = fixed, random = random, link = link, nodes = nodes,
       contrasts = contrasts, guess = guess, lapse = lapse)
models <- list(
  model("people", "yes", "n", "u * condition", "(1 + u | participant)", "probit"),
  model("people", "yes", "n", "u * condition", "(1 + u | participant)", "logit"),
  model("people", "yes", "n", "u + condition", "(1 + u | participant)", "cloglog"),
  model("people", "yes", "n", "u * condition", "(1 + u || participant)", "probit"),
  model("people", "yes", "n", "0 + condition + u:condition", "(0 + u | participant) + (1 | participant)", "probit"),
  model("people", "yes", "n", "u * condition", "(1 + u | participant)", "probit", contrasts = "sum"),
  model("people", "yes", "n", "u + condition", "(0 + condition | participant)", "logit", contrasts = "sum"),
  model("people", "yes", "n", "scale(u) * condition", "(1 | participant)", "probit", nodes = 9),
  model("people", "yes", "n", "u + condition", "(1 | participant)", "cloglog", nodes = 9),
  model("people", "right", "n", "u", "(1 | participant)", "probit", guess = 0.5, lapse = 0.02),
  model("crossed", "y", "", "x", "(1 | person) + (1 | item)", "logit"),
  model("crossed", "y", "", "x", "(1 + x | person) + (1 | item)", "probit"),
  model("crossed", "y", "", "x + session", "(1 | person/session)", "logit"),
  model("crossed", "y", "", "x", "(1 | person)", "logit", nodes = 25),
  model("cbpp", "incidence", "size", "period", "(1 | herd)", "logit"),
  model("cbpp", "incidence", "size", "period", "(1 | herd)", "logit", nodes = 9),
  model("cbpp", "incidence", "size", "period", "(1 | herd)", "probit", nodes = 9),
  model("cbpp", "incidence", "size", "period", "(1 | herd)", "cloglog", contrasts = "sum"),
  model("verbagg", "y", "", "Anger + Gender + btype + situ", "(1 | id) + (1 | item)", "logit"),
  model("verbagg", "y", "", "Anger + Gender + btype + situ", "(1 | id) + (1 | item)", "probit"))

newton <- function(cost, start) {
  at <- start
  for (step in 1:8) {
    h <- hessian(cost, at)
    move <- tryCatch(-solve(h, grad(cost, at)), error = function(e) NULL)
    if (is.null(move)) break
    move <- move * min(1, 0.2 / max(abs(move)))
    if (!is.finite(cost(at + move)) || cost(at + move) > cost(at) + 1e-9) break
    at <- at + move
    if (max(abs(move)) < 1e-8) break
  }
  at
}

fitted_by_lme4 <- function(m) {
  data <- sets[[m$data]]
  # Bytes, not a language, order the levels.
  for (column in names(data)) if (is.character(data[[column]])) {
    data[[column]] <- factor(data[[column]], levels = sort(unique(data[[column]]), method = "radix"))
  }
  options(contrasts = if (m$contrasts == "sum") c("contr.sum", "contr.poly") else c("contr.treatment", "contr.poly"))
  n <- if (m$trials == "") rep(1, nrow(data)) else data[[m$trials]]
  data$answers <- cbind(data[[m$yes]], n - data[[m$yes]])
  family <- binomial(link = if (m$guess > 0) guessing else m$link)
  formula <- as.formula(paste("answers ~", m$fixed, "+", m$random))
  seconds <- system.time(
    plain <- suppressWarnings(glmer(formula, data, family, nAGQ = m$nodes)))[["user.self"]]
  control <- glmerControl(optimizer = "bobyqa", tolPwrss = 1e-12, optCtrl = list(maxfun = 1e5, rhoend = 1e-9))
  is_large <- m$data == "verbagg"
  if (is_large) control <- glmerControl(optimizer = "bobyqa")
  fit <- suppressWarnings(glmer(formula, data, family, nAGQ = m$nodes, control = control))
  deviance <- suppressWarnings(glmer(formula, data, family, nAGQ = m$nodes, control = control, devFunOnly = TRUE))
  cost <- function(at) deviance(at) / 2
  num_theta <- length(getME(fit, "theta"))
  start <- unname(c(getME(fit, "theta"), fixef(fit)))
  at <- if (is_large) start else newton(cost, start)
  if (!(cost(at) < cost(start))) at <- start
  saturated <- if (m$nodes > 1) sum(dbinom(data$answers[, 1], n, data$answers[, 1] / n, log = TRUE)) else 0
  theta <- at[seq_len(num_theta)]; beta <- at[-seq_len(num_theta)]
  errors <- if (is_large) sqrt(diag(as.matrix(vcov(fit)))) else
    sqrt(diag(solve(hessian(cost, at))))[-seq_len(num_theta)]
  # Spreads and correlations of theta, term by term, in lme4's order of terms.
  fit_terms <- getME(fit, "cnms")
  random <- list(); used <- 0
  for (k in seq_along(fit_terms)) {
    size <- length(fit_terms[[k]])
    lambda <- matrix(0, size, size)
    lambda[lower.tri(lambda, diag = TRUE)] <- theta[used + seq_len(size * (size + 1) / 2)]
    used <- used + size * (size + 1) / 2
    spread <- lambda %*% t(lambda)
    for (i in seq_len(size)) {
      random[[length(random) + 1]] <- list(group = names(fit_terms)[k], name = fit_terms[[k]][i],
                                           sd = sqrt(spread[i, i]),
                                           correlations = if (i > 1) cov2cor(spread)[i, seq_len(i - 1)] else numeric(0))
    }
  }
  cat(m$data, m$fixed, m$random, m$link, m$nodes, number(-cost(at) + saturated), "\n", file = stderr())
  list(names = names(fixef(fit)), beta = beta, errors = errors, random = random, seconds = seconds,
       plain_log_likelihood = as.numeric(logLik(plain)) + saturated, log_likelihood = -cost(at) + saturated)
}

quoted <- function(x) paste0('"', gsub('"', '\\\\"', x), '"')
list_of <- function(x) paste0("[", paste(x, collapse = ", "), "]")
entry <- function(m) {
  f <- fitted_by_lme4(m)
  random <- vapply(f$random, function(r)
    paste0('{"group": ', quoted(r$group), ', "name": ', quoted(r$name), ', "sd": ', number(r$sd),
           ', "correlations": ', list_of(number(r$correlations)), "}"), "")
  paste0('{"data": ', quoted(m$data), ', "yes": ', quoted(m$yes), ', "trials": ', quoted(m$trials),
         ', "fixed": ', quoted(m$fixed), ', "random": ', quoted(m$random), ', "link": ', quoted(m$link),
         ', "nodes": ', m$nodes, ', "contrasts": ', quoted(m$contrasts), ', "guess": ', m$guess, ', "lapse": ', m$lapse,
         ',\n   "names": ', list_of(quoted(f$names)), ',\n   "estimates": ', list_of(number(f$beta)),
         ',\n   "standard_errors": ', list_of(number(f$errors)), ',\n   "random_effects": ', list_of(random),
         ',\n   "log_likelihood": ', number(f$log_likelihood), ', "log_likelihood_of_its_defaults": ',
         number(f$plain_log_likelihood), ', "seconds": ', number(f$seconds), "}")
}
versions <- paste0('{"R": ', quoted(as.character(getRversion())), ', "lme4": ', quoted(as.character(packageVersion("lme4"))),
                   ', "numDeriv": ', quoted(as.character(packageVersion("numDeriv"))), "}")
file <- file("mixed_reference.json", "w")
writeLines(c("{", '"generated_by": "data/reference/mixed/mixed_reference.R",', paste0('"versions": ', versions, ","),
             '"models": ['), file)
writeLines(paste0("  ", vapply(models, entry, ""), collapse = ",\n"), file)
writeLines(c("]", "}"), file)
close(file)
