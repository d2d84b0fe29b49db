# The arm at some twenty instants, light to dark; both torques over time. Loaded by motion.gp.
eval require(picture, "t_in_s,elbow_x_in_m,elbow_y_in_m,tip_x_in_m,tip_y_in_m,tau_1_in_N_m,tau_2_in_N_m")
eval plain_axes
stats table(picture) using (column("t_in_s")) name "T" nooutput
stats table(picture) using (sqrt(column("tip_x_in_m")**2 + column("tip_y_in_m")**2)) name "R" nooutput
every_row = even_spacing(int(T_records) - 1, 20)

eval begin_figure(kind, problem."_motion", 600)
eval begin_panels(problem_label(problem).": the optimal trajectory".by_whom)

# The plane: base in the origin, elbow, tip.
eval left_square
set xrange [-1.12 * R_max:1.12 * R_max]
set yrange [-1.12 * R_max:1.12 * R_max]
set cbrange [T_min:T_max]
set xlabel "x [m]"
set ylabel "y [m]" offset inwards
set label 1 "start" at 0, -R_max offset 2, -0.2 font ",13" textcolor rgb "#3A8FA8"
set label 2 "end" at 0, R_max offset 2, 0.4 font ",13" textcolor rgb "#2B1B5E"
plot table(picture) using (column("tip_x_in_m")):(column("tip_y_in_m")):(column("t_in_s"))\
     with lines linewidth 1 dashtype (3, 3) linecolor palette,\
     table(picture) every every_row\
     using (0):(0):(column("elbow_x_in_m")):(column("elbow_y_in_m")):(column("t_in_s"))\
     with vectors nohead linewidth 2.2 dashtype 1 linecolor palette,\
     table(picture) every every_row using (column("elbow_x_in_m")):(column("elbow_y_in_m")):\
     (column("tip_x_in_m") - column("elbow_x_in_m")):(column("tip_y_in_m") - column("elbow_y_in_m")):(column("t_in_s"))\
     with vectors nohead linewidth 2.2 dashtype 1 linecolor palette,\
     table(picture) every every_row using (column("elbow_x_in_m")):(column("elbow_y_in_m")):(column("t_in_s"))\
     with points pointtype 7 pointsize 0.5 linecolor palette,\
     table(picture) every every_row using (column("tip_x_in_m")):(column("tip_y_in_m")):(column("t_in_s"))\
     with points pointtype 7 pointsize 0.5 linecolor palette,\
     table(picture) every ::0::0 using (0):(0) with points pointtype 7 pointsize 1 linecolor rgb "#202020"
unset label 1
unset label 2

# Torques, and the colours of time below them.
eval right_panel(0.13, 0.9)
set xrange [T_min:T_max]
set yrange [*:*]
set xlabel "time t [s]"
set ylabel "torque [N m]"
set key inside vertical top right
set offsets 0, 0, graph 0.25, 0
set xzeroaxis linetype 8 dashtype 1 linewidth 0.8
plot table(picture) using (column("t_in_s")):(column("tau_1_in_N_m"))\
     with lines linecolor rgb blue dashtype 1 linewidth 2.5 title "τ₁ at the base",\
     table(picture) using (column("t_in_s")):(column("tau_2_in_N_m"))\
     with lines linecolor rgb vermilion dashtype (12, 4) linewidth 2.5 title "τ₂ at the elbow"
unset xzeroaxis
unset offsets
unset multiplot
eval end_figure(kind, problem."_motion")
