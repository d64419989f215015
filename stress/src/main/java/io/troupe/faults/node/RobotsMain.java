package io.troupe.faults.node;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.ArbitratorStarted;
import io.troupe.faults.history.Event.BrokerReported;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.Connected;
import io.troupe.faults.history.Event.Disconnected;
import io.troupe.faults.history.Event.DrivenAgain;
import io.troupe.faults.history.Event.DriverLost;
import io.troupe.faults.history.Event.LeaseLost;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.History;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.DriverReport;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotNode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.FutureTask;
import org.jspecify.annotations.Nullable;

/**
 * A process of the main job: a provider of robot services, or the arbitrator. It obeys lines of its input, and ends
 * with it.
 */
public final class RobotsMain {
    /** The name of the arbitrator's node. */
    public static final String ARBITRATOR = "arbitrator";

    private static final Duration CONNECT_LIMIT = Duration.ofSeconds(2);
    private static final Duration SETTLED_AFTER = Duration.ofSeconds(2);
    private static final Duration WITHDRAW_LIMIT = Duration.ofSeconds(5);
    private static final long RETRY_MILLIS = 100;
    private static final long CHECK_MILLIS = 20;

    private final History.Writer history;
    private final ActorSpace space;
    private final Bus bus;
    private final RobotNode node;

    /**
     * @param arguments the node, the process, the bus server's address, the folder of the histories, and the address of
     *     the world or, for the arbitrator, the mode
     */
    public static void main(String[] arguments) throws Exception {
        var history = new History.Writer(Path.of(arguments[3]), arguments[1]);
        Thread.ofPlatform().daemon().priority(Thread.MAX_PRIORITY).start(new FutureTask<>(() -> {
            NodeMain.watchPauses(history);
            return null;
        }));
        var process = new RobotsMain(arguments[0], arguments[2], history);
        if (arguments[0].equals(ARBITRATOR)) {
            process.arbitrate(Mode.valueOf(arguments[4]));
        } else {
            process.offer(arguments[4].split(":"));
        }
        Runtime.getRuntime().halt(0);
    }

    private RobotsMain(String name, String server, History.Writer history) throws InterruptedException {
        this.history = history;
        this.space = space("broker");
        this.bus = open(name, server);
        this.node = RobotNode.open(bus, space, event -> history.add(new BrokerReported(event.toString())), 0);
    }

    private ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name)
                .withOnError((where, error) -> history.add(new Surprise(where + " threw " + error))));
    }

    /** Until the server is there, and does not count an earlier process of the name as alive. */
    private Bus open(String name, String server) throws InterruptedException {
        var settings = BusSettings.on(space).withObserver(new Observer());
        var nats = NatsSettings.at(server).withConnectLimit(CONNECT_LIMIT);
        while (true) {
            try {
                return NatsBus.open(name, nats, settings);
            } catch (BusException notYet) {
                System.out.println("waits: " + notYet.getMessage());
                Thread.sleep(RETRY_MILLIS);
            }
        }
    }

    private final class Observer implements BusObserver {
        @Override
        public void lost(Loss loss) {}

        @Override
        public void disconnected(String why) {
            history.add(new Disconnected());
        }

        @Override
        public void connected() {
            history.add(new Connected());
        }
    }

    // ---- the provider

    private void offer(String[] world) throws Exception {
        var settings = RobotServicesActor.Settings.defaults()
                .withHost(world[0])
                .withPort(Integer.parseInt(world[1]))
                .withObserver(new Commands());
        var offer = node.offer(space("driving"), settings, List.of("wallFollower", "spaceWanderer"));
        offer.published().get(WITHDRAW_LIMIT);
        System.out.println("ready");
        if (obey()) {
            offer.withdraw().get(WITHDRAW_LIMIT);
            close();
        }
    }

    /** On the thread that drives. */
    private final class Commands implements ServiceObserver {
        private final Map<Integer, Integer> drives = new HashMap<>(); // by robot

        private int drive(int robot) {
            return drives.getOrDefault(robot, 0);
        }

        @Override
        public void commanded(int robot, Service service, Velocity velocity) {
            history.add(new Commanded(robot, drive(robot), service.name(), !velocity.equals(Velocity.STOP)));
        }

        @Override
        public void leaseLost(int robot, Service service) {
            history.add(new LeaseLost(robot, drive(robot)));
        }

        @Override
        public void serviceStarted(int robot, Service service) {}

        @Override
        public void cycleEnded(int robot, Service service) {}

        @Override
        public void serviceEnded(int robot, Service service) {
            drives.merge(robot, 1, Integer::sum);
        }
    }

    // ---- the arbitrator

    private void arbitrate(Mode mode) throws Exception {
        history.add(new ArbitratorStarted());
        System.out.println("ready");
        Thread.ofPlatform().daemon().start(new FutureTask<>(() -> {
            run(mode);
            return null;
        }));
        if (obey()) {
            running = false;
            synchronized (this) { // the run is closed
                close();
            }
        }
    }

    private volatile boolean running = true;

    private synchronized void run(Mode mode) throws InterruptedException {
        try (var run = SubsumptionRun.overHosts(node, mode, SubsumptionTable.ofThePaper(), new Reports())) {
            while (running) {
                run.check();
                Thread.sleep(CHECK_MILLIS);
            }
        } catch (RuntimeException | Error end) {
            history.add(new ArbitratorEnded(end.getClass().getSimpleName(), String.valueOf(end.getMessage())));
        }
    }

    private final class Reports implements SubsumptionRun.HostsListener {
        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {}

        @Override
        public void reported(DriverReport report, String provider) {}

        @Override
        public void driverLost(int robot, String service, Throwable why) {
            history.add(new DriverLost(robot, service + ": " + why));
        }

        @Override
        public void drivenAgain(int robot, String service) {
            history.add(new DrivenAgain(robot));
        }
    }

    // ---- commands

    /** Returns true when the process is to close, and false when the suite is gone. */
    private boolean obey() throws IOException, InterruptedException {
        var commands = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        for (String line = commands.readLine(); line != null; line = commands.readLine()) {
            switch (line) {
                case "settle" -> {
                    while (bus.connectedFor().compareTo(SETTLED_AFTER) < 0) {
                        Thread.sleep(RETRY_MILLIS);
                    }
                    System.out.println("settled");
                }
                case "close" -> {
                    return true;
                }
                default -> throw new IllegalArgumentException(line);
            }
        }
        return false;
    }

    private void close() {
        node.close();
        bus.close();
        System.out.println("closed");
    }
}
