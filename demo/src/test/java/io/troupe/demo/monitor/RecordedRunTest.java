package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.RingFinder;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.demo.OwnPort;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringObserver;
import io.troupe.petri.wiring.WiringObserver.Followed;
import io.troupe.petri.wiring.WiringObserver.Translation;
import io.troupe.petri.wiring.WiringRecorder;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.LeasedRobots;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import java.lang.reflect.Proxy;
import java.nio.file.Path;
import java.util.Optional;
import java.util.concurrent.CountDownLatch;
import java.util.function.UnaryOperator;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The main job, recorded: the arbitrator and, for each robot, the actor of the services as a component. */
@Timeout(600)
class RecordedRunTest {
    private final Scenario scenario = OwnPort.of(ScenarioReader.read(Path.of("worlds/paper-arena.cfg")));

    private static final Translation BY_ROBOT = (from, to, call) -> {
        if (call.type() == RobotServices.class && !call.isPassedOn()) {
            int robot = (Integer) call.arguments().get(1); // after the lease
            return Optional.of(Followed.of("arbitrator", "service" + (robot + 1) + "." + call.method()));
        }
        if (call.type() == Arbitrator.class) {
            return Optional.of(Followed.of(from.equals(to) ? "arbitrator" : "", "arbitrator." + call.method()));
        }
        return Optional.empty();
    };

    /** Runs the services until the second switch. */
    private void run(CallObserver observer, UnaryOperator<RobotServices> change, Runnable atEnd)
            throws InterruptedException {
        var switches = new int[1];
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withCallObserver(observer))) {
            var settings = RobotServicesActor.Settings.defaults()
                    .withPort(scenario.robotPort().orElseThrow());
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator.StateListener states = (state, seenBy) -> switches[0] += seenBy == null ? 0 : 1;
            space.spawn(
                            Arbitrator.class,
                            () -> new Arbitrator(
                                    Mode.PROMISE,
                                    LeasedRobots.of(change.apply(services)),
                                    SubsumptionTable.ofThePaper(),
                                    states))
                    .live();
            var started = new CountDownLatch(1);
            space.onIdle(started::countDown);
            started.await();
            for (int tick = 0; tick < 3_000 && switches[0] < 2; tick++) {
                simulation.tick();
            }
            atEnd.run(); // closing is no part of the wiring
        }
        assertThat(switches[0]).isEqualTo(2);
    }

    private static WiringMonitor monitor(WiringRecorder recorder) {
        var wiring = recorder.wiring();
        return WiringMonitor.of(wiring).observing(WiringObserver.stepsFromOutside(wiring));
    }

    @Test
    void recordedRun_isAcceptedAgain_andAChangedOneIsNot() throws InterruptedException {
        var recorder = new WiringRecorder("main job", BY_ROBOT);
        run(recorder, services -> services, () -> {});
        assertThat(recorder.wiring().components()).containsExactly("arbitrator", "service1", "service2");
        assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(WiringResult.Proved.class);
        assertThat(recorder.problems()) // the run ends while both robots drive
                .contains(
                        "service1 has not answered drive of arbitrator when the run ended",
                        "service2 has not answered drive of arbitrator when the run ended");
        assertThat(recorder.java("io.troupe.demo.monitor", "RecordedWiring"))
                .contains("Protocol.of(\"service1\", io.troupe.services.subsumption.RobotServices.class)")
                .contains("accepts(\"drive\").then(\"drive\")")
                .contains("answers(\"drive\").then(\"idle\")");

        var again = monitor(recorder);
        run(new WiringObserver(again, BY_ROBOT), services -> services, again::end);
        again.check();
        assertThat(again.count()).isGreaterThan(10);

        var changed = monitor(recorder);
        run(new WiringObserver(changed, BY_ROBOT), RecordedRunTest::stoppingTwice, changed::end);
        assertThat(changed.violation().orElseThrow().problem())
                .contains("arbitrator asks service1.stop is not allowed");
    }

    /** The services, each of which is asked twice to stop. */
    private static RobotServices stoppingTwice(RobotServices services) {
        return (RobotServices) Proxy.newProxyInstance(
                RobotServices.class.getClassLoader(),
                new Class<?>[] {RobotServices.class},
                (proxy, method, arguments) -> {
                    if (method.getName().equals("stop")) {
                        method.invoke(services, arguments);
                    }
                    return method.invoke(services, arguments);
                });
    }

    @Test
    void rings_areNone() throws InterruptedException {
        var rings = new RingFinder();
        run(rings, services -> services, () -> {});
        assertThat(rings.rings()).isEmpty();
        rings.check();
    }

    /** The services ask the arbitrator for its state before they stop a robot, and it takes no call meanwhile. */
    @Test
    void plantedRing_isFound() throws InterruptedException {
        var rings = new RingFinder();
        try (var test = new TestSpace(rings)) {
            Watch watch = test.spawn(Watch.class, Watching::new, ActorSettings.named("watch"));
            RobotServices services = test.spawn(
                    RobotServices.class,
                    () -> (RobotServices) Proxy.newProxyInstance(
                            RobotServices.class.getClassLoader(),
                            new Class<?>[] {RobotServices.class},
                            (proxy, method, arguments) -> method.getName().equals("stop")
                                    ? watch.colour().thenApply(colour -> null)
                                    : new Deferred<Object>()),
                    ActorSettings.named("services"));
            watch.change(services);
            test.runQueued();
            rings.idle();
            test.takeProblems();
        }
        assertThat(rings.rings()).singleElement().hasToString("""
                        watch is called while it waits for that call: a ring that blocks watch, services
                          - watch serves change, which waits for services.stop
                          - services serves stop, which waits for watch.colour, which that has not begun: it holds its calls""");
    }

    /** Changes the state of a robot, as the arbitrator does. */
    interface Watch {
        Promise<@Nullable Void> change(RobotServices services);

        Promise<Integer> colour();
    }

    private static final class Watching extends Actor implements Watch {
        @Override
        public Promise<@Nullable Void> change(RobotServices services) {
            context().hold();
            return services.stop(new RobotServices.Lease(1, 1, RobotServices.Stamp.NONE), 0)
                    .thenApply(stopped -> {
                        context().release();
                        return null;
                    });
        }

        @Override
        public Promise<Integer> colour() {
            return Promise.of(255);
        }
    }
}
