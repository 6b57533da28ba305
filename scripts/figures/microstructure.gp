# Six views of the micro-structure (Staron & Phillips 2015, figures 5 and 6, and what they leave open):
#   gnuplot -c scripts/figures/microstructure.gp FOLDER
# of the tables that docs/microstructure.md makes in FOLDER: time.tsv, paper.tsv, ends.tsv, forces.tsv.
folder = ARG1
set datafile separator tab
set datafile missing NaN
set terminal pngcairo size 1500,900 font "DejaVu Sans,11"
set output folder."/microstructure.png"
small = "#1f77b4"
large = "#d62728"
set multiplot layout 2,3
set key top right samplen 2

# The whole bed over time: its rows are those without heights of a layer.
bed(value) = stringcolumn("y0[m]") eq "nan" ? value : NaN
middle(dummy) = (column("t0[s]") + column("t1[s]")) / 2
set xlabel "t (s)"
set yrange [0:3.2]
set ylabel "contacts per grain;  y_L/H"
plot folder."/time.tsv" using (middle(0)):(bed(column("z_L"))) with lines lw 2 lc rgb large title "z_L", \
     "" using (middle(0)):(bed(column("z_S"))) with lines lw 2 lc rgb small title "z_S", \
     "" using (middle(0)):(bed(column("yL/H"))) with lines lw 2 dt 2 lc rgb "black" title "y_L/H"
set yrange [0:4.5]
set ylabel "f / (ρ g cosθ (H − y) d_S)"
plot folder."/time.tsv" using (middle(0)):(bed(column("f_depth_L"))) with lines lw 2 lc rgb large title "f_L", \
     "" using (middle(0)):(bed(column("f_depth_neutral_L"))) with lines lw 1 dt 2 lc rgb large title "neutral, π r/z_L", \
     "" using (middle(0)):(bed(column("f_depth_S"))) with lines lw 2 lc rgb small title "f_S", \
     "" using (middle(0)):(bed(column("f_depth_neutral_S"))) with lines lw 1 dt 2 lc rgb small title "neutral, π/z_S"

set xlabel "φ_L"
set xrange [0:1]
set yrange [-3:14]
set ylabel "Π/P − 1 (%), prefactor 1/(πd)"
plot folder."/paper.tsv" using "phi_L":(100 * column("error_S")) with linespoints pt 7 lc rgb small title "Π^S, contacts, |f|", \
     "" using "phi_L":(100 * column("error_L")) with linespoints pt 7 lc rgb large title "Π^L, contacts, |f|", \
     "" using "phi_L":(100 * column("error")) with linespoints pt 7 lc rgb "black" title "Π, contacts, |f|", \
     folder."/ends.tsv" using "phi_L":(100 * column("error_S")) with linespoints pt 6 dt 2 lc rgb small title "Π^S, ends, f_n", \
     "" using "phi_L":(100 * column("error_L")) with linespoints pt 6 dt 2 lc rgb large title "Π^L, ends, f_n"

set yrange [-0.15:0.2]
set ylabel "B"
plot folder."/paper.tsv" using "phi_L":"B_P" with linespoints pt 7 lc rgb "black" title "from P^S/P^L", \
     "" using "phi_L":"B_Pi" with linespoints pt 6 lc rgb large title "from z and f, contacts, |f|", \
     folder."/ends.tsv" using "phi_L":"B_Pi" with linespoints pt 6 lc rgb small title "from z and f, ends, f_n", \
     0 with lines lc rgb "grey" notitle

set yrange [0.2:0.9]
set ylabel "q/p of the contacts of a type"
plot for [k = 1:3] folder."/paper.tsv" using "phi_L":(column("q/p_".word("SS LS LL", k))) with points pt 7 lc k title word("SS LS LL", k), \
     for [k = 1:3] folder."/paper.tsv" using "phi_L":(column("rothenburg_".word("SS LS LL", k))) with lines dt 2 lc k notitle, \
     for [k = 1:3] folder."/paper.tsv" using "phi_L":(column("rothenburg_full_".word("SS LS LL", k))) with lines lc k notitle

set xlabel "f_n / ⟨f_n⟩ of the layer"
set xrange [0:10]
set yrange [1e-4:3]
set logscale y
set ylabel "probability density"
last(value) = stringcolumn("y0[m]") eq "nan" && column("t0[s]") >= 30 ? value : NaN
plot for [k = 1:3] folder."/forces.tsv" using (column("x0") + 0.05):(last(column("P_".word("SS LS LL", k)))) \
       with lines lw 2 lc k title word("SS LS LL", k)
unset multiplot
