# Shared by all figures: input tables, names and units, line styles, output as SVG and PNG.
# A script sets `plots` (this folder) and loads this file; `results` is the folder of the tables.
if (!exists("results")) results = "results"
# gnuplot runs text between backquotes, wherever the folder's name is evaluated.
if (strstrt(results, '`') > 0) { print "the name of the results folder must not contain a backquote"; exit status 1 }
set encoding utf8
set datafile separator comma
set datafile columnheaders

# --- Input tables ----------------------------------------------------------------------------------------------------
table(name) = results."/".name.".csv"
exists_table(name) = system("test -s '".table(name)."' && echo 1 || echo 0") + 0
rows_awk(options, name) = "awk -f '".plots."/rows.awk' ".options." '".table(name)."'"

# To be evaluated: ends the script with one line if the table or one of its columns is missing. Figures show from then on
# whether the run of that table was incomplete.
require(name, columns) = sprintf(\
    "complaint = exists_table('%s') ? system(rows_awk('-v missing=\"%s\"', '%s')) : '-';\
     if (complaint eq '-') { print table('%s').' is missing or empty'; exit status 1 };\
     if (complaint ne '') { print table('%s').' has no column '.complaint; exit status 1 };\
     incomplete = incomplete_run('%s')",\
    name, columns, name, name, name, name)

# Rows that may be drawn, as a data file; `where` is problem=a,method=b,..., `need` a column with a value above zero.
rows(name, where, need) = "< ".rows_awk("-v where='".where."' -v need=".need, name)
# The same of solutions that are no trajectories (too coarse, or violating constraints between stages): drawn hollow, and used by no fit.
coarse_rows(name, where, need) = "< ".rows_awk("-v take=coarse -v where='".where."' -v need=".need, name)
drawn_rows(name, where, need) = "< ".rows_awk("-v take=drawn -v where='".where."' -v need=".need, name)
has_coarse(name, where) = system(rows_awk("-v take=coarse -v distinct=method -v where='".where."'", name)) ne ""
# Distinct values in those rows, as words that serve as `where` again.
distinct(name, columns, where, need) =\
    system(rows_awk("-v distinct=".columns." -v where='".where."' -v need=".need, name))
problems_of(name, need) = distinct(name, "problem", "", need)
curves_of(name, where, need) = distinct(name, "problem,method,tableau,stages,solver", where, need)
# The value of one key in such a word: entry("problem=a,method=b", "method") is "b".
after(text, key) = text[strstrt(text, key."=") + strlen(key) + 1:*]
up_to_comma(text) = strstrt(text, ",") > 0 ? text[1:strstrt(text, ",") - 1] : text
entry(where, key) = up_to_comma(after(where, key))

# To be evaluated: x_low, x_high, y_low, y_high of those rows; axes are linear and without range afterwards.
measure(name, where, x, y) = sprintf("unset logscale; set autoscale;\
    stats drawn_rows('%s', '%s', '%s') using (column('%s')):(column('%s')) name 'S' nooutput;\
    x_low = S_min_x; x_high = S_max_x; y_low = S_min_y; y_high = S_max_y", name, where, y, x, y)

# A number from its text. gnuplot 5.4 stops at the "e" of "1e-05", which "1.e-05" spares it.
number(text) = strstrt(text, "e") == 0 || strstrt(text, ".") > 0 ? real(text)\
    : real(text[1:strstrt(text, "e") - 1].".".text[strstrt(text, "e"):*])

# A whole number from a word; gnuplot looks at the body of an empty loop once, without a word.
number_in(text) = strlen(text) > 0 ? text + 0 : 1

# Fitted slope of a curve with its standard error, as text; empty if the table lacks it or two points are no fit.
slope_fields(name, where, quantity, fields) = exists_table(name) ? system(rows_awk(sprintf(\
    "-v where='problem=%s,method=%s,tableau=%s,stages=%s,quantity=%s%s' -v fields=%s", entry(where, "problem"),\
    entry(where, "method"), entry(where, "tableau"), entry(where, "stages"), quantity, truncation_in(where),\
    fields), name)) : ""
truncation_in(where) = strstrt(where, ",truncation=") > 0 ? ",truncation=".entry(where, "truncation") : ""
slope_text(fields) =\
    words(fields) < 2 ? "" : sprintf("slope %.3f ± %.3f", number(word(fields, 1)), number(word(fields, 2)))
slope(name, where, quantity) = slope_text(slope_fields(name, where, quantity, "slope,standard_error"))
# The numbers of intervals that it is fitted over.
fit_range(name, where, quantity) = fit_range_text(slope_fields(name, where, quantity, "coarsest,finest"))
fit_range_text(fields) = words(fields) < 2 ? "" : sprintf("N = %s to %s", word(fields, 1), word(fields, 2))
with_slope(label, slope) = strlen(slope) == 0 ? label : label.", ".slope
# A note for the legend of a curve on which bounds are active, where orders are lower.
bounds_note(name, where, quantity) = noted_bounds(slope_fields(name, where, quantity, "active"))
noted_bounds(read) = strlen(read) == 0 ? "" : ", bounds on ".read." active"

# --- How a table was made --------------------------------------------------------------------------------------------
# A value of the run's metadata, results/NAME.json, as text; empty if it is missing.
told(name, key) = system(sprintf("sed -n 's/^  \"%s\": \"*\\([^\",]*\\)\"*,*$/\\1/p' '%s/%s.json' 2>/dev/null",\
    key, results, name))
# The run that wrote a table: the longest beginning of the table's name with metadata next to it; empty if there is none.
run_of(name) = strlen(name) == 0 ? "" : system(sprintf("test -s '%s/%s.json' && echo 1", results, name)) ne "" ? name\
    : run_of(system("echo '".name."' | sed 's/_*[^_]*$//'"))
# The note of a figure on a table whose run did not come to its end; empty if it did, or if unknown.
incomplete_run(name) = told(run_of(name), "complete") eq "false" ? what_is_there(run_of(name)) : ""
what_is_there(run) = run.".csv: ".(strlen(told(run, "cases")) == 0 ? "its run has not ended"\
    : told(run, "rows")." of ".told(run, "cases")." rows, its run was interrupted")
incomplete = ""
start_in_words(start) = start eq "common" ? "Warm start"\
    : start eq "guess" ? "Cold start" : strlen(start) == 0 ? "" : "Start from a file"
# "Warm start; tolerance 1e-10", and over how many solves the medians of times go.
conditions(name) = joined(start_in_words(told(name, "start")), labelled("tolerance ", told(name, "tolerance")))
timed_conditions(name) = joined(conditions(name), number_of_solves(told(name, "repeats")))
number_of_solves(repeats) = strlen(repeats) == 0 ? "" : repeats eq "1" ? "times of single solves"\
    : "times are medians of ".repeats." solves"
labelled(label, text) = strlen(text) == 0 ? "" : label.text
joined(a, b) = a.(strlen(a) == 0 || strlen(b) == 0 ? "" : "; ").b
sentence(text) = strlen(text) == 0 ? "" : text.". "
# The label of the paper's figure that a figure repeats, as a sentence; its underscores are no subscripts.
of_paper(problem, orbit, two_link) = for_paper(problem, labelled("Paper: section 4.2.1, ", orbit),\
    labelled("Paper: section 4.2.2, ", two_link))
# A sentence about the paper's first problem or about its second; empty for any other.
for_paper(problem, orbit, two_link) = problem eq "orbital_transfer" ? sentence(orbit)\
    : problem eq "two_link_manipulator" ? sentence(two_link) : ""
# Where the paper treats what a figure shows; empty for problems that are not the paper's.
paper_note(problem, where) = for_paper(problem, "Paper: ".where, "Paper: ".where)
# What errors of a table are measured against.
reference_words(name, where) = with_grid(or_else(told(name, "reference"), "the finest grid of the same method"),\
    finest_grid(name, where))
with_grid(reference, grid) =\
    strstrt(reference, "finest grid") == 0 || strlen(grid) == 0 ? reference : reference." (".grid.")"
# "N = 1024, h = 0.00286" of the finest grid of a table.
finest_grid(name, where) = in_words_of_grid(system(rows_awk("-v take=all -v branches=any -v where='".where."'", name).\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i == \"intervals\") n = i; if ($i == \"step\") h = i }; next }\
                 $n + 0 > most { most = $n + 0; step = $h } END { if (most > 0) print most, step }'"))
in_words_of_grid(fields) = words(fields) < 2 ? "" : sprintf("N = %s, h = %.3g", word(fields, 1), number(word(fields, 2)))

# --- Names and units -------------------------------------------------------------------------------------------------
described(problem, column) = system(sprintf("awk -F, '\
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"%s\") c = i } $1 == \"%s\" { print $c }' '%s/problems.csv'",\
    column, problem, plots))
plain_label(problem) = system("echo '".problem."' | awk '\
    { gsub(/_/, \" \"); print toupper(substr($0, 1, 1)) substr($0, 2) }'")
solver_label(solver) = solver eq "interior_point" ? "interior point" : solver
or_else(text, default) = strlen(text) > 0 ? text : default
problem_label(problem) = or_else(described(problem, "label"), plain_label(problem))
# A unit that is also the symbol of the quantity is spelled out.
with_unit(text, unit) = strlen(unit) == 0 ? text : unit eq "dimensionless" ? text." (dimensionless)"\
    : text." [".(unit eq "h" ? "hours" : unit)."]"
axis_label(text, problem, column) = with_unit(text, described(problem, column))

# Families of methods: a method has the name of its family, or begins with it: multiple_shooting_rk4_2 is "Multiple shooting,
# rk4, 2 steps". Other methods keep their names.
load plots."/families.inc"
family_of(method) = sum [i_family = 1:words(families)] (strstrt(method."_", word(families, i_family)."_") == 1 ? i_family : 0)
method_label(method) = family_of(method) == 0 ? method\
    : strstrt(method, "galerkin_") == 1 ? "Galerkin".spaces_label(method[10:*])\
    : family_labels[family_of(method)].integration_label(method[strlen(word(families, family_of(method))) + 2:*])
# "degree 2, controls 1 shared" of a Galerkin variational integrator, "rk4, 2 steps" of shooting.
spaces_label(spaces) = strstrt(spaces, "_") == 0 ? "" : ", degree ".spaces[1:strstrt(spaces, "_") - 1].", controls "\
    .(strstrt(after_bar(spaces), "_") == 0 ? after_bar(spaces) : up_to_bar(after_bar(spaces))." ".after_bar(after_bar(spaces)))
up_to_bar(text) = text[1:strstrt(text, "_") - 1]
integration_label(integration) = strstrt(integration, "_") == 0 ? ""\
    : ", ".integration[1:strstrt(integration, "_") - 1].steps_label(after_bar(integration))
after_bar(text) = text[strstrt(text, "_") + 1:*]
steps_label(steps) = steps eq "1" ? "" : ", ".steps." steps"
method_style(method) = family_of(method) == 0 ? 4 : family_styles[family_of(method)]
# Tableau, stages and solver are named only where one figure shows several of them.
several(name, where, column) = words(distinct(name, column, "problem=".entry(where, "problem"), "")) > 1
curve_label(name, where) = method_label(entry(where, "method"))\
    .(several(name, where, "tableau") ? ", ".entry(where, "tableau") : "")\
    .(several(name, where, "stages") ? ", s = ".entry(where, "stages") : "")\
    .(several(name, where, "solver") ? ", ".entry(where, "solver") : "")

# --- Style -----------------------------------------------------------------------------------------------------------
# Colours of Okabe and Ito. DMOC and Hamiltonian collocation often coincide: filled discs on a broad line below,
# large open circles on a dashed line above, so that both stay visible.
blue = "#0072B2"; vermilion = "#D55E00"; green = "#009E73"; purple = "#CC79A7"; orange = "#E69F00"; sky = "#56B4E9"
black = "#202020"; grey = "#707070"
set linetype 1 linecolor rgb blue linewidth 3.0 dashtype 1 pointtype 7 pointsize 0.6
set linetype 2 linecolor rgb vermilion linewidth 1.5 dashtype (6, 5) pointtype 6 pointsize 1.15
set linetype 3 linecolor rgb green linewidth 1.5 dashtype (10, 4, 2, 4) pointtype 9 pointsize 0.85
set linetype 4 linecolor rgb purple linewidth 1.5 dashtype (2, 3) pointtype 5 pointsize 0.7
set linetype 5 linecolor rgb orange linewidth 1.5 dashtype 1 pointtype 13 pointsize 0.8
set linetype 6 linecolor rgb sky linewidth 1.5 dashtype 1 pointtype 11 pointsize 0.8
set linetype 7 linecolor rgb black linewidth 1.5 dashtype (4, 3) pointtype 4 pointsize 0.8
set linetype 8 linecolor rgb grey linewidth 1.2 dashtype (8, 5)
set linetype 9 linecolor rgb grey linewidth 1.2 dashtype (2, 4)
# Families have the line types 1 to 7; their colours and points for figures that draw methods otherwise.
style_colours = blue." ".vermilion." ".green." ".purple." ".orange." ".sky." ".black
method_colour(method) = word(style_colours, method_style(method))
method_points(method) = int(word("7 6 9 5 13 11 4", method_style(method)))

set border 3 linecolor rgb "#404040" linewidth 1
set tics nomirror out scale 0.8, 0.4 textcolor rgb "#202020"
set grid xtics ytics linecolor rgb "#DADADA" linewidth 1 dashtype 1
set key reverse Left samplen 3.5 spacing 1.25 width 1 noautotitle font ",13"
set style fill solid 1.0 noborder
# Title: what is drawn in bold, and two remarks below, together two lines at most (tests/style/figures). A title
# makes no claim: results are in legends, as numbers of the tables. Remarks hold no indices by _ or ^, which would
# be smaller than the smallest text.
remark(line) = strlen(line) == 0 ? "" : "\n{/*0.8 ".wrapped(line, 107, "}\n{/*0.8 ")."}"
title_text(title, first, second) = "{/:Bold ".wrapped(title, 76, "}\n{/:Bold ")."}"\
    .remark(first.(strlen(first) * strlen(second) == 0 ? "" : " ").second)
wrapped(text, most, separator) = strlen(text) <= most ? text : wrapped_at(text, last_space(text, most + 1), most, separator)
wrapped_at(text, end, most, separator) =\
    end == 0 ? text : text[1:end - 1].separator.wrapped(text[end + 1:*], most, separator)
last_space(text, end) = end == 0 || text[end:end] eq " " ? end : last_space(text, end - 1)
# A distance between ticks of which an axis of this length has about three: 1, 2 or 5 times a power of ten.
few_ticks(length) = nice(length / 3.0, 10.0**floor(log10(length / 3.0)))
nice(step, power) = power * (step > 3.5 * power ? 5 : step > 1.5 * power ? 2 : 1)
# A whole number from 0 to 9 as an exponent of the size of the text.
exponent(n) = word("⁰ ¹ ² ³ ⁴ ⁵ ⁶ ⁷ ⁸ ⁹", int(n) + 1)
lines_in(text) = strstrt(text, "\n") == 0 ? 1 : 1 + lines_in(text[strstrt(text, "\n") + 1:*])

# Axis of interval numbers: ticks at powers of two, a little room at both ends.
power_tics = "set xtics ("
do for [i = 0:20] { power_tics = power_tics.(i == 0 ? "" : ", ").sprintf("%d", 2**i) }
intervals_axis = "set logscale x 2; ".power_tics."); set format x '%g'; set xlabel 'number of intervals N'"
# To be evaluated: an axis over powers of ten, and a range with room at both ends.
power_axis(axes) = "do for [axis in '".spaced(axes)."'] { eval one_power_axis(axis) }"
spaced(axes) = strlen(axes) == 2 ? axes[1:1]." ".axes[2:2] : axes
one_power_axis(axis) = sprintf("set logscale %s 10; set %stics autofreq; set format %s '10^{%%T}'; set m%stics 10",\
    axis, axis, axis, axis)
plain_axis(axis, high) = sprintf("unset logscale %s; set %stics autofreq; set m%stics default; set format %s '%s'",\
    axis, axis, axis, axis, abs(high) < 0.01 ? '%.3e' : '%g')
# The same with labels at 3·10^k too, for axes of few decades.
finer_tics(axis) = "set ".axis."tics add (".thirds.")"
thirds = ""
do for [k = -16:8] { thirds = thirds.(k == -16 ? "" : ", ").sprintf("'3·10^{%d}' 3e%d", k, k) }
set_range(axis, low, high, factor) = sprintf("set %srange [%.6g:%.6g]", axis, low / factor, high * factor)

error_of(name) = "max_k |".name."_k − ".name."_{ref}(t_k)|"

# To be evaluated: lines and columns of panels below `figure_title`, with room in pixels: for the labels left of the first and
# right of the last panel, for text below them, and between two panels next to and above each other.
panels(lines, columns, left, right, bottom, between, above) = sprintf("set multiplot layout %d, %d title figure_title\
    offset 0, 0.3 margins %g, %g, %g, %g spacing %g, %g", lines, columns, across(left), 1 - across(right), upwards(bottom),\
    1 - upwards(22.5 * lines_in(figure_title) + 44), across(between), upwards(above))
# Pixels as shares of the figure.
across(pixels) = real(pixels) / page_width
upwards(pixels) = real(pixels) / figure_height
# To be evaluated, after `title_above`: one panel between these pixels from the left and from below.
place(left, right, bottom, top) = sprintf("set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g;\
    set tmargin at screen %g", across(left), across(right), upwards(bottom), upwards(top))
title_above = "set multiplot title figure_title offset 0, 0.3"
top_of_panels(figure_title) = figure_height - 22.5 * lines_in(figure_title) - 44
key_below = "set key at screen 0.5, screen 0.01 center bottom vertical maxrows 1 width -2 samplen 2.5 font ',12'"

# --- Output ----------------------------------------------------------------------------------------------------------
# do for [kind in kinds] { eval begin_figure(kind, name, height); plot ...; eval end_figure(kind, name) }
# Every figure is `page_width` pixels wide, which stand for the 16 cm of a printed page: 12 pixels, the smallest text, are 7 pt
# there. Text is 15 pixels high, and its indices by _ and ^ are 12; smaller fonts are for text without indices.
page_width = 770
# The terminal of SVG takes ticks for wider than they are: labels of axes with a margin of their own have `offset inwards`.
# A figure is written under a hidden name, in which `drawer` is the process that may remove it, and renamed when it is
# complete.
if (!exists("drawer")) drawer = "0"
kinds = "svg png"
figures = results."/figures"
hidden(kind, name) = figures."/.".name.".".drawer.".".kind
terminal(kind, height) = kind eq "svg"\
    ? sprintf("set terminal svg size %d, %d enhanced font 'sans-serif,15' background 'white'", page_width, height)\
    : sprintf("set terminal pngcairo size %d, %d enhanced font 'sans-serif,15' fontscale 1.5 linewidth 2 pointscale 3\
        dashlength 1.4", 2 * page_width, 2 * height)
begin_figure(kind, name, height) = sprintf("figure_height = %g; inwards = %g; system \"mkdir -p '%s'\"; %s; set output \"%s\"; %s",\
    height, kind eq "svg" ? 1.5 : 0, figures, terminal(kind, height), hidden(kind, name), stamp)
# Across a figure of an incomplete table, whatever else is drawn there.
stamp = "unset label 901; unset label 902; if (strlen(incomplete) > 0) {\
    set label 901 'INCOMPLETE' at screen 0.5, screen 0.52 center front font ',60' textcolor rgb '#60D55E00';\
    set label 902 incomplete at screen 0.5, screen 0.44 center front noenhanced font ',18' textcolor rgb '#20D55E00' }"
end_figure(kind, name) = sprintf("unset output; system \"%s mv '%s' '%s/%s.%s'\"",\
    kind eq "svg" ? keep_spaces(hidden(kind, name)) : "", hidden(kind, name), figures, name, kind)
# Without this, viewers of SVG drop spaces next to subscripts.
keep_spaces(file) = sprintf("sed -i 's/<text>/<text xml:space=%spreserve%s>/' '%s' &&", '\\\"', '\\\"', file)
