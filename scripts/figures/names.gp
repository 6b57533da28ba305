# What a figure does with names of files: gnuplot runs a name that begins with < or | as a command.
#   load ARG0[:strstrt(ARG0, "FIGURE.gp") - 1]."names.gp"

# named(PATH): the same file, by a name that begins with / or a point.
named(path) = (path[1:1] eq "/" ? "" : "./").path
# quoted(PATH): one word for the shell.
escaped(text) = strstrt(text, "'") ? text[:strstrt(text, "'") - 1]."'\\''".escaped(text[strstrt(text, "'") + 1:]) : text
quoted(path) = "'".escaped(path)."'"
# The first number of this quantity by this rule in a table of grseg-fit.
number_of(file, rule, quantity) = real(system("awk -F '\\t' '$1 == \"".rule."\" && $5 == \"".quantity."\" {print $7; known = 1; exit} END {if (!known) print \"NaN\"}' ".quoted(file)))
