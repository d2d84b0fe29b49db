# Minor iterations of the SQP method over the number of intervals: fig:kepler_iterations and fig:twolink_iterations; and
# what collocation costs beside DMOC in every currency.
#   gnuplot -e "results='results'" plots/iterations.gp
# Reads iterations.csv; the second figure iterations_common_ratios.csv if it is there, else iterations_ratios.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("iterations",\
    "problem,method,tableau,stages,solver,status,branch,intervals,minor_iterations,predicted_minors,crash")

do for [where in problems_of("iterations", "minor_iterations")] {
  problem = entry(where, "problem")
  slack = curves_of("iterations", where.",solver=sqp,crash=none", "minor_iterations")
  crash = curves_of("iterations", where.",solver=sqp,crash=basis", "minor_iterations")
  with_start(curve, crash) = curve.",crash=".crash
  eval measure("iterations", where, "intervals", "minor_iterations")
  unset logscale
  set xtics autofreq; set ytics autofreq; set format x '%g'; set format y '%g'; unset mxtics; unset mytics
  set xlabel "number of intervals N"
  set ylabel "minor iterations of the SQP method"
  set xrange [0:1.03 * x_high]
  set yrange [0:1.25 * y_high]
  set key top left
  set title title_text(problem_label(problem).": the law of the slack start, one minor iteration per free variable",\
      "and one per later major iteration, is what is counted",\
      words(crash) > 0 ? "With the first basis chosen for free (small marks, broken line) all methods need the same." : "")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_iterations", 900, 600)
    plot for [curve in slack] rows("iterations", with_start(curve, "none"), "minor_iterations")\
           using (column("intervals")):(column("predicted_minors")) with lines linetype method_style(entry(curve, "method"))\
           linewidth 1.2 dashtype 1 notitle,\
         for [curve in crash] rows("iterations", with_start(curve, "basis"), "minor_iterations")\
           using (column("intervals")):(column("predicted_minors")) with lines linetype method_style(entry(curve, "method"))\
           linewidth 1.2 dashtype (9, 7) notitle,\
         for [curve in slack] rows("iterations", with_start(curve, "none"), "minor_iterations")\
           using (column("intervals")):(column("minor_iterations")) with points linetype method_style(entry(curve, "method"))\
           pointsize (method_style(entry(curve, "method")) == 2 ? 1.6 : 1.0) title method_label(entry(curve, "method")),\
         for [curve in crash] rows("iterations", with_start(curve, "basis"), "minor_iterations")\
           using (column("intervals")):(column("minor_iterations")) with points linetype method_style(entry(curve, "method"))\
           pointsize (method_style(entry(curve, "method")) == 2 ? 0.9 : 0.5) notitle,\
         NaN with lines linecolor rgb "#404040" linewidth 1.2 dashtype 1 title "predicted, from the slack basis",\
         words(crash) > 0 ? NaN : 1/0 with lines linecolor rgb "#404040" linewidth 1.2 dashtype (9, 7)\
           title (words(crash) > 0 ? "predicted, first basis chosen for free" : "")
    eval end_figure(kind, problem."_iterations")
  }
}

name = exists_table("iterations_common_ratios") ? "iterations_common_ratios" : "iterations_ratios"
eval require(name, "problem,method,tableau,stages,intervals,currency,ratio_at_equal_intervals,ratio_at_equal_accuracy")

# Currencies in the order of the legend, each with its label, colour and point.
currencies = "free_variables kkt_nonzeros factor_nonzeros minor_iterations minor_iterations_crash_basis sqp_seconds\
  ipopt_iterations ipopt_seconds slsqp_evaluations"
currency_labels = "'free variables' 'entries of the KKT matrix' 'entries of its factor' 'minor iterations, slack basis'\
  'minor iterations, crash basis' 'time of SQP, slack basis' 'iterations of Ipopt' 'time of Ipopt' 'evaluations of SLSQP'"
currency_colours = "#000000 #707070 #CC79A7 #0072B2 #56B4E9 #009E73 #E69F00 #D55E00 #8B4513"
currency_points = "7 6 13 5 4 9 8 11 12"
# Hamiltonian collocation has DMOC's solutions: at equal accuracy its grids are the same.
panels = "hamiltonian tangent tangent"
panel_columns = "ratio_at_equal_intervals ratio_at_equal_intervals ratio_at_equal_accuracy"
panel_titles = "'Hamiltonian, same N' 'Tangent-space, same N' 'Tangent-space, same accuracy'"

do for [where in problems_of(name, "ratio_at_equal_intervals")] {
  problem = entry(where, "problem")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_savings", 1300, 600)
    set multiplot layout 1, 3 title title_text(problem_label(problem).": what collocation costs beside DMOC,",\
        "currency by currency", "Accuracy is the error of the replayed motion at its end; both methods start from one motion.")\
        offset 0, -0.4 margins 0.065, 0.775, 0.12, 0.8 spacing 0.025
    do for [i = 1:3] {
      method = word(panels, i)
      ratio = word(panel_columns, i)
      conditions = where.",method=".method
      eval measure(name, conditions, "intervals", "ratio_at_equal_intervals")
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.3)
      set logscale y 2
      set ytics (0.5, 0.75, 1, 1.5, 2, 3, 4); set format y '%g'; unset mytics
      set yrange [0.4:4.5]
      set title word(panel_titles, i) font ",14"
      set ylabel (i == 1 ? "cost of collocation / cost of DMOC" : "")
      if (i > 1) { set format y "" }
      if (i < 3) { unset key } else { set key at screen 0.785, graph 1 left top font ",12" samplen 2.5 }
      drawn = ""
      do for [c = 1:words(currencies)] {
        currency = conditions.",currency=".word(currencies, c)
        if (strlen(distinct(name, "currency", currency, ratio)) > 0) { drawn = drawn." ".c }
      }
      plot 1 with lines linecolor rgb grey linewidth 1 notitle,\
           for [c in drawn] rows(name, conditions.",currency=".word(currencies, c + 0), ratio)\
             using (column("intervals")):(column(ratio)) with linespoints\
             linecolor rgb word(currency_colours, c + 0) linewidth 1.8 dashtype 1 pointtype int(word(currency_points, c + 0))\
             pointsize 0.8 title word(currency_labels, c + 0)
    }
    unset multiplot
    eval end_figure(kind, problem."_savings")
  }
}
