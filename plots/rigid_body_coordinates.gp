# One slew of a rigid body in five systems of coordinates: error of the attitude over the number of unknowns, away from the
# singularity of Euler angles and close to it.
#   gnuplot -e "results='results'" plots/rigid_body_coordinates.gp
# Reads rigid_body_coordinates.csv and rigid_body_coordinates_near_singularity.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
away = "rigid_body_coordinates"
near = away."_near_singularity"
if (!exists_table(away) || !exists_table(near)) { exit }
columns = "problem,method,tableau,stages,status,branch,intervals,free_variables,state_error"
eval require(away, columns)
of_away = incomplete
eval require(near, columns)
incomplete = joined(of_away, incomplete)

systems = "satellite_angles satellite_quaternion satellite_quaternion_embedded satellite_directors satellite_directors_embedded"
system_labels = "'Euler angles' 'quaternion' 'quaternion, chart per node' 'directors' 'directors, chart per node'"
curve(i) = sprintf("problem=%s,method=dmoc,tableau=gauss,stages=1", word(systems, i))
unset logscale; set autoscale
y_least = 1.0; y_most = 0.0; x_least = 1e9; x_most = 0.0
do for [name in away." ".near] {
  stats drawn_rows(name, "method=dmoc,tableau=gauss,stages=1", "state_error") using (column("free_variables")):(column("state_error")) name "S" nooutput
  y_least = S_min_y < y_least ? S_min_y : y_least; y_most = S_max_y > y_most ? S_max_y : y_most
  x_least = S_min_x < x_least ? S_min_x : x_least; x_most = S_max_x > x_most ? S_max_x : x_most
}

do for [kind in kinds] {
  eval begin_figure(kind, away, 500)
  figure_title = title_text("A slew in five systems of coordinates: error of the attitude",\
      "Largest angle over the nodes between the attitude and the optimal one. DMOC with one Gauss stage.",\
      "Left: away from the singularity of Euler angles. Right: close to it; hollow: the grid is too coarse.")
  eval panels(1, 2, 95, 25, 130, 70, 0)
  do for [panel = 1:2] {
    name = panel == 1 ? away : near
    is_hollow = has_coarse(name, curve(1))
    set logscale xy
    set xrange [x_least / 1.25:x_most * 1.25]
    set yrange [y_least / 2.0:y_most * 2.0]
    eval power_axis("y")
    set xlabel "free unknowns"
    set format x "%g"
    if (panel == 1) { set ylabel "angle [rad]" offset inwards } else { unset ylabel; set format y "" }
    if (panel == 1) { set key at screen 0.5, screen 0.01 center bottom vertical maxrows 2 width -2 samplen 2.5 font ",12" } else { unset key }
    plot for [i = 1:words(system_labels)] rows(name, curve(i), "state_error")\
         using (column("free_variables")):(column("state_error")) with linespoints linetype i title word(system_labels, i),\
         is_hollow ? coarse_rows(name, curve(1), "state_error") : rows(name, curve(1), "state_error")\
         using (column("free_variables")):(column("state_error")) with points linetype 1 pointtype (is_hollow ? 6 : 7) notitle
  }
  unset multiplot
  eval end_figure(kind, away)
}
