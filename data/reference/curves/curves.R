# Fits every group of answers.csv by every model of models.csv, with R's own glm where the curve is one of its links, with
# psyphy's links for a forced choice where that package is installed, else with optim from many starts. Writes
# reference.csv beside them: `Rscript curves.R`, in this folder. Rates that are free are in 0 .. 0.5.

answers <- read.csv("answers.csv", stringsAsFactors = FALSE)
models <- read.csv("models.csv", stringsAsFactors = FALSE)
has_psyphy <- requireNamespace("psyphy", quietly = TRUE)

families <- list(
  normal = function(u, l, s) pnorm((u - l) / s),
  logistic = function(u, l, s) plogis((u - l) / s),
  gumbel = function(u, l, s) -expm1(-exp((u - l) / s)),
  weibull = function(u, l, s) -expm1(-exp((u - l) / s)),
  reversed_gumbel = function(u, l, s) exp(-exp(-(u - l) / s)),
  hyperbolic_secant = function(u, l, s) 2 / pi * atan(exp(pi / 2 * (u - l) / s)))
links <- c(normal = "probit", logistic = "logit", gumbel = "cloglog", weibull = "cloglog")

minus_log_likelihood <- function(p, yes, n) {
  p <- pmin(pmax(p, 1e-300), 1 - 1e-16)
  -sum(yes * log(p) + (n - yes) * log1p(-p))
}

# Location and scale of F on the axis u, the rates and the log-likelihood.
by_optim <- function(u, yes, n, model) {
  curve <- families[[model$family]]
  free <- c(guess = model$guess == "free", lapse = model$lapse == "free")
  at <- function(q) {
    rates <- c(guess = suppressWarnings(as.numeric(model$guess)), lapse = suppressWarnings(as.numeric(model$lapse)))
    rates[free] <- 0.25 * (1 + sin(q[-(1:2)]))
    list(location = q[1], scale = exp(q[2]), guess = rates[["guess"]], lapse = rates[["lapse"]])
  }
  cost <- function(q) {
    v <- at(q)
    s <- curve(u, v$location, v$scale)
    if (model$falling == 1) s <- 1 - s
    minus_log_likelihood(v$guess + (1 - v$guess - v$lapse) * s, yes, n)
  }
  best <- list(value = Inf)
  wide <- diff(range(u))
  for (place in quantile(u, c(0.1, 0.3, 0.5, 0.7, 0.9), names = FALSE)) for (width in c(0.03, 0.1, 0.3)) {
    q <- c(place, log(width * wide), rep(-1.2, sum(free)))
    for (again in 1:4) {
      q <- optim(q, cost, control = list(reltol = 1e-15, maxit = 4000))$par
      found <- optim(q, cost, method = "BFGS", control = list(reltol = 1e-15, maxit = 500))
      q <- found$par
    }
    if (found$value < best$value) best <- found
  }
  c(at(best$par), log_likelihood = -best$value)
}

by_glm <- function(u, yes, n, model) {
  guess <- as.numeric(model$guess)
  link <- links[[model$family]]
  if (guess > 0) link <- get(paste0("mafc.", link), asNamespace("psyphy"))(round(1 / guess))
  u_up <- if (model$falling == 1) -u else u
  line <- coef(glm(cbind(yes, n - yes) ~ u_up, family = binomial(link), control = glm.control(epsilon = 1e-14, maxit = 500)))
  location <- -line[[1]] / line[[2]]
  v <- list(location = if (model$falling == 1) -location else location, scale = 1 / line[[2]], guess = guess, lapse = 0)
  s <- families[[model$family]](u_up, location, v$scale)
  c(v, log_likelihood = -minus_log_likelihood(guess + (1 - guess) * s, yes, n))
}

rows <- list()
for (i in seq_len(nrow(models))) {
  model <- models[i, ]
  of_set <- answers[answers$data_set == model$data_set, ]
  for (group in unique(of_set$group)) {
    d <- of_set[of_set$group == group & of_set$num_trials > 0, ]
    u <- if (model$axis == "log") log(d$intensity) else d$intensity
    d <- d[is.finite(u), ]
    u <- u[is.finite(u)]
    by <- list()
    if (model$guess == "0" && model$lapse == "0" && model$family %in% names(links)) {
      by[[paste("R", getRversion(), "glm")]] <- suppressWarnings(by_glm(u, d$num_yes, d$num_trials, model))
    } else {
      by[[paste("R", getRversion(), "optim")]] <- by_optim(u, d$num_yes, d$num_trials, model)
      # A falling curve of a link that is not symmetric is another one.
      if (has_psyphy && model$lapse == "0" && model$guess != "free" && model$family %in% names(links)) {
        by[[paste("psyphy", packageVersion("psyphy"))]] <- by_glm(u, d$num_yes, d$num_trials, model)
      }
    }
    for (program in names(by)) {
      v <- by[[program]]
      if (model$family == "weibull") {
        v$location <- exp(v$location)
        v$scale <- 1 / v$scale
      }
      rows[[length(rows) + 1]] <- cbind(model, group = group, program = program, as.data.frame(v))
    }
  }
}
names_of <- c("data_set", "group", "family", "axis", "guess", "lapse", "falling", "program",
              "location", "scale", "guess_rate", "lapse_rate", "log_likelihood")
out <- do.call(rbind, lapply(rows, function(r) { r <- r[, c(1, 7, 2:6, 8:13)]; names(r) <- names_of; r }))
for (column in names_of[9:13]) out[[column]] <- sprintf("%.12g", out[[column]])
write.csv(out, "reference.csv", row.names = FALSE, quote = FALSE)
