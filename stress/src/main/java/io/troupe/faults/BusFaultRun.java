package io.troupe.faults;

import io.troupe.actor.ActorSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.faults.history.Event.FaultBegan;
import io.troupe.faults.history.Event.FaultEnded;
import io.troupe.faults.history.Event.FaultKind;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.History;
import io.troupe.faults.hosts.HostProcess;
import io.troupe.faults.hosts.Hosts;
import io.troupe.faults.node.NodeMain;
import io.troupe.faults.node.WorldMain;
import java.io.IOException;
import java.net.Socket;
import java.net.SocketException;
import java.net.SocketTimeoutException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.function.Consumer;

/** One run: a server and three nodes are started, broken at random, repaired, and ended in good order. */
final class BusFaultRun implements FaultRun {
    private static final int READY_SECONDS = 60;
    private static final int MOST_BROKEN = 2; // hosts and servers that are broken at the same time
    private static final int FREEZE_MILLIS = 5_000;
    private static final int AFTER_QUIET_MILLIS = 3_000; // the marks of the topics are sent
    private static final long WELL_AFTER_NANOS = 5_000_000_000L;

    private final Hosts hosts;
    private final BusServer server;
    private final Path folder;
    private final Random random;
    private final History.Writer history;
    private final Consumer<Progress> progress;
    private final Map<String, HostProcess> processes = new ConcurrentHashMap<>();
    private final Map<String, Integer> lives = new ConcurrentHashMap<>();
    private final Map<String, Long> wellSince = new HashMap<>(); // guarded by itself; without the hosts that are broken
    private String world = "";
    private final ExecutorService breaking = Executors.newCachedThreadPool(
            Thread.ofPlatform().daemon().factory()); // virtual ones wait for processes in turns

    /**
     * Creates a run.
     *
     * @param folder gets the histories
     * @param progress is called at each fault
     */
    BusFaultRun(Hosts hosts, Path folder, long seed, Consumer<Progress> progress) throws IOException {
        this.hosts = hosts;
        this.folder = Files.createDirectories(folder);
        this.random = new Random(seed);
        this.history = new History.Writer(folder, "suite");
        this.progress = progress;
        this.server = new BusServer(hosts, this.folder, this::surprise);
    }

    @Override
    public History run(int faults) throws IOException, InterruptedException {
        startWorld();
        startServer();
        for (String node : Hosts.NODES) {
            startNode(node);
        }
        Hosts.NODES.forEach(this::awaitReady);
        Hosts.NODES.forEach(this::isWell);
        isWell(Hosts.SERVER);
        List<Future<?>> open = new ArrayList<>();
        for (long number = 1; number <= faults; number++) {
            Thread.sleep(random.nextInt(300, 1_500));
            Fault fault = next();
            history.add(new FaultBegan(number, fault.kind, fault.host, fault.details));
            progress.accept(new Progress(number, fault.toString()));
            long its = number;
            open.add(breaking.submit(() -> {
                fault.act.run();
                history.add(new FaultEnded(its));
                if (!isHarmless(fault.kind)) {
                    isWell(fault.host);
                }
                return null;
            }));
        }
        for (Future<?> fault : open) {
            try {
                fault.get();
            } catch (ExecutionException failure) {
                history.add(new Surprise("the suite failed: " + failure.getCause()));
            }
        }
        end();
        return History.read(folder);
    }

    /** All nodes are connected; then they end their calls; then they write down what is left. */
    private void end() throws InterruptedException {
        for (String phase : List.of("settle", "quiet", "close")) {
            Hosts.NODES.forEach(node -> processes.get(node).command(phase));
            for (String node : Hosts.NODES) {
                if (processes
                                .get(node)
                                .await(
                                        phase.equals("quiet") ? phase : phase.replaceFirst("e$", "") + "ed",
                                        READY_SECONDS)
                        == null) {
                    surprise(processes.get(node) + " does not " + phase);
                }
            }
            if (phase.equals("settle")) {
                Thread.sleep(1_000); // values of nodes that all are connected
            } else if (phase.equals("quiet")) {
                Thread.sleep(AFTER_QUIET_MILLIS);
                processes.values().forEach(HostProcess::mayEnd);
            }
        }
    }

    private void surprise(String what) {
        history.add(new Surprise(what));
    }

    // ---- processes

    private void startServer() throws IOException, InterruptedException {
        processes.put(Hosts.SERVER, server.start());
    }

    /** On the host of the last node, whose link is cut as well. */
    private void startWorld() throws IOException, InterruptedException {
        String host = Hosts.NODES.getLast();
        List<String> arguments = List.of("world-1", folder.toString(), hosts.address(host), "bus");
        var started = HostProcess.start(
                "world-1", hosts.on(host, HostProcess.java(WorldMain.class, arguments)), this::surprise);
        processes.put("world", started);
        String line = started.await("world at ", READY_SECONDS);
        if (line == null) {
            throw new IOException("the world does not start: " + started.lastLines());
        }
        world = hosts.address(host) + ":" + line.substring(line.lastIndexOf(' ') + 1);
    }

    private void startNode(String node) throws IOException {
        String process = node + "-" + lives.merge(node, 1, Integer::sum);
        List<String> arguments =
                List.of(node, process, server.address(), folder.toString(), "" + random.nextLong(), world);
        var command = hosts.on(node, HostProcess.java(NodeMain.class, arguments));
        processes.put(node, HostProcess.start(process, command, this::surprise));
    }

    private void awaitReady(String node) {
        try {
            HostProcess process = processes.get(node);
            if (process.await("ready", READY_SECONDS) == null) {
                surprise(process + " is not ready after " + READY_SECONDS + " s: " + process.lastLines());
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    // ---- which host is broken

    private void isWell(String host) {
        synchronized (wellSince) {
            wellSince.put(host, System.nanoTime());
        }
    }

    /** Marks a host as broken, if it and enough others are well. */
    private boolean take(String host) {
        synchronized (wellSince) {
            return wellSince.size() > 1 + Hosts.NODES.size() - MOST_BROKEN && wellSince.remove(host) != null;
        }
    }

    private boolean isWellForLong(String host) {
        synchronized (wellSince) {
            Long since = wellSince.get(host);
            return since != null && System.nanoTime() - since > WELL_AFTER_NANOS;
        }
    }

    // ---- faults

    private interface Act {
        void run() throws IOException, InterruptedException;
    }

    private record Fault(FaultKind kind, String host, String details, Act act) {
        @Override
        public String toString() {
            return kind + " " + host + (details.isEmpty() ? "" : ", " + details);
        }
    }

    /** The next random fault that is possible now. */
    private Fault next() throws InterruptedException {
        FaultKind[] kinds = FaultKind.values();
        while (true) {
            Fault fault = fault(kinds[random.nextInt(kinds.length)]);
            boolean isPossible =
                    hosts.canCut() || fault.kind != FaultKind.CUT_NODE && fault.kind != FaultKind.CUT_SERVER;
            if (isPossible && (isHarmless(fault.kind) || take(fault.host))) {
                return fault;
            }
            Thread.sleep(20);
        }
    }

    private static boolean isHarmless(FaultKind kind) {
        return switch (kind) {
            case SLOW_SUBSCRIBER, FLOOD, NAME_TAKEN, OVERSIZED, UNREADABLE -> true;
            default -> false;
        };
    }

    private Fault fault(FaultKind kind) {
        String node = Hosts.NODES.get(random.nextInt(Hosts.NODES.size()));
        int millis = random.nextInt(2_500);
        return switch (kind) {
            case KILL_PROVIDER -> killed(kind, Hosts.NODES.get(random.nextInt(2)), millis);
            case KILL_BROKER -> killed(kind, Hosts.NODES.getLast(), millis);
            case KILL_SERVER -> new Fault(kind, Hosts.SERVER, "for " + millis + " ms", () -> killServer(millis));
            case FREEZE_NODE -> new Fault(kind, node, "", () -> freeze(node));
            case FREEZE_SERVER -> new Fault(kind, Hosts.SERVER, "", () -> freeze(Hosts.SERVER));
            case CUT_NODE -> cut(kind, node, 2 * millis);
            case CUT_SERVER -> cut(kind, Hosts.SERVER, 2 * millis);
            case SLOW_SUBSCRIBER -> command(kind, node, "slow " + 2 * millis);
            case FLOOD -> command(kind, node, "flood " + 4 * millis);
            case OVERSIZED -> command(kind, node, "big");
            case NAME_TAKEN -> new Fault(kind, node, "", () -> takeName(node));
            case UNREADABLE -> {
                long seed = random.nextLong();
                yield new Fault(kind, node, "", () -> sendUnreadable(node, new Random(seed)));
            }
        };
    }

    private Fault killed(FaultKind kind, String node, int millis) {
        return new Fault(kind, node, "for " + millis + " ms", () -> {
            processes.get(node).kill();
            Thread.sleep(millis);
            startNode(node);
            awaitReady(node);
        });
    }

    private void killServer(int millis) throws IOException, InterruptedException {
        processes.get(Hosts.SERVER).kill();
        Thread.sleep(millis);
        startServer();
    }

    private void freeze(String host) throws IOException, InterruptedException {
        HostProcess process = processes.get(host);
        process.signal("STOP");
        Thread.sleep(FREEZE_MILLIS);
        process.signal("CONT");
    }

    private Fault cut(FaultKind kind, String host, int millis) {
        boolean silently = random.nextBoolean();
        return new Fault(kind, host, (silently ? "silently " : "") + "for " + millis + " ms", () -> {
            hosts.cut(host, silently);
            Thread.sleep(millis);
            hosts.heal(host);
        });
    }

    private Fault command(FaultKind kind, String node, String command) {
        return new Fault(kind, node, command, () -> processes.get(node).command(command));
    }

    /** Another process has the name of a node: the bus refuses it, unless the node itself is broken. */
    private void takeName(String node) {
        boolean mustBeRefused = isWellForLong(node) && isWellForLong(Hosts.SERVER);
        try (Bus twin = NatsBus.open(
                node,
                NatsSettings.at(server.address()),
                BusSettings.on(ActorSpace.global()).withObserver(loss -> {}))) {
            if (mustBeRefused && isWellForLong(node) && isWellForLong(Hosts.SERVER)) {
                surprise("two processes have the name of " + twin.node());
            }
        } catch (BusException refused) {
            if (mustBeRefused
                    && !String.valueOf(refused.getMessage()).contains("another process has that name")
                    && isWellForLong(node)
                    && isWellForLong(Hosts.SERVER)) {
                surprise("a second " + node + " was refused by: " + refused.getMessage());
            }
        }
    }

    /** Writes bytes that are no frames, in the protocol of NATS. */
    private void sendUnreadable(String node, Random bytes) {
        try (var socket = new Socket(hosts.address(Hosts.SERVER), server.port())) {
            var out = socket.getOutputStream();
            out.write("CONNECT {\"verbose\":false,\"pedantic\":false}\r\n".getBytes(StandardCharsets.US_ASCII));
            for (String subject : List.of("troupe.t.bursts", "troupe.t.fresh.latest", "troupe.n." + node)) {
                var garbage = new byte[bytes.nextInt(200)];
                bytes.nextBytes(garbage);
                out.write(("PUB " + subject + " " + garbage.length + "\r\n").getBytes(StandardCharsets.US_ASCII));
                out.write(garbage);
                out.write("\r\n".getBytes(StandardCharsets.US_ASCII));
            }
            out.write("PING\r\n".getBytes(StandardCharsets.US_ASCII));
            out.flush();
            socket.setSoTimeout(FREEZE_MILLIS);
            while (socket.getInputStream().read() >= 0
                    && socket.getInputStream().available() > 0) {}
        } catch (SocketException | SocketTimeoutException broken) {
            return; // the server is broken as well
        } catch (IOException failure) {
            surprise("unreadable bytes could not be sent: " + failure);
        }
    }

    @Override
    public void close() {
        breaking.shutdownNow();
        processes.values().forEach(HostProcess::close);
        history.close();
    }
}
