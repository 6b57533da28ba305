# Top: B over the large grain's share p of a mixed contact, with its 95 % band, from FOLDER/scan.tsv, and
# B of neutral contacts. If FOLDER/stock.tsv exists (grseg-fit --partition stock), also the rules of
# published codes. Bottom: B minus B of neutral contacts.
#   gnuplot -c scripts/figures/b-of-p.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "b-of-p.gp") - 1]."names.gp"
folder = named(ARG1)
scan = folder."/scan.tsv"
stock = folder."/stock.tsv"
marked = system("test -f ".quoted(stock)." && echo yes") eq "yes"
same_runs = system("cat ".quoted(scan)." ".(marked ? quoted(stock) : "")." | awk '/^# input: / {n[$0]++} END {for (run in n) if (n[run] != 2) other = 1; print other ? \"no\" : \"yes\"}'")
if (marked && same_runs eq "no") { system("echo 'b-of-p.gp: scan.tsv and stock.tsv of ".folder." are of different runs; make both from the same tables' >&2"); exit status 1 }
cell(rule, quantity) = marked ? number_of(stock, rule, quantity) : NaN
rules = "size contact-point half"
p_zero = real(system("awk '/^# p_zero:/ {print $3}' ".quoted(scan)))

# The picture is begun after the checks, so that a refusal keeps an earlier picture.
eval figure("b-of-p", 900, 900, 12)

set xlabel "share p of a mixed contact given to its large grain"
set xzeroaxis
set style fill transparent solid 0.25 noborder
set lmargin 11
set multiplot layout 2,1

set ylabel "B"
set key top left
if (p_zero == p_zero) {
  set arrow from p_zero, graph 0 to p_zero, first 0 nohead dt 3 lc rgb "gray"
  set label sprintf("B = 0 at p = %.3f", p_zero) at p_zero, graph 0.36 offset 0.5,0 tc rgb "#606060"
}
if (marked) {
  set label "size: grseg, the paper" at cell("size", "share"), cell("size", "B") right offset -1,1 tc rgb red
  set label "contact-point: MercuryCG, YADE, PFC" at cell("contact-point", "share"), cell("contact-point", "B") offset 1.5,-1.2 tc rgb red
  set label "half: LAMMPS, LIGGGHTS stress/atom (also of a group)" at cell("half", "share"), cell("half", "B") offset 1.5,-0.7 tc rgb red
  k = cell("drop", "paper_k")
  if (k == k) {
    set label sprintf("drop (only pairs inside a group): no p, no B;\nσ_S/σ_L = %.2f (φ_S/φ_L)^{%.2f} instead of φ_S/φ_L", k, cell("drop", "paper_a")) at graph 0.98, graph 0.12 right tc rgb red
  }
}
plot scan using "p":"low":"high" with filledcurves lc rgb blue title "95 %", \
     scan using "p":"B" with lines lw 2 lc rgb blue title "this flow", \
     scan using "p":"neutral" with lines dt 2 lc rgb "black" title "neutral contacts", \
     for [rule in marked ? rules : ""] "+" using (cell(rule, "share")):(cell(rule, "B")) every ::0::0 \
       with points pt 7 ps 1.2 lc rgb red notitle

unset label
unset arrow
set ylabel "B minus that of neutral contacts"
set key top left
plot scan using "p":(column("low") - column("neutral")):(column("high") - column("neutral")) \
       with filledcurves lc rgb blue title "95 %", \
     scan using "p":(column("B") - column("neutral")) with lines lw 2 lc rgb blue title "this flow", \
     for [rule in marked ? rules : ""] "+" using (cell(rule, "share")):(cell(rule, "B") - cell(rule, "neutral")) every ::0::0 \
       with points pt 7 ps 1.2 lc rgb red notitle
