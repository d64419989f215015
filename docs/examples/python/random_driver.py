"""Drives robots at random through random mazes: first one alone, then 8 in one process."""

import gymnasium
import troupe_gym

TASK = troupe_gym.DriveTask(seconds=10)  # an episode ends at a touch, or after 10 s


def alone(steps):
    """Returns the number of episodes that have ended."""
    env = gymnasium.make("Troupe/Drive-v0", random="maze", side=12, task=TASK)
    env.action_space.seed(42)
    ranges, info = env.reset(seed=42)
    episodes = 0
    for _ in range(steps):
        ranges, reward, terminated, truncated, info = env.step(env.action_space.sample())
        if terminated or truncated:
            ranges, info = env.reset()
            episodes += 1
    env.close()
    return episodes


def together(steps):
    """Returns the number of episodes that have ended, in all worlds."""
    envs = gymnasium.make_vec("Troupe/Drive-v0", 8, vectorization_mode="vector_entry_point", random="maze", task=TASK)
    envs.action_space.seed(42)
    envs.reset(seed=42)
    episodes = 0
    for _ in range(steps):
        ranges, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
        episodes += int((terminated | truncated).sum())
    envs.close()
    return episodes


if __name__ == "__main__":
    print(alone(1000), "episodes alone in a maze,", together(1000), "in eight mazes at once")
