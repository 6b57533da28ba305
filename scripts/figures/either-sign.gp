# The picture of README.md. Left: B over the large grain's share p of a mixed contact, with the rules of
# published codes and the values of Staron & Phillips (2015). Right: B by size of each mixture. The
# folder needs scan.tsv, stock.tsv and fits.tsv, which make -C scripts reproduction.md writes into
# reproduction-figures:
#   gnuplot -c scripts/figures/either-sign.gp reproduction-figures docs/figures/either-sign.png
load ARG0[:strstrt(ARG0, "either-sign.gp") - 1]."names.gp"
folder = named(ARG1)
scan = folder."/scan.tsv"
stock = folder."/stock.tsv"
fits = folder."/fits.tsv"
eval note(ARG2, 1200, 440)
grey = "#606060"
is(name, value) = strcol(name) eq value
mixture(rule) = is("rule", rule) && is("stage", "all") && is("heights", "inside") && is("component", "yy") \
  && is("quantity", "contact") && column("slope") == 23 && column("phi") > 0
rules(dummy) = mixture("size") || mixture("half") || mixture("uniform:0.8") || mixture("uniform:0.6")
cell(rule, quantity) = number_of(stock, rule, quantity)
p_zero = real(system("awk '/^# p_zero:/ {print $3}' ".quoted(scan)))
$paper << EOD
0.5	-0.32
0.6	-0.1
0.66667	0.0345
0.8	0.33
EOD

set style fill transparent solid 0.25 noborder
set xzeroaxis lt 1 lw 1.5 lc rgb grey
set multiplot

set size 0.66,1
set origin 0,0
set xrange [0.4:0.86]
set yrange [-0.56:0.56]
set xlabel "share p of a mixed contact's stress that is given to its large grain"
set ylabel "segregation strength B"
set key bottom right reverse Left samplen 2 spacing 1.15
set label "B > 0: large grains carry more\nthan their share of the pressure" at 0.41,0.47 tc rgb grey
set label "B < 0: small grains do" at 0.415,-0.06 tc rgb grey
set label "LAMMPS,\nLIGGGHTS\n(half to each)" at cell("half", "share"), cell("half", "B") right offset -1.5,3.2 tc rgb red
set label "Staron \\& Phillips (by size);\nMercuryDPM, YADE, PFC\n(up to the contact point)" at cell("size", "share"), cell("size", "B") right offset -1.5,3.9 tc rgb red
set arrow from p_zero, -0.03 to p_zero, -0.135 backhead size 0.006,25 lc rgb grey
set label sprintf("B = 0 at p* = %.3f", p_zero) at p_zero, -0.16 offset -0.5,0 tc rgb grey
plot scan using "p":"low":"high" with filledcurves lc rgb blue notitle, \
     scan using "p":"B" with lines lw 2.5 lc rgb blue title "grseg: 24 runs of six mixtures", \
     fits using (rules(0) ? column("share") : NaN):"B" with points pt 7 ps 0.7 lc rgb "#7fb3d9" title "each mixture (4 runs)", \
     $paper using 1:2 with points pt 4 ps 1.7 lw 1.5 lc rgb "black" title "Staron \\& Phillips (2015)", \
     for [rule in "size half"] "+" using (cell(rule, "share")):(cell(rule, "B")) every ::0::0 \
       with points pt 7 ps 1.4 lc rgb red title rule eq "size" ? "rules of published codes" : ""

unset label
unset arrow
set size 0.34,1
set origin 0.66,0
set xrange [0:0.82]
set yrange [0:0.06]
set xtics 0.2
set xlabel "large grains, Φ_L of the mixture"
set ylabel "B by size"
unset key
set label "dashed: Staron \\& Phillips,\nall mixtures" at 0.8,0.0238 right tc rgb "black"
plot 0.0345 with lines dt 2 lc rgb "black", \
     fits using (mixture("size") ? column("phi") : NaN):"B":"B_low":"B_high" \
       with yerrorbars pt 7 ps 1.1 lw 1.5 lc rgb blue
