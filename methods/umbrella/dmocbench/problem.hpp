#pragma once

// For your own problem: the class `Problem`, its card, expressions and their functions, problems of several phases, and
// forces of constraint as formulas.
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/problem.hpp"
