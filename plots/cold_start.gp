# Cold starts: how many end in a solved, confirmed and best motion, problem by problem and across the library, and how
# many within a budget of evaluations or time.
#   gnuplot -e "results='results'" plots/cold_start.gp
# Reads cold_start_shares.csv and cold_start_profiles.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
shares = "cold_start_shares"
profiles = "cold_start_profiles"
eval require(shares, "problem,method,tableau,stages,solver,intervals,start_kind,starts,solved_share,solved_lower,".\
    "solved_upper,confirmed_share,confirmed_lower,confirmed_upper,best_share,best_lower,best_upper")
eval require(profiles, "problem,method,tableau,stages,solver,intervals,start_kind,measure,budget,share")

dash(method) = method_style(method) == 1 ? 1 : method_style(method) + 1
counted = "solved confirmed best"
counted_points = "6 7 9"
counted_labels = "'solved' 'solved and confirmed' 'on the best branch'"
place_in(list, text) = sum [k = 1:words(list)] (word(list, k) eq text ? k : 0)
values(column, where) = values_of(distinct(shares, column, where, ""), column)
values_of(found, column) = words(found) == 0 ? "" : system("echo '".found."' | sed 's/".column."=//g'")
steps_of(where, measure, method) = rows(profiles, where.",measure=".measure.",method=".method, "")
what_is_counted = "Solved: an optimum of the discrete program. Confirmed: each interval, replayed alone, joins the next."\
    ." Best: and its cost is the reference’s."
perturbed = "The guess, and that guess with random curves of up to ".told("cold_start", "amplitude")." of its range."
drawn_starts(where) = values_of(distinct(shares, "starts", where, ""), "starts")

# --- A problem by several solvers ------------------------------------------------------------------------------------
do for [problem_word in distinct(shares, "problem", "", "")] {
  problem = entry(problem_word, "problem")
  scheme = word(distinct(shares, "tableau,stages,intervals", problem_word, ""), 1)
  where = problem_word.",".scheme
  solvers = values("solver", where)
  if (words(solvers) < 2) { continue }
  methods = values("method", where)
  # That with the most starts.
  solver_of_profiles = place_in(solvers, "interior_point") > 0 ? "interior_point" : word(solvers, 1)
  x_of(solver, method, c) = place_in(solvers, solver) + 0.27 * (place_in(methods, method) - 2) + 0.07 * (c - 2)
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_cold_start", 1400, 640)
    set multiplot layout 1, 3 title title_text(problem_label(problem).": shares of cold starts, N = ".entry(scheme, "intervals"),\
        what_is_counted,\
        perturbed." Bars are 95 % intervals (Wilson). Tolerance ".told("cold_start", "tolerance").".") offset 0, -0.4
    set lmargin at screen 0.055; set rmargin at screen 0.43; set tmargin at screen 0.8; set bmargin at screen 0.25
    unset logscale
    set xtics nomirror scale 0 () font ",13"
    do for [solver in solvers] {
      set xtics add (sprintf("%s\n%s starts", solver_label(solver), word(drawn_starts(where.",solver=".solver), 1))\
          place_in(solvers, solver))
    }
    set ytics nomirror 0, 0.2, 1; set format y "%.1f"
    set grid noxtics ytics
    set xrange [0.5:words(solvers) + 0.5]
    set yrange [0:1.03]
    set xlabel ""
    set ylabel "share of the cold starts"
    set key at screen 0.24, screen 0.01 center bottom vertical maxrows 3 width 1 font ",12" samplen 2
    plot for [method in methods] for [solver in solvers] for [c = 1:3]\
           rows(shares, where.",solver=".solver.",method=".method, "")\
           using (x_of(solver, method, c)):(column(word(counted, c)."_share")):(column(word(counted, c)."_lower")):\
           (column(word(counted, c)."_upper")) with yerrorbars linecolor rgb method_colour(method) linewidth 1.6 dashtype 1\
           pointtype int(word(counted_points, c)) pointsize 0.9 notitle,\
         for [method in methods] keyentry with lines linecolor rgb method_colour(method) linewidth 3 dashtype 1\
           title method_label(method),\
         for [c = 1:3] keyentry with points linecolor rgb "#202020" pointtype int(word(counted_points, c)) pointsize 0.9\
           title word(counted_labels, c)
    set grid xtics ytics
    unset key
    do for [measure in "evaluations seconds"] {
      is_left = measure eq "evaluations"
      set lmargin at screen (is_left ? 0.5 : 0.755); set rmargin at screen (is_left ? 0.73 : 0.985)
      eval power_axis("x")
      set xtics nomirror scale 0.8 font ",13"
      set autoscale x
      set format y (is_left ? "%.1f" : "")
      set xlabel (is_left ? "evaluations" : "time of the solver [s]")
      set ylabel (is_left ? "share solved and confirmed, ".solver_label(solver_of_profiles) : "")
      plot for [method in methods] steps_of(where.",solver=".solver_of_profiles, measure, method)\
           using (column("budget")):(column("share")) with steps linecolor rgb method_colour(method)\
           linewidth (method_style(method) == 1 ? 3 : 1.8) dashtype dash(method) notitle
    }
    unset multiplot
    eval end_figure(kind, problem."_cold_start")
  }
}

# --- Across the library ----------------------------------------------------------------------------------------------
where = "solver=interior_point"
problems = values("problem", where)
if (words(problems) < 3) { exit }
methods = values("method", where)
count = words(problems)
y_of(problem, method) = count + 1 - place_in(problems, problem) - 0.22 * (place_in(methods, method) - 2)
height = 205 + 42 * count
mean_where = "problem=every_problem,".where
do for [kind in kinds] {
  eval begin_figure(kind, "library_cold_start", 1400, height)
  set multiplot layout 1, 3 title title_text("Every problem: shares of cold starts by interior point, N = "\
      .word(values("intervals", where), 1), what_is_counted, "95 % intervals (Wilson), "\
      .word(drawn_starts(where.",problem=".word(problems, count)), 1)." starts a problem and method, "\
      .word(drawn_starts(where.",problem=".word(problems, 1)), 1)." on the paper’s problems. Right: mean of the problems’ shares.")\
      offset 0, -0.3
  set tmargin at screen 1 - 130.0 / height; set bmargin at screen 100.0 / height
  do for [c = 2:3] {
    set lmargin at screen (c == 2 ? 0.17 : 0.45); set rmargin at screen (c == 2 ? 0.43 : 0.71)
    unset logscale; unset mxtics
    set xtics nomirror 0, 0.2, 1; set format x "%.1f"
    set xrange [-0.02:1.02]
    set yrange [0.4:count + 0.6]
    set ytics nomirror scale 0 ()
    do for [i = 1:count] { set ytics add ((c == 2 ? problem_label(word(problems, i)) : "") count + 1 - i) }
    set xlabel "share ".word(counted_labels, c)
    set ylabel ""
    if (c == 2) { set key at screen 0.44, screen 0.004 center bottom vertical maxrows 1 width 3 } else { unset key }
    plot for [method in methods] for [problem in problems] rows(shares, where.",problem=".problem.",method=".method, "")\
           using (column(word(counted, c)."_share")):(y_of(problem, method)):(column(word(counted, c)."_lower")):\
           (column(word(counted, c)."_upper")) with xerrorbars linecolor rgb method_colour(method) linewidth 1.4 dashtype 1\
           pointtype method_points(method) pointsize 0.7 notitle,\
         for [method in methods] keyentry with linespoints linecolor rgb method_colour(method) linewidth 1.4 dashtype 1\
           pointtype method_points(method) pointsize 0.7 title method_label(method)
  }
  set lmargin at screen 0.775; set rmargin at screen 0.985
  unset key
  eval power_axis("x")
  set autoscale x
  set yrange [0:1.03]
  set ytics nomirror scale 0.8 0, 0.2, 1; set format y "%.1f"
  set xlabel "evaluations"
  set ylabel "mean share solved and confirmed"
  plot for [method in methods] steps_of(mean_where, "evaluations", method) using (column("budget")):(column("share"))\
       with steps linecolor rgb method_colour(method) linewidth (method_style(method) == 1 ? 3 : 1.8) dashtype dash(method) notitle
  unset multiplot
  eval end_figure(kind, "library_cold_start")
}
