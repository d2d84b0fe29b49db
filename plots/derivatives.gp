# Effort and accuracy of a solve with each back end of derivatives: section 4.1, "Automatic Differentiation".
#   gnuplot -e "results='results'" plots/derivatives.gp
# Reads derivatives.csv, and derivatives_quasi_newton.csv if it is there.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("derivatives",\
    "problem,method,tableau,stages,solver,derivatives,hessian,status,branch,intervals,seconds,kkt_residual")

# One style per back end; filled and joined where solved, open and alone where not.
names = "tape adolc finite_differences forward_differences"
colour(i) = i == 1 ? blue : i == 2 ? vermilion : i == 3 ? green : i == 4 ? purple : i == 5 ? orange : sky
filled(i) = word("7 5 9 11 13 15", i) + 0
open(i) = filled(i) - 1
label_of(i) = i == 1 ? "tape (exact, ours)" : i == 2 ? "ADOL-C (exact)" : i == 3 ? "central differences"\
    : i == 4 ? "forward differences" : i == 5 ? "tape, quasi-Newton Hessian" : "forward differences, quasi-Newton Hessian"
dashes(i) = i > 4 ? 2 : 1  # of a quasi-Newton Hessian
curve_of(i) = i == 5 ? "derivatives=tape,hessian=limited_memory"\
    : i == 6 ? "derivatives=forward_differences,hessian=limited_memory"\
    : "derivatives=".word(names, i).",hessian=exact"

further = exists_table("derivatives_quasi_newton") ? "derivatives_quasi_newton" : ""
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
  do for [i = 1:6] {
    if (counted("all", everything.",".curve_of(i), "seconds") > 0) { shown = shown." ".i }
  }
  columns_of_panels = words(methods)
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_derivatives", 900)
    figure_title = title_text(problem_label(problem)\
        .": solves by exact derivatives and by differences, ".solver_label(entry(scheme, "solver")),\
        "Paper: “Automatic Differentiation”, section 4.1. ".timed_conditions("derivatives").".",\
        "Bars: quartiles of the rounds".(strlen(further) > 0 ? " (quasi-Newton: one solve)" : "")\
        .". Open markers: not solved to that tolerance; the time spent and the residual reached.")
    eval panels(2, columns_of_panels, 95, 15, 155, 12, 25)
    do for [q = 1:2] {
      quantity = word(quantities, q)
      do for [m = 1:columns_of_panels] {
        where = everything.",".word(methods, m)
        solved = ""; unsolved = ""; with_bars = ""
        do for [i = 1:6] {
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
          set key at screen 0.5, screen 0.008 center bottom vertical maxrows 3 width -3 font ",12" samplen 2.5
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
