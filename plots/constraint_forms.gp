# Mechanisms by DMOC with multipliers, by their embedding and in minimal coordinates: condition of the KKT matrix and time of
# an iteration over the number of intervals, a row of panels per mechanism. Draws nothing without objective_forms.csv.
#   gnuplot -e "results='results'" plots/constraint_forms.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "objective_forms"
if (!exists_table(name)) { exit }
eval require(name, "problem,method,tableau,stages,status,branch,intervals,condition,seconds,major_iterations")

mechanisms = "spherical_pendulum_cartesian cart_pole_cartesian two_link_maximal link_chain_maximal"
minimal = "spherical_pendulum cart_pole two_link_manipulator link_chain"
form_labels = "'multipliers' 'embedding' 'minimal coordinates'"
statement(i, form) = "problem=".(form == 3 ? word(minimal, i) : word(mechanisms, i).(form == 2 ? "_embedded" : ""))
drawn = ""
do for [i = 1:words(mechanisms)] { if (strlen(distinct(name, "problem", statement(i, 1), "condition")) > 0) { drawn = drawn." ".i } }

do for [kind in kinds] {
  eval begin_figure(kind, "constraint_forms", 120 + 230 * words(drawn))
  figure_title = title_text("Mechanisms with multipliers, embedding and minimal coordinates",\
      "DMOC with one Gauss stage, interior point; ".number_of_solves(told(name, "repeats")).".",\
      "Left: condition number of the equilibrated KKT matrix. Right: time of an iteration.")
  eval panels(words(drawn), 2, 80, 15, 95, 90, 45)
  do for [place in drawn] {
    i = int(place)
    last = place eq word(drawn, words(drawn))
    do for [panel = 1:2] {
      eval intervals_axis
      eval power_axis("y")
      set autoscale
      set xrange [28:146]
      if (!last) { set xlabel ""; set format x "" }
      set ylabel (panel == 1 ? "condition" : "seconds per iteration") offset inwards
      if (panel == 1) { set title problem_label(word(minimal, i)) offset 0, -0.5 } else { unset title }
      if (last && panel == 1) { eval key_below } else { unset key }
      plot for [form = 1:3] rows(name, statement(i, form), "condition")\
           using (column("intervals")):(panel == 1 ? column("condition") : column("seconds") / column("major_iterations"))\
           with linespoints linetype form title word(form_labels, form)
    }
  }
  unset multiplot
  eval end_figure(kind, "constraint_forms")
}
