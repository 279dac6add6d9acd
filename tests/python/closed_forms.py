"""The bouncing ball, exactly: flight by flight."""

import math
from bisect import bisect_right

import numpy as np


class Flight:
    """From `begin` at height y with speed v upwards, until it reaches `floor`."""

    def __init__(self, begin, y, v, g, floor):
        self.begin, self.y, self.v, self.g, self.floor = begin, y, v, g, floor
        self.impact_speed = math.sqrt(v * v + 2 * g * (y - floor))
        self.end = begin + (v + self.impact_speed) / g

    def height(self, t):
        s = t - self.begin
        return self.y + self.v * s - 0.5 * self.g * s * s

    def speed(self, t):
        return self.v - self.g * (t - self.begin)


class Rest:
    """On the floor from `begin` on."""

    def __init__(self, begin, floor):
        self.begin, self.floor = begin, floor

    def height(self, t):
        return self.floor


class Ball:
    """Dropped from y0 at t = 0 over a floor; `drops` are times at which the floor falls, with its
    new height.

    A flight shorter than `shortest` [s] is rest on the floor: it is lower than g shortest^2 / 8.
    """

    def __init__(self, y0, g, e, floor=0.0, drops=(), end=math.inf, shortest=1e-12):
        self.bounces, self.rests, pieces = [], [], []
        drops = [*drops, (math.inf, None)]
        begin, y, v = 0.0, y0, 0.0
        while begin < end:
            flight = Flight(begin, y, v, g, floor)
            if flight.end >= drops[0][0]:  # the floor falls first
                time, floor = drops.pop(0)
                begin, y, v = time, flight.height(time), flight.speed(time)
                pieces.append(flight)
                continue
            pieces.append(flight)
            self.bounces.append(flight.end)
            begin, y, v = flight.end, floor, e * flight.impact_speed
            if e < 1 and 2 * v / g < shortest:
                self.rests.append(begin + 2 * v / g / (1 - e))
                time, lower = drops.pop(0)
                pieces.append(Rest(begin, floor))
                if time >= end:
                    break
                begin, y, v, floor = time, floor, 0.0, lower
        self.pieces = pieces
        self.starts = [piece.begin for piece in pieces]
        self.bounces = np.array([t for t in self.bounces if t <= end])

    def height(self, t):
        """At a bounce, of the flight before or after it, they are the same."""
        return self.pieces[bisect_right(self.starts, t) - 1].height(t)

    def heights(self, times):
        return np.array([self.height(t) for t in times])
