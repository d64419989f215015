package io.troupe.demo.terminal;

import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.sim.worldfile.WorldFileException;
import io.troupe.sim.worldfile.WorldFileWarning;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.function.Consumer;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/**
 * Reads worlds the same way in all commands. Warnings with their position go to standard error. What is unknown or
 * cannot be used is a warning only with {@code --lenient}.
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
        PrintWriter err = spec.commandLine().getErr();
        Consumer<WorldFileWarning> print = warning -> err.println("troupe: warning: " + warning);
        Scenario scenario = lenient ? ScenarioReader.readLeniently(file, print) : ScenarioReader.read(file, print);
        err.flush();
        return scenario;
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
