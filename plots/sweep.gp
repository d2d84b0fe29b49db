# Cost and iterations over two quantities that a sweep varies, the first two of its --over; and the status where not all
# instances are solved.
#   gnuplot -e "results='results'" plots/sweep.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("sweep", "problem,method,intervals,status,objective,major_iterations,instance")
# The columns after `instance` are the quantities.
quantities = system("awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if (found) print $i; if ($i == \"instance\") found = 1 } }' '"\
    .table("sweep")."'")
if (words(quantities) < 2) { print "only a sweep of two quantities has a map"; exit status 0 }
x = word(quantities, 1)
y = word(quantities, 2)
tried(where) = "< ".rows_awk("-v take=all -v branches=any -v where='".where."'", "sweep")
solutions(where) = "< ".rows_awk("-v take=drawn -v branches=any -v where='".where."'", "sweep")
is(wanted) = stringcolumn("status") eq wanted ? column(y) : NaN
is_coarse(word) = word eq "too coarse" || word eq "violates between stages"
other(height) = (stringcolumn("status") eq "solved") || is_coarse(stringcolumn("status")) ? NaN : height
# Squares that touch where there are few values.
size_of(where) = 11.0 / (1.5 + words(system(rows_awk("-v take=all -v branches=any -v distinct=".y." -v where='".where."'", "sweep"))))

# "mass 1 [kg]": the unit of the column, from the metadata of the run.
axis_of(quantity) = with_unit(system("echo '".quantity."' | tr '_' ' '"), system(sprintf(\
    "sed -n '/^          \"%s\": {/,/^          }/s/.*\"unit\": \"\\(.*\\)\".*/\\1/p' '%s/sweep.json' 2>/dev/null | head -n 1",\
    quantity, results)))
set palette defined (0 "#0b2a4a", 0.35 blue, 0.7 "#9ecae1", 1 "#f4d35e")
do for [where in system(rows_awk("-v take=all -v branches=any -v distinct=problem,method,intervals", "sweep"))] {
  name = entry(where, "problem")."_sweep".(entry(where, "method") eq "dmoc" ? "" : "_".entry(where, "method"))
  stats tried(where) using x name "X" nooutput
  stats solutions(where) using (column("major_iterations")) name "I" nooutput
  all_solved = system(rows_awk("-v take=all -v branches=any -v distinct=status -v where='".where."'", "sweep")) eq "status=solved"
  do for [kind in kinds] {
    eval begin_figure(kind, name, all_solved ? 465 : 800)
    figure_title = title_text(problem_label(entry(where, "problem")).": a sweep over "\
        .system("echo '".x." and ".y."' | tr '_' ' '"), method_label(entry(where, "method")).", N = "\
        .entry(where, "intervals").". ".conditions("sweep").(all_solved ? ". All ".int(I_records)." instances are solved." : ""), "")
    eval panels(all_solved ? 1 : 2, 2, 85, 80, 80, 130, 125)
    set xlabel axis_of(x)
    set ylabel axis_of(y) offset inwards
    set xtics few_ticks(X_max - X_min > 0 ? X_max - X_min : 1)
    set offsets graph 0.08, graph 0.08, graph 0.1, graph 0.1
    unset key
    set title "cost J" offset 0, -0.5
    plot solutions(where) using x:y:"objective" with points pointtype 5 pointsize size_of(where) linecolor palette
    unset ylabel
    set title "iterations" offset 0, -0.5
    if (I_max - I_min < 6) { set cbtics 1 }
    plot solutions(where) using x:y:"major_iterations" with points pointtype 5 pointsize size_of(where) linecolor palette
    set ylabel axis_of(y) offset inwards
    set cbtics autofreq
    if (all_solved) { unset multiplot; eval end_figure(kind, name); continue }
    set title "status" offset 0, -0.5
    set key at graph 1.1, graph 1 left top
    plot tried(where) using x:(is("solved")) with points pointtype 5 pointsize 1 linecolor rgb blue title "solved",\
         tried(where) using x:(is_coarse(stringcolumn("status")) ? column(y) : NaN) with points pointtype 4 pointsize 1 linecolor rgb green\
           title "too coarse, or violates between stages",\
         tried(where) using x:(other(column(y))) with points pointtype 2 pointsize 1 linecolor rgb vermilion\
           title "not solved"
    unset multiplot
    eval end_figure(kind, name)
  }
}
