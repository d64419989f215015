package io.troupe.demo.app;

import io.troupe.common.text.Suggestions;
import io.troupe.demo.hosts.BusOptions;
import io.troupe.demo.hosts.RobotAddress;
import io.troupe.demo.monitor.AppMonitor;
import io.troupe.demo.table.ServiceJars;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.RunFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.sim.model.Scenario;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe app}: runs an application of components that the broker finds and starts and a declaration wires. */
@Command(
        name = "app",
        description = {
            "Runs a declared application on a simulated world: the broker finds and starts the services that it needs.",
            "With --bus, several processes run it together, on the robots of a server (troupe serve): each one starts the same file under the name of one of its nodes.",
            "Exit status 3: a service that it needs is missing."
        },
        footer = {"  troupe app two-robots.app", "  troupe app python.app --view", "  troupe app --list"},
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class AppCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "FILE", arity = "0..1", description = "the declaration, an .app file")
    private @Nullable Path file;

    @Option(names = "--list", description = "print the kinds of components that a declaration can name")
    private boolean list;

    @Option(names = "--seconds", paramLabel = "N", description = "simulated time to run; over a bus real time")
    private double seconds = 60;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private Path world = Installation.world("paper-arena.cfg");

    @Mixin
    private WorldLoader loader;

    @Mixin
    private ServiceJars jars;

    @Option(names = "--realtime", description = "no faster than real time")
    private boolean realtime;

    @Option(
            names = "--robots",
            paramLabel = "HOST:PORT",
            description = "over a bus: where a Player server offers the robots; the file's values host and port")
    private @Nullable String robots;

    @Mixin
    private BusOptions bus;

    @Mixin
    private ViewOptions view;

    @Option(
            names = "--monitor",
            description =
                    "follow the declared protocols of providers, components and messages, and end with the story if something is not allowed")
    private boolean monitored;

    @Option(names = "--out", paramLabel = "DIR", description = "where trajectory.svg and run.jsonl go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException, InterruptedException {
        PrintWriter terminal = spec.commandLine().getOut();
        if (list) {
            ComponentKinds.standard().all().forEach(kind -> terminal.print(kind.describe()));
            terminal.flush();
            return 0;
        }
        if (file == null) {
            throw new ParameterException(spec.commandLine(), "FILE is missing, expected a declaration (or --list)");
        }
        if (!(seconds > 0) || seconds > 1e6) {
            throw new ParameterException(
                    spec.commandLine(), "--seconds is " + seconds + ", expected a number above 0 and up to 1000000");
        }
        Path declaration = FileProblems.input(spec, file, "the file of a declaration");
        if (bus.isGiven()) {
            return overBus(declaration, terminal);
        }
        bus.refuseWithoutBus();
        if (robots != null) {
            throw wrong("--robots is " + robots + ", but there is no bus: expected --bus as well");
        }
        Scenario scenario = loader.read(world);
        try (var opened = jars;
                var interruption = Interruption.open()) {
            var kinds = ComponentKinds.standard(opened.catalogue(declaration));
            AppMonitor monitor = monitored ? new AppMonitor() : null;
            try (var page = view.open();
                    var files = new RunFiles(spec, out, scenario.world(), seconds)) {
                new AppRun(declaration, kinds, scenario, new AppReport(terminal), page, monitor, files)
                        .run(seconds, realtime, interruption::isRequested);
            }
            if (monitor != null) {
                terminal.println(monitor.summary());
                terminal.flush();
            }
            return interruption.isRequested() ? Interruption.STATUS : 0;
        }
    }

    private int overBus(Path declaration, PrintWriter terminal) throws IOException, InterruptedException {
        for (String option : List.of("--world", "--realtime", "--view", "--monitor", "--out")) {
            if (spec.commandLine().getParseResult().hasMatchedOption(option)) {
                throw wrong(
                        option + " is given with --bus, expected only --robots: over a bus the world runs elsewhere,"
                                + " in real time");
            }
        }
        if (robots == null) {
            throw wrong("--robots is missing, expected HOST:PORT of a Player server (troupe serve)");
        }
        RobotAddress address = RobotAddress.parse(spec, robots);
        try (var opened = jars;
                var interruption = Interruption.open()) {
            var plan = ApplicationReader.read(
                    declaration,
                    ComponentKinds.standard(opened.catalogue(declaration)),
                    Map.of("host", address.host(), "port", String.valueOf(address.port())));
            checkNode(declaration, plan);
            new AppOverBus(declaration, plan, bus::open, new AppReport(terminal))
                    .run(seconds, interruption::isRequested);
            return interruption.isRequested() ? Interruption.STATUS : 0;
        }
    }

    private void checkNode(Path declaration, ApplicationPlan plan) {
        if (plan.nodes().isEmpty()) {
            throw wrong(declaration + " names no nodes, expected \"application " + plan.name()
                    + " on NODE,NODE\" for --bus");
        }
        boolean first = plan.nodes().getFirst().equals(bus.node());
        if (!first && plan.componentsOn(bus.node()).isEmpty()) {
            throw wrong("--name is " + bus.node() + ", which is no node with components of " + declaration + "; "
                    + Suggestions.hintWithSome(bus.node(), plan.nodes()));
        }
    }

    private ParameterException wrong(String problem) {
        return new ParameterException(spec.commandLine(), problem);
    }
}
