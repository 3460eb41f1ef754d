# Curves, some with a band.
# Run by gnuplot in its folder, this script draws an svg, a pdf and a png of its own name.
reset
set encoding utf8
output = "./fitness"
if (exists('ARG1') && strlen(ARG1) > 0) { output = ARG1 }  # gnuplot -c script output
$curve_1 << EOD
# x y
0 0.9235298354142361
1 0.9235298354142361
2 0.9235298354142361
3 0.9235298354142361
4 0.9235298354142361
5 0.9235298354142361
6 0.9235298354142361
7 0.9235298354142361
8 0.9235298354142361
9 0.9235298354142361
10 0.9235298354142361
11 0.9236422106792651
12 0.9236422106792651
13 0.9236422106792651
EOD
$curve_2 << EOD
# x y
0 0.8659879233781007
1 0.9115042036350461
2 0.9162532314438239
3 0.9116225684695208
4 0.9176538217469908
5 0.8703387456062671
6 0.8712848745852259
7 0.8921440743174553
8 0.9120391419228837
9 0.9185135495586225
10 0.918572180045948
11 0.9186114480641042
12 0.9202588129442715
13 0.9217870017604204
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
  set yrange [0.86:0.93]
  set ytics nomirror ("0.86" 0.86, "0.88" 0.88, "0.90" 0.9, "0.92" 0.92)
  set label "tune-arena-caravan" at screen 0.50000, screen 0.95980 center
  set arrow from screen 0.07698, screen 0.89196 to screen 0.16429, screen 0.89196 nohead front lc rgb '#0072b2' lw 1.1 dt solid
  set label "best, island 0" at screen 0.17619, screen 0.89196 left
  set arrow from screen 0.43111, screen 0.89196 to screen 0.51841, screen 0.89196 nohead front lc rgb '#d55e00' lw 1.1 dt (12,5)
  set label "mean of the populations" at screen 0.53032, screen 0.89196 left
  set label "fitness" at screen 0.03175, screen 0.49497 center rotate by 90
  set label "generation" at screen 0.56111, screen 0.04020 center
  set lmargin at screen 0.15444; set rmargin at screen 0.96778
  set tmargin at screen 0.83417; set bmargin at screen 0.15578
  plot NaN notitle, \
    $curve_1 using 1:2 with lines lc rgb '#0072b2' lw 1.1 dt solid notitle, \
    $curve_2 using 1:2 with lines lc rgb '#d55e00' lw 1.1 dt (12,5) notitle
  unset multiplot
  unset output
}
