# Contacts per grain, mean force and their product over the time step, for the whole bed of phi_L = 0.45 at 23
# degrees from 10 to 60 s. From FOLDER/flows.tsv (scripts/reproduce/campaign flows):
#   gnuplot -c scripts/figures/step.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "step.gp") - 1]."names.gp"
eval figure("step", 1400, 480, 12)
flows = folder."/flows.tsv"
set multiplot layout 1,3
# Selects the flows that differ only in time step and accuracy.
steps(value) = column("phi") == 0.45 && column("slope") == 23 && strstrt("none draft reference step0.000125", stringcolumn("variant")) ? value : NaN
set xlabel "step (10^{-4} s)"
set xrange [0:5]
set yrange [0:*]
set key bottom right
do for [quantity in "z f zf"] {
  set ylabel quantity eq "z" ? "contacts per grain, z" : quantity eq "f" ? "mean force f / (m_S g)" : "z f / (m_S g)"
  plot flows using (1e4 * column("step")):(steps(column(quantity."_L"))):(column("hw_".quantity."_L")) with yerrorbars pt 7 lc rgb large title "large", \
       flows using (1e4 * column("step")):(steps(column(quantity."_S"))):(column("hw_".quantity."_S")) with yerrorbars pt 7 lc rgb small title "small"
}
