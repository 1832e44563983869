"""A camera ray folded by mirrors: positions of the mirrors, and the Stokes vector at the camera in closed form.

The closed form propagates the coherence matrix <E E*> of the light in space, 3 x 3 and Hermitian, from the emitter to
the camera. It uses neither Stokes vectors nor frames, so it shares nothing with the renderers.
Complex index eta - i k, time e^{+iwt}. Source: Born and Wolf, Principles of Optics, 7th edition, 1.5.2.
"""
import cmath
import math

from .shapes import quad
from .vectors import cross, dot, minus, plus, times, unit


def tile(point, normal, along, half, half_across=None):
    """Returns a square, or a rectangle, about a point; two edges are parallel to `along`. Its centre is beside the
    point, so that a ray to the point does not hit the diagonal."""
    s, t = times(along, half), times(cross(normal, along), half_across or half)
    middle = plus(point, s, 0.1)
    return quad(minus(minus(middle, s), t), minus(plus(middle, s), t), plus(plus(middle, s), t),
                plus(minus(middle, s), t))


class Chain:
    """d: direction of the ray; s: the s direction of the last mirror, initially the x axis of the image."""

    def __init__(self, position, target, up=(0.0, 1.0, 0.0)):
        self.point, self.d = position, unit(minus(target, position))
        self.x = self.s = unit(cross(self.d, up))
        self.first = self.d
        self.mirrors = []  # (direction of the incident camera ray, normal), from the camera on

    def go(self, distance):
        """Moves along the ray and returns the point reached."""
        self.point = plus(self.point, self.d, distance)
        return self.point

    def mirror(self, distance, incidence, twist, half):
        """Adds a mirror after `distance` at an angle of incidence [degrees], with its plane of incidence rotated about
        the ray by `twist` degrees. Returns a tile that appears `half` wide and high along the ray."""
        a, b = math.radians(twist), math.radians(incidence)
        s = plus(times(self.s, math.cos(a)), cross(self.d, self.s), math.sin(a))
        return self.reflect(distance, plus(times(self.d, -math.cos(b)), cross(s, self.d), math.sin(b)), half)

    def reflect(self, distance, normal, half):
        """Adds a mirror with this normal."""
        point, c = self.go(distance), -dot(self.d, normal)
        self.s = unit(cross(self.d, normal))
        self.mirrors.append((self.d, normal))
        self.d = unit(plus(self.d, normal, 2 * c))
        return tile(point, normal, self.s, half, half / c)

    def panel(self, distance, half):
        """Returns a square perpendicular to the ray that faces it."""
        return tile(self.go(distance), times(self.d, -1), self.s, half)

    def stokes(self, indices, circular=True):
        """Returns (S0, S1, S2, S3) at the camera for unpolarized light of radiance 1. indices: (eta, k) of every mirror.
        Without `circular`, the imaginary part, which is circular light, is removed after every mirror."""
        light = [[(0.5 if i == j else 0.0) - 0.5 * self.d[i] * self.d[j] for j in range(3)] for i in range(3)]
        for (d, normal), (eta, k) in zip(reversed(self.mirrors), reversed(indices)):
            m = _reflection(plus(d, normal, -2 * dot(d, normal)), d, normal, complex(eta, -k))
            light = _product(_product(m, light), [[m[j][i].conjugate() for j in range(3)] for i in range(3)])
            if not circular:
                light = [[c.real for c in row] for row in light]
        x, y = self.x, cross(times(self.first, -1), self.x)
        xx, yy, xy = (sum(a[i] * light[i][j] * b[j] for i in range(3) for j in range(3))
                      for a, b in ((x, x), (y, y), (x, y)))
        return xx.real + yy.real, xx.real - yy.real, 2 * xy.real, -2 * xy.imag


def _reflection(d_source, d_camera, normal, n):
    """Returns the matrix of a mirror for the field. The light arrives along -d_source and leaves along -d_camera."""
    c = -dot(d_camera, normal)
    t = cmath.sqrt(n * n - 1 + c * c)
    t = -t if t.imag > 0 else t
    rs, rp = (c - t) / (c + t), (n * n * c - t) / (n * n * c + t)
    s = unit(cross(d_camera, normal))
    p_in, p_out = cross(s, d_source), cross(s, d_camera)
    return [[rs * s[i] * s[j] + rp * p_out[i] * p_in[j] for j in range(3)] for i in range(3)]


def _product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
