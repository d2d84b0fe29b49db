# Errors of state and control over the step, with fitted slopes: fig:kepler_error and fig:twolink_error; and the orders
# of tableaus with several stages.
#   gnuplot -e "results='results'" plots/convergence.gp
# Reads convergence.csv; convergence_512.csv and convergence_stages.csv if they are there; slopes from NAME_slopes.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
columns = "problem,method,tableau,stages,solver,status,branch,intervals,step,state_error,control_error"
eval require("convergence", columns)

set key top left
step_label(problem) = axis_label("step {/:Italic h}", problem, "time_unit")
state_label(problem) = axis_label("state error ".error_of("q"), problem, "state_unit")
control_label(problem) = axis_label("control error ".error_of("u"), problem, "control_unit")

# To be evaluated: the point (x_guide, y_guide) from which a guide line starts, below the curves at the second coarsest
# grid.
guide_start(name, where, y) = sprintf(\
    "stats rows('%s', '%s', '%s') using (column('step') < 0.9 * x_high || x_low > 0.9 * x_high ?\
         column('step') : NaN) name 'G' nooutput;\
     x_guide = G_max;\
     stats rows('%s', '%s', '%s') using (abs(column('step') / x_guide - 1) < 0.01 ?\
         column('%s') : NaN) name 'G' nooutput;\
     y_guide = G_min / 3", name, where, y, name, where, y, y)
# Step of the reference among the rows without an error; 0 if the table holds no reference of its own.
reference_step(name, where) = number(system(rows_awk("-v without=state_error -v where=".where, name).\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"step\") c = i; next }\
                 { h = $c } END { print h + 0 }'"))

do for [name in "convergence convergence_512"] {
  if (!exists_table(name)) { continue }
  eval require(name, columns)
  do for [quantity in "state control"] {
    error = quantity."_error"
    do for [where in problems_of(name, error)] {
      problem = entry(where, "problem")
      figure = problem."_".error.(name eq "convergence" ? "" : "_512")
      curves = curves_of(name, where, error)
      eval measure(name, where, "step", error)
      eval guide_start(name, where, error)
      # The guide lines of order 2 are for one stage.
      one_stage = distinct(name, "stages", where, error) eq "stages=1"
      h_ref = reference_step(name, where)
      coarse_curves = ""
      do for [curve in curves] {
        found = system(rows_awk("-v take=coarse -v distinct=method -v where='".curve."' -v need=".error, name))
        if (strlen(found) > 0) { coarse_curves = coarse_curves." ".curve }
      }
      eval power_axis("xy")
      eval finer_tics("x")
      eval set_range("x", x_low, x_high, 1.3)
      eval set_range("y", y_low, y_high, 3)
      fitted = ""  # every range that a curve is fitted over
      do for [curve in curves] {
        range = fit_range(name."_slopes", curve, quantity)
        if (strlen(range) > 0 && strstrt(fitted, range) == 0) { fitted = fitted.(strlen(fitted) > 0 ? " or " : "").range }
      }
      set title title_text(problem_label(problem).": error of the ".quantity." over the step",\
          (quantity eq "state" ? of_paper(problem, "fig:kepler\\_error, left", "fig:twolink\\_error a)")\
              : of_paper(problem, "fig:kepler\\_error, right", "fig:twolink\\_error b)"))\
              .for_paper(problem, "Order 2 against N = 1024", "Order 2 against N = 512")\
              ."Against ".reference_words(name, where).".",\
          sentence(conditions(name)).labelled("Slopes: ", sentence(fitted)))
      set xlabel step_label(problem)
      set ylabel (quantity eq "state" ? state_label(problem) : control_label(problem))
      do for [kind in kinds] {
        eval begin_figure(kind, figure, 600)
        plot for [curve in curves] rows(name, curve, error) using (column("step")):(column(error))\
             with linespoints linetype method_style(entry(curve, "method"))\
             title with_slope(curve_label(name, curve), slope(name."_slopes", curve, quantity))\
             .bounds_note(name."_slopes", curve, quantity),\
             for [k = 1:words(coarse_curves)] coarse_rows(name, word(coarse_curves, k), error)\
             using (column("step")):(column(error))\
             with points linetype method_style(entry(word(coarse_curves, k), "method")) pointtype 6 notitle,\
             keyentry with points linetype 8 pointtype 6 title (strlen(coarse_curves) > 0 ? "too coarse, or violates between stages" : ""),\
             for [k = 1:one_stage] y_guide * (x / x_guide)**2 with lines linetype 8 title "C h²",\
             for [k = 1:(one_stage && h_ref > 0)] x > h_ref\
             ? y_guide * (x**2 - h_ref**2) / (x_guide**2 - h_ref**2) : NaN with lines linetype 9\
             title "C (h² − H²), H the step of the reference"
        eval end_figure(kind, figure)
      }
    }
  }
}

name = "convergence_stages"
if (!exists_table(name)) { exit }
eval require(name, columns)
set key at screen 0.5, screen 0.01 center bottom vertical maxrows 6 width -4 font ",12"
without_collocation(label) = strstrt(label, " colloc") > 0 ? label[1:strstrt(label, " colloc") - 1] : label
stage_label(curve) = without_collocation(method_label(entry(curve, "method"))).", s = ".entry(curve, "stages")
do for [problem_word in problems_of(name, "state_error")] {
  where = problem_word.",tableau=gauss"
  problem = entry(where, "problem")
  figure = problem."_order"
  eval measure(name, where, "step", "state_error")
  # Curves with one stage first; each guide line as its step, error and order 2 s.
  curves = ""
  guides = ""
  do for [stage in distinct(name, "stages", where, "state_error")] {
    curves = curves." ".curves_of(name, where.",".stage, "state_error")
    eval guide_start(name, where.",".stage, "state_error")
    guides = guides.sprintf(" %.6g,%.6g,%d", x_guide, y_guide, 2 * int(entry(stage, "stages")))
  }
  nth(list, i) = i == 1 ? number(up_to_comma(list)) : nth(list[strstrt(list, ",") + 1:*], i - 1)
  eval power_axis("xy")
  eval finer_tics("x")
  eval set_range("x", x_low, x_high, 1.3)
  eval set_range("y", y_low, y_high, 3)
  set title title_text(problem_label(problem).": error of the state over the step, Gauss tableaus with s stages",\
      "Against ".reference_words(name, where).". ".conditions(name).".",\
      "A curve without a slope has too few grids above round-off.")
  set xlabel step_label(problem)
  set ylabel state_label(problem)
  do for [kind in kinds] {
    eval begin_figure(kind, figure, 760)
    set bmargin at screen 0.31
    plot for [curve in curves] rows(name, curve, "state_error") using (column("step")):(column("state_error"))\
         with linespoints linetype method_style(entry(curve, "method"))\
         title with_slope(stage_label(curve), slope(name."_slopes", curve, "state")),\
         for [guide in guides] nth(guide, 2) * (x / nth(guide, 1))**nth(guide, 3)\
         with lines linetype 8 dashtype (20 - 3 * nth(guide, 3), 5) title "C h".exponent(nth(guide, 3)).", guide"
    eval end_figure(kind, figure)
  }
}
