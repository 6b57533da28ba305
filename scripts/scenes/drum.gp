# Mean distance of small and large grains from the middle of the bed in a drum.
#   gnuplot -c scripts/scenes/drum.gp drum.tsv drum.png
set terminal pngcairo size 800,560 font "DejaVu Sans,11"
set output ARG2
set datafile separator "\t"
set grid
set key right center
set xlabel "turns"
set ylabel "mean distance from the middle, over that of all"
plot ARG1 using 1:2 skip 1 with lines title "small", ARG1 using 1:3 skip 1 with lines title "large", 1 with lines linecolor "gray" notitle
