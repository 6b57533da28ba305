# Stress of each species over height, as printed by the program that made the flow and as computed by grseg
# from its contacts: FOLDER/stress.tsv of scripts/archives/compare.
#   gnuplot -c scripts/figures/archives-stress.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "archives-stress.gp") - 1]."names.gp"
folder = named(ARG1)
set datafile separator tab
eval picture(asked("ARG2", folder."/archives-stress.png"), 1000, 560, 12, "")
set multiplot layout 1,2
set xlabel "σ_{yy} of the species, N/m"
set ylabel "height, d_S"
set yrange [0:*]
set xrange [0:*]
of(program, name) = strcol("program") eq program ? column(name) : NaN
do for [program in "LAMMPS LIGGGHTS"] {
  set title program
  plot folder."/stress.tsv" using (of(program, "S_grseg[N/m]")):"y[dS]" with lines lw 2 lc rgb "#e8a33d" title "small: contacts, by grseg", \
       "" using (of(program, "S_theirs[N/m]")):"y[dS]" with points pt 6 ps 1.2 lc rgb "#a06000" title "small: printed by ".program, \
       "" using (of(program, "L_grseg[N/m]")):"y[dS]" with lines lw 2 lc rgb "#1f77b4" title "large: contacts, by grseg", \
       "" using (of(program, "L_theirs[N/m]")):"y[dS]" with points pt 4 ps 1.2 lc rgb "#0b3c66" title "large: printed by ".program
}
unset multiplot
