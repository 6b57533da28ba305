# A large grain rises through a flow of small ones.
#   gnuplot -c scripts/scenes/intruder.gp intruder.tsv intruder.png
set terminal pngcairo size 800,560 font "DejaVu Sans,11"
set output ARG2
set datafile separator "\t"
set grid
set key bottom right
set xlabel "time (s)"
set ylabel "height / d_S"
plot ARG1 using 1:2 skip 1 with lines title "large grain", ARG1 using 1:3 skip 1 with lines title "bed"
