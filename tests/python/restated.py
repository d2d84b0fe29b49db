"""Problems of the library, and of textbooks whose C++ statements are next to the tests, stated in Python."""

import math

import numpy as np

import dmocbench as db


class CartPole(db.Problem):
    """swing-up of a pendulum on a cart"""

    q = db.coordinates("x", "theta", lower={"x": -2.0}, upper={"x": 2.0})
    u = db.controls("u", lower=-20.0, upper=20.0)
    cart_mass = db.parameter(1.0, "kg", "of the cart", 1e-3, 1e3)
    bob_mass = db.parameter(0.3, "kg", "of the bob", 1e-3, 1e3)
    length = db.parameter(0.5, "m", "of the pole", 1e-3, 1e3)
    distance = db.parameter(1.0, "m", "that the cart travels", -2.0, 2.0)
    horizon = 2.0
    start = db.at_rest(x=0.0, theta=0.0)

    def end(self):
        return db.at_rest(x=self.distance, theta=math.pi)

    def lagrangian(self, x):
        m1, m2, l = self.cart_mass, self.bob_mass, self.length
        theta, v = x.q.theta, x.v
        kinetic = 0.5 * (m1 + m2) * v.x * v.x + m2 * l * v.x * v.theta * np.cos(theta) + 0.5 * m2 * l * l * v.theta * v.theta
        return kinetic + m2 * 9.81 * l * np.cos(theta)

    def force(self, x):
        return [x.u.u, 0.0]

    def running_cost(self, x):
        return x.u.u**2

    def guess(self, t):
        tau = t / 2.0
        rate = self.distance / 2.0
        theta = math.pi * tau - 2.0 * math.sin(math.pi * tau)
        slope = (math.pi - 2.0 * math.pi * math.cos(math.pi * tau)) / 2.0
        return [self.distance * tau, theta], [rate, slope], [0.0]


class DoubleIntegrator(db.Problem):
    """a unit mass from rest to rest in fixed time"""

    q = db.coordinates("q")
    u = db.controls("u")
    horizon = db.parameter(1.0, "s", "duration", 1e-3, 1e3)
    start = db.at_rest([0.0])
    end = db.at_rest([1.0])

    def lagrangian(self, x):
        return 0.5 * x.v[0] ** 2

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return 0.5 * x.u @ x.u


class Hovercraft(db.Problem):
    """underactuated hovercraft to a new position and attitude"""

    q = db.coordinates("x", "y", "theta")
    u = db.controls("u_1", "u_2")
    horizon = 5.0
    start = db.at_rest(x=0.0, y=0.0, theta=0.0)
    end = db.at_rest(x=1.0, y=1.0, theta=0.5 * math.pi)

    def lagrangian(self, x):
        return 0.5 * (x.v.x**2 + x.v.y**2) + 0.5 * 0.05 * x.v.theta**2

    def force(self, x):
        c, s = db.cos(x.q.theta), db.sin(x.q.theta)
        turned = np.array([[c, -s], [s, c]]) @ x.u
        return [*turned, -0.1 * x.u[1]]

    def running_cost(self, x):
        return 0.5 * x.u.dot(x.u)

    def symmetry(self, q):
        return [-q.y, q.x, 1.0]


class SphericalPendulum(db.Problem):
    """transfer of a spherical pendulum from a steady cone to a wider cone"""

    q = db.coordinates("theta", "phi")
    u = db.controls("u_theta", "u_phi")
    horizon = 1.5

    def on_cone(self, theta, phi):
        return db.state(q=[theta, phi], v={"phi": math.sqrt(9.81 / math.cos(theta))})

    def start(self):
        return self.on_cone(math.pi / 4, 0.0)

    def end(self):
        return self.on_cone(math.pi / 3, 2.0 * math.pi)

    def lagrangian(self, x):
        return 0.5 * (x.v.theta**2 + db.sin(x.q.theta) ** 2 * x.v.phi**2) + 9.81 * db.cos(x.q.theta)

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return 0.5 * sum(u * u for u in x.u)


class TwoLinkManipulator(db.Problem):
    """swing-up of a planar two-link arm"""

    q = db.coordinates("theta_1", "theta_2")
    u = db.controls("tau_1", "tau_2")
    horizon = 1.0
    start = db.at_rest([-0.5 * math.pi] * 2)
    end = db.at_rest([0.5 * math.pi] * 2)

    def lagrangian(self, x):
        (a, b), (v, w) = x.q, x.v
        kinetic = 0.125 * 5.0 * v * v + 0.125 * w * w + 0.5 * db.cos(a - b) * v * w + (v * v + w * w) / 24.0
        return kinetic - 1.5 * 9.81 * db.sin(a) - 0.5 * 9.81 * db.sin(b)

    def force(self, x):
        return [x.u[0] - x.u[1], x.u[1]]

    def running_cost(self, x):
        return 0.5 * (x.u[0] ** 2 + x.u[1] ** 2)


class ControlRate(db.Problem):
    """double integrator with a bound of the force's rate (PSOPT, control_rate)"""

    q = db.coordinates("q", "iu")
    u = db.controls("rate", lower=-4.0, upper=4.0)
    horizon = 2.0
    start = db.at_rest([0.0, 0.0])
    end = db.state(q={"q": 1.0, "iu": db.free()}, v={"q": 0.0, "iu": db.free()})

    def lagrangian(self, x):
        return 0.5 * x.v.dot(x.v)

    def force(self, x):
        return [x.v.iu, x.u.rate]

    def running_cost(self, x):
        return x.v.iu**2


class HangingChain(db.Problem):
    """hanging chain (COPS 3.0, problem 4)"""

    q = db.coordinates("ix", "is_")
    u = db.controls("u")
    horizon = 1.0
    start = db.state(q=[0.0, 0.0], v=[1.0, 0.0])
    end = db.state(q=[db.free(2.0), db.free(2.0)], v=[3.0, 4.0])

    def lagrangian(self, x):
        return 0.5 * x.v.dot(x.v)

    def force(self, x):
        return [x.u[0], db.sqrt(1.0 + x.u[0] ** 2)]

    def running_cost(self, x):
        return x.v[0] * db.sqrt(1.0 + x.u[0] ** 2)

    def guess(self, t):
        v = [8.0 * t * (0.5 * t - 0.25) + 1.0, 4.0 * t]
        q = [8.0 * (t**3 / 6 - t * t / 8) + t, 2.0 * t * t]
        return q, v, [8.0 * (t - 0.25)]


class MoonLanding(db.Problem):
    """soft landing with least fuel (PSOPT, moon)"""

    q = db.coordinates("h", "mass_integral", rate_lower={"mass_integral": 0.01}, rate_upper={"mass_integral": 1.0})
    u = db.controls("thrust", lower=0.0, upper=1.227)
    horizon = db.between(0.1, 100.0, guess=1.5)
    start = db.state(q=[1.0, 0.0], v=[-0.783, 1.0])
    end = db.state(q=[0.0, db.free(1.0)], v=[0.0, db.free(0.5)])

    def lagrangian(self, x):
        return 0.5 * (x.v[0] ** 2 + x.v[1] ** 2) - x.q.h

    def force(self, x):
        return [x.u.thrust / x.v[1], -x.u.thrust / 2.349]

    def running_cost(self, x):
        return x.u.thrust

    def guess(self, t):
        s = t / 1.5
        return [1 - s, 1.5 * (s - 0.25 * s * s)], [-0.783 * (1 - s), 1.0 - 0.5 * s], [0.6]


class Cannonball(db.Problem):
    """radius and launch for the largest range at given muzzle energy (Dymos)"""

    q = db.coordinates("x", "h", "radius")
    horizon = db.between(0.5, 10.0, guess=2.5)
    start = db.state(q=[0.0, 0.0, db.between(0.1, 1.0, guess=0.5)], v=[db.free(3.0), db.free(3.0), 0.0])
    end = db.state(q=[db.free(3.0), 0.0, db.free(0.5)], v=[db.free(1.0), db.free(-1.5), db.free()])

    @staticmethod
    def mass(r):
        return 7870.0 * 4.0 / 3.0 * math.pi * 1e-3 * r**3

    def lagrangian(self, x):
        return 0.5 * x.v.dot(x.v) - 0.980665 * x.q.h

    def force(self, x):
        r = x.q.radius
        speed = db.sqrt(x.v.x**2 + x.v.h**2)
        k = 0.5 * 1.225 * db.exp(-x.q.h / 8.44) * 0.5 * math.pi * 1e-2 * r * r / self.mass(r) * 1000.0
        return [-k * speed * x.v.x, -k * speed * x.v.h, 0.0]

    def final_cost(self, last):
        return -last.q.x

    def boundary_conditions(self, first, last):
        square = (first.v.x**2 + first.v.h**2) * 1e4
        return [0.5 * self.mass(first.q.radius) * square / 4e5 - 1.0]

    def guess(self, t):
        tau = t / 2.5
        return [3.0 * tau, 3.0 * t - 3.0 / 2.5 * t * t, 0.5], [1.2, 3.0 - 6.0 / 2.5 * t, 0.0]


class SlidingMass(db.Problem):
    """2 kg over 1 m by at most 50 N in the shortest time"""

    q = db.coordinates("x", lower=-5.0, upper=5.0, rate_lower=-50.0, rate_upper=50.0)
    u = db.controls("f", lower=-50.0, upper=50.0)
    horizon = db.between(0.01, 5.0, guess=2.5)
    start = db.at_rest(x=0.0)
    end = db.at_rest(x=1.0)

    def lagrangian(self, x):
        return x.v.x**2

    def force(self, x):
        return x.u

    def final_cost(self, last):
        return last.t


class PushedInABand(db.Problem):
    """a unit mass over 1 m in 1 s, with two-sided bounds on its path"""

    q = db.coordinates("place", unit="m")
    u = db.controls("push", unit="N")
    horizon = 1.0
    start = db.at_rest(place=0.0)
    end = db.at_rest(place=1.0)
    bounds = {"path": ([-5.0, -math.inf], [5.0, 4.5])}

    def lagrangian(self, x):
        return 0.5 * x.v[0] * x.v[0]

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return 0.5 * x.u[0] * x.u[0]

    def path_constraints(self, x):
        return [x.u[0] + x.v[0], x.u[0]]


class TwoLinkWithMotors(TwoLinkManipulator):
    """swing-up of a planar two-link arm driven by motors with inductance, with least heat"""

    u = db.controls("voltage_1", "voltage_2", unit="V")
    y = db.first_order_states("current_1", "current_2", unit="A")
    start = db.state([-0.5 * math.pi] * 2, y=[0.0, 0.0])
    end = db.state([0.5 * math.pi] * 2, y=db.free())

    def first_order_rates(self, x):
        induced = np.array([x.v[0], x.v[1] - x.v[0]])
        return (x.u - x.y - induced) / 0.1

    def force(self, x):
        return [x.y.current_1 - x.y.current_2, x.y.current_2]

    def running_cost(self, x):
        return 0.5 * x.y @ x.y + 0.5 * 0.01 * x.u @ x.u


class OrbitalTransferWithMass(db.Problem):
    """low-thrust transfer of a satellite that burns mass, with least control effort"""

    q = db.coordinates("r", "phi")
    u = db.controls("u")
    y = db.first_order_states("mass")
    inverse_power = db.parameter(5e3, "", "mass flow per square of the thrust", 0.0, 1e4)
    ratio = (6371.0 + 330.0) / (6371.0 + 30.0)
    horizon = 2.0 * math.sqrt(4.0 * math.pi**2 / 8.0 * (1.0 + ratio) ** 3)
    start = db.state([1.0, 0.0], [0.0, 1.0], [1.0])
    end = db.state([ratio, 4.0 * math.pi], [0.0, ratio**-1.5], {"mass": db.free(1.0)})
    cost_scale = 1e4

    def first_order_rates(self, x):
        return [-self.inverse_power * x.u.u**2]

    def lagrangian(self, x):
        return x.y.mass * (0.5 * (x.v.r**2 + x.q.r**2 * x.v.phi**2) + 1.0 / x.q.r)

    def force(self, x):
        (rate,) = self.first_order_rates(x)
        return [rate * x.v.r, x.q.r * x.u.u + rate * x.q.r**2 * x.v.phi]

    def running_cost(self, x):
        return x.u.u**2


class CannonballOfUnknownRadius(db.Problem):
    """radius and launch of a cannonball of given muzzle energy for the largest range"""

    name = "cannonball"
    q = db.coordinates("x", "height", unit="km")
    radius = db.unknown(0.05, "m", "of the ball", 0.01, 0.1)
    horizon = db.between(0.5, 10.0, guess=2.5)
    start = db.state([0.0, 0.0], db.free(3.0))
    end = db.state([db.free(3.0), 0.0], [db.free(1.0), db.free(-1.5)])
    cost_scale = 1e-3

    @property
    def mass(self):
        return 4.0 / 3.0 * math.pi * 7870.0 * self.radius**3

    def lagrangian(self, x):
        return 0.5 * x.v @ x.v - 0.980665 * x.q.height

    def force(self, x):
        air = 1.225 * db.exp(-x.q.height * (1000.0 / 8440.0))
        factor = 0.5 * 0.5 * 1000.0 * air * math.pi * self.radius**2 / self.mass
        return -factor * db.sqrt(x.v @ x.v) * x.v

    def final_cost(self, last):
        return -1000.0 * last.q.x

    def boundary_conditions(self, first, last):
        return 0.5 * 100.0**2 / 4e5 * self.mass * (first.v @ first.v) - 1.0

    def guess(self, t):
        return [3.0 * t / 2.5, 3.0 * t - 1.2 * t * t], [3.0 / 2.5, 3.0 - 2.4 * t]


class ChainOfGivenLength(db.Problem):
    """chain of given length between two points, with least potential energy"""

    name = "hanging_chain"
    q = db.coordinates("height")
    u = db.controls("bend")
    length = db.parameter(4.0, "", "of the chain", 2.25, 100.0)
    horizon = 1.0
    start = db.state([1.0], [db.free(-2.0)])
    end = db.state([3.0], [db.free(6.0)])

    def bounds(self):
        return {"integrals": (self.length, self.length)}

    def lagrangian(self, x):
        return 0.5 * x.v[0] ** 2

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return x.q[0] * db.sqrt(1.0 + x.v[0] ** 2)

    def integrands(self, x):
        return db.sqrt(1.0 + x.v[0] ** 2)

    def guess(self, t):
        return [8.0 * t * (0.5 * t - 0.25) + 1.0], [8.0 * t - 2.0], [8.0]


class PointsAtGivenTimes(db.Problem):
    """hovercraft that passes given points at given times, with least control effort"""

    name = "waypoints"
    q = db.coordinates("x", "y", unit="m")
    u = db.controls("u_x", "u_y", unit="N")
    horizon = 60.0
    start = db.at_rest([1.0, 1.0])
    end = db.state([1.0, 1.0], db.free())
    waypoints = {50.0 / 60.0: db.state([6.0, 0.0]), 25.0 / 60.0: db.state([4.0, 3.0])}

    def lagrangian(self, x):
        return 0.5 * x.v @ x.v

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return x.u @ x.u


class RollingDisk(db.Problem):
    """upright disk that rolls to a position ahead and to the side, with least control effort"""

    name = "rolling_disk"
    q = db.coordinates("x", "y", "theta", "phi")
    u = db.controls("steering", "drive")
    horizon = 2.0
    start = db.at_rest([0.0, 0.0, 0.0, 0.0])
    end = db.at_rest([1.0, 1.0, 0.0, db.free(2.0 * math.sqrt(2.0))])

    def velocity_constraints(self, q, v):
        rolled = 0.5 * v.phi
        return [v.x - rolled * db.cos(q.theta), v.y - rolled * db.sin(q.theta)]

    def lagrangian(self, x):
        return 0.5 * (x.v.x**2 + x.v.y**2) + 0.125 * 0.25 * x.v.theta**2 + 0.25 * 0.25 * x.v.phi**2

    def force(self, x):
        return [0.0, 0.0, x.u.steering, x.u.drive]

    def running_cost(self, x):
        return 0.5 * x.u @ x.u
