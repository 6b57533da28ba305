# Mean overlap and energy defect of the chute over a million steps at 21 and 26 degrees, from
# FOLDER/million-steps-21.tsv and -26.tsv:
#   GRSEG_HARD_CASES=FOLDER build/bin/million_steps_test
#   gnuplot -c scripts/figures/million-steps.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "million-steps.gp") - 1]."names.gp"
folder = named(ARG1)
eval picture(asked("ARG2", folder."/million-steps.png"), 1000, 420, 11, "")
set multiplot layout 1,2
set xlabel "time after the tilt (s)"
set xrange [0:250]
set key bottom right
set ylabel "mean overlap of 500 steps / d_S"
set yrange [0:0.003]
plot folder."/million-steps-26.tsv" every ::1 using 1:2 with lines lc rgb "#d62728" title "26°", \
     folder."/million-steps-21.tsv" every ::1 using 1:2 with lines lc rgb "#1f77b4" title "21°"
set key top right
set ylabel "energy defect of each 500th step"
set logscale y
set format y "10^{%T}"
set yrange [1e-17:1e-10]
plot folder."/million-steps-26.tsv" every ::1 using 1:4 with points pt 7 ps 0.2 lc rgb "#d62728" title "26°", \
     folder."/million-steps-21.tsv" every ::1 using 1:4 with points pt 7 ps 0.2 lc rgb "#1f77b4" title "21°", \
     1e-12 with lines dt 2 lc rgb "black" title "bound"
