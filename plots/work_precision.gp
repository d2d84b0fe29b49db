# The cost of accuracy: state error over free variables (the paper compares sizes in rem:savings), and over time where solves
# are long enough to be timed, and were timed more than once.
#   gnuplot -e "results='results'" plots/work_precision.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("convergence",\
    "problem,method,tableau,stages,solver,status,branch,state_error,seconds,free_variables")

long_enough = 0.1  # seconds on the finest grids; other times are those of a busy machine

do for [where in problems_of("convergence", "state_error")] {
  problem = entry(where, "problem")
  curves = curves_of("convergence", where, "state_error")
  eval measure("convergence", where, "seconds", "state_error")
  is_timed = told("convergence", "repeats") ne "1" && x_high > long_enough
  panels = is_timed ? "free_variables seconds" : "free_variables"
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_work_precision", 600)
    figure_title = title_text(problem_label(problem).": state error over ".(is_timed ? "free variables and time" : "free variables"),\
        paper_note(problem, "section 3.4, rem:savings").(is_timed ? timed_conditions("convergence") : conditions("convergence")).".",\
        is_timed ? "Bars: quartiles over repeated solves. Warm starts take few iterations." : "")
    eval panels(1, words(panels), 95, 24, 115, 60, 0)
    set ylabel axis_label("state error ".error_of("q"), problem, "state_unit") offset inwards
    do for [work in panels] {
      with_bars = ""
      do for [k = 1:words(curves)] {
        if (work eq "seconds" && strlen(distinct("convergence", "method", word(curves, k), "seconds_lower_quartile")) > 0) {
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
      set xlabel (work eq "seconds" ? "time of the solver [s]" : "free variables of the program")
      if (work eq "free_variables") { eval key_below } else { unset ylabel; unset key }
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
