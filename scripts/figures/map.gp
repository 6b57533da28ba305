# A field of a map: TABLE is what grseg-stress or grseg-kinetic print with --bins xy, xz or rz, FIELD
# a column without its unit, WINDOW the number of a window from 0 (by default the last one).
#   gnuplot -c scripts/figures/map.gp TABLE FIELD PICTURE.png [WINDOW]
# Cells whose value is 0 or nan are white. The colour bar may be given a range: [WINDOW] LOW HIGH.
load ARG0[:strstrt(ARG0, "map.gp") - 1]."names.gp"
table = named(ARG1)
field = ARG2
header = system("grep -v '^#' ".quoted(table)." | head -n 1")
set datafile separator tab
columns = 0
found = 0
title_of = ""
do for [k = 1:strlen(header)] { if (header[k:k] eq "\t") { columns = columns + 1 } }
columns = columns + 1
name_of(k) = system("printf '%s' ".quoted(header)." | cut -f ".sprintf("%d", k))
plain(name) = strstrt(name, "[") ? name[:strstrt(name, "[") - 1] : name
do for [k = 1:columns] { if (plain(name_of(k)) eq field) { found = k; title_of = name_of(k) } }
if (found == 0) { print ARG1.": no column '".field."'"; exit status 1 }
first = plain(name_of(3))[1:1]
second = plain(name_of(5))[1:1]

stats table using 1 skip 1 nooutput
last = STATS_max
begin = last
if (ARGC > 3 && ARG4 ne "") {
  cells = real(system("grep '^# cells: ' ".quoted(table)." | cut -d ' ' -f 3")) * real(system("grep '^# cells: ' ".quoted(table)." | cut -d ' ' -f 4"))
  row = int(cells) * int(ARG4)
  stats table using 1 skip 1 every ::row::row nooutput
  begin = STATS_max
}
shown(value) = value == 0 ? NaN : value
stats table using ($1 == begin ? $3 : NaN):4 skip 1 name "X" nooutput
stats table using ($1 == begin ? $5 : NaN):6 skip 1 name "Y" nooutput
stats table using ($1 == begin ? $2 : NaN) skip 1 name "T" nooutput
width = X_max_y - X_min_x
height = Y_max_y - Y_min_x

# Room for the colour bar and labels beside a picture of equal scales.
pixels = 620.0 / (width > height ? width : height)
across = width * pixels + 230
up = height * pixels + 120
set terminal pngcairo size int(across), int(up) font "DejaVu Sans,11"
set output named(ARG3)
set margins at screen 90 / across, screen (90 + width * pixels) / across, screen 60 / up, screen (60 + height * pixels) / up
set size ratio -1
set xrange [X_min_x:X_max_y]
set yrange [Y_min_x:Y_max_y]
set xlabel first." [m]"
set ylabel second." [m]"
set cblabel title_of noenhanced
set title sprintf("%g s ≤ t < %g s", begin, T_max)
set palette defined (0 "#440154", 1 "#414487", 2 "#2a788e", 3 "#22a884", 4 "#7ad151", 5 "#fde725")
if (ARGC > 5) { set cbrange [real(ARG5):real(ARG6)] }
set style fill solid noborder
set key off
plot table using (($3 + $4) / 2):(($5 + $6) / 2):3:4:5:6:($1 == begin ? shown(column(found)) : NaN) skip 1 with boxxyerror linecolor palette
