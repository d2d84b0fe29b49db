# Times of whole solves over the number of intervals: by interior_point and by Ipopt, and their ratio.
#   gnuplot -e "results='results'" plots/speed_solves.gp
# Reads speed_solves.csv and speed_solves_ratios.csv (bench/speed/page solves.json --csv results/speed_solves.csv); draws
# nothing if they are not there, or for cases left out of that run.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
if (!exists_table("speed_solves")) { exit }
eval require("speed_solves", "problem,method,intervals,solver,threads,solved,ns_per_interval_iteration")
eval require("speed_solves_ratios", "problem,method,intervals,quantity,ratio")

on_grids = "orbital_transfer two_link_manipulator two_link_manipulator_bounded"
methods = paper_families
solvers = "interior_point ipopt"
solver_label(s) = word("'interior\\_point' Ipopt", s)
colour(m) = word(blue." ".vermilion." ".green, m)
marker(m, s) = int(word(s == 1 ? "7 5 9" : "6 4 8", m))  # filled: interior_point
dashes(s) = word("'1' '(6, 4)'", s)
times(problem, m, s) = sprintf("problem=%s,method=%s,solver=%s,threads=1", problem, word(methods, m), word(solvers, s))
ratios(problem, m) = sprintf("problem=%s,method=%s,quantity=solver", problem, word(methods, m))
here(name, where, need) = strlen(distinct(name, "problem", where, need)) > 0
# A line style from text cannot stand in a plot with iteration.
do for [m = 1:3] { do for [s = 1:2] {
  eval sprintf("set linetype %d linecolor rgb '%s' linewidth %g dashtype %s pointtype %d pointsize %g",\
      20 + 2 * m + s, colour(m), (m == 1 ? 2.4 : 1.4), dashes(s), marker(m, s), (m == 1 ? 1.0 : 0.8))
} }
# From 64 to a million; there is no room for the number of every grid.
grids_axis = "set logscale x 2; unset mxtics; set format x '%g'; set xrange [45:1.5e6]; set xlabel 'number of intervals N';\
    set xtics ('64' 64, '' 256, '1024' 1024, '' 4096, '16384' 16384, '' 65536, '' 262144, '2^{20}' 1048576)"

# --- Time per interval and iteration ---------------------------------------------------------------------------------
drawn = ""
do for [problem in on_grids] {
  if (here("speed_solves", "problem=".problem.",threads=1", "solved")) { drawn = drawn." ".problem }
}
if (words(drawn) > 0) {
  do for [kind in kinds] {
    eval begin_figure(kind, "speed_solves", 600)
    figure_title = title_text("Time of a solve per interval and iteration", "",\
        "One thread, tolerance 1e-10, from the problem's own guess; unsolved cases are left out. Smaller is better.")
    eval panels(1, words(drawn), 105, 25, 150, 30, 0)
    do for [p = 1:words(drawn)] {
      problem = word(drawn, p)
      unset logscale; set autoscale; unset label
      eval power_axis("y")
      set format y (p == 1 ? "%g" : "")
      eval grids_axis
      set yrange [50:200000]
      set title problem_label(problem) font ",12"
      set ylabel (p == 1 ? "time per interval and iteration [ns]" : "") offset inwards
      unset key
      if (p == 1) { set key at screen 0.5, screen 0.015 center bottom vertical maxrows 3 width 0 font ",12" }
      shown = ""
      do for [c = 3:8] {
        if (here("speed_solves", times(problem, (c - 1) / 2, (c - 1) % 2 + 1), "solved")) {
          shown = shown.sprintf(" %d", c)
        }
      }
      plot for [c in shown] rows("speed_solves", times(problem, (int(c) - 1) / 2, (int(c) - 1) % 2 + 1), "solved")\
               using (column("intervals")):(column("ns_per_interval_iteration"))\
               with linespoints linetype 20 + int(c),\
           for [m = 1:3] for [s = 1:2] keyentry with linespoints linetype 20 + 2 * m + s\
               title method_label(word(methods, m)).", ".solver_label(s)
    }
    unset multiplot
    eval end_figure(kind, "speed_solves")
  }
}

# --- How many times faster than Ipopt --------------------------------------------------------------------------------
drawn = ""
do for [problem in on_grids] {
  if (here("speed_solves_ratios", "problem=".problem.",quantity=solver", "ratio")) { drawn = drawn." ".problem }
}
if (words(drawn) == 0) { exit }
do for [kind in kinds] {
  eval begin_figure(kind, "speed_solves_ratio", 560)
  figure_title = title_text("Ratio of the times of Ipopt and interior\\_point", "",\
      "Medians of whole solves, one thread; only where both solved and their costs agree to 1e-9.")
  eval panels(1, words(drawn), 80, 25, 110, 30, 0)
  do for [p = 1:words(drawn)] {
    problem = word(drawn, p)
    unset logscale; set autoscale; unset label
    eval power_axis("y")
    set ytics (1, 2, 5, 10, 20, 50, 100, 200, 500)
    set format y (p == 1 ? "%g" : "")
    eval grids_axis
    set xrange [45:24000]
    set yrange [5:500]
    set title problem_label(problem) font ",12"
    set ylabel (p == 1 ? "seconds of Ipopt / seconds of interior\\_point" : "") offset inwards
    unset key
    if (p == 1) { eval key_below }
    shown = ""
    do for [m = 1:3] {
      if (here("speed_solves_ratios", ratios(problem, m), "ratio")) { shown = shown.sprintf(" %d", m) }
    }
    plot for [m in shown] rows("speed_solves_ratios", ratios(problem, int(m)), "ratio")\
             using (column("intervals")):(column("ratio")) with linespoints linetype 21 + 2 * int(m),\
         for [m = 1:3] keyentry with linespoints linetype 21 + 2 * m title method_label(word(methods, m))
  }
  unset multiplot
  eval end_figure(kind, "speed_solves_ratio")
}
