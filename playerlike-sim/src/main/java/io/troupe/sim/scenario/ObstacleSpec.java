package io.troupe.sim.scenario;

/**
 * A thing that stands still: a wall, a box.
 *
 * @param pose in the world's frame
 * @param colour {@code 0x00RRGGBB}
 * @param blocksBodies robots bump into it
 * @param blocksRangers sonar rays end at it
 * @param visible the blobfinder sees it (and what is behind it is hidden)
 */
public record ObstacleSpec(
        String name,
        Pose pose,
        Shape shape,
        int colour,
        boolean blocksBodies,
        boolean blocksRangers,
        boolean visible,
        SourcePosition where) {}
