# The cost of accuracy: state error over time and over free variables (the paper compares sizes in rem:savings).
#   gnuplot -e "results='results'" plots/work_precision.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("convergence",\
    "problem,method,tableau,stages,solver,status,branch,state_error,seconds,free_variables")

panels = "seconds free_variables"

do for [where in problems_of("convergence", "state_error")] {
  problem = entry(where, "problem")
  curves = curves_of("convergence", where, "state_error")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_work_precision", 600)
    figure_title = title_text(problem_label(problem).": state error over time and over free variables",\
        "Paper: sizes in section 3.4, the remark on savings (rem:savings). ".timed_conditions("convergence").".",\
        "Bars: quartiles of these solves, one after the other. Times from a warm start cover few iterations.")
    eval panels(1, 2, 95, 24, 115, 60, 0)
    set ylabel axis_label("state error ".error_of("q"), problem, "state_unit") offset inwards
    do for [i = 1:2] {
      work = word(panels, i)
      with_bars = ""
      do for [k = 1:words(curves)] {
        if (i == 1 && strlen(distinct("convergence", "method", word(curves, k), "seconds_lower_quartile")) > 0) {
          with_bars = with_bars." ".k
        }
      }
      eval measure("convergence", where, work, "state_error")
      if (strlen(with_bars) > 0) {
        eval measure("convergence", where, "seconds_lower_quartile", "state_error"); lowest = x_low
        eval measure("convergence", where, "seconds_upper_quartile", "state_error"); x_low = lowest
      }
      eval power_axis("xy")
      eval finer_tics("x")
      eval set_range("x", x_low, x_high, 1.3)
      set xlabel (i == 1 ? "time of the solver [s]" : "free variables of the program")
      if (i == 1) { eval key_below } else { unset ylabel; unset key }
      plot for [curve in curves] rows("convergence", curve, "state_error")\
             using (column(work)):(column("state_error"))\
             with linespoints linetype method_style(entry(curve, "method")) title curve_label("convergence", curve),\
           for [k = 1:words(with_bars)] rows("convergence", word(curves, number_in(word(with_bars, k))), "state_error")\
             using (column("seconds")):(column("state_error")):(column("seconds_lower_quartile")):\
             (column("seconds_upper_quartile")) with xerrorbars\
             linetype method_style(entry(word(curves, number_in(word(with_bars, k))), "method")) linewidth 1 dashtype 1
    }
    unset multiplot
    eval end_figure(kind, problem."_work_precision")
  }
}
