#include "methods/mechanics/links.hpp"

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

ExpressionVector difference(const ExpressionVector& after, const ExpressionVector& before, const char* of) {
  if (after.size() == before.size()) return after - before;
  throw Error(
      "the phase before the switch has {} {}, but the phase after it has {}; state the conditions entry by entry",
      before.size(), of, after.size());
}

ExpressionVector change_of_q(const PhaseEnd& before, const PhaseEnd& after) {
  return difference(after.q, before.q, "coordinates");
}

ExpressionVector change_of_y(const PhaseEnd& before, const PhaseEnd& after) {
  return difference(after.y, before.y, "first-order states");
}

}  // namespace

ExpressionVector continuous(const PhaseEnd& before, const PhaseEnd& after) {
  return stacked({change_of_q(before, after), ExpressionVector(after.v - before.v), change_of_y(before, after)});
}

ExpressionVector momentum_kept(const PhaseEnd& before, const PhaseEnd& after) {
  return stacked({change_of_q(before, after), ExpressionVector(after.p - before.p), change_of_y(before, after)});
}

ExpressionVector dropped(const PhaseEnd& before, const PhaseEnd& after, const ExpressionVector& amount) {
  PhaseEnd left = before;
  left.y = difference(before.y, amount, "first-order states or entries of the dropped amount");
  return continuous(left, after);
}

ExpressionVector impact(const VectorFormula& guard, const Expression& restitution, const ExpressionVector& impulse,
                        const PhaseEnd& before, const PhaseEnd& after) {
  const ExpressionVector change = change_of_q(before, after);
  const ExpressionVector distance = guard(before.q);
  if (impulse.size() != distance.size()) {
    throw Error("an impact with {} has {}, but needs one impulse per guard", counted(distance.size(), "guard"),
                counted(impulse.size(), "impulse"));
  }
  const ExpressionMatrix gradient = jacobian_at(guard, before.q);
  return stacked({change, ExpressionVector(after.p - before.p - gradient.transpose() * impulse), distance,
                  ExpressionVector(gradient * ExpressionVector(after.v + restitution * before.v)),
                  change_of_y(before, after)});
}

ExpressionVector new_foothold(const FreeBody& body, const PhaseEnd& before, const PhaseEnd& after) {
  const ExpressionVector q = body.on_old_foot(before.q);
  const ExpressionVector v = jacobian_at(body.on_old_foot, before.q) * before.v;
  const VectorFormula lagrangian = [&](const ExpressionVector& rates) {
    return ExpressionVector::Constant(1, body.lagrangian(State{q, rates, before.t, before.y}));
  };
  const ExpressionVector momentum = jacobian_at(lagrangian, v).transpose();
  const ExpressionMatrix held = jacobian_at(body.on_new_foot, after.q);
  return stacked({difference(body.on_new_foot(after.q), q, "coordinates of the free body"),
                  ExpressionVector(after.p - held.transpose() * momentum), change_of_y(before, after)});
}

}  // namespace dmocbench
