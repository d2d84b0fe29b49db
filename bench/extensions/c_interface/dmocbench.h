/* dmocbench for other languages: solve a problem by its name, get arrays.
 *
 * Nothing here is C++: pointers to opaque handles, numbers, strings (UTF-8), arrays of doubles row by row. A failing call
 * returns NULL, or a number other than 0, and leaves a sentence for a person: dmocbench_last_error(). No exception
 * comes out. All functions may be called by several threads at once; one handle is used by one thread at a time.
 * Threads may solve at the same time; solves by "ipopt" and "sqp" wait for each other, and so does "auto" where it goes
 * to Ipopt. A string belongs to the handle that returned it, or to the library, and must not be freed. */
#ifndef DMOCBENCH_H
#define DMOCBENCH_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define DMOCBENCH_API __attribute__((visibility("default")))
#else
#define DMOCBENCH_API
#endif

/* A problem with the values of its parameters. */
typedef struct dmocbench_problem dmocbench_problem;
/* The result of a solve, whether or not it succeeded. */
typedef struct dmocbench_solution dmocbench_solution;

/* "0.2.0". */
DMOCBENCH_API const char* dmocbench_version(void);
/* Why the last call of this thread that failed did so; empty if none has. Valid until the thread's next failure. */
DMOCBENCH_API const char* dmocbench_last_error(void);

/* The names of all problems, number 0 to count - 1; NULL beyond the last. */
DMOCBENCH_API size_t dmocbench_problem_count(void);
/* The name of a problem, from 0; NULL beyond the last. */
DMOCBENCH_API const char* dmocbench_problem_name(size_t number);

/* The problem with that name and its default parameters; NULL if there is none, or where the environment (DMOCBENCH_THREADS,
 * DMOCBENCH_INSTRUCTION_SET, DMOCBENCH_NATIVE_CODE) has an invalid value. Freed by dmocbench_free_problem. */
DMOCBENCH_API dmocbench_problem* dmocbench_make_problem(const char* name);
/* Ends a problem; NULL is allowed. */
DMOCBENCH_API void dmocbench_free_problem(dmocbench_problem* problem);

/* Its parameters: names (NULL beyond the last), values. Both return 0, or another number if there is no parameter with
 * that name or the value is not allowed. */
DMOCBENCH_API const char* dmocbench_parameter_name(dmocbench_problem* problem, size_t number);
/* The value of a parameter by its name. 0 on success. */
DMOCBENCH_API int dmocbench_get_parameter(dmocbench_problem* problem, const char* name, double* value);
/* Gives a parameter another value. 0 on success. */
DMOCBENCH_API int dmocbench_set_parameter(dmocbench_problem* problem, const char* name, double value);

/* The name of a configuration and of a control, from 0; NULL beyond the last. */
DMOCBENCH_API const char* dmocbench_configuration_name(dmocbench_problem* problem, size_t number);
/* The name of a control, from 0. */
DMOCBENCH_API const char* dmocbench_control_name(dmocbench_problem* problem, size_t number);

/* How a problem is solved. dmocbench_default_options fills all of it. */
typedef struct dmocbench_options {
  const char* method;  /* "dmoc", "hamiltonian", "tangent", or a shooting method as "multiple_shooting_rk4_1" */
  const char* tableau; /* "gauss", "lobatto" */
  int stages;          /* of the tableau */
  size_t intervals;    /* of equal length */
  const char* solver;  /* "interior_point", "ipopt", "auto", "sqp", "nlopt" */
  double tolerance;    /* of the KKT residual */
  double most_seconds; /* wall clock of the solver; 0 for no limit */
} dmocbench_options;
/* The options that dmocbench itself would take. */
DMOCBENCH_API void dmocbench_default_options(dmocbench_options* options);

/* Solves from the problem's guess. An answer that a Newton step would still move is settled by such steps before it is
 * judged. NULL on misuse only: an unknown name, a number out of range; a solve that does not converge is a solution whose
 * status is not "solved". Freed by dmocbench_free_solution. */
DMOCBENCH_API dmocbench_solution* dmocbench_solve(dmocbench_problem* problem, const dmocbench_options* options);
/* The same from the motion of another solution, by any method and on any grid, of a problem with as many q and u, for
 * example with other values of its parameters. NULL also if that solution has no motion. It stays as it is. */
DMOCBENCH_API dmocbench_solution* dmocbench_solve_from(dmocbench_problem* problem, const dmocbench_options* options,
                                                       const dmocbench_solution* start);
/* Solves on one grid after the other, beginning with the options' grid, until the estimated relative error of q, p and
 * cost (dmocbench_estimate_error) is at most `accuracy`, 1e-14 to 0.1. `refinement`: "h" refines steps, "hp" takes up to
 * three stages too. The solution belongs to the last grid; dmocbench_is_solved returns 1 only if the accuracy was reached.
 * NULL on misuse, and for the problems that dmocbench_estimate_error refuses. */
DMOCBENCH_API dmocbench_solution* dmocbench_solve_accurately(dmocbench_problem* problem,
                                                             const dmocbench_options* options, double accuracy,
                                                             const char* refinement);
/* Ends a solution; NULL is allowed. */
DMOCBENCH_API void dmocbench_free_solution(dmocbench_solution* solution);

/* 1 if the answer is solved: confirmed by residuals of our own, and a motion (each interval, replayed alone, meets the
 * next node). Only then are its arrays results. */
DMOCBENCH_API int dmocbench_is_solved(const dmocbench_solution* solution);
/* "solved", "iteration limit", "too coarse", "violates between stages", ..., and the same in a sentence. */
DMOCBENCH_API const char* dmocbench_status(const dmocbench_solution* solution);
/* What happened, in a sentence. */
DMOCBENCH_API const char* dmocbench_message(const dmocbench_solution* solution);

/* Estimates the relative error of q, p and cost of a solved answer, the largest of them, from the answer alone: no
 * reference is needed. Returns 0 and the error, which dmocbench_number then returns as "estimated_error"; another number if
 * the solve failed, if the horizon is free, if bounds or inequalities are active, or if the answer has no costates. */
DMOCBENCH_API int dmocbench_estimate_error(dmocbench_solution* solution, double* relative);

/* A number of a solution: "cost", "kkt_residual", "constraint_violation", "relative_jump" (by how much of the motion's
 * range an interval, replayed alone, misses the next node), "violation_between_stages" (the largest amount by which the
 * motion leaves a bound or path constraint), "iterations", "seconds", "settling_steps" (Newton steps after
 * the solver), "intervals", "stages", "estimated_error" once it is known. Returns 0; another number if there is none with
 * that name, or this solution does not have it. */
DMOCBENCH_API int dmocbench_number(const dmocbench_solution* solution, const char* name, double* value);

/* An array of a solution, row by row, valid as long as the solution: a row per node of "t" (1 column), "q", "v", "p",
 * "psi_q", "psi_p" (n columns); a row per stage, interval by interval, of "stage_t" (1), "stage_q", "stage_v" (n),
 * "stage_u" (m). NULL if no array has that name, or the solve ended without one. */
DMOCBENCH_API const double* dmocbench_array(const dmocbench_solution* solution, const char* name, size_t* rows,
                                            size_t* columns);

#ifdef __cplusplus
}
#endif

#endif
