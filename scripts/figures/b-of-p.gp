# B over the share p of a mixed contact that goes to its large grain, with its 95 % band, of
# FOLDER/scan.tsv, and the neutral model's line:
#   gnuplot -c scripts/figures/b-of-p.gp FOLDER
folder = ARG1
set datafile separator tab
set terminal pngcairo size 900,700 font "DejaVu Sans,13"
set output folder."/b-of-p.png"
set xlabel "share p of a mixed contact given to its large grain"
set ylabel "B"
set key top left
set xzeroaxis
set style fill transparent solid 0.25 noborder
set arrow from 0.5, graph 0 to 0.5, graph 1 nohead dt 3 lc rgb "gray"
set arrow from 2.0/3, graph 0 to 2.0/3, graph 1 nohead dt 3 lc rgb "gray"
set label "half" at 0.505, graph 0.05
set label "size" at 0.672, graph 0.05
scan = folder."/scan.tsv"
plot scan using "p":"low":"high" with filledcurves lc rgb "#1f77b4" title "95 %", \
     scan using "p":"B" with lines lw 2 lc rgb "#1f77b4" title "B at φ = 1/2", \
     scan using "p":"neutral" with lines dt 2 lc rgb "black" title "neutral contacts, direct fit"
