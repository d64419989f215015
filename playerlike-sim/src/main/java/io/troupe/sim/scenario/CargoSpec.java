package io.troupe.sim.scenario;

/**
 * Something a robot carries: it moves with the robot and looks like itself.
 *
 * @param shape in the robot's frame
 * @param colour {@code 0x00RRGGBB}
 * @param blocksBodies it bumps into things, as a part of the robot's body
 * @param blocksRangers rays of others end at it; those of its own robot pass
 * @param visible the blobfinders of others see it
 */
public record CargoSpec(Shape shape, int colour, boolean blocksBodies, boolean blocksRangers, boolean visible) {}
