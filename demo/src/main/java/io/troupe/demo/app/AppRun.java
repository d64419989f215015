package io.troupe.demo.app;

import io.troupe.actor.CallGraph;
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.demo.monitor.AppMonitor;
import io.troupe.demo.terminal.RunFiles;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.view.WallClockPacer;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.ViewedRun;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * Runs an application on a simulated world, in lock step.
 *
 * <p><b>Threads.</b> The calling thread advances the world. The application, its bus and its broker run on one actor
 * space in simulated time. At any time one of the two waits for the other.
 */
final class AppRun {
    /**
     * Stops a robot half a second after its last command, from any client. Our components request a limit for each of
     * their commands, which may be shorter. This one is for programs that request none, such as an external process
     * that is killed while another client has the robot open.
     */
    static final WorldSettings WORLD = WorldSettings.defaults().withWatchdogMicros(500_000);

    /** Ends the name of the port by which an application forwards values. */
    private static final String FORWARDER = ":application";

    private static final String TCP = "${tcp}";
    private final Path file;
    private final ComponentKinds kinds;
    private final Scenario scenario;
    private final AppReport report;
    private final @Nullable LiveView page;
    private final @Nullable AppMonitor monitor;
    private final @Nullable RunFiles files;

    /**
     * Prepares a run.
     *
     * @param page that shows the world; null = none
     * @param monitor follows the application; null = none
     * @param files record the robots; null = none
     */
    AppRun(
            Path file,
            ComponentKinds kinds,
            Scenario scenario,
            AppReport report,
            @Nullable LiveView page,
            @Nullable AppMonitor monitor,
            @Nullable RunFiles files) {
        this.page = page;
        this.files = files;
        this.monitor = monitor;
        this.file = file;
        this.kinds = kinds;
        this.scenario = scenario;
        this.report = report;
    }

    /**
     * Runs for the given simulated time, or until {@code stop} returns true. Rethrows the failure that ended the
     * application.
     */
    void run(double seconds, boolean realtime, BooleanSupplier stop) throws IOException, InterruptedException {
        String declaration = ApplicationReader.text(file);
        int port = WorldLoader.robotPort(scenario, scenario.world().file());
        try (var simulation = Simulation.open(scenario, WORLD);
                var tcp = declaration.contains(TCP) ? tcp(simulation, port) : null;
                var space = new AppSpace(file, simulation.clock(), page == null ? null : page.callGraph())) {
            Map<String, String> values = new LinkedHashMap<>();
            values.put("host", "localhost");
            values.put("port", String.valueOf(port));
            if (tcp != null) {
                values.put("tcp", String.valueOf(tcp.port()));
            }
            var plan = ApplicationReader.parse(declaration, file, kinds, values).inOneProcess();
            if (files != null) {
                files.open();
            }
            report.watch(simulation.latest(), simulation::timeMicros);
            try (var bus = Bus.inProcess(
                    "troupe",
                    BusSettings.on(space.space())
                            .withObserver(monitor == null ? observer(plan) : monitor.bus(observer(plan))))) {
                Application application = space.start(plan, bus, report, monitor);
                try {
                    space.awaitStarted(application);
                    move(
                            simulation,
                            StrictMath.round(seconds * 1e6),
                            realtime,
                            () -> stop.getAsBoolean() || space.hasFailed());
                } finally {
                    space.stop(application);
                }
            }
            space.rethrowFailure();
            if (monitor != null) {
                monitor.check();
            }
            report.summary(plan.name(), scenario.world().name());
            if (files != null) {
                report.wrote(files.finish(simulation.timeMicros() < StrictMath.round(seconds * 1e6)));
            }
        }
    }

    /** Counts messages for the page: a topic to which no component subscribes is forwarded by the application. */
    private BusObserver observer(ApplicationPlan plan) {
        var logging = BusObserver.logging();
        if (page == null) {
            return logging;
        }
        Map<String, List<String>> subscribers = new HashMap<>();
        plan.components()
                .forEach((name, component) -> component
                        .subscribes()
                        .forEach(topic -> subscribers
                                .computeIfAbsent(topic.name(), each -> new ArrayList<>())
                                .add(name)));
        CallGraph graph = page.callGraph();
        return new BusObserver() {
            @Override
            public void lost(Loss loss) {
                logging.lost(loss);
            }

            @Override
            public void failed(BusMessage request, Throwable error) {
                logging.failed(request, error);
            }

            @Override
            public void passed(BusMessage message) {
                List<String> receivers = switch (message.purpose()) {
                    case Purpose.Publication(String topic) ->
                        subscribers.getOrDefault(topic, List.of(plan.name() + FORWARDER));
                    case Purpose.Request request -> List.of(request.to().name());
                    case Purpose.Notice notice -> List.of(notice.to().name());
                    case Purpose.Reply reply -> List.of(reply.to().name());
                    case Purpose.Rejection rejection -> List.of(rejection.to().name());
                };
                receivers.forEach(each -> graph.note("bus", message.from().name(), each));
            }
        };
    }

    private static TcpServer tcp(Simulation simulation, int port) {
        simulation.disconnectSilentClients(true); // a process may hang; the others must continue
        return TcpServer.open(PlayerPorts.find(port).orElseThrow(), 0);
    }

    private void move(Simulation simulation, long endMicros, boolean realtime, BooleanSupplier stop)
            throws InterruptedException {
        var viewed = new ViewedRun(scenario.world(), new RunControl(page == null ? 0 : 1, page != null));
        if (page != null) {
            viewed.onto(page).moved(simulation.latest());
        }
        if (files != null) {
            files.record(simulation.latest());
        }
        var pacer = new WallClockPacer();
        while (simulation.timeMicros() < endMicros && !stop.getAsBoolean()) {
            viewed.beforeTick(simulation, stop);
            if (monitor != null) {
                monitor.check();
            }
            var snapshot = simulation.tick();
            report.moved(snapshot);
            if (files != null) {
                files.record(snapshot);
            }
            viewed.moved(snapshot);
            if (realtime && page == null) {
                pacer.await(snapshot.timeMicros());
            }
        }
    }
}
