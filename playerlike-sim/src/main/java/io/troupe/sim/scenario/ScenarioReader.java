package io.troupe.sim.scenario;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/**
 * Reads worlds in the Stage language (classic dialect) and Player configuration files.
 *
 * <p><b>Units and shapes.</b> Files speak degrees, records radians. Concave outlines have been cut into convex pieces,
 * clockwise ones turned round. The world is flat: heights are read and play no part.
 *
 * <p><b>Errors.</b> {@link WorldFileException}, which begins with {@code file:line:column} where there is one: unknown
 * names, wrong values, missing files, what is not supported yet, bodies that overlap or stand outside the walls. What
 * steers Stage's window, its pace or devices nobody can ask for here (fiducials, grippers) is accepted without effect.
 */
public final class ScenarioReader {
    private ScenarioReader() {}

    /**
     * Reads a {@code .world} file with its {@code .cfg}, or a {@code .cfg} file with its world.
     *
     * <p>For a world the configuration is the file of the same base name beside it. If there is none, every robot is
     * offered on port 6665: the first as {@code position2d:0}, {@code sonar:0} and {@code blobfinder:0} as far as it has
     * them, the next with index 1, and so on.
     */
    public static Scenario read(Path file) {
        requireNonNull(file, "file");
        String name = String.valueOf(file.getFileName());
        if (name.endsWith(".cfg")) {
            return readConfig(file);
        }
        if (!name.endsWith(".world")) {
            throw new WorldFileException("expected a .world or a .cfg file, not " + file);
        }
        String base = name.substring(0, name.length() - ".world".length());
        Path config = file.resolveSibling(base + ".cfg");
        if (!Files.exists(config) || !Files.exists(file)) {
            return DeviceOffer.everything(readWorld(file));
        }
        Scenario scenario = readConfig(config);
        if (!isSame(scenario.world().file(), file)) {
            throw new WorldFileException(config + " beside " + file + " is for another world, "
                    + scenario.world().file() + "; name the .cfg file to use it");
        }
        return scenario;
    }

    /** Reads the world alone, without devices. */
    public static WorldSpec readWorld(Path file) {
        return WorldReader.read(requireNonNull(file, "file"), null);
    }

    /** Reads a {@code .cfg} file and the world its {@code worldfile} names, relative to it. */
    public static Scenario readConfig(Path file) {
        return ConfigReader.read(requireNonNull(file, "file"));
    }

    private static boolean isSame(Path one, Path other) {
        try {
            return Files.isSameFile(one, other);
        } catch (IOException e) {
            throw new WorldFileException("cannot compare " + one + " with " + other + ": " + e);
        }
    }
}
