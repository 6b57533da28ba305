# Height of the large grains, contacts per grain and mean forces of the whole bed over time (Staron &
# Phillips 2015, figure 6), from FOLDER/time.tsv (grseg-derive):
#   gnuplot -c scripts/figures/micro-over-time.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "micro-over-time.gp") - 1]."names.gp"
eval figure("micro-over-time", 1200, 900, 12)
time = folder."/time.tsv"
set datafile missing NaN
set multiplot layout 2,2
set key top right samplen 2
# Rows of the whole bed have nan in place of the heights of a layer.
bed(value) = stringcolumn("y0[m]") eq "nan" ? value : NaN
middle(dummy) = (column("t0[s]") + column("t1[s]")) / 2
set xlabel "t (s)"
set yrange [0:1]
set ylabel "y_L / H"
plot time using (middle(0)):(bed(column("yL/H"))) with lines lw 2 lc rgb large notitle, \
     0.677 with lines dt 3 lc rgb "gray" title "above it neutral f_S > f_L (φ_L = 0.45)"
set yrange [0:*]
set ylabel "contacts per grain"
set key bottom right
plot time using (middle(0)):(bed(column("z_L"))) with lines lw 2 lc rgb large title "z_L", \
     "" using (middle(0)):(bed(column("z_S"))) with lines lw 2 lc rgb small title "z_S"
set ylabel "f / (m_S g)"
set key top right
plot time using (middle(0)):(bed(column("f_weight_L"))) with lines lw 2 lc rgb large title "f_L", \
     "" using (middle(0)):(bed(column("f_weight_neutral_L"))) with lines lw 1 dt 2 lc rgb large title "neutral", \
     "" using (middle(0)):(bed(column("f_weight_S"))) with lines lw 2 lc rgb small title "f_S", \
     "" using (middle(0)):(bed(column("f_weight_neutral_S"))) with lines lw 1 dt 2 lc rgb small title "neutral"
set ylabel "f / (ρ g cosθ (H − y) d_S)"
set key bottom right
plot time using (middle(0)):(bed(column("f_depth_L"))) with lines lw 2 lc rgb large title "f_L", \
     "" using (middle(0)):(bed(column("f_depth_neutral_L"))) with lines lw 1 dt 2 lc rgb large title "neutral, π r/z_L", \
     "" using (middle(0)):(bed(column("f_depth_S"))) with lines lw 2 lc rgb small title "f_S", \
     "" using (middle(0)):(bed(column("f_depth_neutral_S"))) with lines lw 1 dt 2 lc rgb small title "neutral, π/z_S"
