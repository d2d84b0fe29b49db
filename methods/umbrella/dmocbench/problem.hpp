#pragma once

// What a problem of your own includes: the class `Problem`, its card, expressions and their functions.
#include "methods/mechanics/problem.hpp"
