package io.troupe.sim.model;

import io.troupe.common.text.SourcePosition;

/**
 * A thing that no robot moves, such as a wall or a box.
 *
 * @param pose in the world's frame
 * @param colour {@code 0x00RRGGBB}
 * @param blocksBodies robots collide with it
 * @param blocksRangers it stops the rays of sonars, lasers and rangers
 * @param visible blobfinders see it (and it hides what is behind it)
 */
public record ObstacleSpec(
        String name,
        Pose pose,
        Shape shape,
        int colour,
        boolean blocksBodies,
        boolean blocksRangers,
        boolean visible,
        SourcePosition where) {
    /** A copy at another pose. */
    public ObstacleSpec at(Pose other) {
        return new ObstacleSpec(name, other, shape, colour, blocksBodies, blocksRangers, visible, where);
    }
}
