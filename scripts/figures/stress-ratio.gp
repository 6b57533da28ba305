# sigma^S_yy / sigma^L_yy over phi_S/phi_L by the rule size: the layers and windows of FOLDER/stress.tsv that the fit in
# FOLDER/fit.tsv used, and the line of the fit (Staron & Phillips 2015, figure 2b):
#   gnuplot -c scripts/figures/stress-ratio.gp FOLDER [PICTURE]
# The same for the kinetic stress and for the lowest layer, from FOLDER/kinetic.tsv and kinetic-fit.tsv, into kinetic-ratio.png
# (figure 3b):
#   gnuplot -c scripts/figures/stress-ratio.gp FOLDER kinetic [PICTURE]
load ARG0[:strstrt(ARG0, "stress-ratio.gp") - 1]."names.gp"
folder = named(ARG1)
kinetic = ARGC > 1 && ARG2 eq "kinetic"
sums = folder.(kinetic ? "/kinetic.tsv" : "/stress.tsv")
fit = folder.(kinetic ? "/kinetic-fit.tsv" : "/fit.tsv")
slope = number_of(fit, kinetic ? "kinetic" : "size", "paper_s")
set datafile separator tab
taken = "< ".quoted(named(ARG0[:strstrt(ARG0, "stress-ratio.gp") - 1]."fit-points"))." ".quoted(fit)." ".quoted(sums)
if (system(taken[3:]." >/dev/null && echo yes") ne "yes") { exit status 1 }
lowest = taken.(kinetic ? " --left-out" : "") # gnuplot reads this table even if it draws nothing of it
eval picture(asked(kinetic ? "ARG3" : "ARG2", folder.(kinetic ? "/kinetic-ratio.png" : "/stress-ratio.png")), 900, 700, 13, "")
set logscale xy
set format xy "10^{%T}"
set xlabel "φ_S / φ_L"
set ylabel kinetic ? "σ^{κS}_{yy} / σ^{κL}_{yy}" : "σ^S_{yy} / σ^L_{yy}"
set xrange [0.01:100]
set yrange [0.003:1000]
set key bottom right
plot taken using 1:2 skip 1 with points pt 7 ps 0.4 lc rgb "#a01f77b4" title "layers and windows of the fit", \
     for [k = 1:kinetic] lowest using 1:2 skip 1 with points pt 7 ps 0.4 lc rgb "#60ff7f0e" title "the lowest layer, not in the fit", \
     slope * x with lines lw 2 lc rgb "#d62728" title sprintf("%.3f φ_S/φ_L", slope), \
     x with lines dt 2 lc rgb "black" title "mixture theory"
