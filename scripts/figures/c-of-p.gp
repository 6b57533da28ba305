# Left: coefficient c of Gray & Thornton's closure over the large grain's share p of a mixed contact, a line for each mixture.
# Right: B/c and d/c from the flux of large grains, by mixture. From closures.tsv (scripts/reproduce/campaign closures):
#   gnuplot -c scripts/figures/c-of-p.gp closures.tsv c-of-p.png
load ARG0[:strstrt(ARG0, "c-of-p.gp") - 1]."names.gp"
table = named(ARG1)
eval note(ARG2, 1200, 460)
set palette defined (0 "#440154", 0.25 "#3b528b", 0.5 "#21918c", 0.75 "#5ec962", 1 "#d0b000")
unset colorbox
set cbrange [0:0.75]
set multiplot layout 1,2
set lmargin 10
stats table using "phi" skip 1 nooutput
array phi[STATS_records]
array slope[STATS_records]
array zero[STATS_records]
stats table using (phi[int($0) + 1] = column("phi"), slope[int($0) + 1] = column("dc_dp"), zero[int($0) + 1] = column("p_star"), 0) skip 1 nooutput
set xlabel "share p of a mixed contact given to its large grain"
set ylabel "c, 1/s"
set xrange [0.45:0.8]
set xzeroaxis lt 1 lw 1.5 lc rgb "#606060"
set key top left reverse Left title "Φ_L" samplen 2
set arrow 1 from 0.5, graph 0 to 0.5, graph 1 nohead dt 3 lc rgb "#606060"
set arrow 2 from 2.0 / 3, graph 0 to 2.0 / 3, graph 1 nohead dt 3 lc rgb "#606060"
set label 1 "half" at 0.5, graph 0.04 offset 0.5
set label 2 "size" at 2.0 / 3, graph 0.04 offset 0.5
plot for [k = 1:|phi|] slope[k] * (x - zero[k]) with lines lw 2 lc palette cb phi[k] title sprintf("%.2f", phi[k])
unset arrow
unset label
unset xzeroaxis
set xlabel "large grains, Φ_L of the mixture"
set ylabel "from the flux alone: B/c, 10^{−4} s"
set y2label "d/c, 10^{−4} m²/s"
set xrange [0:0.82]
set yrange [0:8]
set y2range [0:4]
set y2tics
set border 11
set key top right title ""
plot table using "phi":(column("B_over_c") * 1e4):(column("B_over_c_low") * 1e4):(column("B_over_c_high") * 1e4) skip 0 with yerrorbars pt 7 lc rgb "#0072b2" title "B/c", \
     table using (column("phi") + 0.012):(column("d_over_c") * 1e4):(column("d_over_c_low") * 1e4):(column("d_over_c_high") * 1e4) axes x1y2 with yerrorbars pt 5 lc rgb "#d55e00" title "d/c"
