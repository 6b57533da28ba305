# B by each rule, height of large grains above small ones, speed and stress ratio over time, from
# FOLDER/series.tsv (grseg-fit --series).
#   gnuplot -c scripts/figures/over-time.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "over-time.gp") - 1]."names.gp"
folder = named(ARG1)
series = folder."/series.tsv"
rules = system("grep -v '^#' ".quoted(series)." | head -n 1 | tr '\\t' '\\n' | sed -n 's/^B_//p'")
eval figure("over-time", 900, 1200, 12)
set datafile missing NaN
set xlabel "time (s)"
set lmargin 11
set multiplot layout 4,1
middle(t0, t1) = (t0 + t1) / 2
set ylabel "B"
set xzeroaxis
set key outside top center horizontal
plot for [rule in rules] series using (middle(column("t0[s]"), column("t1[s]"))):(column("B_".rule)) with points pt 7 ps 0.7 title rule
unset xzeroaxis
set ylabel "large above small grains (m)"
plot series using (middle(column("t0[s]"), column("t1[s]"))):(column("y_L_minus_y_S[m]")) with points pt 7 ps 0.7 lc rgb large notitle
set ylabel "speed (m/s)"
plot series using (middle(column("t0[s]"), column("t1[s]"))):(column("speed[m/s]")) with points pt 7 ps 0.7 lc rgb small notitle
set ylabel "|σ_{xy}|/σ_{yy}"
plot series using (middle(column("t0[s]"), column("t1[s]"))):(column("stress_ratio")) with points pt 7 ps 0.7 lc rgb "black" notitle
unset multiplot
