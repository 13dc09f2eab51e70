# Finds the maximum of every model of published.csv, psignifit_2.csv and psyphy.csv by itself, and, where the other program maximised
# a posterior, the maximum of the same likelihood with that program's documented priors. Writes compared.csv beside them:
# `Rscript agreement.R [PART OF A NAME]`, in this folder; with a part of a name it prints those rows alone. Base R.
#
# Log-likelihoods are without the binomial coefficients. Rates that are free are in 0 .. 0.5.

families <- list(
  normal = function(z) pnorm(z),
  logistic = function(z) plogis(z),
  gumbel = function(z) -expm1(-exp(z)),
  weibull = function(z) -expm1(-exp(z)),
  reversed_gumbel = function(z) exp(-exp(-z)),
  hyperbolic_secant = function(z) 2 / pi * atan(exp(pi / 2 * z)))
quantiles <- list(
  normal = qnorm,
  logistic = qlogis,
  gumbel = function(p) log(-log1p(-p)),
  weibull = function(p) log(-log1p(-p)),
  reversed_gumbel = function(p) -log(-log(p)),
  hyperbolic_secant = function(p) 2 / pi * log(tan(pi / 2 * p)))

probability <- function(u, v, model) {
  s <- families[[model$family]]((u - v$location) / v$scale)
  if (isTRUE(model$falling == 1)) s <- 1 - s
  if (model$symmetric == 1) v$guess + v$lapse + (1 - v$guess - 2 * v$lapse) * s else v$guess + (1 - v$guess - v$lapse) * s
}

log_likelihood <- function(u, yes, n, v, model) {
  p <- pmin(pmax(probability(u, v, model), 1e-300), 1 - 1e-16)
  sum(yes * log(p) + (n - yes) * log1p(-p))
}

# Answers of one row of equal probability p differ by eta: Schuett et al. (2016), a beta distribution about the curve.
log_likelihood_beta <- function(u, yes, n, v, model, eta) {
  if (eta^2 < 1e-9) return(log_likelihood(u, yes, n, v, model))
  p <- pmin(pmax(probability(u, v, model), 1e-12), 1 - 1e-12)
  more <- 1 / eta^2 - 1
  sum(lbeta(yes + p * more, n - yes + (1 - p) * more) - lbeta(p * more, (1 - p) * more))
}

# The minimum of a smooth cost: PORT's method from every start, simplex and BFGS from the best, then Newton's method with
# differences of high order.
lowest <- function(cost, starts) {
  safe <- function(q) { value <- cost(q); if (is.finite(value)) value else 1e10 }
  best <- list(value = Inf)
  for (q in starts) {
    found <- suppressWarnings(nlminb(q, safe, control = list(rel.tol = 1e-13, x.tol = 1e-10)))
    if (found$objective < best$value) best <- list(par = found$par, value = found$objective)
  }
  # A simplex does not stop at an edge of the numbers' precision.
  found <- optim(best$par, safe, control = list(reltol = 1e-14, maxit = 2000))
  found <- optim(found$par, safe, method = "BFGS", control = list(reltol = 1e-15, maxit = 500))
  if (found$value < best$value) best <- found
  q <- best$par
  for (step in 1:8) {
    h <- 1e-3
    slope <- vapply(seq_along(q), function(i) {
      e <- replace(numeric(length(q)), i, h)
      (8 * (safe(q + e) - safe(q - e)) - (safe(q + 2 * e) - safe(q - 2 * e))) / (12 * h)
    }, 0)
    move <- tryCatch(solve(optimHess(q, safe), slope), error = function(e) NULL)
    if (is.null(move) || !all(is.finite(move)) || max(abs(move)) > 0.1) break
    if (safe(q - move) > safe(q) + 1e-10) break
    q <- q - move
  }
  if (safe(q) < best$value + 1e-10) best <- list(par = q, value = safe(q))
  best
}

starts_of <- function(u, num_rates, extra = NULL) {
  wide <- diff(range(u))
  out <- list()
  # Without free rates and guesses there is one maximum.
  for (place in if (num_rates > 0) c(0.2, 0.4, 0.6, 0.8) else 0.5) for (width in c(0.05, 0.2)) {
    out[[length(out) + 1]] <- c(min(u) + place * wide, log(width * wide), rep(-1.2, num_rates), extra)
  }
  out
}

rate_of <- function(q) 0.25 * (1 + sin(q))

values_of <- function(q, model) {
  v <- list(location = q[1], scale = exp(q[2]))
  next_one <- 3
  for (rate in c("guess", "lapse")) {
    if (model[[rate]] == "free") {
      v[[rate]] <- rate_of(q[next_one])
      next_one <- next_one + 1
    } else {
      v[[rate]] <- as.numeric(model[[rate]])
    }
  }
  v
}

maximum <- function(u, yes, n, model) {
  free <- (model$guess == "free") + (model$lapse == "free")
  # The axis in its own range, so that steps are alike on every one.
  at <- mean(u)
  unit <- sd(u)
  w <- (u - at) / unit
  best <- lowest(function(q) -log_likelihood(w, yes, n, values_of(q, model), model), starts_of(w, free))
  v <- values_of(best$par, model)
  v$location <- at + unit * v$location
  v$scale <- unit * v$scale
  c(v, log_likelihood = -best$value)
}

# psignifit's words: a curve is at 0.5 at its threshold, and from alpha to 1 - alpha over its width.
width_over_scale <- function(family, alpha) quantiles[[family]](1 - alpha) - quantiles[[family]](alpha)

from_width <- function(threshold, width, family, alpha) {
  scale <- width / width_over_scale(family, alpha)
  list(location = threshold - scale * quantiles[[family]](0.5), scale = scale)
}

# The priors of psignifit 4, not normalised: flat in the range of the stimuli, falling as a cosine within half a range; the
# width flat from twice the smallest step to the range, rising as a cosine from one step and falling to three ranges; both
# rates and eta as Beta(1, 10).
log_priors <- function(u, threshold, width, guess, lapse, eta, model) {
  range_of <- range(u)
  spread <- diff(range_of)
  step <- min(diff(sort(unique(u))))
  beyond <- max(range_of[1] - threshold, threshold - range_of[2], 0)
  of_threshold <- if (beyond <= spread / 2) 0.5 + 0.5 * cos(2 * pi * beyond / spread) else 0
  of_width <-
    if (width < step || width > 3 * spread) 0
    else if (width <= 2 * step) 0.5 - 0.5 * cos(pi * (width - step) / step)
    else if (width < spread) 1
    else 0.5 + 0.5 * cos(pi / 2 * (width - spread) / spread)
  of_rate <- function(rate) 9 * log1p(-rate)
  log(of_threshold) + log(of_width) + of_rate(lapse) + of_rate(eta) + if (model$guess == "free") of_rate(guess) else 0
}

log_posterior <- function(u, yes, n, v, eta, model) {
  q <- quantiles[[model$family]]
  threshold <- v$location + v$scale * q(0.5)
  width <- v$scale * width_over_scale(model$family, 0.05)
  log_likelihood_beta(u, yes, n, v, model, eta) + log_priors(u, threshold, width, v$guess, v$lapse, eta, model)
}

posterior_maximum <- function(u, yes, n, model) {
  free <- (model$guess == "free") + (model$lapse == "free")
  at <- mean(u)
  unit <- sd(u)
  spell <- function(q, eta) {
    v <- values_of(q, model)
    v$location <- at + unit * v$location
    v$scale <- unit * v$scale
    list(v = v, eta = eta)
  }
  w <- (u - at) / unit
  # eta is 0 or not: as binomial answers, and with eta free.
  binomial <- lowest(function(q) { s <- spell(q, 0); -log_posterior(u, yes, n, s$v, 0, model) },
                     starts_of(w, free))
  s <- spell(binomial$par, 0)
  value <- binomial$value
  eta_of <- function(q) 0.5 * (1 + sin(q[length(q)]))
  scattered <- lowest(function(q) { s <- spell(q, eta_of(q)); -log_posterior(u, yes, n, s$v, s$eta, model) },
                      starts_of(w, free, -0.9))
  if (scattered$value < value - 1e-9) {
    s <- spell(scattered$par, eta_of(scattered$par))
    value <- scattered$value
  }
  c(s$v, eta = s$eta, log_posterior = -value)
}

answers <- rbind(read.csv("answers.csv", stringsAsFactors = FALSE), read.csv("../curves/answers.csv", stringsAsFactors = FALSE))
published <- do.call(rbind, lapply(c("published.csv", "psignifit_2.csv", "psyphy.csv"), read.csv, stringsAsFactors = FALSE, colClasses = "character"))
part <- commandArgs(trailingOnly = TRUE)
if (length(part) > 0) published <- published[grepl(part[1], paste(published$data_set, published$group, published$program)), ]

rows_of <- function(table, data_set, group, model) {
  d <- table[table$data_set == data_set & table$group == group & table$num_trials > 0, ]
  if (model$axis == "log" || model$family == "weibull") {
    d <- d[d$intensity > 0, ]
    d$u <- log(d$intensity)
  } else {
    d$u <- d$intensity
  }
  d
}

# Greatrex let Palamedes search a grid of thresholds, slopes and lapse rates for where to start, and then held the lapse rate
# that the best point had. His thresholds near the one that was found are searched again.
lapse_of_grid <- function(u, yes, n, near) {
  places <- seq(min(u), max(u), 0.001)
  places <- places[abs(places - near) < 0.25]
  slopes <- 10^seq(-1, 2, 0.025)
  slopes <- slopes[slopes > 0.2 & slopes < 3]
  best <- c(-Inf, NA)
  for (lapse in seq(0, 0.08, 0.01)) {
    total <- 0
    for (i in seq_along(u)) {
      p <- (1 - lapse) * pnorm(outer(u[i] - places, slopes))
      if (yes[i] > 0) total <- total + yes[i] * log(p)
      if (n[i] > yes[i]) total <- total + (n[i] - yes[i]) * log1p(-p)
    }
    if (max(total) > best[1]) best <- c(max(total), lapse)
  }
  best[2]
}

# The words of the program: Weibull's location and scale are those of (x / location)^scale.
in_words <- function(v, model) {
  if (model$family == "weibull") {
    v$location <- exp(v$location)
    v$scale <- 1 / v$scale
  }
  v
}

out <- list()
for (i in seq_len(nrow(published))) {
  row <- published[i, ]
  model <- row[, c("family", "axis", "guess", "lapse", "symmetric")]
  d <- rows_of(answers, row$data_set, row$group, model)
  if (model$lapse == "grid") model$lapse <- as.character(lapse_of_grid(d$u, d$num_yes, d$num_trials, as.numeric(row$first)))
  ours <- maximum(d$u, d$num_yes, d$num_trials, model)
  first <- as.numeric(row$first)
  second <- as.numeric(row$second)
  theirs <- switch(row$form,
    location_scale = list(location = first, scale = second),
    location_inverse_scale = list(location = first, scale = 1 / second),
    location_shape = list(location = log(first), scale = 1 / second),
    width05 = from_width(first, second, row$family, 0.05),
    list(location = NA, scale = NA))
  theirs$guess <- if (row$guess == "free") as.numeric(row$guess_rate) else as.numeric(row$guess)
  theirs$lapse <- if (row$lapse == "free") as.numeric(row$lapse_rate) else as.numeric(model$lapse)
  there <- if (is.na(theirs$location)) NA else log_likelihood(d$u, d$num_yes, d$num_trials, theirs, model)
  post <- list(location = NA, scale = NA, guess = NA, lapse = NA, eta = NA)
  gain <- NA
  if (row$criterion == "map") {
    post <- posterior_maximum(d$u, d$num_yes, d$num_trials, model)
    gain <- post$log_posterior - log_posterior(d$u, d$num_yes, d$num_trials, theirs, as.numeric(row$eta), model)
    post <- in_words(post, model)
  }
  theirs <- in_words(theirs, model)
  ours <- in_words(ours, model)
  out[[i]] <- data.frame(
    data_set = row$data_set, group = row$group, family = row$family, axis = row$axis, guess = row$guess, lapse = model$lapse,
    symmetric = row$symmetric, program = row$program, criterion = row$criterion,
    location = theirs$location, scale = theirs$scale, guess_rate = theirs$guess, lapse_rate = theirs$lapse, log_likelihood = there,
    r_location = ours$location, r_scale = ours$scale, r_guess_rate = ours$guess, r_lapse_rate = ours$lapse,
    r_log_likelihood = ours$log_likelihood,
    prior_location = post$location, prior_scale = post$scale, prior_guess_rate = post$guess, prior_lapse_rate = post$lapse,
    prior_eta = post$eta, prior_gain = gain)
}
written <- function(table, file) {
  for (column in names(table)) if (is.numeric(table[[column]])) {
    table[[column]] <- ifelse(is.na(table[[column]]), "", sprintf("%.12g", table[[column]]))
  }
  write.csv(table, file, row.names = FALSE, quote = FALSE)
}
table <- do.call(rbind, out)
if (length(part) > 0) print(table, digits = 10) else written(table, "compared.csv")
