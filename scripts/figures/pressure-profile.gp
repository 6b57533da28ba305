# Mean pressure of the contacts over height, from FOLDER/profile.tsv (scripts/profile):
#   gnuplot -c scripts/figures/pressure-profile.gp FOLDER [PICTURE]
# Pressure per bulk volume (voids included) and per area of grains, in units of rho g d_S with rho = 1
# kg/m^2, with the weight of the grains above (Staron & Phillips 2015, figure 2a).
load ARG0[:strstrt(ARG0, "pressure-profile.gp") - 1]."names.gp"
eval figure("pressure-profile", 900, 700, 13)
profile = folder."/profile.tsv"
number(key) = real(system("grep '^# ".key.":' ".quoted(profile)." | cut -d ' ' -f 3"))
slope = number("slope")
H = number("height/d_S")
y = "y/d_S"

set xlabel "P / (ρ g d_S)"
set ylabel "y / d_S"
set key top right
set yrange [0:*]
set xrange [0:*]
set angles degrees
plot profile using "P":y with linespoints pt 7 lc rgb "#1f77b4" title "per bulk volume", \
     profile using (column("nu") > 0.2 ? column("P_solid") : NaN):y with linespoints pt 5 lc rgb "#d62728" title "per area of grains", \
     profile using "weight":y with lines lw 1 lc rgb "#1f77b4" title "weight of the grains above", \
     [0:H] '+' using (cos(slope) * (H - $1)):1 with lines dt 2 lc rgb "black" title "ρ g cosθ (H - y)", \
     [0:H] '+' using (H - $1):1 with lines dt 3 lc rgb "gray40" title "ρ g (H - y), the paper's caption"
