package io.troupe.demo.terminal;

import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.sim.worldfile.WorldFileException;
import io.troupe.sim.worldfile.WorldFileWarning;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.Consumer;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/**
 * Reads worlds the same way in all commands. Warnings with their position go to standard error, equal ones once. What
 * is unknown or cannot be used is a warning only with {@code --lenient}.
 */
public final class WorldLoader {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--lenient",
            description = "leave out what is unknown or cannot be used in the world file, and warn")
    private boolean lenient;

    /**
     * Reads a world or configuration file, which may be one of the installation.
     *
     * @throws picocli.CommandLine.ParameterException if the file does not exist or is not readable
     */
    public Scenario read(Path named) {
        Path file = FileProblems.input(spec, named, "a world file");
        var warnings = new Warnings();
        try {
            return lenient ? ScenarioReader.readLeniently(file, warnings) : ScenarioReader.read(file, warnings);
        } finally { // an error may be easier to understand with them
            warnings.print(spec.commandLine().getErr());
        }
    }

    /** The warnings about a file; of those with equal words the first one, and how many follow. */
    private static final class Warnings implements Consumer<WorldFileWarning> {
        private record Group(WorldFileWarning first, int size) {}

        private final Map<String, Group> byProblem = new LinkedHashMap<>();

        @Override
        public void accept(WorldFileWarning warning) {
            byProblem.merge(
                    warning.problem(),
                    new Group(warning, 1),
                    (before, one) -> new Group(before.first, before.size + 1));
        }

        void print(PrintWriter err) {
            byProblem
                    .values()
                    .forEach(group -> err.println("troupe: warning: " + group.first
                            + (group.size == 1 ? "" : " .. and " + (group.size - 1) + " more of this kind")));
            err.flush();
        }
    }

    /**
     * The port on which a world offers its robots: that of its first position2d.
     *
     * @param file names the world in the error message
     * @throws WorldFileException if the world offers no position2d
     */
    public static int robotPort(Scenario scenario, Path file) {
        return scenario.robotPort().orElseThrow(() -> new WorldFileException(file + " offers no position2d"));
    }
}
