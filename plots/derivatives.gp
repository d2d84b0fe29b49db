# Effort and accuracy of a solve with each back end of derivatives: section 4.1, "Automatic Differentiation".
#   gnuplot -e "results='results'" plots/derivatives.gp
# Reads derivatives.csv, and derivatives_quasi_newton.csv if it is there.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("derivatives",\
    "problem,method,tableau,stages,solver,derivatives,hessian,status,branch,intervals,seconds,kkt_residual")

# One colour per back end, dashed with a quasi-Newton Hessian; filled and joined where solved, open and alone where not.
names = "tape adolc adolc_whole finite_differences forward_differences dense_differences tape adolc_whole\
 forward_differences dense_differences"
curves = 10
backend(i) = i < 7 ? i : i == 7 ? 1 : i == 8 ? 3 : i - 4
colour(i) = backend(i) == 1 ? blue : backend(i) == 2 ? vermilion : backend(i) == 3 ? orange : backend(i) == 4 ? green\
    : backend(i) == 5 ? purple : sky
filled(i) = word("7 5 9 11 13 15", backend(i)) + 0
open(i) = filled(i) - 1
back_end_label(i) = i == 1 ? "tape" : i == 2 ? "ADOL-C by interval" : i == 3 ? "ADOL-C once" : i == 4 ? "central differences"\
    : i == 5 ? "forward differences" : "dense differences"
label_of(i) = back_end_label(backend(i)).(i > 6 ? ", quasi-Newton" : "")
dashes(i) = i > 6 ? 2 : 1

further = exists_table("derivatives_quasi_newton") ? "derivatives_quasi_newton" : ""
# Several tolerances would be several points on a grid.
loosest = strlen(further) == 0 ? "" : word(system(rows_awk("-v take=all -v distinct=tolerance", further)), 1)
curve_of(i) = "derivatives=".word(names, i).(i > 6 ? ",hessian=limited_memory,".loosest : ",hessian=exact")
picked(take, where, need, name) = rows_awk("-v take=".take." -v where='".where."' -v need=".need, name)
taken_by(take, where, need) = picked(take, where, need, "derivatives")\
    .(strlen(further) == 0 ? "" : "; ".picked(take, where, need, further)." | tail -n +2")
taken(take, where, need) = "< ".taken_by(take, where, need)
counted(take, where, need) = system("{ ".taken_by(take, where, need)."; } | wc -l") - 1

quantities = "seconds kkt_residual"
problems = system(rows_awk("-v take=all -v distinct=problem -v need=seconds", "derivatives"))

do for [problem_word in problems] {
  problem = entry(problem_word, "problem")
  methods = system(rows_awk("-v take=all -v distinct=method -v where='".problem_word."'", "derivatives"))
  scheme = word(system(rows_awk("-v take=all -v distinct=tableau,stages,solver -v where='".problem_word."'",\
      "derivatives")), 1)
  everything = problem_word.",".scheme
  shown = ""
  do for [i = 1:curves] {
    if (counted("all", everything.",".curve_of(i), "seconds") > 0) { shown = shown." ".i }
  }
  columns_of_panels = words(methods)
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_derivatives", 948)
    figure_title = title_text(problem_label(problem)\
        .": solves with exact derivatives and differences, ".solver_label(entry(scheme, "solver")),\
        paper_note(problem, "section 4.1").timed_conditions("derivatives").".",\
        (told("derivatives", "repeats") eq "1" ? "" : "Bars: quartiles. ").(strlen(further) > 0 ? "Dashed: quasi-Newton, tolerance ".entry(loosest, "tolerance")."." : "")\
        ." Open: not solved (time spent, residual reached).")
    eval panels(2, columns_of_panels, 95, 15, 203, 12, 25)
    do for [q = 1:2] {
      quantity = word(quantities, q)
      do for [m = 1:columns_of_panels] {
        where = everything.",".word(methods, m)
        solved = ""; unsolved = ""; with_bars = ""
        do for [i = 1:curves] {
          if (counted("''", where.",".curve_of(i), quantity) > 0) { solved = solved." ".i }
          if (counted("unsolved", where.",".curve_of(i), quantity) > 0) { unsolved = unsolved." ".i }
          if (q == 1 && counted("''", where.",".curve_of(i), "seconds_lower_quartile") > 0) { with_bars = with_bars." ".i }
        }
        unset logscale; set autoscale
        stats taken("all", everything, quantity) using (column("intervals")):(column(quantity)) name 'S' nooutput
        eval intervals_axis
        eval power_axis("y")
        eval set_range("x", S_min_x, S_max_x, 1.25)
        eval set_range("y", S_min_y, S_max_y, q == 1 ? 1.6 : 4)
        if (m > 1) { set format y "" }
        set title (q == 1 ? method_label(entry(word(methods, m), "method")) : "") font ",12" offset 0, -0.6
        set xlabel (q == 2 ? "number of intervals N" : "")
        if (q == 1) { set format x "" }
        set ylabel (m > 1 ? "" : q == 1 ? "time of the solver [s]" : "KKT residual, exact derivatives") offset inwards
        if (q == 1 && m == 1) {
          set key at screen 0.5, screen 0.008 center bottom vertical maxrows 5 width -4 font ",12" samplen 2.5
        } else { unset key }
        plot for [i in shown] keyentry with linespoints linecolor rgb colour(number_in(i)) linewidth 1.5 dashtype dashes(number_in(i))\
                 pointtype filled(number_in(i)) pointsize 0.75 title label_of(number_in(i)),\
             NaN notitle,\
             for [i in solved] taken("''", where.",".curve_of(number_in(i)), quantity)\
                 using (column("intervals")):(column(quantity))\
                 with linespoints linecolor rgb colour(number_in(i)) linewidth 1.5 dashtype dashes(number_in(i))\
                 pointtype filled(number_in(i)) pointsize 0.75,\
             for [k = 1:words(with_bars)] taken("''", where.",".curve_of(number_in(word(with_bars, k))), "seconds_lower_quartile")\
                 using (column("intervals")):(column("seconds")):(column("seconds_lower_quartile")):\
                 (column("seconds_upper_quartile")) with yerrorbars linecolor rgb colour(number_in(word(with_bars, k))) linewidth 1.2 dashtype 1\
                 pointtype filled(number_in(word(with_bars, k))) pointsize 0.75,\
             for [i in unsolved] taken("unsolved", where.",".curve_of(number_in(i)), quantity)\
                 using (column("intervals")):(column(quantity))\
                 with points linecolor rgb colour(number_in(i)) linewidth 1 pointtype open(number_in(i)) pointsize 0.9
      }
    }
    unset multiplot
    eval end_figure(kind, problem."_derivatives")
  }
}
