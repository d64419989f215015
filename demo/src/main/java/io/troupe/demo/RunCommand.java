package io.troupe.demo;

import io.troupe.demo.hosts.BusOptions;
import io.troupe.demo.hosts.RobotAddress;
import io.troupe.demo.monitor.RunMonitor;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Mode;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedHostedRun;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import io.troupe.view.RunResult;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.ViewFile;
import io.troupe.view.live.ViewedRun;
import io.troupe.view.tools.RunFileException;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe run}: runs the paper's two robots with two services and three colours, or a crowd of any size. */
@Command(
        name = "run",
        description = "Lets the robots of a world follow walls, wander, and swap services by the colours they see.",
        footer = {
            "  troupe run --view",
            "  troupe run --seed 7 --seconds 60 --mode sync --out out/sync",
            "  troupe run --world office.world"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class RunCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Mixin
    private TeamOptions teamOptions;

    @Mixin
    private BusOptions busOptions;

    @Mixin
    private ViewOptions viewOptions;

    @Option(
            names = "--view-speed",
            paramLabel = "N",
            description = "with --view: how many times as fast as real time at first; 0 = as fast as possible")
    private double viewSpeed = 1;

    @Option(
            names = "--html",
            paramLabel = "FILE",
            description = "write a page with the whole run, which any browser plays",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path html;

    @Option(
            names = "--repeat",
            paramLabel = "FILE",
            description = "repeat what was done by hand in the run that wrote this run.jsonl",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path repeat;

    @Option(names = "--seconds", paramLabel = "N", description = "simulated time to run")
    private double seconds = 300;

    @Option(
            names = "--seed",
            paramLabel = "N",
            description = "moves the start poses by up to 2 cm along x and y, and 2 degrees")
    private long seed = 1;

    @Option(
            names = "--corners",
            paramLabel = "STYLE",
            description =
                    "how the wall follower turns at a wall ahead: FORWARD as in the paper, BACKWARD as its model program does")
    private CornerStyle corners = CornerStyle.FORWARD;

    @Option(
            names = "--mode",
            paramLabel = "MODE",
            description =
                    "how the services run: sync (one after the other), callback (every colour is sent), promise (one colour is sent)")
    private Mode mode = Mode.PROMISE;

    @Option(
            names = "--reconnect",
            description = "connect with the robots anew at every switch, as the paper does; not with --mode sync")
    private boolean reconnect;

    @Option(names = "--realtime", description = "no faster than real time")
    private boolean realtime;

    @Option(
            names = "--monitor",
            description =
                    "follow the declared protocols of arbitrator, services and messages, and end the run with the story if a message is not allowed")
    private boolean monitored;

    @Option(names = "--out", paramLabel = "DIR", description = "where trajectory.svg and run.jsonl go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException, InterruptedException {
        if (!(seconds > 0) || seconds > 1e6) {
            throw new ParameterException(
                    spec.commandLine(), "--seconds is " + seconds + ", expected a number above 0 and up to 1000000");
        }
        if (!(viewSpeed >= 0) || viewSpeed > 1e6) {
            throw new ParameterException(
                    spec.commandLine(), "--view-speed is " + viewSpeed + ", expected a number from 0 to 1000000");
        }
        if (html != null) {
            FileProblems.checkOutput(spec, "--html", html);
        }
        if (repeat != null) {
            repeat = FileProblems.input(spec, repeat, "the run.jsonl of a run");
        }
        if (mode == Mode.SYNC && reconnect) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--reconnect goes with --mode callback or promise: the synchronous mode connects once");
        }
        RobotAddress address = teamOptions.address();
        checkHosts(address);
        try (var options = teamOptions) {
            TeamOptions.Team team = options.team(corners);
            if (address == null) {
                run(team); // refuses a world that does not fit
            } else {
                settings(address, team); // the same
            }
            OutputDirectory.make(spec, out);
            warnOfSizes(team.scenario().world());
            try (var interruption = Interruption.open()) {
                if (address == null) {
                    run(run(team), team, interruption);
                } else {
                    new HostedRunJob(spec, busOptions, viewOptions, out).run(settings(address, team), interruption);
                }
                return interruption.isRequested() ? Interruption.STATUS : 0;
            }
        }
    }

    /** Rejects combinations of options that make no sense over hosts, or without them. */
    private void checkHosts(@Nullable RobotAddress address) {
        if (address == null) {
            busOptions.refuseWithoutBus();
            if (busOptions.isGiven()) {
                throw new ParameterException(
                        spec.commandLine(),
                        "--bus is given, but the robots are in this process: expected --robots HOST:PORT as well");
            }
            return;
        }
        if (!busOptions.isGiven()) {
            throw new ParameterException(
                    spec.commandLine(), "--robots is " + address + ", but there is no bus: expected --bus as well");
        }
        if (mode == Mode.SYNC) {
            throw new ParameterException(
                    spec.commandLine(), "--mode is sync, expected callback or promise for services on other hosts");
        }
        for (String option :
                List.of("--seed", "--reconnect", "--realtime", "--html", "--repeat", "--view-speed", "--monitor")) {
            if (spec.commandLine().getParseResult().hasMatchedOption(option)) {
                throw new ParameterException(
                        spec.commandLine(),
                        option + " is for robots in this process, and --robots is " + address
                                + ": expected only one of them");
            }
        }
    }

    private RecordedHostedRun.Settings settings(RobotAddress address, TeamOptions.Team team) {
        return new RecordedHostedRun.Settings(
                address.host(), address.port(), team.scenario().world(), team.table(), mode, seconds);
    }

    private void warnOfSizes(WorldSpec world) {
        var sizes = Sizes.of(world.robots().size(), world.intervalMillis(), seconds);
        if (sizes.areLarge()) {
            PrintWriter err = spec.commandLine().getErr();
            err.println("troupe: warning: --seconds is " + seconds + ": expect about " + sizes.describe());
            err.flush();
        }
    }

    private RecordedRun run(TeamOptions.Team team) {
        var settings = RecordedRun.Settings.defaults()
                .withMode(mode)
                .withSeed(seed)
                .withSeconds(seconds)
                .withRealTime(realtime && !viewOptions.isGiven())
                .withReconnection(reconnect);
        return new RecordedRun(team.scenario(), team.table(), settings);
    }

    private void run(RecordedRun run, TeamOptions.Team team, Interruption interruption)
            throws IOException, InterruptedException {
        PrintWriter terminal = spec.commandLine().getOut();
        Scenario scenario = team.scenario();
        long begin = System.nanoTime();
        RunResult result;
        Path file = out.resolve("run.jsonl");
        ViewFile film = html == null ? null : new ViewFile();
        RunMonitor monitor = monitored ? new RunMonitor(mode, team.table().robots()) : null;
        try (var page = viewOptions.open();
                var log = new RunLog(file)) {
            try (var progress = ProgressBar.onTerminal(seconds)) {
                var listener =
                        progress.listener(change -> progress.interrupt(() -> terminal.println(change)), interruption);
                result =
                        run.run(log, viewed(team, page, film, monitor == null ? listener : monitor.listener(listener)));
            }
            if (page != null) {
                page.close("the run has ended");
            }
            double wallSeconds = (System.nanoTime() - begin) / 1e9;
            terminal.printf(
                    Locale.ROOT,
                    "%n%s, %s mode%s, seed %d: %s s simulated in %.1f s, %.0f times real time%n",
                    scenario.world().name(),
                    mode,
                    reconnect ? " with reconnection" : "",
                    seed,
                    result.duration(),
                    wallSeconds,
                    result.endMicros() / 1e6 / wallSeconds);
            terminal.print(result.summary());
            if (monitor != null) {
                terminal.println(monitor.summary());
            }
            terminal.flush(); // before writing files, which may fail
        }
        Path picture = out.resolve("trajectory.svg");
        OutputFiles.write(picture, Pictures.trajectory(scenario.world(), result));
        if (interruption.isRequested() && result.endMicros() < StrictMath.round(seconds * 1e6)) {
            terminal.println("interrupted: this is what was done until then; the last line of run.jsonl has that");
        }
        if (film != null && html != null) {
            OutputFiles.write(html, film.html());
        }
        terminal.println("wrote " + picture + (html == null ? "" : ", " + html) + " and " + file);
        terminal.flush();
    }

    /** The listener of a run, which also shows it if that is wanted, and repeats interventions. */
    private RecordedRun.Listener viewed(
            TeamOptions.Team team, @Nullable LiveView page, @Nullable ViewFile film, RecordedRun.Listener listener)
            throws IOException {
        if (page == null && film == null && repeat == null) {
            return listener;
        }
        var control = new RunControl(page == null ? 0 : viewSpeed, page != null);
        WorldSpec world = team.scenario().world();
        if (repeat != null) {
            try {
                control.repeat(
                        repeat,
                        world,
                        Map.of(
                                "seed", Long.toString(seed),
                                "mode", mode.toString(),
                                "reconnect", Boolean.toString(reconnect)));
            } catch (IllegalArgumentException | RunFileException e) {
                throw new ParameterException(spec.commandLine(), "--repeat: " + e.getMessage(), e);
            }
        }
        var viewed = new ViewedRun(world, team.table(), control);
        if (page != null) {
            viewed.onto(page);
        }
        if (film != null) {
            viewed.onto(film);
        }
        return viewed.listener(listener);
    }

    /** Estimated sizes of the output files, for the warning before a long run. */
    record Sizes(double logBytes, double pictureBytes) {
        private static final double LARGE_BYTES = 50e6;
        /** Measured in the paper's arena. */
        private static final double BYTES_PER_POSE = 160;

        private static final double BYTES_PER_POINT = 12;

        static Sizes of(int robots, long intervalMillis, double seconds) {
            double poses = robots * seconds * 1000 / intervalMillis;
            double logged = robots < RunRecorder.MANY_ROBOTS ? poses : robots * seconds;
            return new Sizes(logged * BYTES_PER_POSE, poses * BYTES_PER_POINT);
        }

        boolean areLarge() {
            return logBytes > LARGE_BYTES || pictureBytes > LARGE_BYTES;
        }

        String describe() {
            return String.format(
                    Locale.ROOT,
                    "%.0f MB in run.jsonl and at most %.0f MB in trajectory.svg",
                    logBytes / 1e6,
                    pictureBytes / 1e6);
        }
    }
}
