# The large grain rises to the top of a shaken bed, one curve per seed, one point per shake.
#   gnuplot -c scripts/scenes/shaken-box.gp shaken-box.tsv shaken-box.png
load ARG0[:strstrt(ARG0, "shaken-box.gp") - 1]."../figures/names.gp"
table = named(ARG1)
eval picture(named(ARG2), 800, 560, 11, "")
set datafile separator "\t"
set grid
set key bottom right
set xlabel "time (s)"
set ylabel "height / d_S"
stats table using 1 nooutput
plot for [k=0:STATS_blocks-2] table using 1:2 index k every 2 with lines title sprintf("large grain, seed %d", k+1), \
     table using 1:3 index 0 every 2 with lines linecolor "gray" title "bed"
