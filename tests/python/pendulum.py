"""The pendulum of README, as tests state it in Python."""

import math

import dmocbench as db


class PendulumSwingUp(db.Problem):
    """swing-up of a pendulum, least torque"""

    q = db.coordinates("theta", unit="rad")
    u = db.controls("tau", unit="N m")
    length = db.parameter(1.0, "m", "of the rod", lower=0.1, upper=10.0)
    horizon = 1.5
    start = db.at_rest(theta=0.0)
    end = db.at_rest(theta=math.pi)

    def lagrangian(self, x):
        l, g = self.length, 9.81
        return 0.5 * l * l * x.v[0] * x.v[0] + g * l * db.cos(x.q[0])

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return 0.5 * x.u[0] * x.u[0]
