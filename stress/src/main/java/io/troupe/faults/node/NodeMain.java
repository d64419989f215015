package io.troupe.faults.node;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.faults.history.Event.Closed;
import io.troupe.faults.history.Event.Connected;
import io.troupe.faults.history.Event.Disconnected;
import io.troupe.faults.history.Event.Memory;
import io.troupe.faults.history.Event.Opened;
import io.troupe.faults.history.Event.Paused;
import io.troupe.faults.history.Event.Sent;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.History;
import io.troupe.faults.hosts.Hosts;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.lang.management.ManagementFactory;
import java.lang.management.MemoryMXBean;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.FutureTask;
import org.jspecify.annotations.Nullable;

/**
 * The process on a host: a node of the bus with a broker, which offers a tool, calls the tools of all nodes, publishes
 * and subscribes, and obeys the suite, whose commands are lines of its input.
 *
 * <p>It ends with its input, so that it does not survive the suite.
 */
public final class NodeMain {
    private static final int CAPACITY = 256;
    private static final Duration CONNECT_LIMIT = Duration.ofSeconds(2);
    private static final long RETRY_MILLIS = 200;
    private static final long PAUSE_CHECK_MILLIS = 10;
    private static final long SHORTEST_PAUSE_NANOS = 40_000_000;
    private static final Duration SETTLED_AFTER = Duration.ofSeconds(2);
    private static final long PATIENCE_MILLIS = 25_000;

    private final String node;
    private final History.Writer history;
    private final Publications publications;
    private final Callers callers;
    private final ActorSpace work;
    private final ActorSpace subscribers;
    private final ActorSpace handlers;
    private final Bus bus;

    /**
     * @param arguments the host, the process, the server's address, the folder of the histories, the seed, and the
     *     address of the world
     */
    public static void main(String[] arguments) throws Exception {
        Thread.ofPlatform().daemon().priority(Thread.MAX_PRIORITY).start(new FutureTask<>(() -> {
            watchPauses(new History.Writer(Path.of(arguments[3]), arguments[1]));
            return null;
        }));
        var history = new History.Writer(Path.of(arguments[3]), arguments[1]);
        var node = new NodeMain(arguments[0], arguments[1], arguments[2], history, Long.parseLong(arguments[4]));
        node.drive(arguments[1], arguments[5]);
        node.obey();
        Runtime.getRuntime().halt(0);
    }

    private NodeMain(String node, String process, String server, History.Writer history, long seed)
            throws InterruptedException, ExecutionException {
        this.node = node;
        this.history = history;
        this.work = space("work");
        this.subscribers = space("subscribers");
        this.handlers = space("handlers");
        this.publications = new Publications(history, process);
        this.callers = new Callers(work, history, process, seed);
        this.bus = open(server);
        publications.subscribe(bus, subscribers);
        var broker = Broker.over(bus, work, BrokerSettings.defaults().withObserver(event -> {}));
        var services = broker.services();
        services.publish(handlers, Tool.class, "tool", List.of("at-" + node), () -> new Tool.ToolActor(history));
        onWork(() -> callers.start(services, Hosts.NODES));
        var subscribed = new CountDownLatch(1);
        subscribers.execute(subscribed::countDown);
        subscribed.await();
        history.add(new Opened(node));
        onWork(() -> publications.tick(work));
        System.out.println("ready");
    }

    /** Each of the first two hosts drives a robot. */
    private void drive(String process, String world) {
        int robot = Hosts.NODES.indexOf(node);
        if (robot < 2) {
            ActorSpace space = space("driving");
            int life = Integer.parseInt(process.substring(process.indexOf('-') + 1));
            var driving = new Driving(space, history, world, robot, life);
            space.execute(driving::drive);
        }
    }

    private ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name)
                .withOnError((where, error) -> history.add(new Surprise(where + " threw " + error))));
    }

    /** Until the server is there, and does not count an earlier process of the name as alive. */
    private Bus open(String server) throws InterruptedException {
        var settings = BusSettings.on(work).withCapacity(CAPACITY).withObserver(new Observer());
        var nats = NatsSettings.at(server).withConnectLimit(CONNECT_LIMIT);
        while (true) {
            try {
                return NatsBus.open(node, nats, settings);
            } catch (BusException notYet) {
                System.out.println("waits: " + notYet.getMessage());
                Thread.sleep(RETRY_MILLIS);
            }
        }
    }

    private void onWork(Runnable task) throws InterruptedException, ExecutionException {
        var done = new FutureTask<>(task, null);
        work.execute(done);
        done.get();
    }

    private final class Observer implements BusObserver {
        @Override
        public void lost(Loss loss) {
            publications.lost(loss);
        }

        @Override
        public void passed(BusMessage message) {
            publications.passed(message);
        }

        @Override
        public void disconnected(String why) {
            history.add(new Disconnected());
        }

        @Override
        public void connected() {
            history.add(new Connected());
        }
    }

    // ---- commands

    private void obey() throws IOException, InterruptedException, ExecutionException {
        var commands = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        for (String line = commands.readLine(); line != null; line = commands.readLine()) {
            String[] words = line.split(" ");
            switch (words[0]) {
                case "slow" -> publications.slow(Long.parseLong(words[1]));
                case "flood" -> publications.flood(Integer.parseInt(words[1]));
                case "big" -> publications.publishTooMuch();
                case "settle" -> settle();
                case "quiet" -> quiet();
                case "close" -> {
                    close();
                    return;
                }
                default -> throw new IllegalArgumentException(line);
            }
        }
    }

    /** Waits until the node has been connected for a while. */
    private void settle() throws InterruptedException {
        while (bus.connectedFor().compareTo(SETTLED_AFTER) < 0) {
            Thread.sleep(RETRY_MILLIS);
        }
        System.out.println("settled");
    }

    /** Ends the calls and the publications, and waits for the answers. */
    private void quiet() throws InterruptedException, ExecutionException {
        publications.quiet();
        onWork(callers::quiet);
        for (long waited = 0; waited < PATIENCE_MILLIS && openCalls() > 0; waited += RETRY_MILLIS) {
            Thread.sleep(RETRY_MILLIS);
        }
        System.out.println("quiet");
    }

    private int openCalls() throws InterruptedException, ExecutionException {
        var open = new FutureTask<>(callers::open);
        work.execute(open);
        return open.get();
    }

    private void close() throws InterruptedException {
        var delivered = new CountDownLatch(1);
        subscribers.execute(delivered::countDown);
        delivered.await();
        publications.close();
        MemoryMXBean memory = ManagementFactory.getMemoryMXBean();
        memory.gc();
        history.add(new Memory(memory.getHeapMemoryUsage().getUsed()));
        history.add(new Closed());
        System.out.println("closed");
    }

    /** A busy machine, a garbage collection, or a signal. */
    static void watchPauses(History.Writer history) throws InterruptedException {
        long last = System.nanoTime();
        while (true) {
            Thread.sleep(PAUSE_CHECK_MILLIS);
            long now = System.nanoTime();
            if (now - last > SHORTEST_PAUSE_NANOS) {
                history.add(new Paused(now - last));
            }
            last = now;
        }
    }

    /**
     * Drives one robot through its Player server, with another speed each time, whether readings arrive or not.
     * Connects again when the connection has ended. On one space.
     */
    private static final class Driving {
        private static final Duration PERIOD = Duration.ofMillis(100);
        private static final double SLOWEST_RADPS = 0.2;
        private static final double STEP_OF_A_LIFE_RADPS = 0.01;
        private static final double STEP_RADPS = 1e-6; // fewer than 10,000 commands of a life

        private final ActorSpace space;
        private final History.Writer history;
        private final String host;
        private final int port;
        private final int robot;
        private final int life;
        private @Nullable RobotConnection connection;
        private int commands;

        /** @param address that of the Player server, HOST:PORT */
        Driving(ActorSpace space, History.Writer history, String address, int robot, int life) {
            this.space = space;
            this.history = history;
            this.host = address.split(":")[0];
            this.port = Integer.parseInt(address.split(":")[1]);
            this.robot = robot;
            this.life = life;
        }

        void drive() {
            try {
                RobotConnection open = connection;
                if (open == null) {
                    open = RobotConnection.open(
                            host,
                            port,
                            RobotConnection.Delivery.PUSH,
                            List.of(new RobotConnection.Devices(robot, false, false)));
                    open.readOnSpace();
                    connection = open;
                }
                PlayerRobot wheels = open.robots().getFirst();
                double turnRadps = SLOWEST_RADPS + life * STEP_OF_A_LIFE_RADPS + ++commands * STEP_RADPS;
                history.add(new Sent(robot, turnRadps));
                wheels.drive(new Velocity(0, turnRadps));
            } catch (PlayerException ended) {
                if (connection != null) {
                    connection.close();
                    connection = null;
                }
            }
            space.delay(PERIOD).thenRun(this::drive);
        }
    }
}
