package io.troupe.sim.model;

import io.troupe.common.text.SourcePosition;

/**
 * A thing, such as a wall or a box. It stands still unless it has other traits.
 *
 * @param pose in the world's frame
 * @param colour {@code 0x00RRGGBB}
 * @param blocksBodies robots collide with it
 * @param blocksRangers it stops the rays of sonars, lasers and rangers
 * @param visible blobfinders see it (and it hides what is behind it)
 * @param traits what only some devices notice
 */
public record ObstacleSpec(
        String name,
        Pose pose,
        Shape shape,
        int colour,
        boolean blocksBodies,
        boolean blocksRangers,
        boolean visible,
        Traits traits,
        SourcePosition where) {
    /** Creates an obstacle without a marker. */
    public ObstacleSpec(
            String name,
            Pose pose,
            Shape shape,
            int colour,
            boolean blocksBodies,
            boolean blocksRangers,
            boolean visible,
            SourcePosition where) {
        this(name, pose, shape, colour, blocksBodies, blocksRangers, visible, Traits.PLAIN, where);
    }

    /** A copy at another pose. */
    public ObstacleSpec at(Pose other) {
        return new ObstacleSpec(name, other, shape, colour, blocksBodies, blocksRangers, visible, traits, where);
    }
}
