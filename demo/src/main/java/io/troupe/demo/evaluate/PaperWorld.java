package io.troupe.demo.evaluate;

import io.troupe.sim.scenario.Scenario;
import io.troupe.sim.scenario.ScenarioReader;
import io.troupe.sim.scenario.WorldFileException;
import java.nio.file.Path;

/** A world with the two robots of the paper. */
record PaperWorld(Scenario scenario, int port) {
    private static final int ROBOTS = 2;

    /** @throws WorldFileException if it is none */
    static PaperWorld read(Path file) {
        Scenario scenario = ScenarioReader.read(file);
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
