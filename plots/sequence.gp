# Time of every step where problems follow each other and each starts from the answer of the one before.
#   gnuplot -e "results='results'" plots/sequence.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("sequence", "problem,method,intervals,sequence,step,status,iterations,microseconds")
eval require("sequence_summary",\
    "problem,method,sequence,median_iterations,p99_iterations,median_microseconds,p99_microseconds,median_cold_iterations")

summary(where, column) = entry(distinct("sequence_summary", column, where, ""), column)
rounded(text) = sprintf("%.0f", number(text))
label(where) = method_label(entry(where, "method")).sprintf(\
    ": iterations %s (cold %s), µs %s, 99 %% below %s", rounded(summary(where, "median_iterations")),\
    summary(where, "median_cold_iterations") eq "" ? "–" : rounded(summary(where, "median_cold_iterations")),\
    rounded(summary(where, "median_microseconds")), rounded(summary(where, "p99_microseconds")))
in_words(sequence) = sequence eq "receding_horizon" ? "Receding horizon with disturbances"\
    : sequence eq "homotopy" ? "Homotopy in a parameter" : sequence

do for [problem_word in problems_of("sequence", "microseconds")] {
  problem = entry(problem_word, "problem")
  sequences = distinct("sequence", "sequence", problem_word, "microseconds")
  grid = entry(distinct("sequence", "intervals", problem_word, ""), "intervals")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_sequence", 420 * words(sequences) + 90)
    figure_title = title_text(problem_label(problem).": time of a warm-started step",\
        "Each solve starts from the previous unknowns and multipliers; interior point, N = ".grid.".",\
        "Medians of iterations and times; the time of a step is the solver’s shortest time over the repeats.")
    eval title_above
    do for [panel = 1:words(sequences)] {
      where = problem_word.",".word(sequences, panel)
      methods = distinct("sequence", "method", where, "microseconds")
      set logscale y 10; set format y "%g"; set ytics autofreq
      set xlabel "step"
      set ylabel "microseconds" offset inwards
      lowest = 420 * (words(sequences) - panel)
      eval place(85, 755, lowest + 145, panel == 1 ? top_of_panels(figure_title) : lowest + 390)
      set key at screen 0.05, screen upwards(lowest + 80) left top font ",12" samplen 1.5
      set title in_words(entry(word(sequences, panel), "sequence"))
      plot for [method in methods] rows("sequence", where.",".method, "microseconds") using "step":"microseconds"\
             with points linecolor rgb method_colour(entry(method, "method")) pointsize 0.5\
             pointtype method_points(entry(method, "method"))\
             title label(where.",".method)
    }
    unset multiplot
    eval end_figure(kind, problem."_sequence")
  }
}
