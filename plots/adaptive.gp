# Steps that the estimate of the error chooses, with the motion; the estimate over the true error.
#   gnuplot -e "results='results'" plots/adaptive.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("adaptive", "problem,method,stages,grid,accuracy,intervals,true_error,largest_step,smallest_step")
eval require("adaptive_steps", "problem,method,stages,t,step,motion")
eval require("adaptive_effectivity", "problem,method,stages,grid,quantity,effectivity,relative_error,verdict")

colour_of_stages(s) = word(purple." ".blue." ".vermilion." ".green, s + 0)
field(where, column) = entry(distinct("adaptive", column, where, ""), column)
of_grid(where, grid) = where.",method=dmoc,grid=".grid
intervals_of(where, grid) = field(of_grid(where, grid), "intervals")
label(where) = sprintf("s = %s: N = %s%s", entry(where, "stages"), intervals_of(where, "adapted"),\
    intervals_of(where, "uniform") eq "" ? "" : sprintf(" (uniform: %s)", intervals_of(where, "uniform")))

do for [problem_word in distinct("adaptive_steps", "problem", "", "step")] {
  problem = entry(problem_word, "problem")
  stages = distinct("adaptive_steps", "problem,stages", problem_word.",method=dmoc", "step")
  unset logscale; set autoscale
  stats rows("adaptive_steps", problem_word.",method=dmoc", "step") using (column("t") + column("step")) name "T" nooutput
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_adaptive", 680)
    figure_title = title_text(problem_label(problem).": steps of adapted grids",\
        paper_note(problem, "section 5")."DMOC with s Gauss stages; errors of q, p and cost are at most 1e-8 of their ranges.",\
        "Above: length of every step; below: the trajectory at the nodes for s = 3.")
    eval title_above
    eval place(90, 750, 310, top_of_panels(figure_title) + 15)
    set xrange [0:T_max]
    set logscale y 10; set format y "%g"
    set format x ""
    unset xlabel
    set ylabel "step {/:Italic h}" offset inwards
    set key at screen 0.5, screen 0.01 center bottom vertical maxrows 2 width 1 samplen 2
    plot for [where in stages] rows("adaptive_steps", where.",method=dmoc", "step") using "t":"step"\
           with steps linecolor rgb colour_of_stages(entry(where, "stages")) linewidth 2 dashtype 1 title label(where)
    eval place(90, 750, 130, 290)
    unset logscale y; set format x "%g"
    set xlabel "{/:Italic t}"
    set ylabel "q_1 / max |q_1|" offset inwards
    unset key
    plot "< ".rows_awk("-v where='".problem_word.",method=dmoc,stages=3'", "adaptive_steps") using "t":"motion"\
           with linespoints linecolor rgb grey pointtype 7 pointsize 0.5
    unset multiplot
    eval end_figure(kind, problem."_adaptive")
    unset lmargin; unset rmargin; unset tmargin; unset bmargin
    set autoscale x
    set key
  }
}

eval require("adaptive_effectivity", "problem,method,stages,grid,quantity,effectivity,relative_error,verdict")
quantities = "state momentum costate objective"
do for [kind in kinds] {
  eval begin_figure(kind, "adaptive_effectivity", 800)
  figure_title = title_text("Ratio of the estimated to the true error",\
      "Paper: section 5. Every problem, s = 1 and 2, uniform grids with N = 64 and 128 and adapted grids.",\
      "True errors: relative to the indirect solution, above round-off; dashed: 0.3 and 3.")
  eval panels(2, 2, 80, 25, 115, 20, 45)
  do for [quantity in quantities] {
    eval power_axis("xy")
    set xtics 1e-11, 1e3
    set format y (quantity eq "state" || quantity eq "costate" ? "%g" : "")
    set format x (quantity eq "state" || quantity eq "momentum" ? "" : "10^{%T}")
    set yrange [0.1:10]
    set xlabel (quantity eq "state" || quantity eq "momentum" ? "" : "largest relative error")
    set ylabel (quantity eq "state" || quantity eq "costate" ? "estimated / true error" : "") offset inwards
    set title quantity
    eval key_below
    plot 0.3 with lines linetype 8, 3 with lines linetype 8,\
         for [method in paper_families]\
           rows("adaptive_effectivity", "method=".method.",verdict=measured,quantity=".quantity, "effectivity")\
           using "relative_error":"effectivity" with points linetype method_style(method)\
           title (quantity eq "state" ? method_label(method) : "")
  }
  unset multiplot
  eval end_figure(kind, "adaptive_effectivity")
}
