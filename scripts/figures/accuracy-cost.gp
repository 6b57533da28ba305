# Error of an observable against the reference over the processor time of a simulated second.
#   gnuplot -e "table='accuracy-cost.tsv'; observable='mean_velocity'; out='front.png'" scripts/figures/accuracy-cost.gp
if (!exists("observable")) observable = "mean_velocity"
if (!exists("out")) out = observable . "-front.png"
set terminal pngcairo size 900,600 font "DejaVu Sans,11" noenhanced
set output out
set datafile separator "\t"
set datafile commentschars "#"
set logscale x
set xlabel "processor time per simulated second (s)"
set ylabel sprintf("%s minus reference", observable)
set key off
set grid
plot 0 with lines linecolor "gray", \
     table using "cost":(column(observable."_diff")):(column(observable."_diff_hw")) with yerrorbars pointtype 7 linecolor "#1f77b4", \
     table using "cost":(column(observable."_diff")):"setting" with labels left offset 0.6,0.3 font ",8"
