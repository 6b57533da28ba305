# p*, the large grain's share of a mixed contact at which B = 0 (stress in proportion to volume), by mixture with 95 % intervals
# over runs, and the mean share by the rule `size`. From FOLDER/rules.tsv (scripts/reproduce/campaign mixtures):
#   gnuplot -c scripts/figures/p-star.gp FOLDER p-star.png
load ARG0[:strstrt(ARG0, "p-star.gp") - 1]."names.gp"
rules = named(ARG1)."/rules.tsv"
eval note(ARG2, 760, 460)
only(value) = strcol("rule") eq "size" ? value : NaN
set xrange [0:0.82]
set yrange [0.63:0.675]
set xlabel "large grains, Φ_L of the mixture"
set ylabel "share given to the large grain"
set key bottom right reverse Left
plot 2.0/3 with lines dt 2 lc rgb "black" title "neutral contacts, r/(1 + r)", \
     rules using "phi":(only(column("share"))) with linespoints pt 6 lc rgb "#1f77b4" title "mean share by size", \
     rules using "phi":(only(column("p_star"))):"p_star_low":"p_star_high" with yerrorbars pt 7 lw 1.5 lc rgb "#d62728" title "p*: B = 0"
