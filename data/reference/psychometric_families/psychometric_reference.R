# Writes psychometric_reference.json: psychometric functions of other families, regressions and
# posteriors, computed by R's glm, numDeriv and integrate. Not run by the tests, which read the
# JSON:
#
#     Rscript data/reference/psychometric_families/psychometric_reference.R
suppressMessages(library(numDeriv))
set.seed(1993)
control <- glm.control(epsilon = 1e-15, maxit = 200)
drop <- qchisq(0.95, 1)

draw <- function(x, p, n) data.frame(x = x, k = rbinom(length(x), n, p(x)), n = n)
root <- function(f, low, high) uniroot(f, c(low, high), tol = 1e-14, maxiter = 1000)$root

# --- families -------------------------------------------------------------------------------
# `abscissa` of the intensity, link, and z at the median: the curve is F(slope (u - median) + z0).

families <- list(
  gauss = list(u = function(x) x, back = function(u) u, link = "probit", z0 = 0, jnd = 1),
  weibull = list(u = log, back = exp, link = "cloglog", z0 = log(log(2)),
                 jnd = log(-log(pnorm(1, lower.tail = FALSE))) - log(log(2))))

family_case <- function(name, family, data, reference) {
  f <- families[[family]]
  u <- f$u(data$x)
  answers <- cbind(data$k, data$n - data$k)
  fit <- glm(answers ~ u, family = binomial(f$link), control = control)
  slope <- unname(coef(fit)[2])
  median <- unname((f$z0 - coef(fit)[1]) / slope)
  # (x84.13 - pse) / pse: of gauss the standard deviation over the pse.
  weber <- function(slope, median) if (family == "gauss") f$jnd / slope / median else
    expm1(f$jnd / slope)
  at_slope <- function(s) deviance(glm(answers ~ 1 + offset(s * u), family = binomial(f$link),
                                       control = control)) - deviance(fit) - drop
  at_median <- function(m) deviance(glm(answers ~ 0 + I(u - m) + offset(rep(f$z0, length(u))),
                                        family = binomial(f$link), start = slope,
                                        control = control)) - deviance(fit) - drop
  slopes <- c(root(at_slope, slope * 0.2, slope), root(at_slope, slope, slope * 4))
  # Of gauss z = slope x - 1 / w: at a given w one slope is left, by glm through an offset.
  at_fraction <- function(w) deviance(glm(answers ~ 0 + u + offset(rep(-1 / w, length(u))),
                                          family = binomial(f$link), start = 1 / w / median,
                                          control = control)) - deviance(fit) - drop
  reach <- diff(range(u))
  medians <- c(root(at_median, median - 0.5 * reach, median),
               root(at_median, median, median + 0.5 * reach))
  minus <- function(at) {  # About the median, where slope and place hardly depend.
    p <- binomial(f$link)$linkinv(f$z0 + at[2] * (u - median) - at[1])
    -sum(data$k * log(p) + (data$n - data$k) * log1p(-p))
  }
  w <- weber(slope, median)
  fractions <- if (family == "gauss") c(root(at_fraction, w * 0.5, w), root(at_fraction, w, w * 2)) else
    weber(rev(slopes), median)
  # At the curve c(at, slope) the median is median + at / slope.
  by_curve <- grad(function(at) weber(at[2], median + at[1] / at[2]), c(0, slope))
  variance <- drop(by_curve %*% solve(hessian(minus, c(0, slope))) %*% by_curve)
  expected <- list(weber_fraction = w, pse = f$back(median),
                   weber_fraction_ci95 = fractions, pse_ci95 = f$back(medians),
                   standard_error = sqrt(variance),
                   log_likelihood = -minus(c(0, slope)), deviance = deviance(fit),
                   overdispersion = sum(residuals(fit, "pearson")^2) / fit$df.residual)
  parameters <- if (family == "gauss") list(mean = median, standard_deviation = 1 / slope) else
    list(scale = exp(-unname(coef(fit)[1]) / slope), shape = slope)
  list(name = name, family = family, reference = reference, data = data, expected = expected,
       parameters = parameters, residuals = unname(residuals(fit, "deviance")))
}

x <- c(0, 1, 2, 3, 4, 5, 6)
cases <- list(
  family_case("gauss, with intensity 0", "gauss", draw(x, function(x) pnorm((x - 3) / 1.5), 20), 3),
  family_case("gauss, far from 0", "gauss",
              draw(100 + x, function(x) pnorm((x - 103.2) / 2), 15), 103),
  family_case("weibull", "weibull", draw(x[-1], function(x) 1 - exp(-(x / 3.5)^2), 25), 3),
  family_case("weibull, steep", "weibull",
              draw(c(2, 2.5, 3, 3.5, 4, 4.5), function(x) 1 - exp(-(x / 3.6)^6), 12), 3))

# --- effects --------------------------------------------------------------------------------

trials <- data.frame(trial = 1:160, x = rep(c(0.6, 0.8, 0.9, 1.1, 1.3, 1.7), length.out = 160),
                     test_first = rbinom(160, 1, 0.5))
trials <- trials[sample(160), ]
trials$trial <- 1:160
time <- (trials$trial - 1) / 159 - 0.5
u <- log(trials$x)
trials$yes <- rbinom(160, 1, pnorm((2 + 1.0 * time) * u + 0.2 + 0.5 * (trials$test_first - 0.5) +
                                     0.6 * time))
columns <- cbind(response_bias = 1, interval_order = trials$test_first - 0.5, drift = time,
                 learning = time * u)
probit <- function(matrix) glm(trials$yes ~ 0 + matrix, family = binomial("probit"),
                               control = control)
full <- probit(cbind(u, columns))
minus <- function(at) {
  z <- drop(cbind(u, columns) %*% at)
  -sum(trials$yes * pnorm(z, log.p = TRUE) + (1 - trials$yes) * pnorm(-z, log.p = TRUE))
}
error <- sqrt(diag(solve(hessian(minus, unname(coef(full))))))
effects <- lapply(seq_len(ncol(columns)), function(i) {
  unit <- if (i == 4) unname(coef(full)[1]) else 1
  estimate <- unname(coef(full)[i + 1]) / unit
  reach <- qnorm(0.975) * error[i + 1] / unit
  statistic <- deviance(probit(cbind(u, columns[, -i]))) - deviance(full)
  list(estimate = estimate, low = estimate - reach, high = estimate + reach,
       statistic = statistic, p_value = pchisq(statistic, 1, lower.tail = FALSE))
})

# --- acceleration of BCa, by leaving answers out ----------------------------------------------

weber <- data.frame(x = c(0.6, 0.8, 0.9, 1.1, 1.3, 1.6), k = c(1, 3, 5, 8, 9, 11), n = 12)
fraction <- function(d) expm1(1 / unname(coef(glm(
  cbind(d$k, d$n - d$k) ~ 0 + log(d$x), family = binomial("probit"), control = control))))
left_out <- unlist(lapply(1:6, function(i) {
  d <- weber; d$n[i] <- d$n[i] - 1
  no <- fraction(d); d$k[i] <- d$k[i] - 1; yes <- fraction(d)
  rep(c(yes, no), c(weber$k[i], weber$n[i] - weber$k[i]))
}))
influence <- mean(left_out) - left_out
acceleration <- sum(influence^3) / (6 * sum(influence^2)^1.5)

# --- posterior ------------------------------------------------------------------------------

log_likelihood <- function(slope, place) {
  z <- slope * (log(weber$x) - place)
  sum(weber$k * pnorm(z, log.p = TRUE) + (weber$n - weber$k) * pnorm(-z, log.p = TRUE))
}
quantiles <- function(density, low, high) {
  area <- function(to) integrate(density, low, to, rel.tol = 1e-11, subdivisions = 2000)$value
  whole <- area(high)
  vapply(c(0.025, 0.5, 0.975), function(p) root(function(to) area(to) / whole - p, low + 1e-9, high), 0)
}
top <- log_likelihood(1 / log1p(fraction(weber)), 0)
gap <- min(abs(log(weber$x)))
one <- Vectorize(function(t) exp(log_likelihood(exp(-t), 0) - top))
fixed <- expm1(exp(quantiles(one, log(gap / 4), log(4 * max(abs(log(weber$x)))))))

levels <- log(weber$x); range <- diff(range(levels)); near <- min(diff(levels))
places <- c(min(levels) - range / 2, max(levels) + range / 2)
over_place <- Vectorize(function(t) integrate(Vectorize(function(p)
  exp(log_likelihood(exp(-t), p) - top)), places[1], places[2], rel.tol = 1e-10)$value)
over_slope <- Vectorize(function(p) integrate(Vectorize(function(t)
  exp(log_likelihood(exp(-t), p) - top)), log(near / 4), log(4 * range), rel.tol = 1e-10)$value)
grid <- function(density, low, high) {
  at <- seq(low, high, length.out = 1601)
  spline <- splinefun(at, density(at))
  quantiles(spline, low, high)
}
free <- expm1(exp(grid(over_place, log(near / 4), log(4 * range))))
free_pse <- exp(grid(over_slope, places[1], places[2]))

# --- JSON -----------------------------------------------------------------------------------

number <- function(x) if (length(x) == 1) sprintf("%.17g", x) else
  paste0("[", paste(sprintf("%.17g", x), collapse = ", "), "]")
object <- function(x) paste0("{", paste0('"', names(x), '": ', vapply(x, number, ""),
                                         collapse = ", "), "}")
rows <- function(...) paste0("[", paste(paste("[", paste(..., sep = ", "), "]", sep = ""),
                                        collapse = ", "), "]")
case_json <- function(case)
  paste0('  {"name": "', case$name, '", "family": "', case$family, '", "reference": ',
         number(case$reference), ', "expected": ', object(case$expected), ', "parameters": ',
         object(case$parameters), ', "residuals": ', number(case$residuals), ',\n   "data": ',
         rows(number_each <- sprintf("%.17g", case$data$x), case$data$k, case$data$n), "}")
file <- file("data/reference/psychometric_families/psychometric_reference.json", "w")
writeLines(c("{",
  '"generated_by": "data/reference/psychometric_families/psychometric_reference.R",',
  paste0('"versions": {"R": "', R.version$major, ".", R.version$minor, '", "numDeriv": "',
         packageVersion("numDeriv"), '"},'),
  '"families": [', paste(vapply(cases, case_json, ""), collapse = ",\n"), "],",
  '"effects": {"names": ["response_bias", "interval_order", "drift", "learning"],',
  paste0('  "expected": [', paste(vapply(effects, object, ""), collapse = ",\n    "), "],"),
  paste0('  "rows": ', rows(trials$trial, sprintf("%.17g", trials$x), trials$test_first,
                            trials$yes), "},"),
  paste0('"weber_data": ', rows(sprintf("%.17g", weber$x), weber$k, weber$n), ","),
  paste0('"acceleration": ', number(acceleration), ","),
  paste0('"posterior": ', object(list(fixed_weber_fraction = fixed, free_weber_fraction = free,
                                      free_pse = free_pse))), "}"), file)
close(file)
