# B of layers over their composition phi_L with 95 % intervals: discs with and without what gradients inside the layers add,
# and spheres, from FOLDER/numbers.tsv and FOLDER/spheres.tsv (scripts/reproduce/campaign numbers, spheres):
#   gnuplot -c scripts/figures/b-of-composition.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "b-of-composition.gp") - 1]."names.gp"
eval figure("b-of-composition", 800, 500, 12)
numbers = folder."/numbers.tsv"
set xlabel "φ_L of the layer"
set ylabel "B, by size"
set xrange [0:1]
set yrange [-0.03:0.2]
set key top left
begins(prefix) = strstrt(stringcolumn("name"), prefix) == 1
of(prefix) = begins(prefix) ? column("value") : NaN
at(prefix, shift) = begins(prefix) ? (real(stringcolumn("name")[strlen(prefix) + 1:]) + 0.5) / 10 + shift : NaN
excess = "rise_excess_of_"
kept = "rise_kept_of_"
spheres = "all "
plot numbers using (at(excess, 0)):(of(excess)):"low":"high" with yerrorbars pt 7 lc rgb "#1f77b4" title "discs", \
     numbers using (at(kept, 0.01)):(of(kept)):"low":"high" with yerrorbars pt 6 lc rgb "#ff7f0e" title "discs, of the layers' means", \
     folder."/spheres.tsv" using (at(spheres, 0.005)):(of(spheres)):"low":"high" with yerrorbars pt 9 lc rgb "#2ca02c" title "spheres", \
     0 with lines dt 2 lc rgb "black" notitle
