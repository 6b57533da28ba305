# Effective friction of plane shear over the inertial number, beside the line of da Cruz et al. (2005), discs of
# friction 0.4, whose inertial number is rate (mass/P)^{1/2}: (pi/4)^{1/2} times the one here; and the law that Lagrée et
# al. (2011) fitted to contact dynamics of discs.
#   gnuplot -c scripts/scenes/shear.gp shear.tsv shear.png
load ARG0[:strstrt(ARG0, "shear.gp") - 1]."../figures/names.gp"
table = named(ARG1)
eval picture(named(ARG2), 800, 560, 11, "")
set datafile separator "\t"
set grid
set key bottom right
set xlabel "inertial number I = rate d (density/P)^{1/2}"
set ylabel "effective friction {/Symbol t}/P"
f(x) = a + b*x/(c + x)
a = 0.25; b = 0.4; c = 0.2
set fit quiet logfile "/dev/null" errorvariables
fit f(x) table using 1:2:3 skip 1 yerrors via a, b, c
line(x) = m + s*x
m = 0.25; s = 1
fit line(x) table using 1:2:3 skip 1 yerrors via m, s
set xrange [0:*]
plot table using 1:2:3 skip 1 with yerrorbars pointtype 7 title "grseg, friction 0.5", \
     f(x) with lines title sprintf("(%.3f ± %.3f) + (%.2f ± %.2f) I/((%.2f ± %.2f) + I)", a, a_err, b, b_err, c, c_err), \
     line(x) with lines linecolor "gray" title sprintf("line through all: (%.3f ± %.3f) + (%.2f ± %.2f) I", m, m_err, s, s_err), \
     0.25 + 1.1*sqrt(pi/4)*x with lines dashtype 2 title "da Cruz et al.: 0.25 + 1.1 ({/Symbol p}/4)^{1/2} I", \
     0.32 + 0.28*x/(0.4 + x) with lines dashtype 3 title "Lagrée et al.: 0.32 + 0.28 I/(0.4 + I)"
