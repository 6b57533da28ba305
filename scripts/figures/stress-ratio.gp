# sigma^S_yy / sigma^L_yy against phi_S/phi_L for every layer and window of FOLDER/stress.tsv, mixed
# contacts shared by size, with the fit of FOLDER/fit.tsv (Staron & Phillips 2015, figure 2b):
#   gnuplot -c scripts/figures/stress-ratio.gp FOLDER [PICTURE]
# or of the kinetic stress, of FOLDER/kinetic.tsv and kinetic-fit.tsv, into kinetic-ratio.png (figure 3b):
#   gnuplot -c scripts/figures/stress-ratio.gp FOLDER kinetic [PICTURE]
load ARG0[:strstrt(ARG0, "stress-ratio.gp") - 1]."names.gp"
folder = named(ARG1)
kinetic = ARGC > 1 && ARG2 eq "kinetic"
sums = folder.(kinetic ? "/kinetic.tsv" : "/stress.tsv")
fit = folder.(kinetic ? "/kinetic-fit.tsv" : "/fit.tsv")
slope = number_of(fit, kinetic ? "kinetic" : "size", "paper_s")
set datafile separator tab
eval picture(asked(kinetic ? "ARG3" : "ARG2", folder.(kinetic ? "/kinetic-ratio.png" : "/stress-ratio.png")), 900, 700, 13, "")
set logscale xy
set format xy "10^{%T}"
set xlabel "φ_S / φ_L"
set ylabel kinetic ? "σ^{κS}_{yy} / σ^{κL}_{yy}" : "σ^S_{yy} / σ^L_{yy}"
set xrange [0.01:100]
set yrange [0.003:1000]
set key top left
c(name) = column(name."[N m]")
small(dummy) = kinetic ? column("K_S_yy[J]") : c("A_SS_yy") + c("M_yy") - c("Msize_yy") + c("A_Sb_yy")
large(dummy) = kinetic ? column("K_L_yy[J]") : c("A_LL_yy") + c("Msize_yy") + c("A_Lb_yy")
parts(dummy) = kinetic ? column("mass_S[kg]") / column("mass_L[kg]") : column("area_S[m^2]") / column("area_L[m^2]")
lowest(value, here) = (column("y0[m]") == 0) == here ? value : NaN
plot sums using (parts(0)):(lowest(small(0) / large(0), 0)) with points pt 7 ps 0.4 lc rgb "#a01f77b4" title "a layer in a window", \
     sums using (parts(0)):(lowest(small(0) / large(0), 1)) with points pt 7 ps 0.4 lc rgb "#60ff7f0e" title "the lowest layer", \
     slope * x with lines lw 2 lc rgb "#d62728" title sprintf("%.3f φ_S/φ_L", slope), \
     x with lines dt 2 lc rgb "black" title "mixture theory"
