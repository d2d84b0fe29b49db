# All methods across the suite of problems: performance profiles after Dolan and Moré, and the cost of accuracy on
# every problem.
#   gnuplot -e "results='results'" plots/profile.gp
# Reads profile.csv, profile_profiles.csv and profile_summary.csv; draws nothing if they are not there.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
if (!exists_table("profile")) { exit }
eval require("profile",\
    "problem,method,tableau,stages,solver,status,intervals,success,reference_objective,objective_error,seconds")
eval require("profile_profiles", "measure,method,tableau,stages,solver,ratio,share")
eval require("profile_summary", "method,tableau,stages,solver,instances,successes")

# Competitors, those first that solve most; more than these are not drawn. A colour per method; dashes per tableau,
# stages and solver where there are several, else per method.
most_competitors = 9
all_competitors = system(rows_awk("-v distinct=successes,method,tableau,stages,solver", "profile_summary").\
    " | LC_ALL=C sort -s -t = -k 2,2nr")
count = words(all_competitors) < most_competitors ? words(all_competitors) : most_competitors
variants = distinct("profile_summary", "tableau,stages,solver", "", "")
where_of(i) = word(all_competitors, i)[strstrt(word(all_competitors, i), ",") + 1:*]
successes(i) = int(entry(word(all_competitors, i), "successes"))
instances = int(entry(word(distinct("profile_summary", "instances", "", ""), 1), "instances"))
variant_of(i) = "tableau=".after(where_of(i), "tableau")
place_in(list, text) = sum [k = 1:words(list)] (word(list, k) eq text ? k : 0)
colour(i) = method_colour(entry(where_of(i), "method"))
marker(i) = method_points(entry(where_of(i), "method"))
pattern(i) = words(variants) > 1 ? place_in(variants, variant_of(i)) : method_style(entry(where_of(i), "method"))
width(i) = method_style(entry(where_of(i), "method")) == 1 ? 2.6 : 1.8
dashes = "'1' '(6, 4)' '(10, 4, 2, 4)' '(2, 3)' '(12, 4)' '(10, 3, 2, 3, 2, 3)'"
dash(i) = word(dashes, (pattern(i) - 1) % words(dashes) + 1)
line_of(i) = sprintf("linecolor rgb '%s' linewidth %g dashtype %s", colour(i), width(i), dash(i))
differ(column) = words(distinct("profile_summary", column, "", "")) > 1
label_of(i) = method_label(entry(where_of(i), "method")).variant_label(i)
variant_label(i) = (differ("tableau") ? ", ".entry(where_of(i), "tableau") : "")\
    .(differ("stages") ? ", s = ".entry(where_of(i), "stages") : "")\
    .(differ("solver") ? ", ".solver_label(entry(where_of(i), "solver")) : "")
plateau_label(i) = sprintf("%s: %d of %d", label_of(i), successes(i), instances)
left_out = count < words(all_competitors)\
    ? sprintf(" The %d of %d with most successes are shown.", count, words(all_competitors)) : ""
# A line style from text cannot stand in a plot with iteration.
do for [i = 1:count] { eval sprintf("set linetype %d %s pointtype %d pointsize 0.7", 20 + i, line_of(i), marker(i)) }

# --- Performance profiles --------------------------------------------------------------------------------------------
measures = "seconds evaluations major_iterations"
# An evaluation is a call for the objective, the constraints or one of their derivatives, counted alike for all solvers.
measure_labels = "'time of the solver' 'evaluations (values and derivatives)' 'major iterations'"
profile_rows(i, measure) = rows("profile_profiles", where_of(i).",measure=".measure, "")
fine_ratios = "set xtics (1, 1.5, 2, 3, 5, 10, 15, 20)"
coarse_ratios = "set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)"

do for [kind in kinds] {
  eval begin_figure(kind, "profile", 470 + 22 * count)
  figure_title = title_text(\
      "Share of the library that each method solves within a multiple of the best method’s effort",\
      timed_conditions("profile").".",\
      sprintf("%d instances, each a problem on a grid. A curve that stays below 1 failed on the rest: not solved,\
 or off the reference's cost.%s", instances, left_out))
  eval panels(1, 3, 75, 20, 95 + 22 * count, 20, 0)
  do for [m = 1:3] {
    measure = word(measures, m)
    unset logscale; set autoscale
    stats "< ".rows_awk("-v where=measure=".measure, "profile_profiles") using (column("ratio")) name 'S' nooutput
    x_high = S_max > 1.2 ? S_max : 1.2
    set logscale x 10
    set format x "%g"
    eval x_high < 20 ? fine_ratios : coarse_ratios
    if (x_high > 1000) { eval one_power_axis("x") }
    unset mxtics
    set xtics font ",12"
    set xrange [1:x_high]
    set yrange [0:1]
    set ytics 0, 0.2, 1
    set format y (m == 1 ? "%.1f" : "")
    set title word(measure_labels, m) font ",12"
    set xlabel "multiple of the best"
    set ylabel (m == 1 ? "share of the instances" : "") offset inwards
    if (m == 3) { set key at screen 0.5, screen 0.01 center bottom vertical maxrows count font ",12" } else { unset key }
    if (successes(1) == 0) { set label 101 "no instance was solved" at graph 0.5, 0.5 center font ",13" textcolor rgb grey }
    plot for [i = 1:count] profile_rows(i, measure) using (column("ratio")):(column("share")) with steps linetype 20 + i dashtype 1,\
         for [i = 1:(m == 3 ? count : 0)] keyentry with lines linetype 20 + i dashtype 1 title plateau_label(i)
  }
  unset label
  unset multiplot
  eval end_figure(kind, "profile")
}

# --- Work and precision, a panel per problem -------------------------------------------------------------------------
met = "-v branches=any -v need=objective_error -v where=success=yes"
solved_rows(where) = "< ".rows_awk(met.",".where, "profile")
problems = system(rows_awk("-v branches=any -v take=all -v distinct=problem", "profile"))
with_points = system(rows_awk(met." -v distinct=problem", "profile"))
without_reference = system(rows_awk("-v branches=any -v take=all -v without=reference_objective -v distinct=problem",\
    "profile"))
# Panels of a figure: the number per row and of rows; figures after the first have a number.
columns = 3
lines = 4
pages = (words(problems) + columns * lines - 1) / (columns * lines)
page_name(page) = "library_work_precision".(page == 1 ? "" : sprintf("_%d", page))
unit_of(problem) = described(problem, "cost_unit")
panel_title(problem) = with_unit(problem_label(problem), unit_of(problem) eq "dimensionless" ? "" : unit_of(problem))
# Times in ms, the fewer per decade the more decades there are.
time_tics(decades) = "set xtics nomirror (".(decades < 0.6 ? times_many : decades < 1.1 ? times_125\
    : decades < 2 ? times_13 : times_1).")"
times_many = ""; times_125 = ""; times_13 = ""; times_1 = ""
add_time(text, ms) = text.sprintf("%s'%g' %g", strlen(text) == 0 ? "" : ", ", ms, 1e-3 * ms)
do for [k = -3:7] {
  times_1 = add_time(times_1, 10.0**k)
  do for [d in "1 3"] { times_13 = add_time(times_13, d * 10.0**k) }
  do for [d in "1 2 5"] { times_125 = add_time(times_125, d * 10.0**k) }
  do for [d in "1 1.5 2 3 4 6"] { times_many = add_time(times_many, d * 10.0**k) }
}

# The competitors, by number, that have points on a problem.
competitors_on(problem_word) = numbers_of(system(rows_awk(met.",".problem_word.\
    " -v distinct=method,tableau,stages,solver", "profile")))
numbers_of(present) = system("echo '".present."' | tr ' ' '\n' | awk -v all='".all_drawn."' '\
    BEGIN { n = split(all, place, \" \"); for (i = 1; i <= n; ++i) number[place[i]] = i }\
    $1 in number { printf \"%d \", number[$1] }'")
all_drawn = ""
do for [i = 1:count] { all_drawn = all_drawn.where_of(i)." " }

do for [page = 1:pages] { do for [kind in kinds] {
  first = columns * lines * (page - 1) + 1
  last = columns * lines * page < words(problems) ? columns * lines * page : words(problems)
  lines_here = (last - first) / columns + 1
  bottom = 75 + 20 * ((count + 1) / 2)
  eval begin_figure(kind, page_name(page), 160 + bottom + 210 * lines_here)
  figure_title = title_text(\
      "Effort for an accurate cost on every problem of the library", timed_conditions("profile").".",\
      "Each line joins the grids, coarsest first; only solves that reached the reference cost are drawn.".left_out)
  eval panels(lines_here, columns, 85, 20, bottom, 60, 75)
  do for [p = first:last] {
    problem_word = word(problems, p)
    drawn = place_in(with_points, problem_word) > 0
    unset logscale; set autoscale; unset mxtics; set xlabel ""; set ylabel ""; unset key
    set title panel_title(entry(problem_word, "problem")) font ",12" offset 0, -0.5
    if (p == first) {
      set label 100 "error of the cost |J − J_{ref}| [unit next to the title]"\
          at screen 0.017, screen 0.5 center rotate by 90
      set label 101 "time of the solver [ms]" at screen 0.5, screen upwards(bottom - 50) center
      set key at screen 0.5, screen 0.01 center bottom vertical maxrows (count + 1) / 2 font ",12"
    }
    if (drawn) {
      stats solved_rows(problem_word) using (column("seconds")):(column("objective_error")) name 'S' nooutput
      eval power_axis("xy")
      unset mxtics
      eval set_range("x", S_min_x, S_max_x, 1.25)
      eval time_tics(log10(S_max_x / S_min_x))
      set format x '%g'
      set yrange [10**floor(log10(S_min_y / 1.2)):10**ceil(log10(S_max_y * 1.2))]
      set xtics font ",12"; set ytics nomirror font ",15"
    } else {
      unset xtics; unset ytics; unset mytics
      set xrange [0:1]; set yrange [0:1]
      set label 1 (place_in(without_reference, problem_word) > 0 ? "no reference cost\nto compare with"\
          : "no solve reached\nthe reference cost") at graph 0.5, 0.55 center font ",13" textcolor rgb grey
    }
    legend = p == first ? count : 0
    if (drawn) {
      here = competitors_on(problem_word)
      plot for [i in here] solved_rows(problem_word.",".where_of(int(number(i))))\
             using (column("seconds")):(column("objective_error")) with linespoints linetype 20 + int(number(i)),\
           for [i = 1:legend] keyentry with linespoints linetype 20 + i title label_of(i)
    } else {
      plot NaN, for [i = 1:legend] keyentry with linespoints linetype 20 + i title label_of(i)
    }
    unset label 1; unset label 100; unset label 101
    set xtics nomirror; set ytics nomirror
  }
  unset multiplot
  eval end_figure(kind, page_name(page))
} }
