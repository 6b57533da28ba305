# A large grain rises through a flow of small ones, one curve per seed.
#   gnuplot -c scripts/scenes/intruder.gp intruder.tsv intruder.png
set terminal pngcairo size 800,560 font "DejaVu Sans,11"
set output ARG2
set datafile separator "\t"
set grid
set key bottom right
set xlabel "time (s)"
set ylabel "height / d_S"
stats ARG1 using 1 nooutput
plot for [k=0:STATS_blocks-2] ARG1 using 1:2 index k with lines title sprintf("large grain, seed %d", k+1), \
     ARG1 using 1:3 index 0 with lines linecolor "gray" title "bed"
