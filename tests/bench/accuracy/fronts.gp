# One panel per observable: its difference from the reference over the processor time of a simulated
# second, with 95 % bars; the presets in red.
#   gnuplot -c tests/bench/accuracy/fronts.gp accuracy-cost.tsv fronts.png
load ARG0[:strstrt(ARG0, "tests/bench/accuracy/fronts.gp") - 1]."scripts/figures/names.gp"
table = ARGC > 0 ? named(ARG1) : "accuracy-cost.tsv"
out = ARGC > 1 ? named(ARG2) : "fronts.png"
eval picture(out, 1500, 1500, 10, "noenhanced")
set datafile separator "\t"
set datafile commentschars "#"
set logscale x
set xrange [0.5:20]
set key off
set grid
names = "mean_velocity shear_rate B_size B_half B_kappa mean_overlap mean_gap largest_overlap z_S z_L zf_S zf_L mixed_share energy_defect"
titles = "'mean velocity (m/s)' 'shear rate (1/s)' 'B, size' 'B, half' 'B_kappa' 'mean overlap (d_S)' 'mean |gap| under force (d_S)' 'largest overlap (d_S)' 'z, small' 'z, large' 'z f, small (N)' 'z f, large (N)' 'mixed share' 'energy defect'"
preset(s) = s eq "draft" || s eq "standard" || s eq "reference" || s eq "finer"
set multiplot layout 5,3
do for [k = 1:words(names)] {
  name = word(names, k)
  set title word(titles, k) . " minus reference"
  if (k > words(names) - 3) { set xlabel "processor time per simulated second (s)" }
  plot 0 with lines linecolor "gray", \
       table using "cost":(column(name."_diff")):(column(name."_diff_hw")) with yerrorbars pointtype 7 pointsize 0.6 linecolor "#1f77b4", \
       table using "cost":(preset(stringcolumn("setting")) ? column(name."_diff") : NaN) with points pointtype 7 pointsize 1.2 linecolor "#d62728", \
       table using "cost":(preset(stringcolumn("setting")) ? column(name."_diff") : NaN):"setting" with labels left offset 0.6,0.6 font ",9"
}
unset multiplot
