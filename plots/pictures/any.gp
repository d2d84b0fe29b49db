# For problems without a picture of their own, trajectories by several methods, and iterates of solves that failed: coordinates, controls
# and path constraints over time, a panel per unit, in the units of the problem as solved. Bounds are dotted, bounds at one time are
# bars, path constraints are thick where they are active. Colours are coordinates, dashes are methods; more than four quantities of a
# unit share panels by three. Loaded by motion.gp.
eval require(nodes, "t")
eval require(stages, "t")
eval plain_axes
quantities = motion."_quantities"
# Fields of the table of quantities, as awk has them: characters with a meaning in a shell cannot be part of a name.
fields_of(program) = system("awk -F, 'NR > 1 { gsub(/[^A-Za-z0-9_,^\\/ .+-]/, \"_\"); ".program." }' '".table(quantities)."' 2>/dev/null")
has_quantities = exists_table(quantities)
header(name, stop) = system("head -n 1 '".table(name)."' | awk -F, '\
    { gsub(/[\\140\"$()\\;|&<>]/, \"_\"); for (i = 2; i <= NF && $i !~ /^".stop."/; ++i) print $i }'")
# Panels are words such as q1:N~m, a kind, a number and a unit.
kinds_and_units = has_quantities ? fields_of("gsub(/ /, \"~\", $3); p = $1 \":\" $3; if ($1 != \"t\" && !(p in seen)) print p; seen[p] = 1") : "q: u:"
kind_of(panel) = panel[1:1]
number_of(panel) = int(panel[2:strstrt(panel, ":") - 1])
unit_of(panel) = system("echo '".panel[strstrt(panel, ":") + 1:]."' | tr '~' ' '")
all_columns_of(panel) = !has_quantities ? (kind_of(panel) eq "q" ? header(nodes, "v_") : header(stages, "price_"))\
    : fields_of("if ($1 == \"".kind_of(panel)."\" && $3 == \"".unit_of(panel)."\" && $6 == \"\") print $2")
table_of(member, panel) = member.(kind_of(panel) eq "q" ? "_nodes" : kind_of(panel) eq "u" ? "_stages" : "_constraints")
# How many of n share a panel.
together(n) = n > 4 ? 3 : n
name_at(names, i) = i > words(names) ? "" : word(names, i)
some_of(names, first, count) = count == 0 ? "" : name_at(names, first)." ".some_of(names, first + 1, count - 1)
columns_in(names, k) = some_of(names, 1 + (k - 1) * together(words(names)), together(words(names)))
columns_of(panel) = columns_in(all_columns_of(panel), number_of(panel))
panels = ""
do for [panel in kinds_and_units] {
  names = all_columns_of(panel[1:1]."1".panel[2:])
  do for [k = 1:(words(names) + together(words(names)) - 1) / (words(names) > 0 ? together(words(names)) : 1)] {
    panels = panels." ".panel[1:1].k.panel[2:]
  }
}
kind_label(panel) = kind_of(panel) eq "q" ? "coordinates" : kind_of(panel) eq "u" ? "controls" : "path constraints"
bound(quantity, field) = has_quantities\
    ? fields_of(sprintf("if ($2 == \"%s\" && $1 != \"t\" && $6 == \"\") print $%d", quantity, field)) : ""
# Times, lower and upper bounds at times between the ends, as words.
at_times(quantity) = has_quantities\
    ? fields_of("if ($2 == \"".quantity."\" && $6 != \"\" && $4 != \"\" && $5 != \"\") print $6, $4, $5") : ""
readable(name) = system("echo '".name."' | sed 's/_/ /g'")
time_label = with_unit("time t", has_quantities ? fields_of("if ($1 == \"t\") print $3") : "")
stats table(nodes) using (column("t")) name "T" nooutput
is_open = strlen(failure) > 0
# Line of a quantity by a method.
dash_of(m) = m == 1 ? "linewidth 4 dashtype 1" : m == 2 ? "linewidth 1.5 dashtype (6, 5)"\
    : m == 3 ? "linewidth 1.5 dashtype (10, 4, 2, 4)" : "linewidth 1.5 dashtype (2, 3)"
colour_of(i) = word(style_colours, (i - 1) % words(style_colours) + 1)
pale_colour_of(i) = "#80".colour_of(i)[2:*]
drawn_as(i, m) = words(members) == 1 && !is_open ? sprintf("lines linetype %d", i)\
    : is_open ? sprintf("linespoints linetype %d pointtype 6 pointinterval -20", i)\
    : sprintf("lines %s linecolor rgb '%s'", dash_of(m), m == 1 ? pale_colour_of(i) : colour_of(i))
legend_of_methods = ""
has_one_count = words(members) > 1
do for [count in counts] { has_one_count = has_one_count && count eq word(counts, 1) }
if (words(members) > 1) {
  do for [m = 1:words(members)] {
    legend_of_methods = joined(legend_of_methods, word("broad dashed dash-dotted dotted", m < 4 ? m : 4).": "\
        .method_label(word(methods, m)).(has_one_count ? "" : ", N = ".word(counts, m)))
  }
}

# The legend of a panel is above it, two or three names in a line.
most_names = 1
longest_name = 0
do for [panel in panels] {
  most_names = words(columns_of(panel)) > most_names ? words(columns_of(panel)) : most_names
  do for [name in columns_of(panel)] { longest_name = strlen(name) > longest_name ? strlen(name) : longest_name }
}
names_in_line = longest_name > 6 ? 2 : 3
lines_of_key = (most_names + names_in_line - 1) / names_in_line
rows_of_panels = (words(panels) + 1) / 2
height_of_key = 22 * lines_of_key
figure_title = title_text(problem_label(entry(described, "problem")).(is_open ? ": the last iterate" : words(members) > 1\
    ? ": the optimal trajectories of several methods".(has_one_count ? ", N = ".word(counts, 1) : "") : ": the optimal trajectory and its controls").by_whom, failure, legend_of_methods)
eval begin_figure(kind, problem."_motion", 113 + (227 + height_of_key) * rows_of_panels + 22 * lines_in(figure_title))
eval sprintf("set multiplot layout %d, 2 title figure_title offset 0, 0.3 margins %g, %g, %g, %g spacing %g, %g", rows_of_panels,\
    across(80), 1 - across(20), upwards(75), 1 - upwards(22.5 * lines_in(figure_title) + 14 + height_of_key), across(95),\
    upwards(44 + height_of_key))
set key at graph 0.5, graph 1.03 center bottom horizontal maxcols names_in_line samplen 1.5 width 0 font ",12"
set xrange [T_min:T_max]
set offsets 0, 0, graph 0.05, graph 0.05
do for [p = 1:words(panels)] {
  panel = word(panels, p)
  names = columns_of(panel)
  set ylabel with_unit(kind_label(panel), unit_of(panel)) offset inwards
  set xlabel (p + 2 > words(panels) ? time_label : "")
  # Bounds near the curves; others would compress them.
  low = 1e300; high = -1e300
  do for [i = 1:words(names)] {
    stats table(table_of(motion, panel)) using (column("t")):(column(word(names, i))) name "S" nooutput
    low = S_min_y < low ? S_min_y : low
    high = S_max_y > high ? S_max_y : high
  }
  range = high > low ? high - low : 1.0
  command = ""
  unset arrow
  do for [i = 1:words(names)] {
    name = word(names, i)
    do for [m = 1:words(members)] {
      command = command.sprintf("%s table('%s') using (column('t')):(column('%s')) with %s title '%s'",\
          i * m > 1 ? "," : "", table_of(word(members, m), panel), name, drawn_as(i, m), m == 1 ? readable(name) : "")
    }
    do for [field = 4:5] {
      b = bound(name, field)
      if (strlen(b) > 0) {
        if (number(b) > low - 0.5 * range && number(b) < high + 0.5 * range) {
          command = command.sprintf(", %.10g with lines linetype %d dashtype 3 notitle", number(b), i)
        }
        if (kind_of(panel) eq "h") {
          command = command.sprintf(", table('%s') using (column('t')):(abs(column('%s') - %.10g) < %.10g ? column('%s') : NaN)\
              with linespoints pointtype 7 pointsize 0.3 linewidth 5 linecolor rgb '%s' notitle", table_of(motion, panel), name,\
              number(b), 0.005 * range, name, colour_of(i))
        }
      }
    }
    times = kind_of(panel) eq "q" ? at_times(name) : ""
    do for [k = 1:words(times) / 3] {
      x = T_min + number(word(times, 3 * k - 2)) * (T_max - T_min)
      command = command.sprintf(", '+' using (%.10g):(%.10g):(%.10g):(%.10g) every ::0::0 with yerrorbars pointtype 2 pointsize 1.4\
          linewidth 2 linecolor rgb '%s' notitle", x, 0.5 * (number(word(times, 3 * k - 1)) + number(word(times, 3 * k))),\
          number(word(times, 3 * k - 1)), number(word(times, 3 * k)), colour_of(i))
    }
  }
  eval "plot ".command
}
set offsets
unset multiplot
eval end_figure(kind, problem."_motion")
