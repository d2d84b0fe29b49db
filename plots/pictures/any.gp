# For problems without a picture of their own, and for iterates of solves that failed: coordinates, controls and path
# constraints over time, a panel per unit, in the units of the problem as solved. Bounds are dotted. Loaded by motion.gp.
eval require(nodes, "t")
eval require(stages, "t")
eval plain_axes
quantities = motion."_quantities"
# Fields of the table of quantities, as awk has them: characters with a meaning in a shell cannot be part of a name.
fields_of(program) = system("awk -F, 'NR > 1 { gsub(/[^A-Za-z0-9_,^\\/ .+-]/, \"_\"); ".program." }' '".table(quantities)."' 2>/dev/null")
has_quantities = exists_table(quantities)
header(name, stop) = system("head -n 1 '".table(name)."' | awk -F, '\
    { gsub(/[\\140\"$()\\;|&<>]/, \"_\"); for (i = 2; i <= NF && $i !~ /^".stop."/; ++i) print $i }'")
# Panels are words such as q:N~m, a kind and a unit.
panels = has_quantities ? fields_of("gsub(/ /, \"~\", $3); p = $1 \":\" $3; if ($1 != \"t\" && !(p in seen)) print p; seen[p] = 1") : "q: u:"
kind_of(panel) = panel[1:1]
unit_of(panel) = system("echo '".panel[3:]."' | tr '~' ' '")
columns_of(panel) = !has_quantities ? (kind_of(panel) eq "q" ? header(nodes, "v_") : header(stages, " "))\
    : fields_of("if ($1 == \"".kind_of(panel)."\" && $3 == \"".unit_of(panel)."\") print $2")
table_of(panel) = kind_of(panel) eq "q" ? nodes : kind_of(panel) eq "u" ? stages : motion."_constraints"
kind_label(panel) = kind_of(panel) eq "q" ? "coordinates" : kind_of(panel) eq "u" ? "controls" : "path constraints (not below 0)"
bound(quantity, field) = fields_of(sprintf("if ($2 == \"%s\" && $1 != \"t\") print $%d", quantity, field))
readable(name) = system("echo '".name."' | sed 's/_/ /g'")
time_label = with_unit("time t", has_quantities ? fields_of("if ($1 == \"t\") print $3") : "")
stats table(nodes) using (column("t")) name "T" nooutput
is_open = strlen(failure) > 0

rows_of_panels = (words(panels) + 1) / 2
eval begin_figure(kind, problem."_motion", 140 + 330 * rows_of_panels)
figure_title = title_text(problem_label(problem).(is_open ? ": the last iterate" : ": the optimal motion and its controls").by_whom,\
    failure, "")
eval panels(rows_of_panels, 2, 75, 12, 60, 75, 60)
set key at graph 0.5, graph 1.05 center horizontal
set xrange [T_min:T_max]
set xlabel time_label
do for [p = 1:words(panels)] {
  panel = word(panels, p)
  names = columns_of(panel)
  set ylabel with_unit(kind_label(panel), unit_of(panel))
  # Bounds near the curves; others would compress them.
  low = 1e300; high = -1e300
  do for [i = 1:words(names)] {
    stats table(table_of(panel)) using (column("t")):(column(word(names, i))) name "S" nooutput
    low = S_min_y < low ? S_min_y : low
    high = S_max_y > high ? S_max_y : high
  }
  range = high > low ? high - low : 1.0
  command = ""
  do for [i = 1:words(names)] {
    style = is_open ? sprintf("linespoints linetype %d pointtype 6 pointinterval -20", i) : sprintf("lines linetype %d", i)
    command = command.sprintf("%s table(table_of(panel)) using (column('t')):(column('%s')) with %s title readable('%s')",\
        i > 1 ? "," : "", word(names, i), style, word(names, i))
    do for [field = 4:5] {
      b = has_quantities ? bound(word(names, i), field) : ""
      if (strlen(b) > 0) {
        if (number(b) > low - 0.5 * range && number(b) < high + 0.5 * range) {
          command = command.sprintf(", %.10g with lines linetype %d dashtype 3 notitle", number(b), i)
        }
      }
    }
  }
  eval "plot ".command
}
unset multiplot
eval end_figure(kind, problem."_motion")
