# Segregation of a bed: height of the large grains and mixing index over time with the exponential fit,
# diffusivities over height, flux of large grains over composition. From FOLDER/segregation.tsv
# (grseg-segregation) and FOLDER/segregation-summary.tsv (with --summary and the same --begin):
#   gnuplot -c scripts/figures/segregation.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "segregation.gp") - 1]."names.gp"
folder = named(ARG1)
table = folder."/segregation.tsv"
number(name) = real(system("awk -F '\\t' '$1 == \"".name."\" {print $2}' ".quoted(folder."/segregation-summary.tsv")))
header(name) = real(system("awk '$2 == \"".name.":\" {print $3; exit}' ".quoted(table)))
begin = real(system("awk -F '\\t' '!/^#/ && ++n == 2 {print $1; exit}' ".quoted(table)))
d = header("small_diameter")
start = number("y_L_start[m]"); end = number("y_L_end[m]"); tau = number("tau[s]")
# The picture is begun after the tables are read, so that a missing table keeps an earlier picture.
eval figure("segregation", 1500, 500, 12)
set datafile missing NaN
# Rows of the whole bed have y0 = nan; they are read separately from rows of layers.
rows(test) = "< awk -F '\\t' '!/^#/ && (!n++ || $3 ".test." \"nan\")' ".quoted(table)
set multiplot layout 1,3
middle(dummy) = (column("t0[s]") + column("t1[s]")) / 2
set xlabel "time (s)"
set ylabel "y_L / d_S"
set y2label "mixing index"
set ytics nomirror
set y2tics
set y2range [0:1.05]
set yrange [0:]
set key bottom right
plot rows("==") using (middle(0)):(column("yL[m]") / d) with points pt 7 ps 0.6 lc rgb "#1f77b4" title "y_L", \
     (x > begin ? (end - (end - start) * exp(-(x - begin) / tau)) / d : NaN) with lines lw 2 lc rgb "#d62728" title sprintf("τ = %.0f s", tau), \
     rows("==") using (middle(0)):"mixing" axes x1y2 with points pt 6 ps 0.6 lc rgb "#2ca02c" title "mixing index"
unset y2tics
unset y2label
set ytics mirror
# Means over windows: "smooth unique" plots the mean of all points with the same x.
set xlabel "y / d_S"
set ylabel "D / (|du/dy| d^2)"
set yrange [0:0.3]
set key top left
height(dummy) = (column("y0[m]") + column("y1[m]")) / 2 / d
solid(name) = column("area_S[m^2]") + column("area_L[m^2]") > 0.4 * column("V[m^2]") ? column(name) : NaN
plot rows("!=") using (height(0)):(solid("Dhat_S")) smooth unique with linespoints pt 7 lc rgb "#1f77b4" title "small", \
     rows("!=") using (height(0)):(solid("Dhat_L")) smooth unique with linespoints pt 7 lc rgb "#d62728" title "large", \
     0.042 with lines dt 2 lc rgb "black" title "0.042, in 3D"
set xlabel "φ_L"
set ylabel "flux of large grains (mm/s)"
set yrange [-0.5:2]
set xrange [0:1]
# The lowest layer is left out, because its large grains are trapped by the base.
bin(name) = column("y0[m]") > 0 && solid(name) > 0 ? (floor(column(name) / 0.05) + 0.5) * 0.05 : NaN
S = number("S[m/s]")
segregation(dummy) = 1e3 * (solid("q_L[m/s]") + solid("D[m^2/s]") * solid("dphi_dy[1/m]"))
plot rows("!=") using (bin("phi_L")):(1e3 * solid("q_L[m/s]")) smooth unique with linespoints pt 6 lc rgb "#1f77b4" title "q_L", \
     rows("!=") using (bin("phi_L")):(segregation(0)) smooth unique with linespoints pt 7 lc rgb "#d62728" title "q_L + D dφ_L/dy", \
     1e3 * S * x * (1 - x) with lines lw 2 lc rgb "black" title sprintf("S φ_L φ_S, S = %.2f mm/s", 1e3 * S)
