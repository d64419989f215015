package io.troupe.sim.model;

/**
 * A thing that a robot carries: it moves with the robot and has a separate colour.
 *
 * @param shape in the robot's frame
 * @param colour {@code 0x00RRGGBB}
 * @param blocksBodies it collides with other bodies, as a part of the robot's body
 * @param blocksRangers it stops the rays of other robots; those of the carrying robot pass
 * @param visible the blobfinders of other robots see it
 * @param reflectance as in {@link Traits}
 */
public record CargoSpec(
        Shape shape, int colour, boolean blocksBodies, boolean blocksRangers, boolean visible, double reflectance) {
    /** Creates a thing that is not bright. */
    public CargoSpec(Shape shape, int colour, boolean blocksBodies, boolean blocksRangers, boolean visible) {
        this(shape, colour, blocksBodies, blocksRangers, visible, 0);
    }
}
