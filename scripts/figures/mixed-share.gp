# Share of mixed contacts over composition, for every layer and window of FOLDER/micro.tsv, and the curve
# of neutral contacts (Staron & Phillips 2015, figure 2c):
#   gnuplot -c scripts/figures/mixed-share.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "mixed-share.gp") - 1]."names.gp"
eval figure("mixed-share", 900, 700, 13)
set xlabel "φ_L"
set ylabel "N_{LS} / (N_{LL} + N_{LS} + N_{SS})"
set xrange [0:1]
set yrange [0:0.7]
set key top left
r = 2.0
phi(dummy) = column("area_L[m^2]") / (column("area_S[m^2]") + column("area_L[m^2]"))
share(dummy) = column("n_LS") / (column("n_SS") + column("n_LS") + column("n_LL"))
inside(value) = column("y0[m]") > 0 ? value : NaN
lowest(value) = column("y0[m]") == 0 ? value : NaN
plot folder."/micro.tsv" using (inside(phi(0))):(share(0)) with points pt 7 ps 0.4 lc rgb "#a01f77b4" title "a layer in a window", \
     "" using (lowest(phi(0))):(share(0)) with points pt 7 ps 0.4 lc rgb "#60ff7f0e" title "the lowest layer", \
     2 * r * x * (1 - x) / (x + r * (1 - x))**2 with lines lw 2 lc rgb "black" title "neutral contacts"
