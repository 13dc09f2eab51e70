# Runs the program on every row of compared.csv and prints the tables of docs/methods/agreement.md, and every row whose
# likelihood is not the higher one: `Rscript table.R PROGRAM`, in this folder. Base R.

program <- commandArgs(trailingOnly = TRUE)[1]
compared <- read.csv("compared.csv", stringsAsFactors = FALSE, colClasses = c(guess = "character", lapse = "character"))
answers <- rbind(read.csv("answers.csv", stringsAsFactors = FALSE), read.csv("../curves/answers.csv", stringsAsFactors = FALSE))

ours_of <- function(row) {
  d <- answers[answers$data_set == row$data_set & answers$group == row$group, c("intensity", "num_yes", "num_trials")]
  if (row$axis == "log") d <- d[d$intensity > 0, ]
  file <- tempfile(fileext = ".csv")
  on.exit(unlink(file))
  d$intensity <- sprintf("%.17g", d$intensity)
  write.csv(d, file, row.names = FALSE, quote = FALSE)
  arguments <- c("fit", "psychometric", "--csv", file, "--family", row$family, "--axis", row$axis, "--guess", row$guess,
                 "--lapse", row$lapse, "--rising", if (row$symmetric == 1) "--symmetric", "--as-csv")
  said <- suppressWarnings(system2(program, arguments, stdout = TRUE, stderr = FALSE))
  if (length(said) < 2) stop(paste(arguments, collapse = " "))
  read.csv(text = said, stringsAsFactors = FALSE)
}
kept <- c("status", "reason", "location", "scale", "guess_rate", "lapse_rate", "log_likelihood")
ours <- do.call(rbind, lapply(seq_len(nrow(compared)), function(i) ours_of(compared[i, ])[1, kept]))
names(ours) <- paste0("our_", names(ours))
all <- cbind(compared, ours)

# Of Weibull the location is over itself, of other curves over the scale.
unit <- function(d, scale) ifelse(d$family == "weibull", abs(d$our_location), scale)
all$location_apart <- abs(all$location - all$our_location) / unit(all, all$our_scale)
all$scale_apart <- abs(all$scale / all$our_scale - 1)
all$likelihood_less_ours <- all$log_likelihood - all$our_log_likelihood
all$r_location_apart <- abs(all$r_location - all$our_location) / unit(all, all$our_scale)
all$r_scale_apart <- abs(all$r_scale / all$our_scale - 1)
all$r_less_ours <- all$r_log_likelihood - all$our_log_likelihood
all$prior_location_apart <- abs(all$location - all$prior_location) / ifelse(all$family == "weibull", abs(all$prior_location), all$prior_scale)
all$prior_scale_apart <- abs(all$scale / all$prior_scale - 1)

number <- function(x) formatC(x, digits = 7, width = 1, format = "g")
small <- function(x) ifelse(is.na(x), "", formatC(x, digits = 0, width = 1, format = "e"))
largest <- function(x) if (all(is.na(x))) NA else x[which.max(abs(x))]
model_words <- function(d) {
  words <- if (d$axis == "log" && d$family != "weibull") paste(d$family, "over ln x") else d$family
  if (d$guess == "free" && d$lapse == "free") return(paste0(words, ", guess and lapse free"))
  if (d$symmetric == 1) return(paste0(words, ", equal free rates at both ends"))
  guess <- c("0" = "", "0.5" = ", guess 1/2", "0.25" = ", guess 1/4", "free" = ", guess free")[d$guess]
  if (is.na(guess)) guess <- ", guess 1/3"
  paste0(words, guess, if (d$lapse == "free") ", lapse free" else "")
}
ok <- all[all$our_status == "ok", ]
cat("fits", nrow(all), "without a maximum of ours", nrow(all) - nrow(ok), "\n")
print(all[all$our_status != "ok", c("data_set", "group", "family", "guess", "lapse", "program", "our_reason", "location", "scale")], row.names = FALSE)
worst <- ok[(!is.na(ok$likelihood_less_ours) & ok$criterion == "ml" & ok$likelihood_less_ours > 1e-9 * abs(ok$our_log_likelihood)) | ok$r_less_ours > 1e-8 * abs(ok$our_log_likelihood), ]
cat("\nour likelihood is lower:", nrow(worst), "\n")
print(worst[, c("data_set", "group", "family", "guess", "lapse", "program", "likelihood_less_ours", "r_less_ours")], row.names = FALSE)

# One row for each data set, model and program; for each data set where all four families of psignifit 2.5.6 were fitted to it.
is_four <- function(d) d$program == "psignifit 2.5.6" & d$data_set %in% c("psignifit 2.5", "psignifit 3", "quickpsy")
key <- function(d) {
  family <- ifelse(is_four(d), "", paste(d$family, d$axis))
  paste(d$data_set, d$program, family, d$guess, ifelse(d$data_set == "Greatrex", "", d$lapse), d$symmetric)
}
cat("\n| data set | model | other program | fits | its location, scale | ours | location | scale | log-likelihood |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n")
ml <- ok[ok$criterion == "ml", ]
for (k in unique(key(ml))) {
  d <- ml[key(ml) == k, ]
  none <- is.na(d$location[1])
  cat(sprintf("| %s | %s | %s | %d | %s | %s, %s | %s | %s | %s |\n", d$data_set[1],
              if (is_four(d)[1]) paste0(model_words(d[1, ]), "; logistic, gumbel, weibull") else model_words(d[1, ]), if (none) "no other program" else d$program[1], nrow(d),
              if (none) paste(number(d$r_location[1]), number(d$r_scale[1]), sep = ", ") else paste(number(d$location[1]), number(d$scale[1]), sep = ", "),
              number(d$our_location[1]), number(d$our_scale[1]),
              small(largest(if (none) d$r_location_apart else d$location_apart)), small(largest(if (none) d$r_scale_apart else d$scale_apart)),
              small(largest(if (none) d$r_less_ours else d$likelihood_less_ours))))
}
cat("\nR's maxima of the same models, largest differences: location", small(max(ok$r_location_apart)), "scale", small(max(ok$r_scale_apart)), "log-likelihood", small(largest(ok$r_less_ours)), "\n")
map <- all[all$criterion == "map", ]
cat("\n| data of its tests | model | its location, scale, guess, lapse | R, its priors added | location | scale | ours, without priors | its log-likelihood less ours |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n")
four <- function(a, b, c, d) paste(formatC(c(a, b, c, d), digits = 4, width = 1, format = "g"), collapse = ", ")
for (i in seq_len(nrow(map))) {
  d <- map[i, ]
  cat(sprintf("| `%s` | %s | %s | %s | %s | %s | %s | %s |\n", d$group, model_words(d), four(d$location, d$scale, round(d$guess_rate, 6), round(d$lapse_rate, 6)),
              four(d$prior_location, d$prior_scale, round(d$prior_guess_rate, 6), round(d$prior_lapse_rate, 6)), small(d$prior_location_apart), small(d$prior_scale_apart),
              if (d$our_status == "ok") four(d$our_location, d$our_scale, round(d$our_guess_rate, 6), round(d$our_lapse_rate, 6)) else d$our_reason,
              if (d$our_status == "ok") formatC(d$likelihood_less_ours, digits = 2, width = 1, format = "g") else ""))
}
