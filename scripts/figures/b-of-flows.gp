# B by size and -B_kappa with 95 % intervals, by mixture, by slope and by stage of segregation, from
# FOLDER/fits.tsv (scripts/reproduce/campaign fits):
#   gnuplot -c scripts/figures/b-of-flows.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "b-of-flows.gp") - 1]."names.gp"
eval figure("b-of-flows", 1300, 800, 12)
fits = folder."/fits.tsv"
set datafile missing NaN
set multiplot layout 2,2
set key top right samplen 1
is(name, value) = stringcolumn(name) eq value
mixture(dummy) = column("slope") == 23
tilted(dummy) = column("phi") == 0.45
takes(quantity, stage) = is("quantity", quantity) && is("component", "yy") && is("heights", "inside") && is("stage", stage) && (is("rule", "size") || is("rule", "kinetic"))
only(condition, value) = condition ? value : NaN
stages = "early all late"
titles = "'t < 60 s' 'all times' 't > 100 s'"
colours = "#ff7f0e #1f77b4 #2ca02c"
do for [quantity in "contact kinetic"] {
  sign = quantity eq "contact" ? 1 : -1
  name = quantity eq "contact" ? "B" : "paper_B"
  set ylabel quantity eq "contact" ? "B, by size" : "-B_κ"
  paper = quantity eq "contact" ? 0.0345 : 0.373
  set yrange [sign > 0 ? -0.05 : 0.2:sign > 0 ? 0.12 : 0.45]
  set xlabel "Φ_L of the flow (23°)"
  set xrange [0:0.8]
  plot for [k = 1:3] fits using (only(mixture(0) && takes(quantity, word(stages, k)), column("phi") + 0.012 * (k - 2))):(sign * column(name)):(sign * column(name.(sign > 0 ? "_low" : "_high"))):(sign * column(name.(sign > 0 ? "_high" : "_low"))) with yerrorbars pt 7 lc rgb word(colours, k) title word(titles, k), \
       paper with lines dt 2 lc rgb "black" title "the paper"
  set xlabel "slope (degrees, Φ_L = 0.45)"
  set xrange [20.5:26.5]
  plot for [k = 1:3] fits using (only(tilted(0) && takes(quantity, word(stages, k)), column("slope") + 0.12 * (k - 2))):(sign * column(name)):(sign * column(name.(sign > 0 ? "_low" : "_high"))):(sign * column(name.(sign > 0 ? "_high" : "_low"))) with yerrorbars pt 7 lc rgb word(colours, k) notitle, \
       paper with lines dt 2 lc rgb "black" notitle
}
