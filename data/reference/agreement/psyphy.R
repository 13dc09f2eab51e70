# Runs psyphy's own fits with rates (psyfun.2asym for a logistic curve with both free, glm.WH for a normal one of a forced
# choice with a free lapse rate) on the answers of this folder and of ../curves, and writes what they found to psyphy.csv:
# `Rscript psyphy.R`, in this folder. psyphy 0.2.3 (Debian's package r-cran-psyphy 0.2-3-1).
library(psyphy)

answers <- rbind(read.csv("answers.csv", stringsAsFactors = FALSE), read.csv("../curves/answers.csv", stringsAsFactors = FALSE))
groups_of <- function(data_set) paste(data_set, unique(answers$group[answers$data_set == data_set]), sep = "\t")
both <- unlist(lapply(c("modelfree Levi_Tripathy", "modelfree Baker_etal", "quickpsy qpdat"), groups_of))
forced <- c("quickpsy\tguesses and lapses", "psignifit 3\t2AFC", "psignifit 3\tinterface", "psignifit 4\ttest_2AFC_logn",
            groups_of("modelfree Carcagno"))

out <- list()
for (name in c(both, forced)) {
  words <- strsplit(name, "\t")[[1]]
  d <- answers[answers$data_set == words[1] & answers$group == words[2] & answers$num_trials > 0, ]
  d$no <- d$num_trials - d$num_yes
  is_log <- grepl("logn", name)
  d$u <- if (is_log) log(d$intensity) else d$intensity
  alternatives <- if (grepl("Carcagno", name)) 3 else 2
  fit <- tryCatch(suppressWarnings(
    if (name %in% both) psyfun.2asym(cbind(num_yes, no) ~ u, data = d, link = logit.2asym, tol = 1e-12)
    else glm.WH(cbind(num_yes, no) ~ u, data = d, NumAlt = alternatives, interval = c(0, 0.5), tol = 1e-12)),
    error = function(e) { message(name, ": ", conditionMessage(e)); NULL })
  if (is.null(fit)) next
  line <- coef(fit)
  out[[length(out) + 1]] <- data.frame(
    data_set = words[1], group = words[2], program = "psyphy 0.2.3", criterion = "ml",
    family = if (name %in% both) "logistic" else "normal", axis = if (is_log) "log" else "linear",
    guess = if (name %in% both) "free" else if (alternatives == 3) "0.33333333333333331" else "0.5", lapse = "free",
    symmetric = "0", form = "location_scale", first = sprintf("%.12g", -line[[1]] / line[[2]]), second = sprintf("%.12g", 1 / line[[2]]),
    guess_rate = sprintf("%.12g", if (name %in% both) fit$gam else 1 / alternatives), lapse_rate = sprintf("%.12g", fit$lambda),
    eta = "", deviance = sprintf("%.12g", deviance(fit)), place = "run")
}
write.csv(do.call(rbind, out), "psyphy.csv", row.names = FALSE, quote = FALSE)
