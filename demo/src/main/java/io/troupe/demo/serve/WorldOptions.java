package io.troupe.demo.serve;

import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.CrowdWorld;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** Command line options for the world. */
final class WorldOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path world;

    @Option(names = "--crowd", paramLabel = "N", description = "instead of a file: N robots in halls of 16 m")
    private @Nullable Integer crowd;

    @Mixin
    private WorldLoader loader;

    /** Reads the world. */
    Scenario scenario() {
        if (crowd == null) {
            return loader.read(world == null ? Installation.world("paper-arena.cfg") : world);
        }
        if (world != null) {
            throw new ParameterException(spec.commandLine(), "--crowd and --world are both given, expected one");
        }
        if (crowd < 1 || crowd > CrowdWorld.MOST_ROBOTS) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--crowd is " + crowd + ", expected a number from 1 to " + CrowdWorld.MOST_ROBOTS);
        }
        return CrowdWorld.scenario(crowd);
    }
}
