#pragma once

// The problems of the suite by name, with the target dmocbench::problems: `make_problem`, `problem_names`.
#include "problems/registry.hpp"
