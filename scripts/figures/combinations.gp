# Share of the combinations with each choice that meet each number of Staron & Phillips (2015), from FOLDER/combined.tsv
# (scripts/reproduce/campaign combinations --figure).
#   gnuplot -c scripts/figures/combinations.gp FOLDER [PICTURE]
load ARG0[:strstrt(ARG0, "combinations.gp") - 1]."names.gp"
eval figure("combinations", 1100, 760, 12)
set datafile columnheaders
table = folder."/combined.tsv"
names = system("grep -v '^#' '".table."' | head -n 1 | cut -f 3- | tr '\\t' ' '")
numbers = words(names)
choice(dummy) = stringcolumn("axis")." ".stringcolumn("choice")
set xrange [-0.5:numbers - 0.5]
set xtics rotate by -35 noenhanced
do for [k = 1:numbers] { set xtics add (word(names, k) k - 1) }
set ytics noenhanced
rows = system("grep -vc '^#' '".table."'") - 1
set yrange [rows - 0.4:-0.6]
set bmargin 6
set cbrange [0:1]
set cblabel "part of the combinations that meet it"
set palette defined (0 "#ffffff", 1 "#1f77b4")
unset key
plot for [k = 1:numbers] table using (k - 1):0:(column(k + 2)):ytic(choice(0)) with points pt 5 ps 3.4 palette, \
     for [k = 1:numbers] "" using (k - 1):0:(column(k + 2) > 0 ? sprintf("%.0f", 100 * column(k + 2)) : "") with labels font ",9"
