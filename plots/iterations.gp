# Minor iterations of the SQP method over the number of intervals: fig:kepler_iterations and fig:twolink_iterations; and
# the cost of collocation in multiples of DMOC's, in every count.
#   gnuplot -e "results='results'" plots/iterations.gp
# Reads iterations.csv with its ratios, iterations_limited_memory.csv with its ratios if they are there; the last figure
# iterations_common_ratios.csv if it is there, else iterations_ratios.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
minor_columns = "problem,method,tableau,stages,solver,status,branch,intervals,minor_iterations,predicted_minors,crash"

# "1.65 times DMOC at N = 256": the ratio of a method's curve on the finest grid.
ratio_fields(name, problem_word, method, currency) = system(rows_awk("-v need=ratio_at_equal_intervals -v where='"\
    .problem_word.",method=".method.",currency=".currency."'", name."_ratios").\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i == \"intervals\") n = i;\
      if ($i == \"ratio_at_equal_intervals\") r = i }; next } { print $n, $r }' | sort -n | tail -n 1")
ratio_text(fields) = words(fields) < 2 ? "" : sprintf(", %.2f × DMOC at N = %s", number(word(fields, 2)), word(fields, 1))
minor_label(name, problem_word, curve, currency) = method_label(entry(curve, "method"))\
    .(exists_table(name."_ratios") ? ratio_text(ratio_fields(name, problem_word, entry(curve, "method"), currency)) : "")
# How many rows stand in the table, and how many of them are drawn.
count_of(take, name, where) = int(system(rows_awk("-v take=".take." -v branches=".(take eq "all" ? "any" : "same")\
    ." -v where='".where."'", name)." | wc -l")) - 1
left_out_text(all, drawn) = all == drawn ? "" : sprintf(" %d of %d solves are not drawn.",\
    all - drawn, all)

do for [name in "iterations iterations_limited_memory"] {
  if (name eq "iterations_limited_memory" && !exists_table(name)) { continue }
  eval require(name, minor_columns)
  figure_of(problem) = problem."_".name
  do for [where in problems_of(name, "minor_iterations")] {
    problem = entry(where, "problem")
    slack = curves_of(name, where.",solver=sqp,crash=none", "minor_iterations")
    crash = curves_of(name, where.",solver=sqp,crash=basis", "minor_iterations")
    with_start(curve, crash) = curve.",crash=".crash
    # Where few rows are left, the others are drawn too: so many iterations took answers that may not be compared.
    others = count_of("''", name, where) < 9 ? system(rows_awk("-v take=drawn -v branches=any -v where='".where\
        .",solver=sqp,crash=none' -v distinct=problem,method,tableau,stages,solver", name)) : ""
    paper_ratio = problem eq "orbital_transfer" ? 1.7 : problem eq "two_link_manipulator" ? 1.5 : NaN
    size(curve, large) = (method_style(entry(curve, "method")) == 2 ? 1.6 : 1.0) * (large ? 1.0 : 0.55)
    eval measure(name, where, "intervals", "minor_iterations")
    unset logscale
    set xtics autofreq; set ytics autofreq; set format x '%g'; set format y '%g'; unset mxtics; unset mytics
    set xlabel "number of intervals N"
    set ylabel "minor iterations of the SQP method"
    set xrange [0:1.03 * x_high]
    set yrange [0:1.5 * y_high]
    set key top left font ",12"
    set title title_text(problem_label(problem).": minor iterations of the SQP method, "\
        .(name eq "iterations" ? "exact" : "quasi-Newton")." Hessian",\
        of_paper(problem, "fig:kepler\\_iterations: 1.7 times as many",\
            "fig:twolink\\_iterations: 1.5 times as many").conditions(name)."."\
        .left_out_text(count_of("all", name, where), count_of("''", name, where)),\
        "Lines: free variables (minus constraints, from a free basis) plus later majors.")
    do for [kind in kinds] {
      eval begin_figure(kind, figure_of(problem), 680)
      plot for [curve in slack] rows(name, with_start(curve, "none"), "minor_iterations")\
             using (column("intervals")):(column("predicted_minors")) with lines\
             linetype method_style(entry(curve, "method")) linewidth 1.2 dashtype 1 notitle,\
           for [k = 1:words(crash)] rows(name, with_start(word(crash, k), "basis"), "minor_iterations")\
             using (column("intervals")):(column("predicted_minors")) with lines\
             linetype method_style(entry(word(crash, k), "method")) linewidth 1.2 dashtype (9, 7) notitle,\
           for [k = 1:(paper_ratio > 1)] rows(name, where.",solver=sqp,crash=none,method=dmoc", "minor_iterations")\
             using (column("intervals")):(paper_ratio * column("predicted_minors")) with lines linetype 8 dashtype (4, 4)\
             title sprintf("paper: %.1f × DMOC", paper_ratio),\
           for [k = 1:words(others)] "< ".rows_awk("-v take=drawn -v branches=any -v where='".word(others, k)\
             .",crash=none'", name) using (column("intervals")):\
             (stringcolumn("branch") eq "same" ? NaN : column("minor_iterations")) with points\
             linetype method_style(entry(word(others, k), "method")) pointtype 2 pointsize 1.1 notitle,\
           keyentry with lines linecolor rgb "white" title "{/:Bold from the slack basis}",\
           for [curve in slack] rows(name, with_start(curve, "none"), "minor_iterations")\
             using (column("intervals")):(column("minor_iterations")) with points\
             linetype method_style(entry(curve, "method")) pointsize size(curve, 1)\
             title minor_label(name, where, curve, "minor_iterations"),\
           keyentry with lines linecolor rgb "white"\
             title (words(crash) > 0 ? "{/:Bold from a first basis chosen without iterations}" : ""),\
           for [k = 1:words(crash)] rows(name, with_start(word(crash, k), "basis"), "minor_iterations")\
             using (column("intervals")):(column("minor_iterations")) with points\
             linetype method_style(entry(word(crash, k), "method")) pointsize size(word(crash, k), 0)\
             title minor_label(name, where, word(crash, k), "minor_iterations_crash_basis")
      eval end_figure(kind, figure_of(problem))
    }
  }
}

name = exists_table("iterations_common_ratios") ? "iterations_common_ratios" : "iterations_ratios"
solves = name eq "iterations_common_ratios" ? "iterations_common" : "iterations"
eval require(name, "problem,method,tableau,stages,intervals,currency,ratio_at_equal_intervals,ratio_at_equal_accuracy")

# Counts in the order of the legend, each with its label, colour, point and size; open points lie around filled ones that
# coincide with them. Times are left to figures of their own.
currencies = "free_variables minor_iterations minor_iterations_crash_basis factor_nonzeros ipopt_iterations"
currency_labels = "'free variables' 'minor iterations, slacks first' 'minor iterations, free basis'\
  'entries of the KKT factor' 'iterations of Ipopt'"
currency_colours = "#000000 #0072B2 #56B4E9 #CC79A7 #E69F00"
currency_points = "7 6 4 13 8"
currency_sizes = "0.7 1.5 1.1 1.0 1.1"
# Hamiltonian collocation has DMOC's solutions: at equal accuracy its grids are the same.
panels = "hamiltonian tangent tangent"
panel_columns = "ratio_at_equal_intervals ratio_at_equal_intervals ratio_at_equal_accuracy"
panel_titles = "'Hamiltonian, same N' 'Tangent-space, same N' 'Tangent-space, same error'"

do for [where in problems_of(name, "ratio_at_equal_intervals")] {
  problem = entry(where, "problem")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_savings", 640)
    figure_title = title_text(problem_label(problem).": cost of collocation in multiples of DMOC’s",\
        for_paper(problem, "Paper: 1.7 in minor iterations (dashed), 5/3 in variables",\
            "Paper: 1.5 in minor iterations (dashed), 3/2 in variables")\
        .conditions(solves).". Above 1, DMOC costs less.",\
        "Replay error: distance from the final state, in the continuous system under the computed control.")
    eval panels(1, 3, 80, 12, 150, 12, 0)
    paper_ratio = problem eq "orbital_transfer" ? 1.7 : problem eq "two_link_manipulator" ? 1.5 : NaN
    low = 1; high = 1
    do for [c = 1:words(currencies)] {
      do for [column_name in "ratio_at_equal_intervals ratio_at_equal_accuracy"] {
        currency = where.",currency=".word(currencies, c)
        if (strlen(distinct(name, "currency", currency, column_name)) > 0) {
          eval measure(name, currency, "intervals", column_name)
          if (y_low < low) { low = y_low }
          if (y_high > high) { high = y_high }
        }
      }
    }
    do for [i = 1:3] {
      method = word(panels, i)
      ratio = word(panel_columns, i)
      conditions_of_panel = where.",method=".method
      eval measure(name, conditions_of_panel, "intervals", "ratio_at_equal_intervals")
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.3)
      set logscale y 2
      set ytics (0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 2.5, 3, 4, 6, 8); set format y '%g'; unset mytics
      set yrange [low / 1.1:high * 1.1]
      set title word(panel_titles, i) font ",14"
      set ylabel (i == 1 ? "collocation / DMOC" : "") offset inwards
      if (i > 1) { set format y "" }
      if (i < 3) { unset key } else { set key at screen 0.5, screen 0.01 center bottom vertical maxrows 3 width -1 font ",12" samplen 2.5 }
      drawn = ""
      do for [c = 1:words(currencies)] {
        currency = conditions_of_panel.",currency=".word(currencies, c)
        if (strlen(distinct(name, "currency", currency, ratio)) > 0) { drawn = drawn." ".c }
      }
      plot 1 with lines linecolor rgb grey linewidth 1 notitle, paper_ratio with lines linetype 8 notitle,\
           for [c in drawn] rows(name, conditions_of_panel.",currency=".word(currencies, number_in(c)), ratio)\
             using (column("intervals")):(column(ratio)) with linespoints\
             linecolor rgb word(currency_colours, number_in(c)) linewidth 1.5 dashtype 1 pointtype int(word(currency_points, number_in(c)))\
             pointsize real(word(currency_sizes, number_in(c))) notitle,\
           for [c = 1:words(currencies)] keyentry with linespoints linecolor rgb word(currency_colours, c) linewidth 1.5\
             dashtype 1 pointtype int(word(currency_points, c)) pointsize real(word(currency_sizes, c))\
             title word(currency_labels, c)
    }
    unset multiplot
    eval end_figure(kind, problem."_savings")
  }
}
