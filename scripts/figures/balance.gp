# Forces on the large grains, by mechanism, over height, from FOLDER/balance-profile.tsv:
#   scripts/profile --balance FOLDER/balance.tsv > FOLDER/balance-profile.tsv
#   gnuplot -c scripts/figures/balance.gp FOLDER [PICTURE]
# Left: forces on the large grains in units of their weight. Right: B and -B_kappa, from which these forces
# follow; dashed are the values of Staron & Phillips (2015). Bars are standard errors over windows.
load ARG0[:strstrt(ARG0, "balance.gp") - 1]."names.gp"
eval figure("balance", 1100, 700, 13)
profile = folder."/balance-profile.tsv"
set multiplot layout 1,2
set ylabel "y / d_S"
set key outside top center vertical maxrows 3 Left reverse
set bars 0.5
y = "y/d_S"
set xlabel "force on large grains / their weight (up > 0)"
set xrange [-0.12:0.08]
set xtics 0.04
set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb "black"
plot profile using "push":y:"e_push" with xerrorbars pt 7 lc rgb "#1f77b4" title "contact stress, -(ψ-φ) ∂_yσ", \
     profile using "kinetic":y:"e_kinetic" with xerrorbars pt 5 lc rgb "#d62728" title "kinetic stress, -(ψ^κ-φ) ∂_yK", \
     profile using "drag":y:"e_drag" with xerrorbars pt 9 lc rgb "#7f7f7f" title "drag"
unset arrow
unset ylabel
set xlabel "B, -B_κ"
set xrange [-0.1:0.5]
set xtics 0.1
set arrow from 0.034, graph 0 to 0.034, graph 1 nohead dt 2 lc rgb "#1f77b4"
set arrow from 0.373, graph 0 to 0.373, graph 1 nohead dt 2 lc rgb "#d62728"
plot profile using "B":y:"e_B" with xerrorbars pt 7 lc rgb "#1f77b4" title "B", \
     profile using (-column("B_kappa")):y:"e_B_kappa" with xerrorbars pt 5 lc rgb "#d62728" title "-B_κ"
