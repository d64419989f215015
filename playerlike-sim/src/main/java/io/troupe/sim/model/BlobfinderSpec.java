package io.troupe.sim.model;

import java.util.List;

/**
 * A camera that reports runs of pixels of one colour.
 *
 * @param mount camera pose in the robot's frame; its heading includes the pan angle
 * @param widthPx image columns, spread evenly over the field of view, column 0 at the left edge
 * @param heightPx image rows
 * @param rangeM maximum distance of visible things
 * @param fovRad horizontal field of view
 * @param colours the colours it reports, {@code 0x00RRGGBB}; empty = every colour
 */
public record BlobfinderSpec(
        Pose mount, int widthPx, int heightPx, double rangeM, double fovRad, List<Integer> colours) {
    public BlobfinderSpec {
        colours = List.copyOf(colours);
    }
}
