#pragma once

// What an experiment of your own includes, with the target dmocbench::experiment: its card and columns, and the claims
// that it adds to those of the program `claims`.
#include "bench/claims/claim.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/table_run.hpp"
