# Times that others have published and ours, problem by problem: hollow marks were measured elsewhere.
#   gnuplot -e "results='results'" plots/speed_published.gp
# Reads speed_published.csv (tests/long/published results); draws nothing if it is not there.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
if (!exists_table("speed_published")) { exit }
eval require("speed_published", "position,problem,intervals,where,seconds,status")

groups = distinct("speed_published", "position,problem,intervals", "", "")
if (words(groups) == 0) { exit }
places = "elsewhere gpu here"
place_label(p) = word("'measured elsewhere, CPU' 'measured elsewhere, GPU' 'measured here'", p)
place_shift(p) = 0.22 * (p - 2)
here(p) = strlen(distinct("speed_published", "where", "where=".word(places, p), "seconds")) > 0
drawn = ""
do for [p = 1:3] { if (here(p)) { drawn = drawn.sprintf(" %d", p) } }

do for [kind in kinds] {
  eval begin_figure(kind, "speed_published", 560)
  set title title_text("Seconds of a solve, published and here", "The published quadrotor has nine states, ours twelve.",\
      "Hollow: other machines, other discretisations, other tolerances. Unsolved cases are left out.")
  eval power_axis("y")
  set ylabel "time of the solver [s]"
  set xrange [0.5:words(groups) + 0.5]
  unset mxtics
  set xtics () font ",13"
  do for [g = 1:words(groups)] {
    group = word(groups, g)
    set xtics add (problem_label(entry(group, "problem"))."\nN = ".entry(group, "intervals") entry(group, "position") + 0)
  }
  set key at screen 0.5, screen 0.015 center bottom horizontal samplen 1 width 0
  set bmargin 6
  plot for [p in drawn] rows("speed_published", "where=".word(places, int(p)), "seconds")\
           using (column("position") + place_shift(int(p))):(column("seconds"))\
           with points pointtype int(word("6 8 7", int(p))) pointsize 1.4 linewidth 1.8\
           linecolor rgb word(vermilion." ".purple." ".blue, int(p)) title place_label(int(p))
  eval end_figure(kind, "speed_published")
}
