# Runs the program psignifit 2.5.6 (Debian's package psignifit 2.5.6-8+b1) on the answers of this folder and of ../curves,
# for the models that it can say, and writes what it printed, in its own words, to psignifit_2.csv: `Rscript psignifit_2.R
# [PROGRAM]`, in this folder. Rates that are free are in 0 .. 0.5. Rising curves alone.

given <- commandArgs(trailingOnly = TRUE)
program <- if (length(given) > 0) given[1] else "psignifit"
answers <- rbind(read.csv("answers.csv", stringsAsFactors = FALSE), read.csv("../curves/answers.csv", stringsAsFactors = FALSE))
shapes <- c(normal = "cumulative Gaussian", logistic = "logistic", gumbel = "Gumbel", weibull = "Weibull")

of_curves <- read.csv("../curves/models.csv", stringsAsFactors = FALSE, colClasses = "character")
of_curves <- of_curves[of_curves$falling == "0" & of_curves$family %in% names(shapes), ]
of_curves <- of_curves[of_curves$axis == "linear" | of_curves$family == "weibull", c("data_set", "family", "axis", "guess", "lapse")]
own <- expand.grid(data_set = c("psignifit 2.5", "psignifit 3", "quickpsy"), family = names(shapes), stringsAsFactors = FALSE)
own$axis <- ifelse(own$family == "weibull", "log", "linear")
own$guess <- "0.5"
own$lapse <- "free"
models <- rbind(own, of_curves)
chance <- c("psignifit 2.5 example", "psignifit 3 2AFC", "psignifit 3 interface", "quickpsy guesses and lapses", "quickpsy paper 2 intervals")

fitted_by <- function(d, model) {
  folder <- tempfile()
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  write.table(d[, c("intensity", "num_yes", "num_trials")], file.path(folder, "data"), row.names = FALSE, col.names = FALSE)
  free_guess <- model$guess == "free"
  guess <- suppressWarnings(as.numeric(model$guess))
  preferences <- c(
    paste("#shape", shapes[[model$family]]),
    # One interval is the model whose lower end may be anything.
    "#n_intervals 1",
    if (free_guess) "#gamma_limits 0, 0.5" else sprintf("#fix_gamma %.17g", guess),
    if (model$lapse == "free") "#lambda_limits 0, 0.5" else paste("#fix_lambda", model$lapse),
    "#matrix_format xrn", "#runs 0", "#verbose false", "#cuts 0.5", "#write_format %.12lg",
    paste("#write_pa_est", file.path(folder, "parameters")), paste("#write_st_est", file.path(folder, "statistics")))
  writeLines(preferences, file.path(folder, "preferences"))
  said <- suppressWarnings(system2(program, c(file.path(folder, "data"), file.path(folder, "preferences")), stdout = TRUE, stderr = TRUE))
  read <- function(name) {
    path <- file.path(folder, name)
    if (!file.exists(path)) return(NA)
    as.numeric(strsplit(gsub("[,\t]", " ", paste(readLines(path), collapse = " ")), " +")[[1]])
  }
  parameters <- read("parameters")
  if (length(parameters) < 4 || !all(is.finite(parameters))) {
    message(paste(model$data_set, d$group[1], model$family, paste(tail(said, 2), collapse = " ")))
    return(NULL)
  }
  list(parameters = parameters, deviance = read("statistics")[1])
}

out <- list()
for (i in seq_len(nrow(models))) {
  model <- models[i, ]
  for (group in unique(answers$group[answers$data_set == model$data_set])) {
    if (i <= nrow(own) && !(paste(model$data_set, group) %in% chance)) next
    d <- answers[answers$data_set == model$data_set & answers$group == group & answers$num_trials > 0, ]
    if (model$family == "weibull") d <- d[d$intensity > 0, ]
    found <- fitted_by(d, model)
    if (is.null(found)) next
    p <- found$parameters
    out[[length(out) + 1]] <- data.frame(
      data_set = model$data_set, group = group, program = "psignifit 2.5.6", criterion = "ml", family = model$family,
      axis = model$axis, guess = model$guess, lapse = model$lapse, symmetric = "0",
      form = if (model$family == "weibull") "location_shape" else "location_scale", first = sprintf("%.12g", p[1]),
      second = sprintf("%.12g", p[2]), guess_rate = sprintf("%.12g", p[3]), lapse_rate = sprintf("%.12g", p[4]), eta = "",
      deviance = sprintf("%.12g", found$deviance), place = "run")
  }
}
write.csv(do.call(rbind, out), "psignifit_2.csv", row.names = FALSE, quote = FALSE)
