# Mean kinetic pressure over height, for both definitions of the fluctuation, and its ratio to the
# contact stress, from FOLDER/profile.tsv (scripts/profile with --kinetic):
#   gnuplot -c scripts/figures/kinetic-profile.gp FOLDER [PICTURE]
# Per area of grains, in units of rho g d_S, with the fit of Staron & Phillips (2015, figure 3a).
load ARG0[:strstrt(ARG0, "kinetic-profile.gp") - 1]."names.gp"
eval figure("kinetic-profile", 1200, 600, 12)
profile = folder."/profile.tsv"
set multiplot layout 1,2
y = "y/d_S"
in(name) = column("nu") > 0.4 ? column(name) : NaN
set ylabel "y / d_S"
set yrange [0:66]
set xlabel "P^κ / (ρ g d_S)"
set xrange [0:1.4]
set key top right
plot profile using (in("K_solid")):y:"e_K_solid" with xerrorbars pt 7 lc rgb "#1f77b4" title "about the profile of the mean velocity", \
     profile using (in("K_layer_solid")):y:"e_K_layer_solid" with xerrorbars pt 5 lc rgb "#d62728" title "about the mean of the layer", \
     [0:60] '+' using (0.98 * exp(-$1 / 29.6)):1 with lines dt 2 lc rgb "black" title "0.98 exp(−z/14.8 d_L), the paper"
set xlabel "σ^κ_{yy} / σ_{yy}"
set logscale x
set xrange [5e-5:0.1]
set format x "10^{%T}"
set arrow from 1e-4, graph 0 to 1e-4, graph 1 nohead dt 2 lc rgb "black"
set label "\"four orders of magnitude\"" at 1.2e-4, 4 font ",10"
plot profile using (in("Kyy/syy")):y:"e_Kyy/syy" with xerrorbars pt 7 lc rgb "#1f77b4" notitle
