# Distances from the final state of an exact plant under feedback: plans at every sample, and the first plan alone.
#   gnuplot -e "results='results'" plots/closed_loop.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("closed_loop", "problem,method,tableau,stages,intervals,feedback,draw,variables,final_distance")

of_loop(curve, feedback, draw) = rows("closed_loop", curve.",feedback=".feedback.draw, "final_distance")

do for [problem_word in problems_of("closed_loop", "final_distance")] {
  problem = entry(problem_word, "problem")
  curves = distinct("closed_loop", "problem,method,tableau,stages", problem_word.",stages=1", "final_distance")
  if (words(curves) == 0) { continue }
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_closed_loop", 560)
    figure_title = title_text(problem_label(problem).": distance of an exact plant from the final state",\
        "Marks: a new plan at every sample; with disturbances, one mark per draw. Dotted: the first plan alone.", "")
    eval panels(1, 2, 95, 24, 125, 40, 30)
    eval measure("closed_loop", problem_word.",stages=1", "variables", "final_distance")
    do for [panel in "without with"] {
      eval power_axis("xy")
      eval finer_tics("x")
      eval set_range("x", x_low, x_high, 1.2)
      eval set_range("y", y_low, y_high, 2)
      set xlabel "free variables of a plan"
      set title panel." disturbances"
      if (panel eq "without") {
        eval key_below
        set ylabel "|(q, v)(T) − (q, v)^T|" offset inwards
        plot for [curve in curves] of_loop(curve, "open", ",draw=0") using "variables":"final_distance"\
               with lines linecolor rgb method_colour(entry(curve, "method")) dashtype (2, 3) linewidth 1.5 notitle,\
             for [curve in curves] of_loop(curve, "closed", ",draw=0") using "variables":"final_distance"\
               with linespoints linetype method_style(entry(curve, "method")) title method_label(entry(curve, "method"))
      } else {
        unset key; unset ylabel
        plot for [curve in curves] of_loop(curve, "closed", "")\
               using "variables":(column("draw") > 0 ? column("final_distance") : NaN)\
               with points linecolor rgb method_colour(entry(curve, "method"))\
               pointtype method_points(entry(curve, "method")) pointsize 0.6 notitle
      }
    }
    unset multiplot
    eval end_figure(kind, problem."_closed_loop")
  }
}
