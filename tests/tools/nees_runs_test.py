#!/usr/bin/env python3
"""Whether many runs' claims are judged as tables of the chi-square distribution have it."""
import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
sys.dont_write_bytecode = True
import nees_runs  # noqa: E402


def claims(scale, seed, runs=20, frames=200):
    """Of one object, independent from frame to frame; honest with a scale of 1."""
    draw = random.Random(seed)
    return [{"frame": frame, "id": "box", "degrees_of_freedom": 6,
             "squared_error": scale * sum(draw.gauss(0, 1) ** 2 for _ in range(6))}
            for _ in range(runs) for frame in range(frames)]


def inside(rows):
    return sum(low <= mean <= high for mean, low, high in rows) / len(rows)


class NeesRuns(unittest.TestCase):
    def test_quantiles_are_those_of_tables(self):
        for share, freedom, value in [(0.025, 30, 16.791), (0.975, 30, 46.979), (0.025, 100, 74.222),
                                      (0.975, 100, 129.561)]:
            self.assertAlmostEqual(nees_runs.quantile(share, freedom) / value, 1.0, delta=0.002)

    def test_each_frame_has_the_mean_of_all_runs_and_objects(self):
        rows = nees_runs.by_frame([
            {"frame": 7, "id": "a", "squared_error": 4.0, "degrees_of_freedom": 6},
            {"frame": 3, "id": "a", "squared_error": 1.0, "degrees_of_freedom": 5},
            {"frame": 7, "id": "b", "squared_error": 8.0, "degrees_of_freedom": 5}])
        self.assertEqual([row[0] for row in rows], [1.0, 6.0])
        self.assertAlmostEqual(rows[1][1], nees_runs.quantile(0.025, 11) / 2)
        self.assertAlmostEqual(rows[1][2], nees_runs.quantile(0.975, 11) / 2)

    def test_of_honest_claims_19_frames_in_20_are_inside(self):
        self.assertAlmostEqual(inside(nees_runs.by_frame(claims(1.0, 1))), 0.95, delta=0.04)

    def test_too_sure_and_too_vague_ones_are_outside(self):
        self.assertLess(inside(nees_runs.by_frame(claims(2.0, 2))), 0.1)
        self.assertLess(inside(nees_runs.by_frame(claims(0.5, 3))), 0.1)
        above, below = nees_runs.row_of("room", 20, claims(2.0, 2)), nees_runs.row_of("room", 20, claims(0.5, 3))
        self.assertEqual(above[6], "0")
        self.assertEqual(below[7], "0")


if __name__ == "__main__":
    unittest.main()
