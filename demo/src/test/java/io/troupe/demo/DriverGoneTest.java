package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationSettings;
import io.troupe.services.component.kinds.BehaviourComponent;
import io.troupe.services.component.kinds.PlayerComponent;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.LeasedRobots;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.WallClockPacer;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.Callable;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.FutureTask;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Predicate;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * A robot stands still half a second of simulated time after its driver is gone, however the driver ended. The world
 * has no watchdog, and another client has all robots open, so no robot stops because its last client has disconnected.
 * Until then the world runs in lock step, so no message is in transit at that time.
 */
@Timeout(value = 10, unit = TimeUnit.MINUTES)
@Execution(ExecutionMode.CONCURRENT)
class DriverGoneTest {
    private static final int HALF_A_SECOND_TICKS = 5;
    private static final Velocity TURNING = new Velocity(0, 0.3);

    private final Scenario scenario = OwnPort.of(ScenarioReader.read(Path.of("worlds", "paper-arena.cfg")));
    private final int port = scenario.robotPort().orElseThrow();
    private final Simulation simulation = Simulation.open(scenario, WorldSettings.defaults());

    DriverGoneTest() {
        var looking = new DataSink() {
            @Override
            public void frame(Frame frame) {}

            @Override
            public void lost(String reason) {}
        };
        var onlooker = PlayerPorts.find(port).orElseThrow().connect(looking, null);
        onlooker.answers(false);
        onlooker.devices().stream()
                .filter(device -> device.interfaceCode() == Interfaces.POSITION2D.code())
                .forEach(onlooker::subscribe);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    private boolean moves(int robot) {
        var odometry = simulation.latest().robots().get(robot).odometry();
        return odometry.forwardMps() != 0 || odometry.turnRadps() != 0;
    }

    private Pose pose(int robot) {
        return simulation.latest().robots().get(robot).pose();
    }

    private void tick(int times) {
        for (int i = 0; i < times; i++) {
            simulation.tick();
        }
    }

    /** In lock step, until the service moves the robot. */
    private void awaitMoving(int robot) {
        simulation.lockStep(true);
        for (int tick = 0; tick < 100 && !moves(robot); tick++) {
            simulation.tick();
        }
        assertThat(moves(robot)).as("robot %d is driven", robot + 1).isTrue();
    }

    /** The driver has just ended, and the world does not wait for it. */
    private void assertStandsAfterHalfASecond(int robot) {
        assertThat(moves(robot)).as("robot %d was driven until now", robot + 1).isTrue();
        simulation.lockStep(false);
        tick(HALF_A_SECOND_TICKS);
        var pose = pose(robot);
        tick(HALF_A_SECOND_TICKS);
        assertThat(pose(robot))
                .as("pose of robot %d after half a second, and after a second", robot + 1)
                .isEqualTo(pose);
    }

    private static void await(CountDownLatch latch) {
        try {
            assertThat(latch.await(5, TimeUnit.MINUTES)).isTrue();
        } catch (InterruptedException e) {
            throw new AssertionError(e);
        }
    }

    // ---- services in this process

    private SubsumptionRun.Settings settings(
            Mode mode, int port, SubsumptionTable table, Arbitrator.StateListener listener) {
        var robots = RobotServicesActor.Settings.defaults().withPort(port).withTable(table);
        return SubsumptionRun.Settings.defaults()
                .withMode(mode)
                .withRobots(robots)
                .withClock(simulation.clock())
                .withListener(listener);
    }

    private SubsumptionRun start(Mode mode, Service ofRobot1, Service ofRobot2) throws InterruptedException {
        var table = SubsumptionTable.forRobots(2).state(NamedColours.BLUE, ofRobot1, ofRobot2);
        return SubsumptionRun.start(settings(mode, port, table.allowFinal().build(), (state, seenBy) -> {}));
    }

    @ParameterizedTest
    @EnumSource
    void serviceThatHangsInItsCycle_andDrivesAgainWhenItGoesOn(Mode mode) throws Exception {
        var hangs = new AtomicBoolean();
        var goesOn = new CountDownLatch(1);
        var hanging = new Service("hanging", false, () -> senses -> {
            if (hangs.get()) {
                await(goesOn);
            }
            return Optional.of(TURNING);
        });
        try (var run = start(mode, hanging, hanging)) {
            awaitMoving(0);
            awaitMoving(1);
            hangs.set(true); // the services of both robots share one thread
            assertStandsAfterHalfASecond(0);
            assertThat(moves(1)).isFalse();
            goesOn.countDown();
            awaitMoving(0);
            awaitMoving(1);
            run.check();
        }
    }

    /** The failure is reported after the tick in which it occurs. */
    @ParameterizedTest
    @EnumSource
    @Timeout(60)
    void behaviourThatThrows_isThrownByCheck_andItsRobotStands(Mode mode) throws Exception {
        int goodCycles = 5;
        var failing = new Service("failing", true, () -> {
            var cycles = new AtomicInteger();
            return senses -> {
                if (cycles.getAndIncrement() == goodCycles) {
                    throw new IllegalStateException("out of ideas");
                }
                return Optional.of(new Velocity(0.1, 0));
            };
        });
        try (var run = start(mode, Service.WALL_FOLLOWER, failing)) {
            int readings = mode == Mode.SYNC ? 2 * goodCycles + 1 : goodCycles;
            for (int tick = 0; tick < readings; tick++) {
                simulation.tick();
                run.check();
            }
            simulation.tick();
            assertThatThrownBy(run::check)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessage("out of ideas");
            var stood = pose(1);
            simulation.tick();
            assertThat(pose(1)).isEqualTo(stood);
        }
    }

    @ParameterizedTest
    @EnumSource
    @Timeout(60)
    void portWithoutAWorld_isToldAtTheStart(Mode mode) {
        var nowhere = settings(mode, 6_664, SubsumptionTable.ofThePaper(), (state, seenBy) -> {});
        assertThatThrownBy(() -> SubsumptionRun.start(nowhere))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("" + port);
    }

    private ActorSpace space() {
        return ActorSpace.create(SpaceSettings.named("driver").withClock(simulation.clock()));
    }

    private static void end(ActorSpace space) { // the compiler warns of a close() in a try with resources
        space.close();
    }

    private static RobotServices drive(ActorSpace space, int port) {
        var settings = RobotServicesActor.Settings.defaults().withPort(port);
        RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
        space.execute(() -> LeasedRobots.of(services).drive(0, Service.WALL_FOLLOWER.name(), NamedColours.BLUE));
        var connected = new CountDownLatch(1);
        space.onIdle(connected::countDown);
        await(connected);
        return services;
    }

    @Test
    void spaceThatIsClosed() {
        try (var space = space()) {
            drive(space, port);
            awaitMoving(0);
            end(space);
            assertStandsAfterHalfASecond(0);
        }
    }

    @Test
    void actorThatIsStopped() {
        try (var space = space()) {
            var services = drive(space, port);
            awaitMoving(0);
            space.stop(services);
            assertStandsAfterHalfASecond(0);
        }
    }

    @Test
    void spaceThatAnotherActorHolds_andItsServiceDrivesAgainAfterThat() {
        var goesOn = new CountDownLatch(1);
        try (var space = space()) {
            drive(space, port);
            awaitMoving(0);
            space.execute(() -> await(goesOn));
            assertStandsAfterHalfASecond(0);
            goesOn.countDown();
            awaitMoving(0);
        }
    }

    @Test
    void arbitratorThatFailsBetweenTwoStates() throws Exception {
        var states = new AtomicInteger();
        Arbitrator.StateListener failing = (state, seenBy) -> {
            if (states.incrementAndGet() == 2) {
                throw new IllegalStateException("no way on");
            }
        };
        var table = SubsumptionTable.ofThePaper();
        try (var run = SubsumptionRun.start(settings(Mode.PROMISE, port, table, failing))) {
            for (int tick = 0; tick < 3_000 && states.get() < 2; tick++) {
                simulation.tick(); // the newest snapshot still has the speeds of the previous reading
            }
            assertThat(states).hasValue(2);
            assertThatThrownBy(run::check).hasMessage("no way on");
            tick(HALF_A_SECOND_TICKS);
            assertThat(moves(0) || moves(1)).isFalse();
        }
    }

    // ---- components

    private void start(ActorSpace space, Bus bus, Supplier<Behaviour> law) throws Exception {
        var plan = ApplicationPlan.named("turning")
                .with("robots", PlayerComponent.of(PlayerComponent.Settings.of("localhost", port, List.of(1))))
                .with("turner", BehaviourComponent.of("turner", "turning", List.of(), law))
                .needing("turning", "player")
                .needing("robot1", "turning");
        var settings = ApplicationSettings.defaults()
                .withBroker(BrokerSettings.defaults().withObserver(event -> {}));
        var application = new CompletableFuture<Application>();
        space.execute(() -> application.complete(Application.start(plan, bus, settings)));
        application.get(5, TimeUnit.MINUTES).started().get(Duration.ofMinutes(5));
        awaitMoving(0);
    }

    @Test
    void driverComponentThatFallsSilentWithoutALastWord_andDrivesAgain() throws Exception {
        var silent = new AtomicBoolean();
        try (var space = space()) {
            var bus = Bus.inProcess("here", BusSettings.on(space));
            start(space, bus, () -> senses -> silent.get() ? Optional.empty() : Optional.of(TURNING));
            silent.set(true);
            assertStandsAfterHalfASecond(0);
            silent.set(false);
            awaitMoving(0);
        }
    }

    @Test
    void busThatIsClosed_betweenTheDriverAndItsRobot() throws Exception {
        try (var space = space()) {
            var bus = Bus.inProcess("here", BusSettings.on(space));
            start(space, bus, () -> senses -> Optional.of(TURNING));
            bus.close();
            assertStandsAfterHalfASecond(0);
        }
    }

    @Test
    void spaceOfBrokerBusAndComponents_thatHangs_andThatIsClosed() throws Exception {
        var goesOn = new CountDownLatch(1);
        try (var space = space()) {
            start(space, Bus.inProcess("here", BusSettings.on(space)), () -> senses -> Optional.of(TURNING));
            space.execute(() -> await(goesOn));
            assertStandsAfterHalfASecond(0);
            goesOn.countDown();
            awaitMoving(0);
            end(space);
            assertStandsAfterHalfASecond(0);
        }
    }

    // ---- over TCP

    /** The directions in which a connection is cut. */
    private enum Cut {
        TO_SERVER(true, false),
        TO_CLIENT(false, true),
        BOTH(true, true);

        private final boolean toServer;
        private final boolean toClient;

        Cut(boolean toServer, boolean toClient) {
            this.toServer = toServer;
            this.toClient = toClient;
        }
    }

    /** Neither side gets a FIN or RST: the robot stands by its limit, and the service ends by its own. */
    @ParameterizedTest
    @EnumSource
    void connectionThatIsCutWithoutAWord_endsTheServiceWithAnErrorToo(Cut cut) throws Exception {
        var driving = new Service("driving", false, () -> senses -> Optional.of(TURNING));
        var table = SubsumptionTable.forRobots(1).state(NamedColours.BLUE, driving);
        try (var tcp = TcpServer.open(PlayerPorts.find(port).orElseThrow(), 0);
                var cable = new Cable(tcp.port());
                var run = SubsumptionRun.start(settings(
                        Mode.PROMISE,
                        cable.listener.getLocalPort(),
                        table.allowFinal().build(),
                        (state, seenBy) -> {}))) {
            awaitMoving(0);
            cable.cut = cut;
            assertStandsAfterHalfASecond(0);
            assertThat(failure(run))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("is connected and silent: nothing has come from it for 5000 ms");
        }
    }

    /** Advances the world in real time until an error ends the run. */
    private Throwable failure(SubsumptionRun run) throws InterruptedException {
        var pacer = new WallClockPacer();
        while (true) {
            try {
                run.check();
                pacer.await(simulation.tick().timeMicros());
            } catch (RuntimeException error) {
                return error;
            }
        }
    }

    /** Forwards one TCP connection. Once it is cut, both ends stay open, but no data are forwarded. */
    private static final class Cable implements AutoCloseable {
        private final ServerSocket listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
        private final List<Socket> ends = new CopyOnWriteArrayList<>();
        private volatile @Nullable Cut cut;

        Cable(int serverPort) throws IOException {
            start(() -> {
                var client = listener.accept();
                var server = new Socket(InetAddress.getLoopbackAddress(), serverPort);
                for (var end : List.of(client, server)) {
                    end.setTcpNoDelay(true);
                    ends.add(end);
                }
                start(() -> forward(client, server, each -> each.toServer));
                return forward(server, client, each -> each.toClient);
            });
        }

        /** The test ends the task by closing its sockets. */
        private static void start(Callable<Boolean> task) {
            Thread.ofVirtual().start(new FutureTask<>(task));
        }

        private boolean forward(Socket from, Socket to, Predicate<Cut> ends) throws IOException {
            var bytes = new byte[8192];
            for (int count = 0; count >= 0; count = from.getInputStream().read(bytes)) {
                var now = cut;
                if (now == null || !ends.test(now)) {
                    to.getOutputStream().write(bytes, 0, count);
                }
            }
            return true;
        }

        @Override
        public void close() throws IOException {
            listener.close();
            for (var end : ends) {
                end.close();
            }
        }
    }

    /**
     * Main class of a child process that drives robot 1. It prints a line when it starts, and runs until it is killed
     * or its input ends.
     */
    static final class Driver {
        private Driver() {}

        public static void main(String[] args) throws IOException {
            var space = ActorSpace.create(SpaceSettings.named("driver"));
            drive(space, Integer.parseInt(args[0]));
            System.out.println("connected");
            System.in.read();
        }
    }

    @Test
    void processThatIsFrozen_drivesAgainWhenItGoesOn_andOneThatIsKilled() throws Exception {
        try (var tcp = TcpServer.open(PlayerPorts.find(port).orElseThrow(), 0)) {
            var process = CommandLineBench.jvm("-XX:TieredStopAtLevel=1", Driver.class, List.of("" + tcp.port()))
                    .redirectError(ProcessBuilder.Redirect.INHERIT)
                    .start();
            try {
                assertThat(process.inputReader().readLine()).isEqualTo("connected");
                awaitMoving(0);
                assumeTrue(signal(process, "-STOP"), "this machine has no kill -STOP");
                assertStandsAfterHalfASecond(0);
                signal(process, "-CONT");
                awaitMoving(0);
                process.destroyForcibly().waitFor();
                assertStandsAfterHalfASecond(0);
            } finally {
                process.destroyForcibly();
            }
        }
    }

    /** Sends a signal and waits until it has taken effect. */
    private static boolean signal(Process process, String name) throws InterruptedException {
        String pid = "" + process.pid();
        try {
            if (new ProcessBuilder("kill", name, pid).start().waitFor() != 0) {
                return false;
            }
            boolean stops = name.equals("-STOP");
            String state;
            do {
                var status = new ProcessBuilder("ps", "-o", "state=", "-p", pid).start();
                state = status.inputReader().readLine();
            } while (state != null && state.startsWith("T") != stops);
            return state != null;
        } catch (IOException noSuchProgram) {
            return false;
        }
    }
}
