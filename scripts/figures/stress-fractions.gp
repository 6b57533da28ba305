# The large grains' fraction of the contact and of the kinetic stress over their part of the grains' volume, from
# FOLDER/FLOW.fractions.tsv (scripts/archives/stress-fractions) of the flows long and mix70, with the form
# f = phi s^a/sum(phi s^a) for a = 0, 1 and 3 (pressure by diameter, by volume) and at the exponents that fit:
#   gnuplot -c scripts/figures/stress-fractions.gp FOLDER A_CONTACT A_KINETIC [PICTURE]
load ARG0[:strstrt(ARG0, "stress-fractions.gp") - 1]."names.gp"
folder = named(ARG1)
a_contact = real(ARG2)
a_kinetic = real(ARG3)
of(flow) = folder."/".flow.".fractions.tsv"
f(phi, a) = phi * 2**a / (phi * 2**a + 1 - phi)
set datafile separator tab
eval picture(asked("ARG4", folder."/stress-fractions.png"), 900, 640, 12, "")
set xlabel "φ_L"
set ylabel "large grains' fraction of σ_{yy}"
set xrange [0:1]
set yrange [0:1]
set key outside right center
blue = "#1f77b4"
red = "#d62728"
plot x lc rgb "black" title "f = φ", \
     f(x, 1) dt 3 lc rgb "gray40" title "by diameter, a = 1", \
     f(x, 3) dt 4 lc rgb "gray40" title "by volume, a = 3", \
     f(x, a_contact) lc rgb blue title sprintf("a = %.3f", a_contact), \
     f(x, a_kinetic) lc rgb red title sprintf("a = %.2f", a_kinetic), \
     for [flow in "long mix70"] of(flow) using "phi":"contact" with points pt 7 lc rgb blue notitle, \
     for [flow in "long mix70"] of(flow) using "phi":"kinetic" with points pt 5 lc rgb red notitle, \
     NaN with points pt 7 lc rgb blue title "contact stress", \
     NaN with points pt 5 lc rgb red title "kinetic stress"
