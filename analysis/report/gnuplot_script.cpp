#include <charconv>
#include <cmath>

#include "analysis/report/figure.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The colours of Okabe and Ito (2008), which colour-blind people can distinguish. In a grey
/// print the marks and dashes distinguish the series.
constexpr char kGnuplotStyle[] = R"(  set linetype 1 lc rgb '#0072B2' dt 1 pt 7
  set linetype 2 lc rgb '#D55E00' dt (10,4) pt 4
  set linetype 3 lc rgb '#009E73' dt (3,3) pt 9
  set linetype 4 lc rgb '#CC79A7' dt (12,4,3,4) pt 12
  set linetype 5 lc rgb '#000000' dt (6,3) pt 2
  set linetype 6 lc rgb '#E69F00' dt (3,6) pt 10
  set linetype 7 lc rgb '#56B4E9' dt (16,4) pt 5
  set style line 10 lc rgb '#BBBBBB' lw 1 dt 1 pt 6
  set style line 11 lc rgb '#222222' lw 2 dt 1 pt 5
  set style line 12 lc rgb '#777777' lw 1 dt (3,3)
  set border 3 lc rgb '#333333'
  set tics nomirror out scale 0.6
  set key noautotitle
  set style fill noborder
)";

std::string inches(double value) {
  char digits[32];
  char* const end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 2).ptr;
  return {digits, end};
}

/// A length in CSS pixels, of which there are 96 per inch.
std::string pixels(double value_in) { return std::to_string(std::lround(96.0 * value_in)); }

/// A text on one line of a comment.
std::string one_line(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
  }
  return text;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : one_line(text)) {
    if (letter == '\'') quoted += '\'';
    quoted += letter;
  }
  return quoted + "'";
}

std::string gnuplot_script(const Figure& figure, bool simulated) {
  const std::string width = inches(figure.width_in);
  const std::string height = inches(figure.height_in);
  std::string script = "# " + one_line(figure.title) +
                       (simulated ? said(" (SIMULATED data)") : "") +
                       "\n# Draw it here with: gnuplot " + figure.name + ".gp\n";
  script +=
      "do for [format in 'svg pdf'] {\n"
      "  if (format eq 'svg') {\n"
      "    set terminal svg size " +
      pixels(figure.width_in) + "," + pixels(figure.height_in) +
      " font 'Inter,12' noenhanced background 'white'\n"
      "    small = 'Inter,10'\n"
      "  } else {\n"
      "    set terminal pdfcairo size " +
      width + "in," + height +
      "in font 'Inter,9' noenhanced\n"
      "    small = 'Inter,7.5'\n"
      "  }\n"
      "  set output '" +
      figure.name +
      ".' . format\n"
      "  reset\n"
      "  set encoding utf8\n"
      "  set datafile separator comma\n"
      "  set datafile columnheaders\n";
  script += kGnuplotStyle;
  if (simulated) {
    script += "  set label 99 " + gnuplot_quoted(said("SIMULATED")) + " at screen 0.995," +
              inches(0.12 / figure.height_in) + " right font small tc rgb '#777777'\n";
  }
  script += figure.plot;
  script += "}\nunset output\n";
  return script;
}

}  // namespace jnd::analysis
