# -B_kappa over the mean shear rate of the flows of phi_L = 0.45 at 21 to 26 degrees, from FOLDER/flows.tsv
# (scripts/reproduce/campaign flows), with the line of Staron & Phillips (2015, figure 4):
#   gnuplot -c scripts/figures/kinetic-shear-rate.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "kinetic-shear-rate.gp") - 1]."names.gp"
eval figure("kinetic-shear-rate", 900, 700, 13)
flows = folder."/flows.tsv"
set xlabel "mean shear rate / (g/d_S)^{1/2}"
set ylabel "-B_κ"
set xrange [0:*]
set yrange [0.2:0.5]
set key top left
slope(value) = column("phi") == 0.45 && stringcolumn("variant") eq "none" ? value : NaN
plot flows using (column("rate")):(slope(-column("K"))):(-column("K_high")):(-column("K_low")) with yerrorbars pt 7 lc rgb "#1f77b4" title "this flow, 95 %", \
     flows using (column("rate")):(slope(-column("K"))):(sprintf("%g°", column("slope"))) with labels left offset 0.8,0.6 font ",10" notitle, \
     0.310 + 0.205 * x with lines dt 2 lc rgb "black" title "0.310 + 0.205 x, the paper"
