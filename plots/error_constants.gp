# Errors of the replay and of the cost times N^p: measured, and predicted from the exact optimum (section 3.6).
#   gnuplot -e "results='results'" plots/error_constants.gp
# Reads error_constants.csv and error_constants_two_stages.csv, and their limits.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"

columns = "problem,method,tableau,stages,status,branch,intervals,replay_error,predicted_replay_error,objective_error,predicted_objective_error"
eval require("error_constants", columns)
limit(name, where, quantity) = system(rows_awk(sprintf(\
    "-v where='problem=%s,method=%s,tableau=%s,stages=%s,quantity=%s' -v fields=constant", entry(where, "problem"),\
    entry(where, "method"), entry(where, "tableau"), entry(where, "stages"), quantity), name."_limits"))
in_legend(text) = strlen(text) == 0 ? "" : sprintf("%.4g", number(text))
limits_in_words(name, where, quantity) = in_legend(limit(name, where, "predicted_".quantity)).", "\
    .in_legend(limit(name, where, quantity))
scaled(quantity, where) = column(quantity) * column("intervals")**(2 * int(entry(where, "stages")))

do for [name in "error_constants error_constants_two_stages"] {
  if (!exists_table(name)) { continue }
  eval require(name, columns)
  do for [problem_word in problems_of(name, "replay_error")] {
    problem = entry(problem_word, "problem")
    curves = distinct(name, "problem,method,tableau,stages", problem_word, "replay_error")
    power = exponent(2 * int(entry(word(curves, 1), "stages")))
    do for [kind in kinds] {
      eval begin_figure(kind, problem."_".name, 535)
      figure_title = title_text(problem_label(problem).": errors times N".power,\
          "Thin lines: predicted from the exact optimum. Legends: limits, predicted and measured. Gauss, s = "\
          .entry(word(curves, 1), "stages").".", "")
      eval panels(1, 2, 95, 25, 160, 105, 0)
      eval measure(name, problem_word, "intervals", "replay_error")
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.1)
      do for [quantity in "replay_error objective_error"] {
        unset logscale y
        if (quantity eq "replay_error") { set yrange [0:*] } else { set yrange [*:*] }
        set ytics autofreq
        set format y "%g"
        set key at screen (quantity eq "replay_error" ? 0.02 : 0.52), screen upwards(90) left top maxrows auto font ",12"\
            samplen 2.5
        set ylabel (quantity eq "replay_error" ? "replay error" : "error of the cost")." · N".power offset inwards
        plot for [where in curves] rows(name, where, "replay_error")\
               using (column("intervals")):(scaled(quantity, where)) with linespoints linetype method_style(entry(where, "method"))\
               title method_label(entry(where, "method")).": ".limits_in_words(name, where, quantity),\
             for [where in curves] rows(name, where, "replay_error")\
               using (column("intervals")):(scaled("predicted_".quantity, where)) with lines\
               linecolor rgb method_colour(entry(where, "method")) linewidth 1.2 dashtype (2, 3) notitle
      }
      unset multiplot
      eval end_figure(kind, problem."_".name)
    }
  }
}
