# Errors of the optimal cost over the steps per revolution, one panel per number of revolutions: low thrust over long
# horizons.
#   gnuplot -e "results='results'" plots/low_thrust.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("low_thrust", "problem,method,revolutions,steps_per_revolution,cost_error,momentum_defect,replay_error,reference")

drawn_methods = distinct("low_thrust", "method", "", "cost_error")
# Two integrators of one family.
style_here(method) = strstrt(method, "multiple_shooting_rk4") == 1 ? 5 : method_style(method)
# "indirect solution, 12.1 digits".
reference_label(panel) = (entry(panel, "reference") eq "indirect" ? "indirect solution" : "two methods").", "\
    .sprintf("%.1f digits", number(entry(panel, "reference_digits")))

do for [problem_word in problems_of("low_thrust", "cost_error")] {
  problem = entry(problem_word, "problem")
  panels = distinct("low_thrust", "revolutions,reference,reference_digits", problem_word, "cost_error")
  columns_of_figure = words(panels) < 2 ? 1 : 2
  lines_of_figure = (words(panels) + columns_of_figure - 1) / columns_of_figure
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_low_thrust", 400 * lines_of_figure + 210)
    figure_title = title_text(problem_label(problem)." with many revolutions: error of the optimal cost",\
        for_paper(problem, "Paper: section 4.2.1, one revolution", "")."One Gauss stage or one step of shooting per interval.",\
        "Titles state J*: of the indirect solution, or of two methods that agree. All solves have the same start.")
    eval panels(lines_of_figure, columns_of_figure, 90, 15, 165, 80, 110)
    do for [panel in panels] {
      where = problem_word.",revolutions=".entry(panel, "revolutions")
      unset logscale
      set autoscale
      eval power_axis("y")
      set logscale x 2
      set xtics (4, 8, 12, 16, 24, 32, 48, 64, 96, 128)
      set format x '%g'
      set xrange [7:36]
      set xlabel "steps per revolution"
      set ylabel "|J − J*| / J*" offset inwards
      set key at screen 0.5, screen 0.01 center bottom vertical maxrows 3 width 0 font ",12"
      set title entry(panel, "revolutions")." revolutions; ".reference_label(panel) font ",12"
      plot for [one in drawn_methods] rows("low_thrust", where.",".one, "cost_error")\
             using "steps_per_revolution":"cost_error"\
             with linespoints linetype style_here(entry(one, "method")) title method_label(entry(one, "method"))
    }
    unset multiplot
    eval end_figure(kind, problem."_low_thrust")
  }
}
