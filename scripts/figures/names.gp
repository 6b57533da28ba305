# Functions for all figures. They make names of files safe, because gnuplot runs a name that begins with < or | as a command.
#   load ARG0[:strstrt(ARG0, "FIGURE.gp") - 1]."names.gp"

# named(PATH): PATH as a name that begins with / or ./
named(path) = (path[1:1] eq "/" ? "" : "./").path
# quoted(PATH): PATH as one word for the shell.
escaped(text) = strstrt(text, "'") ? text[:strstrt(text, "'") - 1]."'\\''".escaped(text[strstrt(text, "'") + 1:]) : text
quoted(path) = "'".escaped(path)."'"
# number_of(FILE, RULE, QUANTITY): the first number of this quantity by this rule in a table of grseg-fit, or NaN.
number_of(file, rule, quantity) = real(system("awk -F '\\t' '$1 == \"".rule."\" && $5 == \"".quantity."\" {print $7; known = 1; exit} END {if (!known) print \"NaN\"}' ".quoted(file)))

# asked("ARG2", DEFAULT): the name of the picture in this argument of the figure; DEFAULT if the argument is missing.
asked(argument, default) = exists(argument) && value(argument) ne "" ? named(value(argument)) : default
# eval picture(PATH, WIDTH, HEIGHT, FONT, MORE): begins the picture PATH, a PDF if it ends in .pdf, else a PNG. Sizes are in
# pixels, 96 per inch of a PDF; MORE are further options of the terminal.
ends_in_pdf(path) = strlen(path) > 4 && path[strlen(path) - 3:] eq ".pdf"
terminal_of(path, width, height, font) = ends_in_pdf(path) \
  ? sprintf("pdfcairo size %.4fin,%.4fin fontscale 0.75 pointscale 0.75 linewidth 1.5 font 'DejaVu Sans,%d'", width / 96., height / 96., font) \
  : sprintf("pngcairo size %d,%d font 'DejaVu Sans,%d'", width, height, font)
picture(path, width, height, font, more) = (picture_path = path, sprintf("set terminal %s %s; set output picture_path", terminal_of(path, width, height, font), more))
# eval figure(NAME, WIDTH, HEIGHT, FONT): begins the picture ARG2 (default: NAME.png in the folder ARG1); tables have tabs.
figure(name, width, height, font) = (folder = named(ARG1), picture(asked("ARG2", folder."/".name.".png"), width, height, font, "")."; set datafile separator tab")
# eval note(PATH, WIDTH, HEIGHT): begins a picture on white without a frame; missing numbers in tables are NaN.
note(path, width, height) = picture(named(path), width, height, 12, "background rgb 'white'")."; set datafile separator tab; set datafile missing NaN; set tics nomirror; set border 3"
# Colours of small and large grains, or of two curves.
small = "#1f77b4"; large = "#d62728"
blue = small; red = large
