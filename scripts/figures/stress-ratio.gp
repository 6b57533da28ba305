# sigma^S_yy / sigma^L_yy against phi_S/phi_L for every layer and window of FOLDER/stress.tsv, mixed
# contacts shared by size, with the fit of FOLDER/fit.tsv (Staron & Phillips 2015, figure 2b):
#   gnuplot -c scripts/figures/stress-ratio.gp FOLDER
folder = ARG1
slope = real(system("grep -v '^#' ".folder."/fit.tsv | awk -F '\\t' 'NR == 1 {for (c = 1; c <= NF; ++c) if ($c == \"slope\") at = c} $1 == \"size\" {print $at}'"))
set datafile separator tab
set terminal pngcairo size 900,700 font "DejaVu Sans,13"
set output folder."/stress-ratio.png"
set logscale xy
set format xy "10^{%T}"
set xlabel "φ_S / φ_L"
set ylabel "σ^S_{yy} / σ^L_{yy}"
set xrange [0.01:100]
set key top left
c(name) = column(name."[N m]")
small(dummy) = c("A_SS_yy") + c("M_yy") - c("Msize_yy") + c("A_Sb_yy")
large(dummy) = c("A_LL_yy") + c("Msize_yy") + c("A_Lb_yy")
plot folder."/stress.tsv" using (column("area_S[m^2]") / column("area_L[m^2]")):(small(0) / large(0)) \
       with points pt 7 ps 0.5 lc rgb "#801f77b4" title "a layer in a window", \
     slope * x with lines lw 2 lc rgb "#d62728" title sprintf("%.3f φ_S/φ_L", slope), \
     x with lines dt 2 lc rgb "black" title "mixture theory"
