package io.troupe.sim.worldfile;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.function.Consumer;

/**
 * Reads worlds in the Stage language, both dialects, and Player configuration files.
 *
 * <p><b>Role.</b> A world that uses {@code sensor}, {@code velocity_bounds} or {@code acceleration_bounds} is read as
 * Stage 4: odometry starts at the global pose, speeds are limited to 1 m/s and 90 degrees/s by default, and things with
 * a {@code ranger_return} of 0 stop rays. Every other world is classic: odometry starts at zero, speeds are not
 * limited, and things with a {@code ranger_return} of 0 do not stop rays. A world that mixes both is read as Stage 4,
 * with a warning.
 *
 * <p><b>Units and shapes.</b> Files contain degrees, records radians. Concave outlines have been cut into convex
 * pieces, and clockwise ones reversed. The dark pixels of a bitmap (first channel at most 127 of 255) are walls; their
 * bounding box fills {@code size}. The world is flat: heights are read and have no effect. Models on a robot are its
 * cargo; bodies of sensors are left out. A laser's {@code resolution} is read, but every sample is cast.
 *
 * <p><b>Errors.</b> {@link WorldFileException}, which begins with {@code file:line:column} where there is one: names
 * that neither Stage nor Player knows, wrong values, missing files, robots outside the walls. Settings of Stage's
 * window or speed are accepted without effect. Features of Stage or Player that are not simulated here are left out
 * with a warning that has a position: energy, radio, speech, programs in {@code ctrl}, sensors that are on no robot,
 * other drivers and interfaces of Player, a second ring of sonars. A lenient reader leaves out unknown names too, and
 * values, shapes and entities that cannot be used, with a warning; only a file that breaks the grammar, or is missing,
 * is then an error. A robot that overlaps something at the start causes a warning: it stalls there.
 */
public final class ScenarioReader {
    private ScenarioReader() {}

    /**
     * Reads a {@code .world} file with its {@code .cfg}, or a {@code .cfg} file with its world; warnings go to the log.
     *
     * <p>The configuration of a world is the file of the same base name beside it, if it fits: a configuration for
     * another world or with an error is not used, which causes a warning. Without one, every robot is offered on port
     * 6665. The devices of the first robot are {@code position2d:0}, {@code sonar:0}, {@code laser:0}, {@code ranger:0}
     * and {@code blobfinder:0}, as far as it has them; those of the next robot have index 1, and so on. Second and
     * further lasers and rangers of one robot follow after all the first ones.
     */
    public static Scenario read(Path file) {
        return read(file, Diagnostics.logged());
    }

    /** As {@link #read(Path)}, with warnings to {@code warnings}, at most 1000 per call. */
    public static Scenario read(Path file, Consumer<WorldFileWarning> warnings) {
        return read(file, Diagnostics.strict(requireNonNull(warnings, "warnings")));
    }

    /**
     * As {@link #read(Path, Consumer)}, leniently: what is unknown or cannot be used is left out with a warning,
     * instead of ending the reading. At most 200 things of a world are left out because they cannot be used.
     */
    public static Scenario readLeniently(Path file, Consumer<WorldFileWarning> warnings) {
        return read(file, Diagnostics.lenient(requireNonNull(warnings, "warnings")));
    }

    private static Scenario read(Path file, Diagnostics diagnostics) {
        requireNonNull(file, "file");
        String name = String.valueOf(file.getFileName());
        if (name.endsWith(".cfg")) {
            return ConfigReader.read(file, diagnostics);
        }
        if (!name.endsWith(".world")) {
            throw new WorldFileException("expected a .world or a .cfg file, not " + file);
        }
        WorldSpec world = WorldReader.read(parse(file, diagnostics), diagnostics);
        String base = name.substring(0, name.length() - ".world".length());
        Path config = file.resolveSibling(base + ".cfg");
        return Files.exists(config) ? withNeighbour(world, config, diagnostics) : ProvidedInterfaces.everything(world);
    }

    /**
     * The world with the configuration beside it, if that fits. The user has not named the configuration, so its errors
     * are only warnings.
     */
    private static Scenario withNeighbour(WorldSpec world, Path config, Diagnostics diagnostics) {
        var itsWarnings = new ArrayList<WorldFileWarning>();
        try {
            Scenario scenario = ConfigReader.read(config, diagnostics.with(itsWarnings::add), (named, namedAt) -> {
                if (!Files.exists(named) || !isSame(named, world.file())) {
                    throw new WorldFileException(namedAt, "it is for another world, " + named);
                }
                return world;
            });
            itsWarnings.forEach(diagnostics::warn);
            return scenario;
        } catch (WorldFileException e) {
            diagnostics.warn(
                    new SourcePosition(config, 1, 1),
                    "this file beside " + world.file()
                            + " is not used, and every robot is offered instead; name it to use" + " it: "
                            + e.getMessage());
            return ProvidedInterfaces.everything(world);
        }
    }

    /** Reads the world only, without devices. */
    public static WorldSpec readWorld(Path file) {
        Diagnostics diagnostics = Diagnostics.logged();
        return WorldReader.read(parse(requireNonNull(file, "file"), diagnostics), diagnostics);
    }

    /**
     * Reads a world from a text, and offers every robot as {@link #read(Path)} does.
     *
     * @param file its name in messages; included files are relative to it
     */
    public static Scenario readText(String text, Path file) {
        requireNonNull(text, "text");
        Diagnostics diagnostics = Diagnostics.logged();
        Document document = EntityParser.parseText(Vocabulary.WORLD, text, requireNonNull(file, "file"), diagnostics);
        return ProvidedInterfaces.everything(WorldReader.read(document, diagnostics));
    }

    /** Reads a {@code .cfg} file and the world that its {@code worldfile} names, relative to it. */
    public static Scenario readConfig(Path file) {
        return ConfigReader.read(requireNonNull(file, "file"), Diagnostics.logged());
    }

    private static Document parse(Path worldFile, Diagnostics diagnostics) {
        return EntityParser.parse(Vocabulary.WORLD, worldFile, null, diagnostics);
    }

    private static boolean isSame(Path one, Path other) {
        try {
            return Files.isSameFile(one, other);
        } catch (IOException e) {
            throw new WorldFileException("cannot compare " + one + " with " + other + ": " + e);
        }
    }
}
