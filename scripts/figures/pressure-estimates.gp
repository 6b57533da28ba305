# Errors of the pressures estimated from contacts per grain and mean forces, over composition (Staron & Phillips
# 2015, figure 5). From FOLDER/paper.tsv and ends.tsv, made as docs/studies/microstructure.md says:
#   gnuplot -c scripts/figures/pressure-estimates.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "pressure-estimates.gp") - 1]."names.gp"
eval figure("pressure-estimates", 900, 700, 13)
set datafile missing NaN
set key top right samplen 2
set xlabel "φ_L"
set xrange [0:1]
set yrange [-3:14]
set ylabel "Π/P − 1 (%), prefactor 1/(πd)"
plot folder."/paper.tsv" using "phi_L":(100 * column("error_S")) with linespoints pt 7 lc rgb small title "Π^S, contacts, |f|", \
     "" using "phi_L":(100 * column("error_L")) with linespoints pt 7 lc rgb large title "Π^L, contacts, |f|", \
     "" using "phi_L":(100 * column("error")) with linespoints pt 7 lc rgb "black" title "Π, contacts, |f|", \
     folder."/ends.tsv" using "phi_L":(100 * column("error_S")) with linespoints pt 6 dt 2 lc rgb small title "Π^S, ends, f_n", \
     "" using "phi_L":(100 * column("error_L")) with linespoints pt 6 dt 2 lc rgb large title "Π^L, ends, f_n"
