# Commanded and delivered Weber fractions (SIMULATED data)
# Draw it here with: gnuplot delivered.gp
set terminal svg size 634,300 font 'Inter,12' noenhanced background 'white'
set output 'delivered.svg'
set encoding utf8
set datafile separator comma
set datafile columnheaders
set border 3 lc rgb '#333333'
set tics nomirror out scale 0.6
set bars 0.6
set logscale y
set yrange [0.12:2.2]
set ytics (0.2, 0.3, 0.5, 1, 2)
set xrange [-1:5.8]
set xtics (0, 2.4, 4.8)
set label 99 'SIMULATED' at screen 0.995,0.965 right font 'Inter,10' tc rgb '#777777'
set multiplot layout 1,2
do for [block in 'group_d group_e'] {
  set title (block eq 'group_d' ? 'Thin fluid (group D)' : 'Thick fluid (group E)') font 'Inter,12'
  set xlabel 'Own damping of the device [N s/m]'
  set ylabel (block eq 'group_d' ? 'Weber fraction of the group' : '')
  if (block eq 'group_d') { set key top left reverse Left samplen 1 font 'Inter,10' } else { unset key }
  plot 'delivered.csv' using (strcol('block') eq block ? column('damping_n_s_per_m')-0.2 : NaN):'commanded':'commanded_low':'commanded_high' with yerrorbars lc rgb '#0072B2' pt 7 ps 0.8 title 'commanded', \
    '' using (strcol('block') eq block ? column('damping_n_s_per_m')+0.1 : NaN):'delivered':'delivered_low':'delivered_high' with yerrorbars lc rgb '#D55E00' pt 4 ps 0.8 title 'delivered', \
    '' using (strcol('block') eq block ? column('damping_n_s_per_m')+0.35 : NaN):'delivered':'device_low':'device_high' with yerrorbars lc rgb '#000000' lw 1.5 pt 13 ps 0.7 title 'of the device'
  unset label 99
}
unset multiplot
unset output
