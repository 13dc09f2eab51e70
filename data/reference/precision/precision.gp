# Precision of a Weber fraction against the number of trials (SIMULATED data)
# Draw it here with: gnuplot precision.gp
do for [format in 'svg pdf'] {
  if (format eq 'svg') {
    set terminal svg size 768,346 font 'Inter,12' noenhanced background 'white'
    small = 'Inter,10'
  } else {
    set terminal pdfcairo size 8.00in,3.60in font 'Inter,9' noenhanced
    small = 'Inter,7.5'
  }
  set output 'precision.' . format
  reset
  set encoding utf8
  set datafile separator comma
  set datafile columnheaders
  set linetype 1 lc rgb '#0072B2' dt 1 pt 7
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
  set label 99 'SIMULATED' at screen 0.995,0.03 right font small tc rgb '#777777'
  set multiplot layout 1,2
  set logscale y
  set xrange [0:125]
  set yrange [0.05:2.2]
  set ytics (0.1, 0.2, 0.4, 0.8, 1.6)
  set xlabel 'Trials'
  set ylabel 'Root mean square error of ln w'
  set title 'pse at the reference'
  set key bottom left Left reverse samplen 2
  plot 'precision.csv' using 'num_trials':(column('series')==1 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 1 lw 1.6 ps 0.5 title 'constant stimuli, curve fitted', 'precision.csv' using 'num_trials':(column('series')==2 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 2 lw 1.6 ps 0.5 title 'staircase, reversals averaged', 'precision.csv' using 'num_trials':(column('series')==3 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 3 lw 1.6 ps 0.5 title 'staircase, curve fitted', 'precision.csv' using 'num_trials':(column('series')==4 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 4 lw 1.6 ps 0.5 title 'QUEST+, posterior mean'
  set title 'pse differs by 0.15 in ln'
  unset key
  plot 'precision.csv' using 'num_trials':(column('series')==5 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 1 lw 1.6 ps 0.5 title 'constant stimuli, curve fitted', 'precision.csv' using 'num_trials':(column('series')==6 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 2 lw 1.6 ps 0.5 title 'staircase, reversals averaged', 'precision.csv' using 'num_trials':(column('series')==7 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 3 lw 1.6 ps 0.5 title 'staircase, curve fitted', 'precision.csv' using 'num_trials':(column('series')==8 ? column('root_mean_square_error_ln') : NaN) with linespoints lt 4 lw 1.6 ps 0.5 title 'QUEST+, posterior mean'
  unset multiplot
}
unset output
