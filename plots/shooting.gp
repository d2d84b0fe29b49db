# Shooting and DMOC (section 3.3): errors of the state, the condition of the programs, and the share of cold starts that
# end in a solved and confirmed motion.
#   gnuplot -e "results='results'" plots/shooting.gp
# Reads shooting.csv, convergence_shooting.csv, convergence_shooting_two_stages.csv, cold_start_shooting_shares.csv, and
# DMOC's errors from convergence_indirect.csv if it is there.
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
colour(method) = method eq "dmoc" ? blue : is_single(method) ? green : vermilion
points_of(method) = method eq "dmoc" ? 7 : is_single(method) ? 9 : strstrt(method, "midpoint") > 0 ? 4 : 6
dashes_of(where) = int(entry(where, "stages")) == 1 ? 1 : 2
of_dmoc = "convergence_indirect"
curves(name, problem_word) = distinct(name, "problem,method,tableau,stages", problem_word.",tableau=gauss", "state_error")
curves_of_dmoc(problem_word) = exists_table(of_dmoc) ? distinct(of_dmoc, "problem,method,tableau,stages",\
    problem_word.",method=dmoc,tableau=gauss,stages=1", "state_error")." ".distinct(of_dmoc,\
    "problem,method,tableau,stages", problem_word.",method=dmoc,tableau=gauss,stages=2", "state_error") : ""
error_title(name, where) = with_slope(method_label(entry(where, "method")).", s = ".entry(where, "stages"),\
    slope_in_words(slope_fields(name."_slopes", where, "state", "slope,verdict")))
slope_in_words(fields) = words(fields) < 2 || word(fields, 2) ne "slope" ? "" : sprintf("slope %.2f", number(word(fields, 1)))
programs = "dmoc multiple_shooting_rk4_1 single_shooting_rk4_1"

do for [problem_word in distinct("shooting", "problem", "", "")] {
  problem = entry(problem_word, "problem")
  has_errors = words(curves(errors, problem_word)) > 0
  grid = entry(word(distinct(shares, "intervals", problem_word, ""), 1), "intervals")
  starts = entry(word(distinct(shares, "starts", problem_word, ""), 1), "starts")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_shooting", has_errors ? 940 : 520)
    figure_title = title_text(problem_label(problem).": DMOC and shooting",\
        paper_note(problem, "section 3.3").(has_errors ? "Reference: indirect solution. " : "").starts." cold starts by Ipopt,"\
        ." N = ".grid.".",\
        "Condition number of the equilibrated KKT matrix. One rk4 step and s = 1 unless stated.")
    eval title_above
    if (has_errors) {
      eval place(105, 755, 530, top_of_panels(figure_title))
      first = 1e9; last = 0; lowest = 1e9; highest = 0
      do for [name in tables_of_errors.(words(curves_of_dmoc(problem_word)) > 0 ? " ".of_dmoc : "")] {
        do for [where in name eq of_dmoc ? curves_of_dmoc(problem_word) : problem_word] {
          eval measure(name, where, "intervals", "state_error")
          first = x_low < first ? x_low : first; last = x_high > last ? x_high : last
          lowest = y_low < lowest ? y_low : lowest; highest = y_high > highest ? y_high : highest
        }
      }
      eval power_axis("y")
      eval intervals_axis
      set xrange [first / 1.1:last * 1.1]
      eval set_range("y", lowest, highest, 3)
      set ylabel error_of("{/:Italic q}") offset inwards
      set key at screen 0.02, screen upwards(375) left bottom vertical maxrows 3 width -6 font ",12" samplen 2.5
      plot for [name in tables_of_errors] for [where in curves(name, problem_word)] rows(name, where, "state_error")\
             using (column("intervals")):(column("state_error")) with linespoints linecolor rgb colour(entry(where, "method"))\
             linewidth 1.8 dashtype dashes_of(where) pointtype points_of(entry(where, "method")) pointsize 0.8\
             title error_title(name, where),\
           for [where in curves_of_dmoc(problem_word)] rows(of_dmoc, where, "state_error")\
             using (column("intervals")):(column("state_error")) with linespoints linecolor rgb blue\
             linewidth 1.8 dashtype dashes_of(where) pointtype 7 pointsize 0.6 title error_title(of_dmoc, where)
    }
    top = has_errors ? 345 : top_of_panels(figure_title)
    eval place(105, 415, 80, top)
    unset logscale; set autoscale
    eval measure("shooting", problem_word, "intervals", "condition")
    eval power_axis("y")
    eval intervals_axis
    set xrange [x_low / 1.1:x_high * 1.1]
    eval set_range("y", y_low / 2, 100 * y_high, 1)
    set ylabel "condition of the KKT matrix" offset inwards
    set key default
    set key top left reverse Left noautotitle font ",12" samplen 2.5
    plot for [method in programs] rows("shooting", problem_word.",method=".method, "condition")\
           using (column("intervals")):(column("condition")) with linespoints linecolor rgb colour(method)\
           linewidth 1.8 dashtype 1 pointtype points_of(method) pointsize 0.9 title family_labels[family_of(method)]
    eval place(505, 755, 80, top)
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
