# Micro-structure beyond figures 5 and 6 of Staron & Phillips (2015): B from contacts and mean forces, fabric and forces
# by type of contact. From FOLDER/paper.tsv, ends.tsv and forces.tsv, made as docs/studies/microstructure.md says.
#   gnuplot -c scripts/figures/microstructure.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "microstructure.gp") - 1]."names.gp"
eval figure("microstructure", 1500, 450, 11)
set datafile missing NaN
set multiplot layout 1,3
set key top right samplen 2

set xlabel "φ_L"
set xrange [0:1]
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
