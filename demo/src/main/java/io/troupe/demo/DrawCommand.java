package io.troupe.demo;

import io.troupe.common.text.Plural;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.view.Pictures;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe draw}: draws a world file in its initial state. */
@Command(
        name = "draw",
        description = "Draws a world file as SVG, with the first readings of its sonars and lasers.",
        footer = {"  troupe draw office.world", "  troupe draw my.world --out my.svg"},
        mixinStandardHelpOptions = true)
final class DrawCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "WORLD", description = "a .world or .cfg file")
    private Path world;

    @Option(names = "--out", paramLabel = "FILE", description = "the picture; world.svg unless given")
    private Path out = Path.of("world.svg");

    @Mixin
    private WorldLoader loader;

    @Override
    public Integer call() throws IOException {
        FileProblems.checkOutput(spec, "--out", out);
        Scenario scenario = loader.read(world);
        try (var simulated = World.create(scenario.world(), WorldSettings.defaults())) {
            OutputFiles.write(out, Pictures.world(scenario.world(), simulated.latest()));
        }
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.println(Plural.of(scenario.world().robots().size(), "robot") + ", "
                + Plural.of(scenario.world().obstacles().size(), "other thing") + "; wrote " + out);
        terminal.flush();
        return 0;
    }
}
