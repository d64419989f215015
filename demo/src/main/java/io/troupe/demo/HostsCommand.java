package io.troupe.demo;

import io.troupe.actor.ActorSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.demo.hosts.HostProcesses;
import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.subsumption.DriverReport;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotNode;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.model.WorldSpec;
import io.troupe.tools.NatsServerProcess;
import io.troupe.view.DriverFault;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedHostedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunResult;
import io.troupe.view.live.LiveView;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.Callable;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe hosts}: the main job over several processes of one machine, with a fault. */
@Command(
        name = "hosts",
        description = {
            "Shows the main job over hosts on one machine: starts a NATS server, the robots (troupe serve), three"
                    + " providers (troupe offer) and the arbitrator, each a process; kills or freezes the provider that"
                    + " drives, in the middle; and draws who drove when.",
            "host-a offers the wall follower, host-b the space wanderer, and host-c both for the case that one of them"
                    + " is gone."
        },
        footer = {
            "  troupe hosts",
            "  troupe hosts --fault freeze --view",
            "  troupe hosts --world office.world --seconds 240"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class HostsCommand implements Callable<Integer> {
    private static final int MOST_SECONDS = 3600;
    private static final Pattern SERVED = Pattern.compile("^127\\.0\\.0\\.1:(\\d+) offers ");
    private static final Pattern OFFERED = Pattern.compile(" offers .* for the robots at ");

    /** What happens to the provider that drives. */
    enum Fault {
        KILL,
        FREEZE,
        NONE
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path world;

    @Mixin
    private WorldLoader loader;

    @Mixin
    private ViewOptions view;

    @Option(names = "--seconds", paramLabel = "N", description = "time to run, in real time")
    private double seconds = 120;

    @Option(
            names = "--fault",
            paramLabel = "FAULT",
            description =
                    "what happens in the middle to the provider that drives robot 1: KILL (SIGKILL), FREEZE (SIGSTOP, after 5 s SIGCONT) or NONE")
    private Fault fault = Fault.KILL;

    @Option(
            names = "--out",
            paramLabel = "DIR",
            description = "where drivers.svg, trajectory.svg, run.jsonl and the logs of the processes go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException, InterruptedException {
        return call(NatsServerProcess.isInstalled());
    }

    int call(boolean isServerInstalled) throws IOException, InterruptedException {
        OptionRange.checkSeconds(spec, seconds, MOST_SECONDS);
        Path file = world == null ? Installation.world("paper-arena.world") : world;
        WorldSpec read = loader.read(file).world();
        settings(read, 0); // refuses a world that does not fit
        if (!isServerInstalled) {
            throw new ParameterException(spec.commandLine(), NatsServerProcess.HOW_TO_GET);
        }
        OutputDirectory.make(spec, out);
        Path configuration = Installation.folder().resolve(Path.of("docs", "hosts", "nats.conf"));
        try (var interruption = Interruption.open();
                var processes = HostProcesses.start(out, Main.class.getName(), configuration)) {
            new Job(processes, file, read, interruption).run();
            return interruption.isRequested() ? Interruption.STATUS : 0;
        }
    }

    private RecordedHostedRun.Settings settings(WorldSpec arena, int port) {
        return new RecordedHostedRun.Settings(
                "127.0.0.1", port, arena, SubsumptionTable.ofThePaper(), Mode.PROMISE, seconds);
    }

    /** One run. */
    private final class Job {
        private final HostProcesses processes;
        private final Path file;
        private final WorldSpec arena;
        private final Interruption interruption;
        private final PrintWriter terminal = spec.commandLine().getOut();

        Job(HostProcesses processes, Path file, WorldSpec arena, Interruption interruption) {
            this.processes = processes;
            this.file = file;
            this.arena = arena;
            this.interruption = interruption;
        }

        void run() throws IOException, InterruptedException {
            print("nats-server: " + processes.bus() + ", settings of docs/hosts/nats.conf");
            int port = startHosts();
            var settings = settings(arena, port);
            print("arbitrator: this process, " + ProcessHandle.current().pid() + "; the times are the robots'");
            var events = new Faults();
            RunResult result = drive(settings, events);
            report(result, events.happened);
        }

        private int startHosts() throws IOException, InterruptedException {
            var served = processes.start(
                    "serve", SERVED, "serve", "--world", file.toString(), "--port", "0", "--bind", "127.0.0.1");
            int port = Integer.parseInt(served.await().group(1));
            print("serve: the robots at 127.0.0.1:" + port + ", process " + processes.pid("serve"));
            List<HostProcesses.Started> started = List.of(
                    offer("host-a", "wallFollower", 0, port),
                    offer("host-b", "spaceWanderer", 0, port),
                    offer("host-c", "wallFollower,spaceWanderer", 1, port));
            for (HostProcesses.Started each : started) {
                each.await();
                interruption.check();
            }
            return port;
        }

        private HostProcesses.Started offer(String node, String services, int rank, int port) throws IOException {
            var started = processes.start(
                    node,
                    OFFERED,
                    "offer",
                    "--name",
                    node,
                    "--services",
                    services,
                    "--rank",
                    String.valueOf(rank),
                    "--robots",
                    "127.0.0.1:" + port,
                    "--bus",
                    processes.bus(),
                    "--bus-user",
                    HostProcesses.USER);
            print(node + ": offers " + services.replace(",", " and ") + ", rank " + rank + ", process "
                    + processes.pid(node));
            return started;
        }

        private RunResult drive(RecordedHostedRun.Settings settings, Faults events)
                throws IOException, InterruptedException {
            var server = NatsSettings.at(processes.bus()).withUser(HostProcesses.USER, processes.password());
            try (var page = view.open();
                    var space = ActorSpace.create(HostedRunJob.settings(page));
                    var bus = NatsBus.open(
                            HostedRunJob.NODE, server, BusSettings.on(space).withObserver(events.counting(page)));
                    var node = RobotNode.open(bus, space, event -> {}, 0);
                    var log = new RunLog(out.resolve("run.jsonl"));
                    var progress = ProgressBar.onTerminal(seconds)) {
                events.watch(bus);
                var run = new RecordedHostedRun(settings);
                interruption.onRequest(run::stop);
                events.shown = progress.hostedListener(line -> progress.interrupt(() -> print(line)), interruption);
                return run.run(node, log, HostedRunJob.viewed(page, settings, events));
            }
        }

        private void report(RunResult result, @Nullable DriverFault happened) throws IOException {
            print("");
            terminal.print(result.summary());
            if (happened != null) {
                for (DriverFault.Gap gap : happened.gaps(result)) {
                    double length = (gap.endMicros() - happened.timeMicros()) / 1e6;
                    print(String.format(
                            Locale.ROOT,
                            gap.next() == null
                                    ? "%s was %s at %.1f s: robot %d had no driver for the last %.1f s"
                                    : "%s was %s at %.1f s: robot %d had no driver for %.1f s, then %s",
                            happened.node(),
                            happened.what(),
                            happened.timeMicros() / 1e6,
                            gap.robot() + 1,
                            length,
                            gap.next()));
                }
            }
            if (interruption.isRequested()) {
                print("interrupted: this is what was done until then; the last line of run.jsonl has that");
            }
            OutputFiles.write(out.resolve("drivers.svg"), Pictures.drivers(result, happened));
            String pictures = out.resolve("drivers.svg").toString();
            if (!result.robots().getFirst().path().isEmpty()) {
                OutputFiles.write(out.resolve("trajectory.svg"), Pictures.trajectory(arena, result));
                pictures += ", " + out.resolve("trajectory.svg");
            }
            print("wrote " + pictures + " and " + out.resolve("run.jsonl"));
        }

        private void print(String line) {
            terminal.println(line);
            terminal.flush();
        }

        /** Breaks the provider that drives when half of the time is over. */
        private final class Faults implements RecordedHostedRun.Listener, BusObserver {
            private static final long FROZEN_MICROS = 5_000_000;

            private final Map<Integer, String> drivers = new TreeMap<>(); // guarded by itself; robots from 0
            private RecordedHostedRun.Listener shown = new RecordedHostedRun.Listener() {};
            private volatile @Nullable LiveView page;
            private @Nullable DriverFault happened;
            private boolean isFrozen;
            private volatile long nowMicros;

            /** Counts the messages for the page, if there is one. */
            Faults counting(@Nullable LiveView newPage) {
                page = newPage;
                return this;
            }

            @Override
            public void passed(BusMessage message) {
                HostedRunJob.count(message, page);
            }

            /** Keeps which node drives which robot. */
            void watch(Bus bus) {
                bus.attach("faults").subscribe(DriverReport.TOPIC, (report, from) -> {
                    synchronized (drivers) {
                        switch (report.event()) {
                            case STARTED -> drivers.put(report.robotIndex(), from.node());
                            case ENDED, LEASE_LOST -> drivers.remove(report.robotIndex(), from.node());
                            case CYCLE_ENDED, COLOUR_SENT -> {}
                        }
                    }
                });
            }

            @Override
            public void stateStarted(String change) {
                synchronized (terminal) {
                    shown.stateStarted(change);
                }
            }

            @Override
            public void driverChanged(String line) {
                synchronized (terminal) {
                    shown.driverChanged(line);
                }
            }

            @Override
            public void ticked(long timeMicros) {
                nowMicros = timeMicros;
                synchronized (terminal) {
                    shown.ticked(timeMicros);
                }
                DriverFault before = happened;
                if (fault != Fault.NONE && before == null && timeMicros >= seconds * 1e6 / 2) {
                    begin(timeMicros);
                } else if (before != null && isFrozen && timeMicros >= before.timeMicros() + FROZEN_MICROS) {
                    signal(before.node(), "CONT");
                    isFrozen = false;
                    happens(before.node() + " goes on (SIGCONT)");
                }
            }

            private void begin(long timeMicros) {
                String victim;
                synchronized (drivers) {
                    if (drivers.isEmpty()) {
                        return; // between two services: at the next reading
                    }
                    victim = drivers.values().iterator().next();
                }
                if (fault == Fault.KILL) {
                    processes.kill(victim);
                    happens(victim + " is killed (SIGKILL)");
                } else {
                    signal(victim, "STOP");
                    isFrozen = true;
                    happens(victim + " is frozen (SIGSTOP)");
                }
                happened = new DriverFault(timeMicros, victim, fault == Fault.KILL ? "killed" : "frozen");
            }

            private void signal(String node, String name) {
                try {
                    processes.signal(node, name);
                } catch (IOException failure) {
                    throw new UncheckedIOException(failure);
                }
            }

            /** On any thread. */
            private void happens(String what) {
                driverChanged(String.format(Locale.ROOT, "%7.1f s  %s", nowMicros / 1e6, what));
            }

            @Override
            public void lost(Loss loss) {
                happens("bus: " + loss);
            }

            @Override
            public void disconnected(String why) {
                happens("not connected to the bus: " + why);
            }

            @Override
            public void connected() {
                happens("connected to the bus again");
            }

            @Override
            public boolean isStopRequested() {
                return shown.isStopRequested();
            }
        }
    }
}
