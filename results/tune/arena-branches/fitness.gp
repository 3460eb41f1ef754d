# Curves, some with a band.
# Run by gnuplot in its folder, this script draws an svg, a pdf and a png of its own name.
reset
set encoding utf8
output = "./fitness"
if (exists('ARG1') && strlen(ARG1) > 0) { output = ARG1 }  # gnuplot -c script output
$curve_1 << EOD
# x y
0 0.862222612549322
1 0.8828910447954064
2 0.8828910447954064
3 0.8828910447954064
4 0.8893384901341291
5 0.8893384901341291
6 0.8893384901341291
7 0.8893384901341291
8 0.8893384901341291
9 0.8893384901341291
10 0.8908016493378129
11 0.8908016493378129
12 0.8968874799719285
13 0.8968874799719285
EOD
$curve_2 << EOD
# x y
0 0.49855231226932545
1 0.6882252160646168
2 0.8279909835426299
3 0.846785920754229
4 0.7243250256384601
5 0.3138057027527773
6 0.4394316137067014
7 0.5344573424455695
8 0.8693616707242263
9 0.8567864940659778
10 0.7727912211990816
11 0.8577897427984266
12 0.8710580790436916
13 0.8476913757767942
EOD
do for [format in 'svg pdf png'] {
  font = format eq 'svg' ? 'sans-serif,' : 'DejaVu Sans,'  # an svg has the reader's own
  if (format eq 'svg') {
    set terminal svg size 336,265 font font."8" fontscale 1.3333 linewidth 1.3333 noenhanced background rgb 'white'
    dot = 0.167
  }
  if (format eq 'pdf') {
    set terminal pdfcairo size 3.5in,2.763888888888889in font font."8" fontscale 0.75 linewidth 2 noenhanced background rgb 'white'
    dot = 0.08
  }
  if (format eq 'png') {
    set terminal pngcairo size 1050,829 font font."8" fontscale 3.1250 linewidth 4.1667 pointscale 4.1667 noenhanced background rgb 'white'
    dot = 0.08
  }
  set output output.'.'.format
  unset label; unset object; unset arrow; unset key
  set border 3 back lc rgb '#606060' lw 0.5
  set tics nomirror out scale 0.35 textcolor rgb 'black'
  set grid ytics noxtics back lt 1 lc rgb '#dedede' lw 0.4
  set multiplot
  unset logscale x
  set xrange [0:13]
  set xtics nomirror ("0" 0, "2" 2, "4" 4, "6" 6, "8" 8, "10" 10, "12" 12)
  unset logscale y
  set yrange [0.30000000000000004:0.9]
  set ytics nomirror ("0.3" 0.30000000000000004, "0.4" 0.4, "0.5" 0.5, "0.6" 0.6000000000000001, "0.7" 0.7000000000000001, "0.8" 0.8, "0.9" 0.9)
  set label "tune-arena-branches" at screen 0.50000, screen 0.95980 center
  set arrow from screen 0.07698, screen 0.89196 to screen 0.16429, screen 0.89196 nohead front lc rgb '#0072b2' lw 1.1 dt solid
  set label "best, island 0" at screen 0.17619, screen 0.89196 left
  set arrow from screen 0.43111, screen 0.89196 to screen 0.51841, screen 0.89196 nohead front lc rgb '#d55e00' lw 1.1 dt (12,5)
  set label "mean of the populations" at screen 0.53032, screen 0.89196 left
  set label "fitness" at screen 0.03175, screen 0.49497 center rotate by 90
  set label "generation" at screen 0.55095, screen 0.04020 center
  set lmargin at screen 0.13413; set rmargin at screen 0.96778
  set tmargin at screen 0.83417; set bmargin at screen 0.15578
  plot NaN notitle, \
    $curve_1 using 1:2 with lines lc rgb '#0072b2' lw 1.1 dt solid notitle, \
    $curve_2 using 1:2 with lines lc rgb '#d55e00' lw 1.1 dt (12,5) notitle
  unset multiplot
  unset output
}
