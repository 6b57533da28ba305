# Pressure of the contacts over height, time mean, of FOLDER/stress.tsv:
#   gnuplot -c scripts/figures/pressure-profile.gp FOLDER
# Bulk pressure (voids included) and pressure per area of grains, in units of rho g d_S with rho = 1
# kg/m^2, against the weight of the grains above (Staron & Phillips 2015, figure 2a).
folder = ARG1
sums = folder."/stress.tsv"
number(key) = real(system("awk '/^# ".key.":/ {print $3}' ".sums))
d = number("small_diameter")
gx = number("gravity_x"); gy = number("gravity_y")
g = sqrt(gx**2 + gy**2)

# Per layer, over all windows: height, trace of the contact sums, volume, area of the grains.
$layers << EOD
EOD
set print $layers
print system("awk -F '\\t' '/^#/ {next} \
  !at[\"frames\"] {for (c = 1; c <= NF; ++c) {name = $c; sub(/\\[.*/, \"\", name); at[name] = c}; next} \
  {y = ($at[\"y0\"] + $at[\"y1\"]) / 2; w = $at[\"frames\"]; n = split(\"A_SS A_LL M A_Sb A_Lb\", part, \" \"); \
   for (k = 1; k <= n; ++k) trace[y] += w * ($at[part[k] \"_xx\"] + $at[part[k] \"_yy\"]); \
   volume[y] += w * $at[\"V\"]; area[y] += w * ($at[\"area_S\"] + $at[\"area_L\"])} \
  END {for (y in volume) print y, trace[y], volume[y], area[y]}' ".sums." | sort -g")
unset print
stats $layers using ($4 > 0.4 * $3 ? $1 : NaN) nooutput
H = STATS_max / d + 2

set terminal pngcairo size 900,700 font "DejaVu Sans,13"
set output folder."/pressure-profile.png"
set xlabel "P / (ρ g d_S)"
set ylabel "y / d_S"
set key top right
set yrange [0:*]
set xrange [0:*]
P(trace, V) = trace / (2 * V * g * d)
plot $layers using (P($2, $3)):($1 / d) with linespoints pt 7 lc rgb "#1f77b4" title "per bulk volume", \
     $layers using ($4 > 0.2 * $3 ? P($2, $4) : NaN):($1 / d) with linespoints pt 5 lc rgb "#d62728" title "per area of grains", \
     [0:H] '+' using (-gy / g * (H - $1)):1 with lines dt 2 lc rgb "black" title "ρ g cosθ (H - y)"
