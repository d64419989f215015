package io.troupe.faults;

import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.Broken;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.FaultEnded;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.History;
import io.troupe.faults.hosts.HostProcess;
import io.troupe.faults.hosts.Hosts;
import io.troupe.faults.node.RobotsMain;
import io.troupe.faults.node.WorldMain;
import io.troupe.services.subsumption.Mode;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeSet;
import java.util.function.Consumer;

/**
 * One run of the main job: a server, a world with two robots, three providers and an arbitrator are started, and broken
 * at random, one at a time.
 */
final class DriverFaultRun implements FaultRun {
    private static final int ROBOTS = 2;
    private static final int READY_SECONDS = 60;
    private static final int FREEZE_MILLIS = 5_000;
    private static final int LONG_MILLIS = 9_000; // an arbitrator without providers ends before
    private static final long DRIVEN_NANOS = 400_000_000; // the last command is not older
    private static final long DRIVEN_LIMIT_NANOS = 30_000_000_000L;
    private static final int POLL_MILLIS = 50;

    private final Hosts hosts;
    private final Path folder;
    private final Random random;
    private final History.Writer history;
    private final Consumer<Progress> progress;
    private final BusServer server;
    private final Map<String, HostProcess> processes = new HashMap<>();
    private final Map<String, Integer> lives = new HashMap<>();
    private final Mode mode;
    private String world = "";

    /**
     * Creates a run.
     *
     * @param folder gets the histories
     * @param progress is called at each fault
     */
    DriverFaultRun(Hosts hosts, Path folder, long seed, Consumer<Progress> progress) throws IOException {
        this.hosts = hosts;
        this.folder = Files.createDirectories(folder);
        this.random = new Random(seed);
        this.history = new History.Writer(folder, "suite");
        this.progress = progress;
        this.server = new BusServer(hosts, folder, this::surprise);
        this.mode = random.nextBoolean() ? Mode.PROMISE : Mode.CALLBACK;
    }

    /** Breaks one thing after the other: the next one when the robots are driven again. */
    @Override
    public History run(int faults) throws IOException, InterruptedException {
        startWorld();
        startServer();
        for (String host : Hosts.NODES) {
            startProvider(host);
        }
        startArbitrator();
        awaitDriven();
        for (long number = 1; number <= faults; number++) {
            Thread.sleep(random.nextInt(200, 1_000));
            Fault fault = next();
            var began = new DriverFaultBegan(number, fault.kind, String.join(",", fault.hosts), fault.details);
            history.add(began);
            progress.accept(new Progress(number, fault.kind + " " + began.target() + " " + fault.details));
            fault.act.run();
            history.add(new Broken(number));
            Thread.sleep(fault.millis);
            fault.repair.run();
            history.add(new FaultEnded(number));
            awaitDriven();
        }
        end();
        return History.read(folder);
    }

    private void end() throws InterruptedException {
        var order = new ArrayList<>(List.of(Hosts.ARBITRATOR));
        order.addAll(Hosts.NODES);
        for (String host : order) {
            HostProcess process = process(host);
            process.mayEnd();
            process.command("close");
            if (process.await("closed", READY_SECONDS) == null) {
                surprise(process + " does not close: " + process.lastLines());
            }
        }
    }

    private void surprise(String what) {
        history.add(new Surprise(what));
    }

    // ---- processes

    private HostProcess process(String host) {
        HostProcess process = processes.get(host);
        if (process == null) {
            throw new IllegalStateException("there is no process on host " + host);
        }
        return process;
    }

    private void startServer() throws IOException, InterruptedException {
        processes.put(Hosts.SERVER, server.start());
    }

    private void startWorld() throws IOException, InterruptedException {
        String address = hosts.address(Hosts.WORLD);
        HostProcess started =
                start(Hosts.WORLD, WorldMain.class, List.of("w-1", folder.toString(), address, "services"));
        String line = started.await("world at ", READY_SECONDS);
        if (line == null) {
            throw new IOException("the world does not start: " + started.lastLines());
        }
        world = address + ":" + line.substring(line.lastIndexOf(' ') + 1);
    }

    private HostProcess start(String host, Class<?> main, List<String> arguments) throws IOException {
        var command = hosts.on(host, HostProcess.java(main, arguments));
        var started = HostProcess.start(host + "-" + lives.getOrDefault(host, 1), command, this::surprise);
        processes.put(host, started);
        return started;
    }

    private String name(String host) {
        return host + "-" + lives.getOrDefault(host, 1);
    }

    private void startProvider(String host) throws IOException, InterruptedException {
        lives.merge(host, 1, Integer::sum);
        var arguments = List.of(host, name(host), server.address(), folder.toString(), world);
        awaitReady(start(host, RobotsMain.class, arguments));
    }

    private void startArbitrator() throws IOException, InterruptedException {
        String host = Hosts.ARBITRATOR;
        lives.merge(host, 1, Integer::sum);
        var arguments = List.of(RobotsMain.ARBITRATOR, name(host), server.address(), folder.toString(), mode.name());
        awaitReady(start(host, RobotsMain.class, arguments));
    }

    private void awaitReady(HostProcess process) throws InterruptedException {
        if (process.await("ready", READY_SECONDS) == null) {
            surprise(process + " is not ready after " + READY_SECONDS + " s: " + process.lastLines());
        }
    }

    // ---- who drives

    /** Until all are connected, and each robot is driven; an arbitrator that has ended is followed by another one. */
    private void awaitDriven() throws IOException, InterruptedException {
        var members = new ArrayList<>(Hosts.NODES);
        members.add(Hosts.ARBITRATOR);
        for (String host : members) {
            process(host).command("settle");
        }
        for (String host : members) {
            if (process(host).await("settled", READY_SECONDS) == null) {
                surprise(process(host) + " is not connected again: "
                        + process(host).lastLines());
            }
        }
        long since = System.nanoTime();
        while (drivers().size() < ROBOTS) {
            if (History.readEnd(folder, name(Hosts.ARBITRATOR)).stream()
                    .anyMatch(entry -> entry.event() instanceof ArbitratorEnded)) {
                process(Hosts.ARBITRATOR).kill();
                startArbitrator();
            }
            if (System.nanoTime() - since > DRIVEN_LIMIT_NANOS) {
                throw new IOException("the robots are not driven again: only " + drivers());
            }
            Thread.sleep(POLL_MILLIS);
        }
    }

    /** The host of the provider of each robot that is driven now. */
    private Map<Integer, String> drivers() throws IOException {
        Map<Integer, String> drivers = new HashMap<>();
        long now = System.nanoTime();
        for (String host : Hosts.NODES) {
            for (History.Entry entry : History.readEnd(folder, name(host))) {
                if (entry.event() instanceof Commanded command && now - entry.nanos() < DRIVEN_NANOS) {
                    drivers.put(command.robot(), host);
                }
            }
        }
        return drivers;
    }

    // ---- faults

    private interface Act {
        void run() throws IOException, InterruptedException;
    }

    private record Fault(DriverFaultKind kind, List<String> hosts, String details, Act act, int millis, Act repair) {}

    /** The next random fault that is possible now. */
    private Fault next() throws IOException, InterruptedException {
        DriverFaultKind[] kinds = DriverFaultKind.values();
        while (true) {
            DriverFaultKind kind = kinds[random.nextInt(kinds.length)];
            if (!hosts.canCut() && kind.name().startsWith("CUT")) {
                continue;
            }
            var driving = new TreeSet<>(drivers().values());
            List<String> spare =
                    Hosts.NODES.stream().filter(host -> !driving.contains(host)).toList();
            if (driving.isEmpty() || spare.isEmpty()) {
                Thread.sleep(POLL_MILLIS);
                continue;
            }
            return fault(kind, any(List.copyOf(driving)), any(spare));
        }
    }

    private String any(List<String> of) {
        return of.get(random.nextInt(of.size()));
    }

    private Fault fault(DriverFaultKind kind, String driver, String spare) {
        return switch (kind) {
            case KILL_DRIVER -> killed(kind, List.of(driver), random.nextInt(2_000));
            case KILL_SPARE -> killed(kind, List.of(spare), random.nextInt(2_000));
            case KILL_ALL_PROVIDERS -> killed(kind, Hosts.NODES, LONG_MILLIS);
            case KILL_ARBITRATOR -> killed(kind, List.of(Hosts.ARBITRATOR), random.nextInt(3_000));
            case KILL_SERVER -> killed(kind, List.of(Hosts.SERVER), random.nextInt(1_000, 3_000));
            case FREEZE_DRIVER -> frozen(kind, driver);
            case FREEZE_SPARE -> frozen(kind, spare);
            case FREEZE_ARBITRATOR -> frozen(kind, Hosts.ARBITRATOR);
            case FREEZE_SERVER -> frozen(kind, Hosts.SERVER);
            case CUT_DRIVER -> cut(kind, driver, random.nextInt(500, 5_000));
            case CUT_SPARE -> cut(kind, spare, random.nextInt(500, 5_000));
            case CUT_ARBITRATOR ->
                cut(kind, Hosts.ARBITRATOR, random.nextInt(3) == 0 ? LONG_MILLIS : random.nextInt(500, 5_000));
            case CUT_DRIVER_FROM_ROBOTS -> {
                int millis = random.nextInt(1_000, 6_000);
                yield new Fault(
                        kind,
                        List.of(driver),
                        "for " + millis + " ms",
                        () -> hosts.cutWay(driver, Hosts.WORLD),
                        millis,
                        () -> hosts.healWay(driver, Hosts.WORLD));
            }
        };
    }

    private Fault killed(DriverFaultKind kind, List<String> hit, int millis) {
        return new Fault(
                kind,
                hit,
                "for " + millis + " ms",
                () -> {
                    for (String host : hit) {
                        process(host).kill();
                    }
                },
                millis,
                () -> {
                    for (String host : hit) {
                        start(host);
                    }
                });
    }

    private void start(String host) throws IOException, InterruptedException {
        switch (host) {
            case Hosts.SERVER -> startServer();
            case Hosts.ARBITRATOR -> startArbitrator();
            default -> startProvider(host);
        }
    }

    private Fault frozen(DriverFaultKind kind, String host) {
        return new Fault(
                kind,
                List.of(host),
                "",
                () -> process(host).signal("STOP"),
                FREEZE_MILLIS,
                () -> process(host).signal("CONT"));
    }

    private Fault cut(DriverFaultKind kind, String host, int millis) {
        boolean silently = random.nextBoolean();
        return new Fault(
                kind,
                List.of(host),
                (silently ? "silently " : "") + "for " + millis + " ms",
                () -> hosts.cut(host, silently),
                millis,
                () -> hosts.heal(host));
    }

    @Override
    public void close() {
        processes.values().forEach(HostProcess::close);
        history.close();
    }
}
