# The paper's figures that show no result: the two routes to optimality conditions, discrete forces, discrete and
# continuous maps, and the two-link manipulator. Nothing in them is measured.
#   gnuplot -e "results='results'" plots/schematics.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"

# To be evaluated: a plane from (0, 0) to (width, height) without axes, a unit as long in both directions.
plane(width, height) = sprintf("unset border; unset tics; unset key; unset grid; unset label; unset arrow; unset object;\
    set lmargin 0; set rmargin 0; set bmargin 0.7; set tmargin 4.5; set xrange [0:%g]; set yrange [0:%g];\
    set size ratio -1", width, height)
ink = "#202020"
set style arrow 1 head filled size screen 0.012, 18 linewidth 1.6 linecolor rgb ink
set style arrow 2 head filled size screen 0.014, 18 linewidth 2.6 linecolor rgb vermilion
set style arrow 3 heads filled size screen 0.01, 18 linewidth 1.2 linecolor rgb grey
set style arrow 4 nohead linewidth 1.2 dashtype (4, 4) linecolor rgb grey
set style arrow 5 head filled size screen 0.012, 18 linewidth 2.4 linecolor rgb blue
# To be evaluated: a frame with words, and an arrow with words next to its middle.
frame(x, y, width, height, words) = sprintf("set object rectangle center %g, %g size %g, %g fillstyle empty border\
    linecolor rgb ink linewidth 1.3; set label \"%s\" at %g, %g center offset 0, %g font ',12'", x, y, width, height, words, x, y,\
    0.5 * lines_of(words) - 0.5)
lines_of(words) = strstrt(words, "\\n") > 0 ? 1 + lines_of(words[strstrt(words, "\\n") + 2:*]) : 1
arrow(x, y, u, v) = sprintf("set arrow from %g, %g to %g, %g arrowstyle 1", x, y, u, v)
words_at(x, y, side, words) = sprintf("set label \"%s\" at %g, %g %s font ',12'", words, x, y, side)

# --- fig:intro_comparison --------------------------------------------------------------------------------------------
do for [kind in kinds] {
  eval begin_figure(kind, "paper_intro_comparison", 760)
  eval plane(20, 17)
  set title title_text("Order of variation and discretisation for the necessary optimality conditions",\
      "Paper: section 3.3, fig:intro\\_comparison", "")
  eval frame(10, 15.7, 9, 1.7, "objective functional +\\nLagrange-d’Alembert principle")
  eval frame(5, 11.9, 7, 1.7, "objective functional +\\nEuler-Lagrange equations")
  eval frame(15.5, 11.9, 7.5, 1.9, "discrete objective function +\\ndiscrete Lagrange-d’Alembert principle")
  eval frame(2.7, 7.5, 4.8, 1.7, "Pontryagin\\nmaximum principle")
  eval frame(8.4, 7.5, 5.8, 1.9, "discrete objective function +\\ndiscretised differential equation")
  eval frame(15.5, 7.5, 7.5, 1.9, "discrete objective function +\\ndiscrete Euler-Lagrange equations")
  eval frame(2.7, 3.2, 4.8, 1.7, "discretised Pontryagin\\nmaximum principle")
  eval frame(8.4, 3.2, 5.8, 1.7, "Karush-Kuhn-Tucker\\nequations")
  eval frame(15.5, 3.2, 7.5, 1.7, "Karush-Kuhn-Tucker\\nequations")
  eval arrow(8.5, 14.8, 5.5, 12.8)
  eval arrow(11.5, 14.8, 15, 12.9)
  eval arrow(4.2, 11, 2.9, 8.4)
  eval arrow(5.8, 11, 8.0, 8.5)
  eval arrow(15.5, 10.9, 15.5, 8.5)
  eval arrow(2.7, 6.6, 2.7, 4.1)
  eval arrow(8.4, 6.5, 8.4, 4.1)
  eval arrow(15.5, 6.5, 15.5, 4.1)
  eval words_at(6.3, 14.0, "right", "{/:Bold variation} (mechanics)")
  eval words_at(13.6, 14.0, "left", "{/:Bold discretisation}")
  eval words_at(3.4, 9.9, "right", "{/:Bold variation} (OCP)")
  eval words_at(7.3, 9.9, "left", "{/:Bold discretisation}")
  eval words_at(15.8, 9.7, "left", "{/:Bold discrete variation}\\n(mechanics)")
  eval words_at(2.9, 5.4, "left", "{/:Bold discretisation}")
  eval words_at(8.6, 5.4, "left", "{/:Bold discrete variation}\\n(OCP)")
  eval words_at(15.8, 5.4, "left", "{/:Bold discrete variation}\\n(OCP)")
  eval words_at(2.7, 1.2, "center", "{/:Bold indirect}")
  eval words_at(8.4, 1.2, "center", "{/:Bold direct}")
  eval words_at(15.5, 1.2, "center", "{/:Bold DMOC}")
  plot NaN notitle
  eval end_figure(kind, "paper_intro_comparison")
}

# --- fig:discreteforces ----------------------------------------------------------------------------------------------
path_y(x) = 2.4 + 1.1 * sin(0.42 * x - 0.4)
do for [kind in kinds] {
  eval begin_figure(kind, "paper_discreteforces", 470)
  eval plane(18, 7)
  set title title_text("Left and right discrete forces", "Paper: section 2.2, fig:discreteforces.",\
      "Orange: forces from the interval before; blue: forces from the interval after.")
  do for [k = 0:2] {
    x = 3 + 6 * k
    name = word("q_{k−1} q_k q_{k+1}", k + 1)
    set object circle center x, path_y(x) size 0.13 fillstyle solid fillcolor rgb ink
    set label name at x, path_y(x) center offset 0, -1.4
    if (k > 0) {
      set arrow from x, path_y(x) to x - 1.3, path_y(x) + 2.1 arrowstyle 2
      set label "f_{".word("k−1 k", k)."}^{+}" at x - 1.5, path_y(x) + 2.4 center textcolor rgb vermilion
    }
    if (k < 2) {
      set arrow from x, path_y(x) to x + 1.3, path_y(x) + 2.1 arrowstyle 5
      set label "f_{".word("k−1 k", k + 1)."}^{−}" at x + 1.5, path_y(x) + 2.4 center textcolor rgb blue
    }
    set label word("t_{k−1} t_k t_{k+1}", k + 1) at x, 0.3 center textcolor rgb grey
    set arrow from x, 0.7 to x, path_y(x) - 0.9 arrowstyle 4
  }
  plot [0.8:17.2] path_y(x) with lines linecolor rgb ink linewidth 1.5 dashtype 1 notitle
  eval end_figure(kind, "paper_discreteforces")
}

large(words) = "{/*1.28 ".words."}"
# --- fig:discretemaps (diagram:LH) and diagram:LEH ---------------------------------------------------------------------
do for [figure in "paper_discretemaps paper_exact_maps"] {
  exact = figure eq "paper_exact_maps"
  upper = exact ? 9.2 : 5.2
  lower = exact ? 5.0 : 0.9
  E = exact ? "E,u_" : "u_"
  do for [kind in kinds] {
    eval begin_figure(kind, figure, exact ? 520 : 350)
    eval plane(20, exact ? 10.4 : 6.4)
    set title exact ? title_text("Exact discrete Lagrangian and forces, continuous Hamiltonian flow with force",\
        "Paper: section 2.3, diagram:LEH", "") : title_text("Forced discrete Lagrangian map and forced discrete Hamiltonian map",\
        "Paper: section 2.2, fig:discretemaps (diagram:LH)", "")
    do for [k = 0:1] { set label sprintf("(q_%d, q_%d)", k, k + 1) at 6 + 8 * k, upper center }
    do for [k = 0:2] { set label sprintf("(q_%d, p_%d)", k, k) at 2 + 8 * k, lower center }
    # So large that indices of indices are no smaller than other text.
    set label large(exact ? "F_{L_d^E}^{ u_0, u_1}" : "F_{L_d}^{ u_0, u_1}") at 10, upper + 0.75 center
    eval arrow(7.4, upper, 12.6, upper)
    do for [k = 0:1] {
      x = 6 + 8 * k
      eval arrow(x - 0.7, upper - 0.5, x - 3.4, lower + 0.6)
      eval arrow(x + 0.7, upper - 0.5, x + 3.4, lower + 0.6)
      set label large(sprintf("𝔽^{f−}L_d^{ %s%d}", E, k)) at x - 2.7, upper - 2.1 right
      set label large(sprintf("𝔽^{f+}L_d^{ %s%d}", E, k)) at x + 1.9, upper - 1.2 left
      eval arrow(3.4 + 8 * k, lower, 8.6 + 8 * k, lower)
      set label large(exact ? sprintf("F̃_{L_d^E}^{ u_%d} = (F_H^{ u_%d})^h", k, k) : sprintf("F̃_{L_d}^{ u_%d}", k))\
          at 6 + 8 * k, lower - 0.8 center
      if (exact) {
        eval arrow(3.7 + 8 * k, 0.9, 8.3 + 8 * k, 0.9)
        set label large(sprintf("(F_L^{ u_%d})^h", k)) at 6 + 8 * k, 0.15 center
      }
    }
    if (exact) {
      do for [k = 0:2] {
        set label sprintf("(q_%d, q̇_%d)", k, k) at 2 + 8 * k, 0.9 center
        eval arrow(2 + 8 * k, 1.5, 2 + 8 * k, lower - 0.6)
        set label "𝔽L" at 1.8 + 8 * k, 2.9 right
      }
    }
    plot NaN notitle
    eval end_figure(kind, figure)
  }
}

# --- fig:twolink -------------------------------------------------------------------------------------------------------
do for [kind in kinds] {
  eval begin_figure(kind, "paper_twolink", 660)
  eval plane(10, 7.2)
  set title title_text("Model of the two-link manipulator", "Paper: section 4.2.2, fig:twolink.",\
      "Links with masses m, lengths l and moments of inertia J; angles counterclockwise from the horizontal.")
  angle_1 = 35.0 * pi / 180; angle_2 = 68.0 * pi / 180
  x0 = 1.6; y0 = 0.9
  x1 = x0 + 4.6 * cos(angle_1); y1 = y0 + 4.6 * sin(angle_1)
  x2 = x1 + 3.4 * cos(angle_2); y2 = y1 + 3.4 * sin(angle_2)
  set arrow from x0, y0 to x1, y1 nohead linewidth 9 linecolor rgb "#9FC3DC"
  set arrow from x1, y1 to x2, y2 nohead linewidth 9 linecolor rgb "#F0B592"
  set arrow from x0, y0 to x0 + 3.0, y0 arrowstyle 4
  set arrow from x1, y1 to x1 + 2.4, y1 arrowstyle 4
  set object circle center x0, y0 size 0.16 front fillstyle solid fillcolor rgb ink
  set object circle center x1, y1 size 0.16 front fillstyle solid fillcolor rgb ink
  set object circle center x2, y2 size 0.12 front fillstyle solid fillcolor rgb ink
  set object circle center x0, y0 size 1.9 arc [0:35] fillstyle empty border linecolor rgb blue linewidth 1.8 nowedge
  set object circle center x1, y1 size 1.4 arc [0:68] fillstyle empty border linecolor rgb vermilion linewidth 1.8 nowedge
  set label "θ_1" at x0 + 2.15 * cos(0.5 * angle_1), y0 + 2.15 * sin(0.5 * angle_1) center textcolor rgb blue
  set label "θ_2" at x1 + 1.7 * cos(0.5 * angle_2), y1 + 1.7 * sin(0.5 * angle_2) center textcolor rgb vermilion
  # Lengths next to the links, masses and moments of inertia on them.
  d = 0.3
  set arrow from x0 - d * sin(angle_1), y0 + d * cos(angle_1) to x1 - d * sin(angle_1), y1 + d * cos(angle_1) arrowstyle 3
  set arrow from x1 - d * sin(angle_2), y1 + d * cos(angle_2) to x2 - d * sin(angle_2), y2 + d * cos(angle_2) arrowstyle 3
  set label "l_1" at 0.5 * (x0 + x1) - 0.65 * sin(angle_1), 0.5 * (y0 + y1) + 0.65 * cos(angle_1) center
  set label "l_2" at 0.5 * (x1 + x2) - 0.65 * sin(angle_2), 0.5 * (y1 + y2) + 0.65 * cos(angle_2) center
  set label "m_1, J_1" at x0 + 3.1 * cos(angle_1) + 0.35, y0 + 3.1 * sin(angle_1) - 0.35 left front
  set label "m_2, J_2" at 0.45 * x1 + 0.55 * x2 + 0.45, 0.45 * y1 + 0.55 * y2 left front
  do for [i = 0:6] {
    set arrow from x0 - 0.7 + 0.2 * i, y0 - 0.35 to x0 - 0.85 + 0.2 * i, y0 - 0.6 nohead linecolor rgb grey linewidth 1.2
  }
  set arrow from x0 - 0.75, y0 - 0.35 to x0 + 0.75, y0 - 0.35 nohead linecolor rgb ink linewidth 1.5
  set arrow from x0, y0 to x0 - 0.4, y0 - 0.35 nohead linecolor rgb ink linewidth 1.5
  set arrow from x0, y0 to x0 + 0.4, y0 - 0.35 nohead linecolor rgb ink linewidth 1.5
  plot NaN notitle
  eval end_figure(kind, "paper_twolink")
}
