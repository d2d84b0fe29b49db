# Shooting compared with DMOC (section 3.3): errors of the state, the condition of the programs, and the share of cold starts that
# end in a solved and confirmed motion.
#   gnuplot -e "results='results'" plots/shooting.gp
# Reads shooting.csv, convergence_shooting.csv, convergence_shooting_two_stages.csv and
# cold_start_shooting_shares.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
shares = "cold_start_shooting_shares"
errors = "convergence_shooting"
more_errors = "convergence_shooting_two_stages"
tables_of_errors = errors." ".more_errors
eval require("shooting", "problem,method,status,intervals,condition")
eval require(shares, "problem,method,solver,intervals,starts,confirmed_share,confirmed_lower,confirmed_upper")
do for [name in tables_of_errors] { eval require(name, "problem,method,tableau,stages,status,branch,intervals,state_error") }

is_single(method) = method[1:6] eq "single"
integrator(method) = strstrt(method, "rk4") > 0 ? "rk4" : "midpoint rule"
colour(method) = method eq "dmoc" ? blue : is_single(method) ? green : vermilion
points_of(method) = method eq "dmoc" ? 7 : is_single(method) ? 9 : 6
dashes_of(where) = int(entry(where, "stages")) == 1 ? 1 : 2
shade(where) = strstrt(where, "midpoint") > 0 ? purple : colour(entry(where, "method"))
curves(name, problem_word) = distinct(name, "problem,method,tableau,stages", problem_word.",tableau=gauss", "state_error")
error_title(name, where) = with_slope(integrator(entry(where, "method")).", s = ".entry(where, "stages"),\
    slope_in_words(slope_fields(name."_slopes", where, "state", "$6, $12")))
slope_in_words(fields) = words(fields) < 2 || word(fields, 2) ne "slope" ? "" : sprintf("slope %.2f", number(word(fields, 1)))
programs = "dmoc multiple_shooting_rk4_1 single_shooting_rk4_1"

do for [problem_word in distinct("shooting", "problem", "", "")] {
  problem = entry(problem_word, "problem")
  has_errors = words(curves(errors, problem_word)) > 0
  grid = entry(word(distinct(shares, "intervals", problem_word, ""), 1), "intervals")
  starts = entry(word(distinct(shares, "starts", problem_word, ""), 1), "starts")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_shooting", 1400, 600)
    set multiplot layout 1, 3 title title_text(problem_label(problem).": shooting and DMOC",\
        (has_errors ? "Errors against the indirect solution; condition" : "Condition")." of the KKT matrix, rows and columns brought to one size;"\
        ." ".starts." cold starts (the guess, and perturbed ones) by Ipopt, N = ".grid.", 95 % intervals (Wilson).",\
        "rk4 with one step per interval and a constant control (s = 1) unless stated otherwise.")\
        offset 0, -0.4
    set tmargin at screen 0.81; set bmargin at screen 0.13
    if (has_errors) {
      set lmargin at screen 0.065; set rmargin at screen 0.34
      eval measure(more_errors, problem_word, "intervals", "state_error")
      lowest = y_low; first = x_low
      eval measure(errors, problem_word, "intervals", "state_error")
      x_low = x_low < first ? x_low : first
      y_low = y_low < lowest ? y_low : lowest
      eval power_axis("y")
      eval intervals_axis
      set xrange [x_low / 1.1:x_high * 1.1]
      eval set_range("y", y_low, y_high, 30)
      set ylabel error_of("{/:Italic q}") offset 1
      set key bottom left font ",12"
      plot for [name in tables_of_errors] for [where in curves(name, problem_word)] rows(name, where, "state_error")\
             using (column("intervals")):(column("state_error")) with linespoints linecolor rgb shade(where)\
             linewidth 1.8 dashtype dashes_of(where) pointtype points_of(entry(where, "method")) pointsize 0.8\
             title error_title(name, where)
    }
    set lmargin at screen (has_errors ? 0.42 : 0.1); set rmargin at screen (has_errors ? 0.68 : 0.5)
    unset logscale; set autoscale
    eval measure("shooting", problem_word, "intervals", "condition")
    eval power_axis("y")
    eval intervals_axis
    set xrange [x_low / 1.1:x_high * 1.1]
    eval set_range("y", y_low, y_high, 3)
    set ylabel "condition of the KKT matrix" offset -0.5
    set key top left font ",12"
    plot for [method in programs] rows("shooting", problem_word.",method=".method, "condition")\
           using (column("intervals")):(column("condition")) with linespoints linecolor rgb colour(method)\
           linewidth 1.8 dashtype 1 pointtype points_of(method) pointsize 0.9 title family_labels[family_of(method)]
    set lmargin at screen (has_errors ? 0.745 : 0.6); set rmargin at screen 0.985
    unset logscale; unset mytics
    set xrange [0.4:3.6]
    set yrange [0:1.03]
    set format y "%.1f"; set ytics 0, 0.2, 1
    set xtics ("DMOC" 1, "multiple" 2, "single" 3) scale 0
    set xlabel ""
    set ylabel "share solved and confirmed"
    unset key
    plot for [i = 1:3] rows(shares, problem_word.",solver=ipopt,method=".word(programs, i), "")\
           using (i):(column("confirmed_share")):(column("confirmed_lower")):(column("confirmed_upper"))\
           with yerrorbars linecolor rgb colour(word(programs, i)) linewidth 2 dashtype 1\
           pointtype points_of(word(programs, i)) pointsize 1.2
    set xtics auto; set ytics auto
    unset multiplot
    eval end_figure(kind, problem."_shooting")
  }
}
