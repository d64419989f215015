package io.troupe.demo.guide;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.sends;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.common.text.NamedColours;
import io.troupe.demo.RecordedDrive;
import io.troupe.petri.Composition;
import io.troupe.petri.Liveness;
import io.troupe.petri.Meld;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.petri.wiring.Overflow;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringObserver;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.services.behaviour.Avoid;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Assignment;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** The samples of the guides 3, 4 and 6. */
@Timeout(120)
class GuideSamplesTest {
    // ---- docs/guide/03-proving-a-wiring.md

    private static Protocol camera() {
        var camera = Protocol.of("camera")
                .state(
                        "idle",
                        does("take a picture").then("holding"),
                        provides("pause").then("paused"))
                .state("holding", requests("store.keep").then("idle"))
                .state("paused", does("wake up").then("idle"))
                .build();
        return camera;
    }

    private static Protocol store() {
        var store = Protocol.of("store")
                .state("open", provides("keep").then("checking"))
                .state(
                        "checking",
                        does("find room").then("open"),
                        does("find none").then("full"))
                .state("full", requests("camera.pause").then("open"))
                .build();
        return store;
    }

    private static Protocol boundedStore() {
        return Protocol.of("store")
                .state("open", provides("keep").then("checking"))
                .state(
                        "checking",
                        does("find room").then("open"),
                        does("drop the oldest").then("open"))
                .build();
    }

    interface Store {
        Promise<Boolean> keep(String picture);
    }

    interface Camera {
        void click();
    }

    /** The store of these samples gives no answer when it is full; the declared one always does. */
    @Test
    void followedActors_conform_untilAnAnswerIsMissing() {
        var wiring = Wiring.of("pictures")
                .component(tireless())
                .component(boundedStore())
                .build();
        var kept = new ArrayList<String>();
        var monitor = WiringMonitor.of(wiring);
        var settings = SpaceSettings.named("pictures").withCallObserver(new WiringObserver(monitor));
        try (var space = ActorSpace.create(settings.withoutThread())) {
            Store store = space.spawn(
                    Store.class,
                    () -> picture -> kept.size() < 2 ? Promise.of(kept.add(picture)) : new Deferred<>(),
                    ActorSettings.named("store"));
            Camera camera =
                    space.spawn(Camera.class, () -> () -> store.keep("a picture"), ActorSettings.named("camera"));
            camera.click();
            space.runQueued();
            camera.click();
            space.runQueued();
            monitor.idle();
            monitor.check();

            camera.click();
            space.runQueued();
            monitor.idle();
        }
        assertThat(monitor.violation().orElseThrow().toString())
                .startsWith("camera waits for the answer of store.keep, and nothing happens any more\n  after:\n")
                .contains("    - camera asks store.keep\n    - store takes keep from camera\n  meanwhile:\n")
                .endsWith("    * store answers keep to camera");
    }

    @Test
    void followedMessages_areRejectedByAFullMailbox() {
        var camera = Protocol.of("camera")
                .state("on", sends("store.keep").then("on").orRejected("on"))
                .build();
        var store = Protocol.of("store")
                .state("open", receives("keep").then("open"))
                .build();
        var wiring = Wiring.of("pictures")
                .component(camera)
                .component(store)
                .mailbox("store", 1, Overflow.REJECT)
                .build();
        var monitor = WiringMonitor.of(wiring);
        monitor.on(Kind.SENT, "camera", "store.keep");
        monitor.on(Kind.REFUSED, "camera", "store.keep");
        monitor.on(Kind.RECEIVED, "store", "keep");
        monitor.idle();
        monitor.check();

        monitor.on(Kind.SENT, "camera", "store.keep");
        monitor.on(Kind.SENT, "camera", "store.keep");
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo("camera sends store.keep is not allowed: store's mailbox [keep]");
    }

    /** The wiring of the guide deadlocks; the guide shows the repaired one too. */
    @Test
    void cameraAndStore_deadlockInACircle() {
        var result = WiringCheck.check(
                Wiring.of("pictures").component(camera()).component(store()).build());
        assertThat(result).isInstanceOf(Deadlock.class);
        assertThat(result.toString()).startsWith("""
                        can deadlock: 14 places, 12 transitions, 32 arcs; 17 markings, 24 edges, 1 dead; 13 markings by stubborn sets, 1 dead and no others
                        camera waits for store.keep; store waits for camera.pause: all ask and none answers
                          after 6 steps:
                            1. camera: take a picture
                            2. camera calls store.keep, which answers
                            3. store: find none
                            4. store asks camera.pause
                            5. camera: take a picture
                            6. camera asks store.keep
                          then:
                            * camera waits for store.keep
                            * store waits for camera.pause
                        """.stripTrailing());
    }

    private static Protocol tireless() {
        return Protocol.of("camera")
                .state("idle", does("take a picture").then("holding"))
                .state("holding", requests("store.keep").then("idle"))
                .build();
    }

    @Test
    void components_neverDeadlock() {
        var wiring = Wiring.of("pictures")
                .component(tireless())
                .component(boundedStore())
                .build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
    }

    @Test
    void papersWiring_isRepairedByASynchronisedStop_andSixCamerasOfOneStoreAreProved() {
        var result = (Deadlock) WiringCheck.check(PaperWiring.wiring());
        var repair = result.repair().orElseThrow();

        assertThat(repair.isProved()).isTrue();
        assertThat(repair.stops()).containsEntry("player", List.of("ready"));

        var cameras = Wiring.of("six cameras").components("camera", 6, tireless());
        assertThat(WiringCheck.check(cameras.component(boundedStore()).build())).isInstanceOf(Proved.class);
    }

    @Test
    void netsByHand_areComposedSearchedAndWritten(@TempDir Path directory) {
        var asking = PetriNet.builder("asking")
                .place("free", 1)
                .place("busy")
                .transition("ask", List.of("free"), List.of("busy"))
                .transition("finish", List.of("busy"), List.of("free"))
                .build();
        var answering = PetriNet.builder("answering")
                .place("ready", 1)
                .transition("answer", List.of("ready"), List.of("ready"))
                .build();
        var net = Composition.compose("both", List.of(asking, answering), List.of(Meld.of("ask", "answer")));

        var graph = ReachabilityGraph.explore(net);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(Liveness.of(graph).reversible()).isEqualTo(Verdict.YES);

        Pnml.write(net, directory.resolve("both.pnml"));
        assertThat(Pnml.read(directory.resolve("both.pnml")).sameStructureAs(net))
                .isTrue();
    }

    // ---- docs/guide/04-bring-your-player-program.md

    @Test
    @Timeout(60)
    void program_andWorld_inOneJvm() {
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.cfg"));
        Snapshot end;
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var runner = SimulationRunner.start(simulation, 1, snapshot -> {})) {
            KeepAway.run(6665, 200);
            end = simulation.latest();
            assertThat(runner.isRunning()).isTrue();
        }
        var start = scenario.world().robots().getFirst().pose();
        var pose = end.robots().getFirst().pose();
        assertThat(end.timeMicros()).isGreaterThanOrEqualTo(19_900_000);
        assertThat(StrictMath.hypot(pose.x() - start.x(), pose.y() - start.y())).isGreaterThan(1);
    }

    // ---- docs/guide/06-subsumption.md

    static Service spin() {
        return new Service("spin", true, () -> {
            double[] began = {Double.NaN};
            return senses -> {
                if (Double.isNaN(began[0])) {
                    began[0] = senses.timeSeconds();
                }
                boolean enough = senses.timeSeconds() - began[0] > 5;
                return enough ? Optional.empty() : Optional.of(new Velocity(0, 0.5));
            };
        });
    }

    static SubsumptionTable crowd(int robots) {
        Service avoid = new Service("avoid", false, Avoid.DEFAULT::behaviour);
        return SubsumptionTable.forRobots(robots)
                .ignoring(NamedColours.BLACK, "walls")
                .state(
                        NamedColours.BLUE,
                        Assignment.everyRobot(Service.SPACE_WANDERER).robots(3, 5, Service.WALL_FOLLOWER))
                .state(
                        NamedColours.RED,
                        Assignment.everyRobot(avoid.over(spin()).over(Service.SPACE_WANDERER)))
                .priority(NamedColours.RED, 1)
                .holdSeconds(2)
                .build();
    }

    static SubsumptionTable read(Path file) {
        var catalogue = ServiceCatalogue.standard().with(new ServiceCatalogue.Kind("spin", true, true, arguments -> {
            double rate = arguments.number("rate", 0.5);
            return () -> senses -> Optional.of(new Velocity(0, rate));
        }));
        return SubsumptionTableReader.read(file, catalogue);
    }

    @Test
    void programOfOnesOwn_drivesTheRobotsOfAWorld() throws Exception {
        int ticks = 20;
        var observer = new RecordedDrive();
        var listener = observer;
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.world"));
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults().withSeed(1))) {
            var clock = simulation.clock();
            var robots = RobotServicesActor.Settings.defaults()
                    .withObserver(observer)
                    .withReconnection(true);
            var settings = SubsumptionRun.Settings.defaults()
                    .withMode(Mode.CALLBACK)
                    .withRobots(robots)
                    .withClock(clock)
                    .withListener(listener);
            try (var run = SubsumptionRun.start(settings)) {
                // advance the world; check() throws if a service has failed
                for (int i = 0; i < ticks; i++) {
                    simulation.tick();
                    run.check();
                }
            }
        }
        assertThat(observer.states).startsWith(1);
        assertThat(observer.cycles.values().stream().mapToInt(cycles -> cycles).sum())
                .isGreaterThanOrEqualTo(2 * 19);
    }

    private static Senses senses(double seconds) {
        var ranges = new float[16];
        Arrays.fill(ranges, 5);
        return new Senses(seconds, SonarRing.of(ranges), new RobotPose(0, 0, 0));
    }

    @Test
    void spin_hasNothingToSayAfterFiveSeconds_andTheWandererBelowDrives() {
        Service layers =
                crowd(6).state(NamedColours.RED).orElseThrow().services().getFirst();
        assertThat(layers).hasToString("avoid > spin > spaceWanderer");
        Behaviour law = layers.behaviour().get();
        assertThat(law.step(senses(10))).hasValue(new Velocity(0, 0.5));
        assertThat(law.step(senses(15))).hasValue(new Velocity(0, 0.5));
        assertThat(law.step(senses(15.1)).orElseThrow().forwardMps()).isEqualTo(0.5);
    }

    @Test
    void kindOfOnesOwn_isReadFromAFile(@TempDir Path directory) throws Exception {
        String text = "robots 1\nservice slow = spin(rate 0.25)\nstate red : slow\n";
        Path file = Files.writeString(directory.resolve("own.table"), text);
        Behaviour law = read(file).first().services().getFirst().behaviour().get();
        assertThat(law.step(senses(0))).hasValue(new Velocity(0, 0.25));
    }

    @Test
    void fileOfTheGuide_isRead_andItsMistakeIsTold() {
        String fifty = """
                robots 50
                ignore black : walls                                    # the text after ':' is the reason
                colour lilac #C8A2C8                                    # declares a name; it must be used
                service patrol = goToGoal(1.5, -2; 3, 0; again) colours # "colours": its robots look for colours
                hold 2 s
                state blue : * = spaceWanderer, 3..5 = wallFollower     # the default; robots 3 to 5
                state lilac priority 1 : * = avoid > patrol
                """;
        var catalogue = ServiceCatalogue.standard();
        var table = SubsumptionTableReader.parse(fifty, Path.of("my.table"), catalogue);
        assertThat(table.robots()).isEqualTo(50);
        assertThat(table.colourName(0xC8A2C8)).isEqualTo("lilac");
        String wrong = fifty.replace("* = spaceWanderer, 3..5 = wallFollower", "spaceWandrer");
        assertThatThrownBy(() -> SubsumptionTableReader.parse(wrong, Path.of("my.table"), catalogue))
                .hasMessage(
                        "my.table:6:14: there is no service called 'spaceWandrer', expected one of: patrol, wallFollower, spaceWanderer, goToGoal, avoid (did you mean 'spaceWanderer'?)");
    }

    // ---- the behaviours of guide 6 that use the camera, and one with laser and stall, with a known outcome

    private static final double NEAR_M = 0.6;
    private static final double GAP_M = 0.8;
    private static final double LEADER_MPS = 0.2;
    /** The robots' cameras have 60 degrees in 80 columns. */
    private static final double COLUMN_RAD = Math.toRadians(60) / 80;

    private static final String ROBOTS = """
            name "open field"
            interval_sim 100
            include "pioneer.inc"
            include "sick.inc"
            """;

    private static Snapshot run(Mode mode, String things, int seconds, Service... services) throws Exception {
        var scenario = ScenarioReader.readText(ROBOTS + things, Path.of("worlds", "field.world"));
        var table = SubsumptionTable.forRobots(services.length).state(NamedColours.BLUE, services);
        return new RecordedDrive().drive(mode, scenario, table.allowFinal().build(), seconds);
    }

    private static Service declared(String declaration) {
        var kinds = new SeekingKinds().kinds();
        var catalogue = ServiceCatalogue.standard().with(kinds.get(0)).with(kinds.get(1));
        return SubsumptionTableReader.service(declaration, catalogue);
    }

    private static ColourBlob seen(Snapshot snapshot, int robot, int colour) {
        return snapshot.robots().get(robot).blobs().blobs().stream()
                .filter(blob -> blob.colour() == colour)
                .findFirst()
                .orElseThrow();
    }

    @ParameterizedTest
    @EnumSource
    void lightSeeker_standsAtItsDistanceBeforeTheLight_andFacesIt(Mode mode) throws Exception {
        String world = """
                model ( color "red" size [ 0.1 0.1 0.5 ] pose [ 1.5 0.5 0 0 ] )
                model ( color "green" size [ 0.1 0.1 0.5 ] pose [ 1.5 -0.5 0 0 ] )
                pioneer2dx ( name "robot1" color "orange" pose [ 0 0 0 0 ] )
                """;
        var end = run(mode, world, 30, declared("light = seek(colour red)"));
        Pose pose = end.robots().getFirst().pose();
        ColourBlob light = seen(end, 0, NamedColours.RED);
        assertThat(light.rangeM()).isCloseTo(NEAR_M, within(0.001));
        assertThat(light.left() + light.right() + 1)
                .as("twice the middle column")
                .isBetween(79, 81);
        double bearingRad = Math.atan2(0.5 - pose.y(), 1.5 - pose.x());
        assertThat(pose.headingRad()).isCloseTo(bearingRad, within(2 * COLUMN_RAD));
    }

    @ParameterizedTest
    @EnumSource
    void leaderFollower_isTwoSecondsBehindItsGap(Mode mode) throws Exception {
        String world = """
                pioneer2dx ( name "leader" color "orange" pose [ 1.3 0.3 0 0 ] )
                pioneer2dx ( name "follower" color "black" pose [ 0 0 0 0 ] )
                """;
        Service leader = declared("leader = goToGoal(9, 0; speed " + LEADER_MPS + ")");
        var end = run(mode, world, 40, leader, declared("behind = follow(colour orange, gap " + GAP_M + ")"));
        Pose ahead = end.robots().get(0).pose();
        Pose behind = end.robots().get(1).pose();
        assertThat(ahead.x()).isCloseTo(1.3 + 40 * LEADER_MPS, within(0.1));
        // speed equal to its leader's: 0.5 / s times the distance above the gap
        double steadyM = GAP_M + LEADER_MPS / 0.5;
        assertThat(seen(end, 1, NamedColours.ORANGE).rangeM()).isCloseTo(steadyM, within(0.005));
        assertThat(ahead.x() - behind.x()).as("between the centres").isBetween(steadyM, steadyM + 0.35);
        assertThat(Math.abs(behind.y() - 0.3)).as("beside the leader's way").isLessThan(0.1);
    }

    @ParameterizedTest
    @EnumSource
    void laserAndStall_areThoseOfTheWorld(Mode mode) throws Exception {
        // the wall is 4 m in front of the laser, which is 0.1 m in front of the robot's centre
        String world = """
                model ( color "black" size [ 0.2 4 0.5 ] pose [ 4.2 0 0 0 ] )
                pioneer2dx ( name "robot1" color "orange" pose [ 0 0 0 0 ] sicklaser ( pose [ 0.1 0 0 0 ] ) )
                """;
        var firstM = new double[] {Double.NaN};
        var stalledAtM = new double[] {Double.NaN};
        Service ram = new Service("ram", false, () -> senses -> {
                    double aheadM = senses.laser().nearestM(-0.001, 0.001);
                    if (Double.isNaN(firstM[0])) {
                        firstM[0] = aheadM;
                    }
                    if (senses.stalled()) {
                        stalledAtM[0] = aheadM;
                        return Optional.empty();
                    }
                    return Optional.of(new Velocity(0.4, 0));
                })
                .withLaser();
        var end = run(mode, world, 15, ram);
        assertThat(firstM[0]).isCloseTo(4.0, within(0.03)); // a cell of the grid is 0.02 m
        double left = 4.1 - end.robots().getFirst().pose().x() - 0.1;
        assertThat(stalledAtM[0]).isCloseTo(left, within(0.05));
        assertThat(left).isLessThan(0.3);
    }
}
