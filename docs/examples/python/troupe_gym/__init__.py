"""Troupe's simulator as environments of Gymnasium.

    import gymnasium, troupe_gym
    env = gymnasium.make("Troupe/Drive-v0", random="maze")
    ranges, info = env.reset(seed=42)
    ranges, reward, terminated, truncated, info = env.step([0.6, 0.0])

The worlds are simulated by a process that `troupe learn serve` starts, one for each environment. A reset with a seed
builds the world of this seed; equal seeds and actions give equal observations, bit for bit, and those of
io.troupe.sim.learn.Trial in Java.
"""

import gymnasium

from .envs import DriveTask, TroupeEnv, TroupeVectorEnv
from .worlds import Seen, TroupeError, Worlds

__all__ = ["DriveTask", "Seen", "TroupeEnv", "TroupeError", "TroupeVectorEnv", "Worlds"]

gymnasium.register(
    id="Troupe/Drive-v0",
    entry_point="troupe_gym.envs:TroupeEnv",
    vector_entry_point="troupe_gym.envs:TroupeVectorEnv",
)
