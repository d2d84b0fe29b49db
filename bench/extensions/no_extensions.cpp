// Stands for the extensions in a build without them.
#include <string>

#include "bench/claims/claim.hpp"
#include "bench/extensions/claims_of_extensions.hpp"
#include "bench/programs.hpp"
#include "methods/error.hpp"

namespace dmocbench {

void register_extensions() {
  Claims claims;
  for (const auto& [problem, name] : claims_of_extensions) {
    claims.push_back({.id = std::string(name),
                      .problems = {std::string(problem)},
                      .where = "",
                      .states = "",
                      .judge = [](const ResultTables& /*tables*/, const std::string& /*problem*/) -> Finding {
                        throw Error("not judged: built without extensions");
                      },
                      .evidence = {}});
  }
  add_claims(claims);
}

}  // namespace dmocbench
