# Roadmaps of DMOC primitives: the nodes with the path, the motion before and after the full solve; the first control.
#   gnuplot -e "results='results'" plots/primitives.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
shown = "horizontal,vertical,nodes,edges,cost_before,cost_after,reference_cost,starts,best_of_starts,plan_milliseconds"
eval require("primitives", "problem,".shown)
eval require("primitives_picture", "problem,part,t,x,y,u")

cost_text(label, text) = strlen(text) == 0 ? label.": not solved" : sprintf("%s: J = %.5g", label, number(text))
number_text(text, otherwise) = strlen(text) == 0 ? otherwise : sprintf("%.5g", number(text))

do for [problem_word in problems_of("primitives", "cost_before")] {
  problem = entry(problem_word, "problem")
  told_of = distinct("primitives", shown, problem_word, "cost_before")
  points(part) = rows("primitives_picture", problem_word.",part=".part, "")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_primitives", 580)
    figure_title = title_text(\
        problem_label(problem).": a roadmap of DMOC primitives",\
        paper_note(problem, "section 5").entry(told_of, "nodes")." nodes, ".entry(told_of, "edges")." edges; a search takes "\
        .sprintf("%.2g", number(entry(told_of, "plan_milliseconds")))." ms.",\
        "Best of ".entry(told_of, "starts")." starts in the same total time: "\
        .number_text(entry(told_of, "best_of_starts"), "none")."; best known cost: "\
        .number_text(entry(told_of, "reference_cost"), "none").".")
    eval panels(1, 2, 90, 15, 150, 115, 0)
    set autoscale
    set key at screen 0.5, screen 0.01 center bottom vertical maxrows 2 width 0
    # A plane has equal units in both directions; as much of it is seen as fits.
    if (word(entry(told_of, "horizontal"), 2) eq word(entry(told_of, "vertical"), 2)\
        && words(entry(told_of, "horizontal")) == 2) { set size ratio -1 }
    stats points("node") using "x" name "X" nooutput
    set xtics few_ticks(X_max - X_min)
    set xlabel entry(told_of, "horizontal") noenhanced
    set ylabel entry(told_of, "vertical") noenhanced offset inwards
    unset title
    plot points("node") using "x":"y" with points pointtype 7 pointsize 0.25 linecolor rgb "#B8B8B8" title "nodes",\
         points("before") using "x":"y" with lines linetype 3 title cost_text("path", entry(told_of, "cost_before")),\
         points("joint") using "x":"y" with points pointtype 6 pointsize 1.3 linecolor rgb green title "nodes of the path",\
         points("after") using "x":"y" with lines linetype 1\
             title cost_text("after the full solve", entry(told_of, "cost_after"))
    unset key
    set size noratio
    set xtics autofreq
    set xlabel axis_label("time", problem, "time_unit")
    set ylabel axis_label("first control", problem, "control_unit") offset inwards
    plot points("before") using "t":"u" with lines linetype 3, points("after") using "t":"u" with lines linetype 1
    unset multiplot
    eval end_figure(kind, problem."_primitives")
  }
}
