package io.troupe.demo.serve;

import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import io.troupe.tools.ProgressLine;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.SimulationControl;
import io.troupe.view.live.ViewedRun;
import java.io.FilterWriter;
import java.io.IOException;
import java.io.Writer;
import java.net.InetAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.CountDownLatch;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A world and the TCP servers that offer it.
 *
 * <p><b>Threads.</b> {@link #run} blocks its caller. {@link #stop} ends it and may be called by any thread.
 */
final class Serving implements AutoCloseable {
    private static final long MICROS_PER_SECOND = 1_000_000;

    private final Scenario scenario;
    private final Simulation simulation;
    /** By the port of the scenario. */
    private final Map<Integer, TcpServer> servers = new TreeMap<>();

    private final InetAddress bind;
    private final CountDownLatch stopped = new CountDownLatch(1);

    private Serving(Scenario scenario, Simulation simulation, InetAddress bind) {
        this.scenario = scenario;
        this.simulation = simulation;
        this.bind = bind;
    }

    /**
     * Creates the world and opens the server sockets.
     *
     * @param port for devices that the scenario offers on Player's default port
     */
    static Serving open(Scenario given, WorldSettings settings, InetAddress bind, int port, boolean lockStep) {
        return open(given, settings, bind, port, lockStep, 0);
    }

    /**
     * As above, with a limit on clients.
     *
     * @param maxClients per port; 0 means no limit
     */
    static Serving open(
            Scenario given, WorldSettings settings, InetAddress bind, int port, boolean lockStep, int maxClients) {
        Scenario scenario = withPort(given, port == 0 ? ServeCommand.PLAYER_PORT : port);
        var serving = new Serving(scenario, Simulation.open(scenario, settings), bind);
        serving.simulation.lockStep(lockStep);
        serving.simulation.disconnectSilentClients(true);
        try {
            long ports = scenario.devices().stream()
                    .mapToInt(DeviceBinding::port)
                    .distinct()
                    .count();
            var machine = TcpServer.Settings.ofMachine(Math.max(1, Math.toIntExact(ports)));
            var limits = maxClients == 0 ? machine : machine.withMaxClients(maxClients);
            for (var binding : scenario.devices()) {
                boolean any = port == 0 && binding.port() == ServeCommand.PLAYER_PORT;
                serving.servers.computeIfAbsent(
                        binding.port(),
                        number ->
                                TcpServer.open(PlayerPorts.find(number).orElseThrow(), any ? 0 : number, bind, limits));
            }
        } catch (RuntimeException e) {
            serving.close();
            throw e;
        }
        return serving;
    }

    private static Scenario withPort(Scenario scenario, int port) {
        return new Scenario(
                scenario.world(),
                scenario.devices().stream()
                        .map(each -> each.port() == ServeCommand.PLAYER_PORT ? moved(each, port) : each)
                        .toList());
    }

    private static DeviceBinding moved(DeviceBinding binding, int port) {
        return new DeviceBinding(
                port, binding.interfaceName(), binding.index(), binding.model(), binding.ranger(), binding.where());
    }

    /** The open ports, in the order of the scenario's ports. */
    List<Integer> ports() {
        return servers.values().stream().map(TcpServer::port).toList();
    }

    void record(Path file) throws IOException {
        simulation.record(new NamedWriter(file, Files.newBufferedWriter(file)));
    }

    /** A writer whose exceptions name the file. */
    static final class NamedWriter extends FilterWriter {
        private final Path file;

        NamedWriter(Path file, Writer out) {
            super(out);
            this.file = file;
        }

        @Override
        public void write(int character) throws IOException {
            try {
                super.write(character);
            } catch (IOException e) {
                throw named(e);
            }
        }

        @Override
        public void write(char[] text, int offset, int length) throws IOException {
            try {
                super.write(text, offset, length);
            } catch (IOException e) {
                throw named(e);
            }
        }

        @Override
        public void write(String text, int offset, int length) throws IOException {
            try {
                super.write(text, offset, length);
            } catch (IOException e) {
                throw named(e);
            }
        }

        @Override
        public void flush() throws IOException {
            try {
                super.flush();
            } catch (IOException e) {
                throw named(e);
            }
        }

        @Override
        public void close() throws IOException {
            try {
                super.close();
            } catch (IOException e) {
                throw named(e);
            }
        }

        private IOException named(IOException e) {
            return new IOException(file + ": " + e.getMessage(), e);
        }
    }

    /** The offered devices, one line per port. */
    String greeting() {
        return servers.entrySet().stream()
                .map(server ->
                        bind.getHostAddress() + ":" + server.getValue().port() + " offers " + devices(server.getKey()))
                .collect(Collectors.joining(
                        "\n", "world " + scenario.world().name() + " is served; Ctrl-C ends it\n", ""));
    }

    private String devices(int port) {
        List<DeviceBinding> offered =
                scenario.devices().stream().filter(each -> each.port() == port).toList();
        String first = offered.stream()
                .limit(12)
                .map(each -> each.interfaceName() + ":" + each.index())
                .collect(Collectors.joining(" "));
        return offered.size() > 12 ? first + " .. (" + offered.size() + " devices)" : first;
    }

    /**
     * Advances the world while there are clients, until it is stopped or the end time is reached.
     *
     * @param clients number of clients required before the start
     * @throws RuntimeException the failure that ended the simulation
     */
    void run(Pace pace, int clients, long endMicros, ProgressLine line) throws InterruptedException {
        run(pace, clients, endMicros, line, null);
    }

    /** As above, and shows the world on a page. */
    void run(Pace pace, int clients, long endMicros, ProgressLine line, @Nullable LiveView page)
            throws InterruptedException {
        double speed = pace instanceof Pace.RealTime real ? real.factor() : 0;
        var control = new SimulationControl(simulation, speed);
        var viewed = new ViewedRun(scenario.world(), new RunControl(0, false));
        if (page != null) {
            viewed.onto(page, control).moved(simulation.latest());
        }
        Consumer<Snapshot> observer = snapshot -> {
            report(snapshot, endMicros, line);
            if (page != null) {
                control.ticked().forEach(each -> viewed.intervened(snapshot.timeMicros(), each));
                viewed.moved(snapshot);
            }
        };
        try (var runner = SimulationRunner.start(simulation, clients, observer, pace)) {
            control.runner(runner);
            runner.ended().whenComplete((end, failure) -> stop()); // a failure is rethrown when the runner is closed
            stopped.await();
            line.close();
            if (runner.droppedMicros() > 0) {
                System.getLogger(Serving.class.getName())
                        .log(
                                System.Logger.Level.INFO,
                                "{0} s of simulated time could not be caught up with",
                                runner.droppedMicros() / MICROS_PER_SECOND);
            }
        }
    }

    private void report(Snapshot snapshot, long endMicros, ProgressLine line) {
        if (snapshot.timeMicros() % MICROS_PER_SECOND == 0) {
            line.show("", String.format(Locale.ROOT, "%d s simulated", snapshot.timeMicros() / MICROS_PER_SECOND));
        }
        if (snapshot.timeMicros() >= endMicros) {
            stop();
        }
    }

    void stop() {
        stopped.countDown();
    }

    String farewell() {
        long late = servers.values().stream().mapToLong(TcpServer::lateCommands).sum();
        return String.format(Locale.ROOT, "%.1f simulated seconds", simulation.timeMicros() / 1e6)
                + (late == 0 ? "" : "; " + late + " speeds arrived late and were dropped");
    }

    @Override
    public void close() {
        try (simulation) {
            servers.values().forEach(TcpServer::close);
        }
    }
}
