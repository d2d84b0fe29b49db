# Which minimum every start of a plane ends in, method by method: "Global Minima", section 4.1.
#   gnuplot -e "results='results'" plots/basins.gp
# Reads local_minima_plane_basins.csv, if there is one.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
basins = "local_minima_plane_basins"
if (!exists_table(basins)) { exit status 0 }
eval require(basins, "problem,method,tableau,stages,intervals,bulge_1,bulge_2,status,minimum,objective,is_motion")

# The colours of Okabe and Ito, the best minimum the darkest. Of the others only so many have one of their own.
colours = "#0072B2 #E69F00 #009E73 #CC79A7 #56B4E9 #D55E00"
rest_colour = "#F0E442"; no_motion_colour = "#B0B0B0"; unsolved_colour = "#303030"
started(where) = "< ".rows_awk("-v take=all -v where='".where."'", basins)
place_in(list, text) = sum [k = 1:words(list)] (word(list, k) eq text ? k : 0)
words_of(where, column) = system("echo '".distinct(basins, column, where, "")."' | tr ' ' '\n' | sed 's/".column."=//g'\
    | sort -n | tr '\n' ' '")
hexadecimal(text) = int("0x".text[2:7])

do for [group in system(rows_awk("-v take=all -v distinct=problem,tableau,stages,intervals", basins))] {
  problem = entry(group, "problem")
  motions = words_of(group.",is_motion=yes", "minimum")
  drawn = words(motions) < words(colours) ? words(motions) : words(colours)
  there = ""
  do for [one in system(rows_awk("-v take=all -v distinct=method -v where='".group."'", basins))] {
    there = there." ".entry(one, "method")
  }
  # In the order of the other figures, then any others.
  methods = ""
  do for [known in families] { if (place_in(there, known) > 0) { methods = methods." ".known } }
  do for [other in there] { if (place_in(methods, other) == 0) { methods = methods." ".other } }
  # Half the width of a cell.
  places = words(system(rows_awk("-v take=all -v distinct=bulge_1 -v where='".group."'", basins)))
  stats started(group) using (column("bulge_1")) name 'B' nooutput
  half = 0.5 * (B_max - B_min) / (places - 1)
  colour_of(status, number, motion) = status ne "solved" ? hexadecimal(unsolved_colour)\
      : motion ne "yes" ? hexadecimal(no_motion_colour)\
      : place_in(motions, sprintf("%d", number)) > words(colours) ? hexadecimal(rest_colour)\
      : hexadecimal(word(colours, place_in(motions, sprintf("%d", number))))
  cost_of(number) = system("printf %.4g ".entry(distinct(basins, "objective", group.",minimum=".number, ""), "objective"))
  has(where) = system(rows_awk("-v take=all -v distinct=problem -v where='".group.",".where."'", basins)) ne ""
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_basins", 490)
    figure_title = title_text(problem_label(problem).": minimum that each starting point reaches",\
        paper_note(problem, "section 5").sprintf("Cold starts with %s: the guess with bulges sin(πt/T) in both coordinates; N = %s,"\
        ." %d × %d starts.",\
        solver_label(entry(word(distinct(basins, "solver", group, ""), 1), "solver")), entry(group, "intervals"), places, places),\
        "Dark: not solved. Grey: too coarse (integrating an interval misses the next node).")
    eval panels(1, words(methods), 85, 15, 140, 20, 0)
    set xrange [B_min - half:B_max + half]
    set yrange [B_min - half:B_max + half]
    set size ratio 1
    unset grid
    set xlabel "bulge of q_1 / range of q_1"
    set ylabel "bulge of q_2 / range of q_2" offset inwards
    set style fill solid 1.0 noborder
    do for [i = 1:words(methods)] {
      method = word(methods, i)
      set title method_label(method) font ",12"
      if (i == 1) { set key at screen 0.5, screen 0.015 center bottom vertical maxrows 2 width 0 font ",12" samplen 1.5 } else { unset key }
      colour_here(byte) = colour_of(stringcolumn("status"), column("minimum"), stringcolumn("is_motion"))
      part(byte) = int(colour_here(byte)) / 256**byte % 256
      # An image of pixels takes a tenth of the bytes of as many boxes.
      plot started(group.",method=".method) using (column("bulge_1")):(column("bulge_2"))\
             :(part(2)):(part(1)):(part(0))\
             with rgbimage notitle,\
           for [k = 1:drawn] NaN with boxes linecolor rgb word(colours, k)\
             title (k == 1 ? "J = " : "").cost_of(word(motions, k)),\
           NaN with boxes linecolor rgb rest_colour title words(motions) > drawn ? "higher" : "",\
           NaN with boxes linecolor rgb no_motion_colour title has("is_motion=no") ? "no motion" : "",\
           NaN with boxes linecolor rgb unsolved_colour title has("is_motion=") ? "unsolved" : ""
      unset ylabel
      set format y ""
    }
    unset multiplot
    set format y "%g"
    set size noratio
    eval end_figure(kind, problem."_basins")
  }
}
