package io.troupe.sim.scenario;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.function.Consumer;

/**
 * Reads worlds in the Stage language, both dialects, and Player configuration files.
 *
 * <p><b>Role.</b> A world that uses {@code sensor}, {@code velocity_bounds} or {@code acceleration_bounds} is read as
 * Stage 4 means it: odometry starts at the global pose, speeds are limited to 1 m/s and 90 degrees/s unless the file
 * says otherwise, and a {@code ranger_return} of 0 is seen. Every other world is classic: odometry starts at zero,
 * nothing limits the speed, and a {@code ranger_return} of 0 is not seen. A world that mixes both is read as one of
 * Stage 4, with a warning.
 *
 * <p><b>Units and shapes.</b> Files speak degrees, records radians. Concave outlines have been cut into convex pieces,
 * clockwise ones turned round. The dark pixels of a bitmap (first channel at most 127 of 255) are walls; their bounding
 * box fills {@code size}. The world is flat: heights are read and play no part. Models on a robot are its cargo; bodies
 * of sensors are left out. A laser's {@code resolution} is read, and every sample is cast all the same.
 *
 * <p><b>Errors.</b> {@link WorldFileException}, which begins with {@code file:line:column} where there is one: names
 * that neither Stage nor Player knows, wrong values, missing files, robots outside the walls. What steers Stage's
 * window or its pace is accepted without effect. What Stage or Player reads and is not simulated here is left out with
 * a warning that has its place: devices nobody can ask for here (fiducial, gripper, bumper, camera, ..), energy,
 * programs in {@code ctrl}, other drivers and interfaces of Player, a second ring of sonars. A lenient reader leaves
 * out unknown names too, with a warning. A robot that overlaps something at the start is worth a warning: it stalls
 * there.
 */
public final class ScenarioReader {
    private ScenarioReader() {}

    /**
     * Reads a {@code .world} file with its {@code .cfg}, or a {@code .cfg} file with its world; warnings go to the log.
     *
     * <p>For a world the configuration is the file of the same base name beside it, if it fits: one for another world
     * or with an error in it is not used, which is a warning. Without one, every robot is offered on port 6665: the
     * first as {@code position2d:0}, {@code sonar:0}, {@code laser:0}, {@code ranger:0} and {@code blobfinder:0} as far
     * as it has them, the next with index 1, and so on; second and further lasers and rangers of one robot follow after
     * all the first ones.
     */
    public static Scenario read(Path file) {
        return read(file, Findings.logged());
    }

    /** The same; warnings go to {@code warnings}, at most 1000 of one reading. */
    public static Scenario read(Path file, Consumer<WorldFileWarning> warnings) {
        return read(file, Findings.strict(requireNonNull(warnings, "warnings")));
    }

    /** The same, leniently: an unknown name is a warning and left out, instead of stopping the reading. */
    public static Scenario readLeniently(Path file, Consumer<WorldFileWarning> warnings) {
        return read(file, Findings.lenient(requireNonNull(warnings, "warnings")));
    }

    private static Scenario read(Path file, Findings findings) {
        requireNonNull(file, "file");
        String name = String.valueOf(file.getFileName());
        if (name.endsWith(".cfg")) {
            return ConfigReader.read(file, findings);
        }
        if (!name.endsWith(".world")) {
            throw new WorldFileException("expected a .world or a .cfg file, not " + file);
        }
        WorldSpec world = WorldReader.read(parse(file, findings), findings);
        String base = name.substring(0, name.length() - ".world".length());
        Path config = file.resolveSibling(base + ".cfg");
        return Files.exists(config) ? withNeighbour(world, config, findings) : DeviceOffer.everything(world);
    }

    /** The world with the configuration beside it, which nobody has named, if that fits. */
    private static Scenario withNeighbour(WorldSpec world, Path config, Findings findings) {
        var itsWarnings = new ArrayList<WorldFileWarning>();
        try {
            Scenario scenario = ConfigReader.read(config, findings.with(itsWarnings::add), (named, asker) -> {
                if (!Files.exists(named) || !isSame(named, world.file())) {
                    throw new WorldFileException(asker, "it is for another world, " + named);
                }
                return world;
            });
            itsWarnings.forEach(findings::warn);
            return scenario;
        } catch (WorldFileException e) {
            findings.warn(
                    new SourcePosition(config, 1, 1),
                    "this file beside " + world.file()
                            + " is not used, and every robot is offered instead; name it to use" + " it: "
                            + e.getMessage());
            return DeviceOffer.everything(world);
        }
    }

    /** Reads the world alone, without devices. */
    public static WorldSpec readWorld(Path file) {
        Findings findings = Findings.logged();
        return WorldReader.read(parse(requireNonNull(file, "file"), findings), findings);
    }

    /**
     * Reads a world from a text, and offers every robot as {@link #read(Path)} does.
     *
     * @param file the name it has in messages; files it includes are relative to it
     */
    public static Scenario readText(String text, Path file) {
        requireNonNull(text, "text");
        Findings findings = Findings.logged();
        Document document = EntityParser.parseText(Vocabulary.WORLD, text, requireNonNull(file, "file"), findings);
        return DeviceOffer.everything(WorldReader.read(document, findings));
    }

    /** Reads a {@code .cfg} file and the world its {@code worldfile} names, relative to it. */
    public static Scenario readConfig(Path file) {
        return ConfigReader.read(requireNonNull(file, "file"), Findings.logged());
    }

    private static Document parse(Path worldFile, Findings findings) {
        return EntityParser.parse(Vocabulary.WORLD, worldFile, null, findings);
    }

    private static boolean isSame(Path one, Path other) {
        try {
            return Files.isSameFile(one, other);
        } catch (IOException e) {
            throw new WorldFileException("cannot compare " + one + " with " + other + ": " + e);
        }
    }
}
