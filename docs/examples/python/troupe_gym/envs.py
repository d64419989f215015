"""Environments of Gymnasium over worlds of Troupe."""

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from .worlds import Worlds

MOST_SPEED_MPS = 0.5
MOST_TURN_RADPS = 1.5
_SCALE = np.array([MOST_SPEED_MPS, MOST_TURN_RADPS])


class DriveTask:
    """Drive far and touch nothing. Replace it to learn something else.

    A step gives the metres that the robots have moved, on average, and -1 if one of them begins to touch something,
    which ends the episode. It also ends, truncated, after a simulated time.
    """

    def __init__(self, seconds=60.0):
        self.seconds = seconds

    def outcome(self, before, after):
        """The reward of a step, whether the episode has ended, and whether it is cut off."""
        touched = bool(after.collided.any())
        moved = float(np.hypot(after.x - before.x, after.y - before.y).mean())
        return moved - (1.0 if touched else 0.0), touched, after.time_s >= self.seconds - 1e-9


def _spaces(worlds):
    ranges = worlds.robots * worlds.sonars
    return (
        gymnasium.spaces.Box(0.0, worlds.greatest_range_m, (ranges,), np.float64),
        gymnasium.spaces.Box(-1.0, 1.0, (2 * worlds.robots,), np.float64),
    )


def _driven(actions):
    """Metres and radians a second of actions from -1 to 1."""
    return np.asarray(actions, dtype=np.float64).reshape(-1, 2) * _SCALE


def _info(seen):
    return {"time_s": seen.time_s, "x": seen.x, "y": seen.y, "heading": seen.heading, "stalled": seen.stalled}


class TroupeEnv(gymnasium.Env):
    """One world. Observations are the ranges of all sonars, in metres.

    An action has two numbers from -1 to 1 for each robot: its speed, of at most 0.5 m/s, and its turn rate, of at most
    1.5 rad/s, left positive.

    task        rewards and ends; a DriveTask by default
    command     what starts Troupe, as for Worlds
    options     of `troupe learn serve`, for example random="maze", side=12, robots=2, or world="my.world"
    """

    metadata = {"render_modes": []}

    def __init__(self, task=None, command=None, render_mode=None, **options):
        if render_mode is not None:
            raise ValueError(f"render_mode {render_mode!r}, expected None: there is no picture")
        self.render_mode = None
        self.task = task or DriveTask()
        self.worlds = Worlds(1, command, **options)
        self.observation_space, self.action_space = _spaces(self.worlds)
        self._seen = None

    def reset(self, *, seed=None, options=None):
        """A reset with a seed builds its world; one without a seed that of a random seed."""
        super().reset(seed=seed)
        world_seed = seed if seed is not None else int(self.np_random.integers(2**62))
        self._seen = self.worlds.exchange([world_seed])[0]
        return self._seen.ranges.reshape(-1), {"world_seed": world_seed, **_info(self._seen)}

    def step(self, action):
        before = self._seen
        self._seen = self.worlds.exchange([_driven(action)])[0]
        reward, terminated, truncated = self.task.outcome(before, self._seen)
        return self._seen.ranges.reshape(-1), reward, terminated, truncated, _info(self._seen)

    def close(self):
        self.worlds.close()


class TroupeVectorEnv(gymnasium.vector.VectorEnv):
    """Many worlds in one process, which steps them on all cores.

    A world whose episode has ended is reset in the next step, with a random seed (AutoresetMode.NEXT_STEP).
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, num_envs, task=None, command=None, **options):
        super().__init__()
        self.num_envs = num_envs
        self.render_mode = None
        self.task = task or DriveTask()
        self.worlds = Worlds(num_envs, command, **options)
        self.single_observation_space, self.single_action_space = _spaces(self.worlds)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._seen = [None] * num_envs
        self._ended = np.zeros(num_envs, dtype=bool)

    def _random_seed(self):
        return int(self.np_random.integers(2**62))

    def reset(self, *, seed=None, options=None):
        """World i gets seed + i, or seed[i], or a random seed."""
        first = seed if seed is None or isinstance(seed, (int, np.integer)) else seed[0]
        super().reset(seed=first)
        if seed is None:
            seeds = [self._random_seed() for _ in range(self.num_envs)]
        elif isinstance(seed, (int, np.integer)):
            seeds = [int(seed) + i for i in range(self.num_envs)]
        else:
            seeds = [self._random_seed() if each is None else int(each) for each in seed]
        self._seen = self.worlds.exchange(seeds)
        self._ended[:] = False
        return self._observations(), self._infos()

    def step(self, actions):
        demands = [self._random_seed() if self._ended[i] else _driven(actions[i]) for i in range(self.num_envs)]
        before = self._seen
        self._seen = self.worlds.exchange(demands)
        rewards = np.zeros(self.num_envs)
        terminated = np.zeros(self.num_envs, dtype=bool)
        truncated = np.zeros(self.num_envs, dtype=bool)
        for i in range(self.num_envs):
            if not self._ended[i]:
                rewards[i], terminated[i], truncated[i] = self.task.outcome(before[i], self._seen[i])
        self._ended = terminated | truncated
        return self._observations(), rewards, terminated, truncated, self._infos()

    def _observations(self):
        return np.stack([seen.ranges.reshape(-1) for seen in self._seen])

    def _infos(self):
        infos = {}
        for i, seen in enumerate(self._seen):
            infos = self._add_info(infos, _info(seen), i)
        return infos

    def close_extras(self, **kwargs):
        self.worlds.close()
