# The grains in each frame of FOLDER/snapshots.tsv, side by side (Staron & Phillips 2015, figure 1):
#   gnuplot -c scripts/figures/snapshots.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "snapshots.gp") - 1]."names.gp"
folder = named(ARG1)
table = folder."/snapshots.tsv"
set datafile separator tab
times = system("grep -v '^#' ".quoted(table)." | awk -F '\\t' 'NR > 1 && !seen[$1]++ {print $1}'")
stats table using "x[m]" nooutput name "X"
length = X_max
stats table using "y[m]" nooutput
top = STATS_max + 0.01
eval picture(asked("ARG2", folder."/snapshots.png"), 450 * words(times), 50 + int(415 * (top + 0.015) / length), 11, "")
set multiplot layout 1, words(times)
set xrange [0:length]
set yrange [-0.015:top]
set size ratio -1
unset tics
unset key
set style fill solid 1 noborder
colour(kind) = kind == 0 ? 0x9ecae1 : kind == 1 ? 0xd62728 : 0x555555
do for [time in times] {
  set title sprintf("t = %.1f s", real(time))
  plot table using (column("t[s]") == real(time) ? column("x[m]") : NaN):"y[m]":"r[m]":(colour(column("species"))) \
         with circles fc rgb variable
}
