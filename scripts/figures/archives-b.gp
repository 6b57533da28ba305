# B of three flows that start from the same state, by partition rule and from the per-atom stress that the
# programs print themselves: FOLDER/b.tsv of scripts/archives/compare.
#   gnuplot -c scripts/figures/archives-b.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "archives-b.gp") - 1]."names.gp"
folder = named(ARG1)
set datafile separator tab
eval picture(asked("ARG2", folder."/archives-b.png"), 900, 560, 12, "")
set ylabel "B"
set xrange [0.5:4.5]
set yrange [-0.5:0.15]
set bmargin 4
set xtics ("size" 1, "contact-point" 2, "half" 3, "printed by\nthe program" 4)
set xzeroaxis dt 2 lc rgb "black"
set key outside top center horizontal
place(rule) = rule eq "size" ? 1 : rule eq "contact-point" ? 2 : rule eq "half" ? 3 : rule eq "printed" ? 4 : NaN
is(program) = strcol("program") eq program
of(program, name) = is(program) ? column(name) : NaN
plot folder."/b.tsv" using (place(strcol("rule")) - 0.15):(of("grseg-sim", "B")):(column("low")):(column("high")) with yerrorbars pt 7 ps 1.3 lw 2 lc rgb "#404040" title "grseg-sim (rigid)", \
     "" using (place(strcol("rule"))):(of("LAMMPS", "B")):(column("low")):(column("high")) with yerrorbars pt 5 ps 1.3 lw 2 lc rgb "#d62728" title "LAMMPS", \
     "" using (place(strcol("rule")) + 0.15):(of("LIGGGHTS", "B")):(column("low")):(column("high")) with yerrorbars pt 9 ps 1.5 lw 2 lc rgb "#1f77b4" title "LIGGGHTS"
