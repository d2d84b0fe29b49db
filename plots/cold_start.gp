# Cold starts: how many end in a solved, confirmed and best solution, problem by problem and across the library, and how
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

# Steps too short for dashes: broad lines below, narrow ones above.
width_of(method) = method_style(method) == 1 ? 4 : method_style(method) == 2 ? 2.4 : 1.2
counted = "solved confirmed best"
counted_points = "6 7 9"
counted_labels = "'solved' 'solved and confirmed' 'in the best minimum'"
place_in(list, text) = sum [k = 1:words(list)] (word(list, k) eq text ? k : 0)
values(column, where) = values_of(distinct(shares, column, where, ""), column)
values_of(found, column) = words(found) == 0 ? "" : system("echo '".found."' | sed 's/".column."=//g'")
steps_of(where, measure, method) = rows(profiles, where.",measure=".measure.",method=".method, "")
what_is_counted = "Confirmed: integrating each interval meets the next node. Best: confirmed, with the reference cost."
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
    eval begin_figure(kind, problem."_cold_start", 940)
    figure_title = title_text(problem_label(problem).": outcomes of cold starts, N = ".entry(scheme, "intervals"),\
        paper_note(problem, "section 5").what_is_counted, "Bars: 95 % intervals (Wilson). Tolerance "\
        .told("cold_start", "tolerance").".")
    eval title_above
    eval place(85, 755, 480, top_of_panels(figure_title))
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
    set ylabel "share of the cold starts" offset inwards
    set key at screen 0.5, screen upwards(365) center bottom vertical maxrows 3 width 1 font ",12" samplen 2
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
      eval place(is_left ? 85 : 445, is_left ? 400 : 750, 80, 340)
      eval power_axis("x")
      set xtics nomirror scale 0.8 font ",15"
      set autoscale x
      set format y (is_left ? "%.1f" : "")
      set xlabel (is_left ? "evaluations, " : "time [s], ").solver_label(solver_of_profiles)
      set ylabel (is_left ? "share solved and confirmed" : "") offset inwards
      plot for [method in methods] steps_of(where.",solver=".solver_of_profiles, measure, method)\
           using (column("budget")):(column("share")) with steps linecolor rgb method_colour(method)\
           linewidth width_of(method) dashtype 1 notitle
    }
    unset multiplot
    eval end_figure(kind, problem."_cold_start")
  }
}

# --- Across the library ----------------------------------------------------------------------------------------------
where = "solver=interior_point"
all_problems = values("problem", where)
if (words(all_problems) < 3) { exit }
methods = values("method", where)
# The smallest or largest share of all methods on a problem.
extreme(problem, column, sign) = number(system(rows_awk("-v where='".where.",problem=".problem."'", shares)\
    ." | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"".column."\") c = i; next }\
      n == 0 || ".sign." * $c > ".sign." * e { e = $c; n = 1 } END { print e + 0 }'"))
# Problems where all starts, or none, do the same with every method are named below the figure.
problems = ""; never = ""; always = "";
do for [problem in all_problems] {
  if (extreme(problem, "confirmed_share", "1") == 0) {
    never = joined(never, problem_label(problem))
  } else { if (extreme(problem, "best_share", "-1") == 1) { always = joined(always, problem_label(problem)) }
  else { problems = problems." ".problem } }
}
count = words(problems)
listed(text, names) = strlen(names) == 0 ? "" : wrapped(text.": ".names.".", 118, "\n")."\n"
notes = listed("All starts end in the best minimum with every method", always)\
    .listed("No start has a confirmed solution (grid too coarse, or not solved)", never)
y_of(problem, method) = count + 1 - place_in(problems, problem) - 0.22 * (place_in(methods, method) - 2)
mean_where = "problem=every_problem,".where
do for [kind in kinds] {
  if (count > 0) {
    bottom = 130 + 16 * lines_in(notes)
    eval begin_figure(kind, "library_cold_start", 150 + bottom + 34 * count)
    figure_title = title_text("All problems: outcomes of cold starts with interior point, N = "\
        .word(values("intervals", where), 1), "Paper: section 5. ".what_is_counted, "95 % intervals (Wilson), "\
        .word(drawn_starts(where.",problem=".word(all_problems, words(all_problems))), 1)." starts per problem and method, "\
        .word(drawn_starts(where.",problem=".word(all_problems, 1)), 1)." on the paper’s problems.")
    eval title_above
    set label 1 notes at screen 0.02, screen upwards(bottom - 80) left font ",12"
    do for [c = 2:3] {
      eval place(c == 2 ? 275 : 525, c == 2 ? 505 : 755, bottom, top_of_panels(figure_title) + 20)
      unset logscale; unset mxtics
      set xtics nomirror 0, 0.2, 1; set format x "%.1f"
      set xrange [-0.02:1.02]
      set yrange [0.4:count + 0.6]
      set ytics nomirror scale 0 () font ",12"
      do for [i = 1:count] {
        set ytics add ((c == 2 ? wrapped(problem_label(word(problems, i)), 30, "\n") : "") count + 1 - i)
      }
      set xlabel "share ".word(counted_labels, c)
      set ylabel ""
      if (c == 2) { eval key_below } else { unset key; unset label 1 }
      plot for [method in methods] for [problem in problems] rows(shares, where.",problem=".problem.",method=".method, "")\
             using (column(word(counted, c)."_share")):(y_of(problem, method)):(column(word(counted, c)."_lower")):\
             (column(word(counted, c)."_upper")) with xerrorbars linecolor rgb method_colour(method) linewidth 1.4 dashtype 1\
             pointtype method_points(method) pointsize 0.7 notitle,\
           for [method in methods] keyentry with linespoints linecolor rgb method_colour(method) linewidth 1.4 dashtype 1\
             pointtype method_points(method) pointsize 0.7 title method_label(method)
    }
    unset multiplot
    eval end_figure(kind, "library_cold_start")
  }

  eval begin_figure(kind, "library_cold_start_budget", 520)
  figure_title = title_text("Every problem: cold starts that are solved and confirmed within a budget",\
      "Mean share over the problems, with interior point; an evaluation is a call for values or derivatives.", "")
  eval panels(1, 1, 85, 15, 115, 0, 0)
  eval power_axis("x")
  set autoscale x
  set yrange [0:1.03]
  set ytics nomirror scale 0.8 0, 0.2, 1 font ",15"; set format y "%.1f"
  set xtics font ",15"
  set xlabel "evaluations"
  set ylabel "mean share solved and confirmed" offset inwards
  eval key_below
  plot for [method in methods] steps_of(mean_where, "evaluations", method) using (column("budget")):(column("share"))\
       with steps linecolor rgb method_colour(method) linewidth width_of(method) dashtype 1 title method_label(method)
  unset multiplot
  eval end_figure(kind, "library_cold_start_budget")
}
