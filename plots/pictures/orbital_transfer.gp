# The orbit in the plane with the Earth and the thrust; altitude and thrust over time. Loaded by motion.gp.
eval require(picture, "t_in_h,x_in_km,y_in_km,altitude_in_km,thrust_in_m_per_s2,thrust_x_in_m_per_s2,thrust_y_in_m_per_s2")
eval plain_axes
stats table(picture) using (column("thrust_in_m_per_s2")) name "S" nooutput
largest_thrust = abs(S_max) > abs(S_min) ? abs(S_max) : abs(S_min)
every_row = even_spacing(int(S_records) - 1, 40)
stats table(picture) using (column("t_in_h")) name "T" nooutput
stats table(picture) using (sqrt(column("x_in_km")**2 + column("y_in_km")**2)) name "R" nooutput
arrow_scale = 0.3 * R_max / largest_thrust

eval begin_figure(kind, problem."_motion", 600)
eval begin_panels(problem_label(problem).": the optimal trajectory".by_whom)

# The plane, to scale: the Earth's radius is the distance from its centre less the altitude.
eval left_square
set xrange [-1.16 * R_max:1.16 * R_max]
set yrange [-1.16 * R_max:1.16 * R_max]
set cbrange [T_min:T_max]
set xtics few_ticks(2 * R_max)
set ytics few_ticks(2 * R_max)
set xlabel "x [km]"
set ylabel "y [km]" offset inwards
set label 1 "Earth" at 0, 0.12 * R_max center front textcolor rgb "#52697A"
set label 2 sprintf("arrows: thrust, across the radius\nthe longest %.3g m/s²\ncolour: time, as on the right", largest_thrust) at 0, -0.3 * R_max center front\
    font ",12" textcolor rgb "#52697A"
plot table(picture) every ::0::0\
     using (0):(0):(sqrt(column("x_in_km")**2 + column("y_in_km")**2) - column("altitude_in_km"))\
     with circles fillcolor rgb "#DCE6EC" fillstyle solid noborder,\
     table(picture) every every_row using (column("x_in_km")):(column("y_in_km")):\
     (arrow_scale * column("thrust_x_in_m_per_s2")):(arrow_scale * column("thrust_y_in_m_per_s2")):(column("t_in_h"))\
     with vectors head filled size screen 0.008, 18 linewidth 1.3 dashtype 1 linecolor palette,\
     table(picture) using (column("x_in_km")):(column("y_in_km")):(column("t_in_h"))\
     with lines linewidth 1.6 dashtype 1 linecolor palette
unset label 1
unset label 2

# Over time, in the colours of the plane.
eval right_panel(0.555, 0.9)
set xrange [T_min:T_max]
set yrange [*:*]
set format x ""
unset xlabel
set ylabel "altitude [km]" offset -1
plot table(picture) using (column("t_in_h")):(column("altitude_in_km")):(column("t_in_h"))\
     with lines linewidth 3 dashtype 1 linecolor palette
eval right_panel(0.13, 0.475)
set format x "%g"
set xlabel "time t [hours]"
set ylabel "thrust per mass [m/s^2]"
plot table(picture) using (column("t_in_h")):(column("thrust_in_m_per_s2")):(column("t_in_h"))\
     with lines linewidth 3 dashtype 1 linecolor palette
unset multiplot
eval end_figure(kind, problem."_motion")
