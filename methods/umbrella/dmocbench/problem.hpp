#pragma once

// For your own problem: the class `Problem`, its card, expressions and their functions.
#include "methods/mechanics/problem.hpp"
