#include "analysis/report/literature.h"

#include <algorithm>

#include "core/error.h"

namespace jnd::analysis {
namespace {

struct Work {
  const char* citation;
  const char* entry;
};

constexpr Work kWorks[] = {
    {"Abbott 1925",
     "Abbott, W. S. (1925). A method of computing the effectiveness of an insecticide. Journal "
     "of Economic Entomology 18, 265-267."},
    {"Armitage 1955",
     "Armitage, P. (1955). Tests for linear trends in proportions and frequencies. Biometrics "
     "11, 375-386."},
    {"Arun et al. 1987",
     "Arun, K. S., Huang, T. S., Blostein, S. D. (1987). Least-squares fitting of two 3-D "
     "point "
     "sets. IEEE Transactions on Pattern Analysis and Machine Intelligence 9, 698-700."},
    {"Bergmann Tiest et al. 2013",
     "Bergmann Tiest, W. M., Vrijling, A. C. L., Kappers, A. M. L. (2013). Haptic "
     "discrimination "
     "and matching of viscosity. IEEE Transactions on Haptics 6, 24-34."},
    {"Bonett and Wright 2000",
     "Bonett, D. G., Wright, T. A. (2000). Sample size requirements for estimating Pearson, "
     "Kendall and Spearman correlations. Psychometrika 65, 23-28."},
    {"Delacre et al. 2021",
     "Delacre, M., Lakens, D., Ley, C., Liu, L., Leys, C. (2021). Why Hedges’ g*s based on the "
     "non-pooled standard deviation should be reported with Welch’s t-test. PsyArXiv, "
     "doi:10.31234/osf.io/tu6mp."},
    {"Efron and Tibshirani 1993",
     "Efron, B., Tibshirani, R. J. (1993). An introduction to the bootstrap. Chapman & Hall."},
    {"Efron and Stein 1981",
     "Efron, B., Stein, C. (1981). The jackknife estimate of variance. Annals of Statistics 9, "
     "586-596."},
    {"Fisher 1921",
     "Fisher, R. A. (1921). On the “probable error” of a coefficient of correlation deduced "
     "from "
     "a small sample. Metron 1, 3-32."},
    {"Gescheider 1997",
     "Gescheider, G. A. (1997). Psychophysics: the fundamentals (3rd ed.). Erlbaum."},
    {"Gil et al. 2004",
     "Gil, J. J., Avello, A., Rubio, A., & Florez, J. (2004). Stability analysis of a 1 DOF "
     "haptic interface using the Routh-Hurwitz criterion. IEEE Transactions on Control Systems "
     "Technology 12, 583-588."},
    {"Green and Swets 1966",
     "Green, D. M., Swets, J. A. (1966). Signal detection theory and psychophysics. Wiley."},
    {"Hautus 1995",
     "Hautus, M. J. (1995). Corrections for extreme proportions and their biasing effects on "
     "estimated values of d′. Behavior Research Methods, Instruments, & Computers 27, 46-51."},
    {"Hedges 1981",
     "Hedges, L. V. (1981). Distribution theory for Glass’s estimator of effect size and "
     "related "
     "estimators. Journal of Educational Statistics 6, 107-128."},
    {"Hesterberg 2015",
     "Hesterberg, T. C. (2015). What teachers should know about the bootstrap: resampling in "
     "the "
     "undergraduate statistics curriculum. The American Statistician 69, 371-386."},
    {"Hodges and Lehmann 1963",
     "Hodges, J. L., Lehmann, E. L. (1963). Estimates of location based on rank tests. Annals "
     "of "
     "Mathematical Statistics 34, 598-611."},
    {"Holm 1979",
     "Holm, S. (1979). A simple sequentially rejective multiple test procedure. Scandinavian "
     "Journal of Statistics 6, 65-70."},
    {"Huber 1967",
     "Huber, P. J. (1967). The behavior of maximum likelihood estimates under nonstandard "
     "conditions. Proceedings of the Fifth Berkeley Symposium on Mathematical Statistics and "
     "Probability 1, 221-233."},
    {"Jury 1964",
     "Jury, E. I. (1964). Theory and application of the z-transform method. Wiley."},
    {"Kabsch 1976",
     "Kabsch, W. (1976). A solution for the best rotation to relate two sets of vectors. Acta "
     "Crystallographica A 32, 922-923."},
    {"Kaernbach 1991",
     "Kaernbach, C. (1991). Simple adaptive testing with the weighted up-down method. "
     "Perception & Psychophysics 49, 227-229."},
    {"Kerby 2014",
     "Kerby, D. S. (2014). The simple difference formula: an approach to teaching "
     "nonparametric "
     "correlation. Comprehensive Psychology 3, 11.IT.3.1."},
    {"Lane et al. 1961",
     "Lane, H. L., Catania, A. C., Stevens, S. S. (1961). Voice level: autophonic scale, "
     "perceived loudness, and effects of sidetone. Journal of the Acoustical Society of "
     "America "
     "33, 160-167."},
    {"Levitt 1971",
     "Levitt, H. (1971). Transformed up-down methods in psychoacoustics. Journal of the "
     "Acoustical Society of America 49, 467-477."},
    {"Liang and Zeger 1986",
     "Liang, K.-Y., Zeger, S. L. (1986). Longitudinal data analysis using generalized linear "
     "models. Biometrika 73, 13-22."},
    {"MacFarlane and Postlethwaite 1977",
     "MacFarlane, A. G. J., & Postlethwaite, I. (1977). The generalized Nyquist stability "
     "criterion and multivariable root loci. International Journal of Control 25, 81-127."},
    {"Macmillan and Creelman 2005",
     "Macmillan, N. A., Creelman, C. D. (2005). Detection theory: a user’s guide (2nd ed.). "
     "Erlbaum."},
    {"Mann and Whitney 1947",
     "Mann, H. B., Whitney, D. R. (1947). On a test of whether one of two random variables is "
     "stochastically larger than the other. Annals of Mathematical Statistics 18, 50-60."},
    {"Noether 1967",
     "Noether, G. E. (1967). Wilcoxon confidence intervals for location parameters in the "
     "discrete case. Journal of the American Statistical Association 62, 184-188."},
    {"Pinheiro and Bates 1995",
     "Pinheiro, J. C., Bates, D. M. (1995). Approximations to the log-likelihood function in "
     "the "
     "nonlinear mixed-effects model. Journal of Computational and Graphical Statistics 4, "
     "12-35."},
    {"Schütt et al. 2016",
     "Schütt, H. H., Harmeling, S., Macke, J. H., Wichmann, F. A. (2016). Painfree and "
     "accurate "
     "Bayesian estimation of psychometric functions for (potentially) overdispersed data. "
     "Vision "
     "Research 122, 105-123."},
    {"Steiger and Fouladi 1997",
     "Steiger, J. H., Fouladi, R. T. (1997). Noncentrality interval estimation and the "
     "evaluation of statistical models. In: Harlow, L. L., Mulaik, S. A., Steiger, J. H. "
     "(eds.), "
     "What if there were no significance tests? Erlbaum, 221-257."},
    {"Stevens 1957",
     "Stevens, S. S. (1957). On the psychophysical law. Psychological Review 64, 153-181."},
    {"Streitberg and Röhmel 1986",
     "Streitberg, B., Röhmel, J. (1986). Exact distributions for permutation and rank tests: "
     "an "
     "introduction to some recently published algorithms. Statistical Software Newsletter 12, "
     "10-17."},
    {"Ulrich and Vorberg 2009",
     "Ulrich, R., Vorberg, D. (2009). Estimating the difference limen in 2AFC tasks: pitfalls "
     "and improved estimators. Attention, Perception, & Psychophysics 71, 1219-1227."},
    {"Watson 2017",
     "Watson, A. B. (2017). QUEST+: a general multidimensional Bayesian adaptive psychometric "
     "method. Journal of Vision 17(3), 10."},
    {"Welch 1947",
     "Welch, B. L. (1947). The generalization of “Student’s” problem when several different "
     "population variances are involved. Biometrika 34, 28-35."},
    {"Wichmann and Hill 2001",
     "Wichmann, F. A., Hill, N. J. (2001). The psychometric function: I. Fitting, sampling, "
     "and "
     "goodness of fit. Perception & Psychophysics 63, 1293-1313."},
    {"Wilcoxon 1945",
     "Wilcoxon, F. (1945). Individual comparisons by ranking methods. Biometrics Bulletin 1, "
     "80-83."},
    {"Wilson 1927",
     "Wilson, E. B. (1927). Probable inference, the law of succession, and statistical "
     "inference. Journal of the American Statistical Association 22, 209-212."},
};

}  // namespace

std::vector<std::string> literature_of(const std::set<std::string>& citations) {
  std::vector<std::string> entries;
  for (const std::string& citation : citations) {
    const auto* const work =
        std::ranges::find_if(kWorks, [&](const Work& one) { return citation == one.citation; });
    if (work == std::end(kWorks)) {
      throw core::Error("literature: expected a work that is known, found " + citation);
    }
    entries.emplace_back(work->entry);
  }
  return entries;
}

}  // namespace jnd::analysis
