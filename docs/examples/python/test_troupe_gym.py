"""Tests of troupe_gym: python3 -m unittest test_troupe_gym, with the variable TROUPE naming what starts Troupe."""

import unittest
import warnings

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import troupe_gym


def turning(step, robot=0):
    """The action of a step, of numbers that Java computes alike."""
    return [0.25 + 0.05 * robot, 0.125 * ((7 * step + 3 * robot) % 11 - 5)]


class EnvTest(unittest.TestCase):
    def test_gymnasiums_checker_finds_nothing(self):
        for options in ({}, {"random": "maze", "side": 6, "robots": 2}):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                check_env(gymnasium.make("Troupe/Drive-v0", **options).unwrapped)

    def test_equal_seeds_and_actions_give_equal_observations(self):
        with troupe_gym.Worlds(3, random="office", side=10) as worlds:
            seen = worlds.exchange([5, 5, 6])
            for step in range(50):
                np.testing.assert_array_equal(seen[0].ranges, seen[1].ranges)
                self.assertTrue((seen[0].ranges != seen[2].ranges).any())
                seen = worlds.exchange([turning(step)] * 3)

    def test_episode_ends_at_a_touch(self):
        env = troupe_gym.TroupeEnv()
        try:
            ranges, info = env.reset(seed=3)
            self.assertEqual(info["world_seed"], 3)
            self.assertEqual(ranges.shape, (16,))
            terminated, moved, steps = False, 0.0, 0
            while not terminated:
                before = info
                ranges, reward, terminated, truncated, info = env.step(np.array([0.8, 0.0]))
                moved += np.hypot(info["x"] - before["x"], info["y"] - before["y"])[0]
                steps += 1
                self.assertFalse(truncated)
                self.assertAlmostEqual(info["time_s"], 0.1 * steps)
            self.assertLess(reward, -0.9)
            self.assertLess(abs(moved - 0.04 * steps), 0.04)
        finally:
            env.close()


class VectorTest(unittest.TestCase):
    def test_worlds_are_those_of_single_environments_and_begin_again(self):
        task = troupe_gym.DriveTask(seconds=1.0)
        envs = gymnasium.make_vec("Troupe/Drive-v0", 4, vectorization_mode="vector_entry_point", task=task)
        single = troupe_gym.TroupeEnv(task=task)
        try:
            self.assertEqual(envs.metadata["autoreset_mode"], AutoresetMode.NEXT_STEP)
            observations, infos = envs.reset(seed=10)
            self.assertTrue(envs.observation_space.contains(observations))
            np.testing.assert_array_equal(observations[2], single.reset(seed=12)[0])
            for step in range(10):
                actions = np.array([turning(step)] * 4)
                observations, rewards, terminated, truncated, infos = envs.step(actions)
                alone = single.step(actions[2])
                np.testing.assert_array_equal(observations[2], alone[0])
                self.assertEqual((rewards[2], terminated[2], truncated[2]), alone[1:4])
            self.assertTrue((terminated | truncated).all())
            observations, rewards, terminated, truncated, infos = envs.step(actions)
            np.testing.assert_array_equal(rewards, np.zeros(4))
            np.testing.assert_array_equal(infos["time_s"], np.zeros(4))
            self.assertFalse((terminated | truncated).any())
        finally:
            envs.close()
            single.close()


class SampleTest(unittest.TestCase):
    def test_random_drivers_end_episodes(self):
        import random_driver

        self.assertGreaterEqual(random_driver.alone(250), 2)
        self.assertGreaterEqual(random_driver.together(100), 8)


class ErrorsTest(unittest.TestCase):
    def test_wrong_requests_are_refused_and_change_nothing(self):
        with troupe_gym.Worlds(2) as worlds:
            with self.assertRaisesRegex(troupe_gym.TroupeError, "world 0: a step before the first reset"):
                worlds.exchange([[0.1, 0], None])
            worlds.exchange([1, 2])
            with self.assertRaisesRegex(troupe_gym.TroupeError, "world 1: an action of NaN"):
                worlds.exchange([[0.1, 0], [float("nan"), 0]])
            self.assertAlmostEqual(worlds.exchange([[0.1, 0], None])[0].time_s, 0.1)
            with self.assertRaisesRegex(ValueError, "3 numbers for 1 robots"):
                worlds.exchange([[0.1, 0, 0], None])
        with self.assertRaisesRegex(troupe_gym.TroupeError, "closed"):
            worlds.exchange([1, 2])

    def test_a_process_that_ends_says_why(self):
        with self.assertRaisesRegex(troupe_gym.TroupeError, "status 2: .*--side|expected from 2 m to 900 m"):
            troupe_gym.Worlds(1, side=1)
        with self.assertRaisesRegex(troupe_gym.TroupeError, "cannot be started"):
            troupe_gym.Worlds(1, command="no-such-troupe")


if __name__ == "__main__":
    unittest.main()
