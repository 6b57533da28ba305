# Run-out of collapsed columns over their aspect ratio, beside the laws of Staron and Hinch (2005) and Lube et al. (2005).
#   gnuplot -c scripts/scenes/column.gp column.tsv column.png
load ARG0[:strstrt(ARG0, "column.gp") - 1]."../figures/names.gp"
table = named(ARG1)
eval picture(named(ARG2), 800, 560, 11, "")
set datafile separator "\t"
set grid
set key top left
set logscale xy
set xlabel "aspect ratio H_0/L_0"
set ylabel "run-out (L - L_0)/L_0"
low(x) = c*x
high(x) = exp(lnA)*x**n
c = 2; lnA = 1; n = 0.7
set fit quiet logfile "/dev/null" errorvariables
fit [*:2.1] low(x) table using 1:3 skip 1 via c
fit [1.9:*] lnA + n*log(x) table using 1:(log($3)) skip 1 via lnA, n
plot table using 1:3 skip 1 with points pointtype 7 title "grseg", \
     x < 2 ? low(x) : NaN with lines title sprintf("%.2f a", c), \
     x > 2 ? high(x) : NaN with lines title sprintf("%.2f a^{%.2f ± %.2f}", exp(lnA), n, n_err), \
     x < 2 ? 2.5*x : 3.25*x**0.7 with lines dashtype 2 title "Staron and Hinch: 2.5 a, 3.25 a^{0.7}", \
     x < 2.3 ? 1.2*x : 1.9*x**(2.0/3) with lines dashtype 3 title "Lube et al.: 1.2 a, 1.9 a^{2/3}"
