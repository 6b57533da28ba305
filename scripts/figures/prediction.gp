# Predicted and measured segregation, from FOLDER/prediction.tsv (grseg-closure --predict RUNS --profiles): left, phi_L over height
# at four times of the first run; right, mean height of the large grains of every run over time.
#   gnuplot -c scripts/figures/prediction.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "prediction.gp") - 1]."names.gp"
folder = named(ARG1)
table = folder."/prediction.tsv"
runs = int(system("awk -F '\\t' '!/^#/ && $1 + 0 > n {n = $1} END {print n + 0}' ".quoted(table)))
eval figure("prediction", 1200, 480, 12)
# Rows of run n that begin at time t, and mean heights of the large grains by window of run n.
profile(n, t) = sprintf("< awk -F '\\t' '!/^#/ && (!k++ || ($1 == %d && $2 == %g))' ", n, t).quoted(table)
heights(n) = sprintf("< awk -F '\\t' '!/^#/ && $1 == %d && $2 < 150 {if ($2 != t) {if (s) print t, a/A, b/B, c/C; s = 1; t = $2; a = A = b = B = c = C = 0} ", n). \
  "y = ($4 + $5)/2; a += $6*$7*y; A += $6*$7; b += $6*$8*y; B += $6*$8; c += $6*$9*y; C += $6*$9} END {print t, a/A, b/B, c/C}' ".quoted(table)
array times[4] = [10, 30, 60, 120]
array colour[5] = ["#1f77b4", "#2ca02c", "#d62728", "#9467bd", "#8c564b"]
set multiplot layout 1,2
set xlabel "φ_L"
set ylabel "y (mm)"
set xrange [0:1]
set key top left
middle(dummy) = (column("y0[m]") + column("y1[m]")) / 2 * 1000
plot for [k = 1:4] profile(1, times[k]) using "phi_L":(middle(0)) with points pt 7 ps 0.7 lc rgb colour[k] title sprintf("%d s", times[k]), \
     for [k = 1:4] profile(1, times[k]) using "phi_L_closure":(middle(0)) with lines lw 2 lc rgb colour[k] notitle, \
     for [k = 1:4] profile(1, times[k]) using "phi_L_trewhela":(middle(0)) with lines lw 1 dt 2 lc rgb colour[k] notitle
set datafile separator whitespace
set xlabel "time (s)"
set ylabel "y_L (mm)"
set xrange [*:150]
set key bottom right
plot for [n = 1:runs] heights(n) using 1:($2 * 1000) with points pt 7 ps 0.5 lc rgb colour[n] notitle, \
     for [n = 1:runs] heights(n) using 1:($3 * 1000) with lines lw 2 lc rgb colour[n] title sprintf("run %d", n), \
     for [n = 1:runs] heights(n) using 1:($4 * 1000) with lines lw 1 dt 2 lc rgb colour[n] notitle
unset multiplot
