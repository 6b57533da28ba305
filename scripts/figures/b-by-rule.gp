# Left: B over the large grain's share p of a mixed contact, a curve with its 95 % band for each mixture. Right: B under three
# rules of published codes. From FOLDER/scan-*.tsv and FOLDER/rules.tsv (scripts/reproduce/campaign mixtures):
#   gnuplot -c scripts/figures/b-by-rule.gp FOLDER b-by-rule.png
load ARG0[:strstrt(ARG0, "b-by-rule.gp") - 1]."names.gp"
folder = named(ARG1)
rules = folder."/rules.tsv"
eval note(ARG2, 1200, 460)
flows = system("awk -F '\\t' '/^phi/ && !seen[$1]++ {print $1}' ".quoted(rules))
phi(flow) = flow[4:strstrt(flow, "-s") - 1]
set palette defined (0 "#440154", 0.25 "#3b528b", 0.5 "#21918c", 0.75 "#5ec962", 1 "#d0b000")
unset colorbox
set cbrange [0:0.75]
set style fill transparent solid 0.3 noborder
set xzeroaxis lt 1 lw 1.5 lc rgb "#606060"
is(rule) = strcol("rule") eq rule
set multiplot layout 1,2
set lmargin 9
set xlabel "share p of a mixed contact given to its large grain"
set ylabel "B"
set xrange [0.45:0.8]
set yrange [-0.5:0.4]
set key top left reverse Left title "Φ_L" samplen 2
plot for [flow in flows] folder."/scan-".flow.".tsv" using "p":"low":"high" with filledcurves lc palette cb phi(flow) notitle, \
     for [flow in flows] folder."/scan-".flow.".tsv" using "p":"B" with lines lw 2 lc palette cb phi(flow) title phi(flow)
set xlabel "large grains, Φ_L of the mixture"
set ylabel "B"
set xrange [0:0.82]
set yrange [-0.4:0.1]
set key at graph 0.5, graph 0.72 title "rule" reverse Left samplen 1
only(rule, value) = is(rule) ? value : NaN
plot rules using "phi":(only("size", column("B"))):"B_low":"B_high" with yerrorbars pt 7 lc rgb "#1f77b4" title "size", \
     rules using (column("phi") + 0.01):(only("contact-point", column("B"))):"B_low":"B_high" with yerrorbars pt 6 lc rgb "#17becf" title "contact-point", \
     rules using "phi":(only("half", column("B"))):"B_low":"B_high" with yerrorbars pt 5 lc rgb "#d62728" title "half", \
     rules using "phi":(only("half", column("neutral"))) with lines dt 2 lc rgb "black" title "half, neutral contacts"
