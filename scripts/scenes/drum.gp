# How far small grains have gathered about the axis of a drum.
#   gnuplot -c scripts/scenes/drum.gp drum.tsv drum.png
load ARG0[:strstrt(ARG0, "drum.gp") - 1]."../figures/names.gp"
table = named(ARG1)
eval picture(named(ARG2), 800, 560, 11, "")
set datafile separator "\t"
set grid
set key bottom right
set xlabel "turns"
set ylabel "index of radial segregation"
set yrange [-0.6:1]
plot table using 1:2 skip 1 with lines title "1: all small grains nearest to the axis", 0 with lines linecolor "gray" title "0: mixed"
