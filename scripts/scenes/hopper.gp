# Discharge over the outlet: Beverloo's law in two dimensions is a straight line here.
#   gnuplot -c scripts/scenes/hopper.gp hopper.tsv hopper.png
load ARG0[:strstrt(ARG0, "hopper.gp") - 1]."../figures/names.gp"
table = named(ARG1)
eval picture(named(ARG2), 800, 560, 11, "")
set datafile separator "\t"
set grid
set key top left
set xlabel "outlet W/d"
set ylabel "(discharge / (g^{1/2} d^{3/2}))^{2/3}"
f(x) = C**(2.0/3)*(x - k)
C = 0.8; k = 1.5
set fit quiet logfile "/dev/null" errorvariables
fit f(x) table using 1:($2**(2.0/3)):($3/$2**(1.0/3)*2/3) skip 1 yerrors via C, k
set xrange [0:*]
set yrange [0:*]
plot table using 1:($2**(2.0/3)):($3/$2**(1.0/3)*2/3) skip 1 with yerrorbars pointtype 7 title "grseg", \
     f(x) with lines title sprintf("Q = %.3f g^{1/2} (W - (%.2f ± %.2f) d)^{3/2}", C, k, k_err)
