package io.troupe.view;

import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import org.jspecify.annotations.Nullable;

/**
 * The pictures of a world and of its runs, as the text of an SVG file.
 *
 * {@snippet :
 * Files.writeString(folder.resolve("trajectory.svg"), Pictures.trajectory(scenario.world(), result));
 * }
 *
 * <p><b>Threads.</b> Any thread; nothing is shared.
 *
 * <p><b>Order.</b> The same arguments give the same text on every machine.
 *
 * <p><b>Cost.</b> A trajectory has about 12 bytes for each robot and reading.
 */
public final class Pictures {
    private Pictures() {}

    /**
     * The arena, the path of each robot coloured by its service, and where the states changed. Older parts of a path
     * are paler. In a crowd each robot has another colour instead.
     *
     * @param world the world of the run
     */
    public static String trajectory(WorldSpec world, RunResult result) {
        return new TrajectorySvg(world, result).draw();
    }

    /**
     * The states over time, one row per mode, and where each mode begins to differ from promise mode.
     *
     * @throws IllegalArgumentException if there is no run in promise mode
     */
    public static String modes(ModeComparison comparison, String title) {
        return new ModesSvg(comparison, title).draw();
    }

    /**
     * Which node drove each robot of a run over hosts when, and with which service.
     *
     * @param fault is marked, with the time until another node drove; null if there was none
     */
    public static String drivers(RunResult result, @Nullable DriverFault fault) {
        return new DriversSvg(result, fault).draw();
    }

    /**
     * A world from above, with the rays of its sonars and lasers.
     *
     * @param now poses and readings of the world's robots
     */
    public static String world(WorldSpec world, Snapshot now) {
        return new WorldSvg(world, now).draw();
    }
}
