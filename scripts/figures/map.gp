# A field of a map in colours. TABLE: output of grseg-stress or grseg-kinetic with --bins xy, xz or rz.
# FIELD: name of a column without its unit. WINDOW: number of a window from 0 (default: the last window).
#   gnuplot -c scripts/figures/map.gp TABLE FIELD PICTURE.png [WINDOW [LOWEST HIGHEST]]
# Both axes have the same scale. Cells without grains and contacts are white. LOWEST and HIGHEST are the
# ends of the colour bar.
load ARG0[:strstrt(ARG0, "map.gp") - 1]."names.gp"
table = named(ARG1)
line(pattern) = system("sed -n '/".pattern."/{p;q}' ".quoted(table))
header = line("^[^#]")
cells = line("^# cells: ")
if (cells eq "") { print ARG1.": is not a table of a map; make one with --bins xy"; exit status 1 }

column_name(k) = system("printf '%s' ".quoted(header)." | cut -f ".sprintf("%d", k))
plain(name) = strstrt(name, "[") ? name[:strstrt(name, "[") - 1] : name
label(name) = plain(name).(strstrt(name, "[") ? " ".name[strstrt(name, "["):] : "")
names = system("printf '%s' ".quoted(header)." | tr '\\t' '\\n' | sed 's/\\[.*//'")
column_of(name) = int(system("{ printf '%s\\n' ".quoted(names)." | grep -nx -e ".quoted(name)." | cut -d : -f 1; echo 0; } | sed -n 1p"))
found = column_of(ARG2)
if (found == 0) { print ARG1.": no column '".ARG2."'"; exit status 1 }

set datafile separator tab
rows = int(word(cells, 3)) * int(word(cells, 4))
stats table using 1 skip 1 nooutput
windows = int(STATS_records / rows)
window = ARGC > 3 ? int(ARG4) : windows - 1
if (window < 0 || window >= windows) { print sprintf("%s: has windows 0 to %d", ARG1, windows - 1); exit status 1 }
from = 1 + window * rows
to = from + rows - 1
stats table using 1:2 every ::from::to name "T" nooutput
stats table using 3:4 every ::from::to name "X" nooutput
stats table using 5:6 every ::from::to name "Y" nooutput
width = X_max_y - X_min_x
height = Y_max_y - Y_min_x

# Space for labels and the colour bar around the map.
scale = 600.0 / (width > height ? width : height)
across = width * scale + 220
up = height * scale + 110
eval picture(named(ARG3), int(across), int(up), 11, "")
set margins at screen 85 / across, screen (85 + width * scale) / across, screen 60 / up, screen (60 + height * scale) / up
set xrange [X_min_x:X_max_y]
set yrange [Y_min_x:Y_max_y]
set xlabel plain(column_name(3))[1:1]." [m]"
set ylabel plain(column_name(5))[1:1]." [m]"
set tics out nomirror
# Labels are at least 70 pixels apart.
power(step) = 10.0**floor(log10(step))
round_step(step) = power(step) * (step <= power(step) ? 1 : step <= 2 * power(step) ? 2 : step <= 5 * power(step) ? 5 : 10)
set xtics round_step(70 / scale)
set ytics round_step(45 / scale)
set cblabel label(column_name(found)) noenhanced
set title sprintf("%g to %g s", T_min_x, T_max_y)
set palette defined (0 "#440154", 1 "#414487", 2 "#2a788e", 3 "#22a884", 4 "#7ad151", 5 "#fde725")
if (ARGC > 5) { set cbrange [real(ARG5):real(ARG6)] }
set key off
# A cell without grains has nu = 0, or u = nan.
of_grains = column_of("nu") > 0 ? column_of("nu") : column_of("u")
shown(value, grains) = value == 0 && !(grains != 0 && grains == grains) ? NaN : value
plot table using (($3 + $4) / 2):(($5 + $6) / 2):(shown(column(found), column(of_grains))) every ::from::to with image
