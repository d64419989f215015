package io.troupe.demo.evaluate;

import io.troupe.sim.WorldSettings;
import io.troupe.sim.scenario.Scenario;
import io.troupe.sim.scenario.ScenarioReader;
import io.troupe.sim.scenario.WorldFileException;
import java.nio.file.Path;

/** A world with the two robots of the paper. */
record PaperWorld(Scenario scenario, int port) {
    private static final int ROBOTS = 2;
    private static final double JITTER_M = 0.02;
    private static final double JITTER_RAD = StrictMath.toRadians(2);

    /** Start poses that the seed has moved a little, in simulated time as on the wall. */
    static WorldSettings settings(long seed) {
        return WorldSettings.DEFAULT.withSeed(seed).withJitter(JITTER_M, JITTER_RAD);
    }

    /**
     * The world of a file which the command has read before, with its warnings.
     *
     * @throws WorldFileException if it is none
     */
    static PaperWorld read(Path file) {
        return of(ScenarioReader.readLeniently(file, warning -> {}), file);
    }

    /** @throws WorldFileException if it is none */
    static PaperWorld of(Scenario scenario, Path file) {
        int robots = scenario.world().robots().size();
        if (robots != ROBOTS) {
            throw new WorldFileException(
                    file + " has " + robots + " robots, expected " + ROBOTS + " for the services of the paper");
        }
        int port = scenario.devices().stream()
                .filter(device -> device.interfaceName().equals("position2d"))
                .findFirst()
                .orElseThrow(() -> new WorldFileException(file + " offers no position2d"))
                .port();
        return new PaperWorld(scenario, port);
    }
}
