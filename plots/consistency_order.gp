# Order of consistency of DMOC's discrete objects, th:ordercalculation: the discrete Lagrangian, the one-step map, the
# discrete forces and the forced discrete Legendre transforms against the exact ones over the step.
#   gnuplot -e "results='results'" plots/consistency_order.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("consistency_order", "problem,tableau,stages,order,quantity,h,error")
eval require("consistency_order_slopes", "problem,tableau,stages,order,quantity,slope,standard_error")

# Below this, errors are the rounding of the tableau's coefficients.
smallest = 1e-16
# The figures, each with its panels.
of_figure(name) = name eq "consistency_order" ? "lagrangian left_force right_force" : "map left_legendre right_legendre"
panel_title(quantity) = quantity eq "lagrangian" ? "discrete Lagrangian L_d"\
    : quantity eq "map" ? "one-step map (q_0, p_0) ↦ (q_1, p_1)"\
    : quantity eq "left_force" ? "left discrete force f_d^{−}" : quantity eq "right_force" ? "right discrete force f_d^{+}"\
    : quantity eq "left_legendre" ? "left Legendre transform 𝔽^{f−}L_d" : "right Legendre transform 𝔽^{f+}L_d"
formula(quantity) = quantity eq "lagrangian" ? "|L_d − L_d^E|" : quantity eq "map" ? "distance from the exact (q_1, p_1)"\
    : quantity eq "left_force" ? "|f_d^{−} − f_d^{E−}|" : quantity eq "right_force" ? "|f_d^{+} − f_d^{E+}|"\
    : quantity eq "left_legendre" ? "|𝔽^{f−}L_d − 𝔽^{f−}L_d^E|" : "|𝔽^{f+}L_d − 𝔽^{f+}L_d^E|"
# The slope of a quantity for a problem and a tableau, as text.
measured(where, quantity) = system(rows_awk("-v where='".where.",quantity=".quantity."'", "consistency_order_slopes").\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"slope\") c = i; next } { printf \"%.2f\", $c }'")
points_of(where) = entry(where, "tableau") eq "gauss" ? 7 : 6
dashes_of(where) = entry(where, "tableau") eq "gauss" ? 1 : 2
colour(where) = int(entry(where, "stages")) == 1 ? blue : int(entry(where, "stages")) == 2 ? vermilion\
    : int(entry(where, "stages")) == 3 ? green : purple
curve_title(where, quantity) = sprintf("%s %s, r = %s: %s", entry(where, "tableau"), entry(where, "stages"),\
    entry(where, "order"), measured(where, quantity))

do for [problem_word in problems_of("consistency_order", "error")] {
  problem = entry(problem_word, "problem")
  curves = distinct("consistency_order", "problem,tableau,stages,order", problem_word, "error")
  orders = distinct("consistency_order", "order", problem_word, "error")
  do for [figure in "consistency_order consistency_order_maps"] {
    do for [kind in kinds] {
      eval begin_figure(kind, problem."_".figure, 1000)
      figure_title = title_text(problem_label(problem)\
          .": errors of DMOC’s discrete objects; r is the order of the tableau",\
          paper_note(problem, "section 2.3, th:ordercalculation: hʳ⁺¹ for all errors"),\
          "Legends show fitted slopes. Grey guides: C hʳ dashed, C hʳ⁺¹ dotted. Nothing is solved: end points are given.")
      eval panels(3, 1, 105, 205, 84, 0, 40)
      do for [quantity in of_figure(figure)] {
        where = problem_word.",quantity=".quantity
        eval measure("consistency_order", where, "h", "error")
        # Guides start at the coarsest step's error of each order.
        guides = ""
        do for [order in orders] {
          stats rows("consistency_order", where.",".order, "error")\
                using (column("h") > 0.99 * x_high ? column("error") : NaN) name 'G' nooutput
          guides = guides.sprintf(" %.6g,%d", G_min / 2, int(entry(order, "order")))
        }
        eval power_axis("xy")
        eval set_range("x", x_low, x_high, 1.2)
        set yrange [smallest / 3:10 * y_high]
        set title panel_title(quantity) offset 0, -0.5
        last = word(of_figure(figure), 3)
        set format x (quantity eq last ? "10^{%T}" : "")
        set xlabel (quantity eq last ? "step {/:Italic h}, unit of time as solved" : "")
        set ylabel formula(quantity) offset inwards
        set key at graph 1.03, graph 1 left top font ",12" samplen 2.5
        plot for [guide in guides] number(up_to_comma(guide)) * (x / x_high)**number(guide[strstrt(guide, ",") + 1:*])\
             with lines linetype 8,\
             for [guide in guides] number(up_to_comma(guide)) * (x / x_high)**(1 + number(guide[strstrt(guide, ",") + 1:*]))\
             with lines linetype 9,\
             for [curve in curves] rows("consistency_order", curve.",quantity=".quantity, "error")\
             using (column("h")):(column("error") > smallest ? column("error") : NaN)\
             with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.8\
             pointtype points_of(curve) dashtype dashes_of(curve) title curve_title(curve, quantity)
      }
      unset multiplot
      eval end_figure(kind, problem."_".figure)
    }
  }
}
