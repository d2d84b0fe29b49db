#pragma once

// For your own experiment, with the target dmocbench::experiment: its card and columns, and the claims
// that it adds to the program `claims`.
#include "bench/claims/claim.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/table_run.hpp"
