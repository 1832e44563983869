"""Points and directions as tuples of three numbers."""
import math


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, b, times=1):
    """a + times b."""
    return tuple(p + times * q for p, q in zip(a, b))


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, factor):
    return tuple(c * factor for c in a)


def unit(a):
    length = math.sqrt(sum(c * c for c in a))
    return tuple(c / length for c in a)


def rounded(a, digits=6):
    """Fixed decimals for scene.json, never a negative zero."""
    return [round(c, digits) + 0.0 for c in a]
