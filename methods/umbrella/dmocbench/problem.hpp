#pragma once

// For your own problem: the class `Problem`, its card, expressions and their functions, and problems of several phases.
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/problem.hpp"
