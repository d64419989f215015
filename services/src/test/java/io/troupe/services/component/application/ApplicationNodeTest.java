package io.troupe.services.component.application;

import static io.troupe.services.subsumption.FakeRobots.ahead;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.services.subsumption.FakeRobots;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.Set;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** An application that two nodes run together, which exchange only bytes. */
class ApplicationNodeTest {
    private static final String TEXT = """
            application pair on base,laptop
            component robots   is player port=7001 robots=1
            component follower is wallFollower on laptop
            component reserve  is spaceWanderer service=wallFollower
            pair needs service player
            robot1 needs service wallFollower
            """;
    private static final ApplicationSettings QUIET =
            ApplicationSettings.defaults().withBroker(BrokerSettings.defaults().withObserver(event -> {}));
    private static final String WITHOUT_RESERVE = TEXT.replaceAll("component reserve .*\n", "");

    private final TestSpace test = new TestSpace();
    private final Wire wire = new Wire();
    private final FakeRobots robots = new FakeRobots(test, 1);
    private final List<Loss> losses = new ArrayList<>();
    private final List<String> events = new ArrayList<>();
    private final RecordingObserver observer = new RecordingObserver(); // of the components of laptop
    private final ApplicationSettings settings = ApplicationSettings.defaults()
            .withBroker(BrokerSettings.defaults().withObserver(this::note))
            .withComponentObserver(observer)
            .withObserver(event -> {});
    private final Bus base = open("base");
    private Bus laptop = open("laptop");
    private Application application;
    private ApplicationNode node;

    /** Carries frames between nodes in the sender's turn, or holds them. */
    private static final class Wire {
        private final Map<String, End> ends = new HashMap<>();
        private final Queue<Runnable> held = new ArrayDeque<>();
        private List<String> heldNodes = List.of();

        void carry(String from, Runnable frame) {
            if (heldNodes.contains(from)) {
                held.add(frame);
            } else {
                frame.run();
            }
        }

        /** Holds what these nodes send. */
        void hold(String... nodes) {
            heldNodes = List.of(nodes);
        }

        void release() {
            hold();
            while (!held.isEmpty()) {
                held.remove().run();
            }
        }

        private final class End implements BusEngine {
            private final Set<String> topics = new HashSet<>();
            private String name = "";
            private @Nullable Listener listener;

            @Override
            public void start(String node, long incarnation, Listener newListener) {
                name = node;
                listener = newListener;
                ends.put(node, this);
            }

            @Override
            public @Nullable String whyDisconnected() {
                return null;
            }

            @Override
            public int maxFrameBytes() {
                return 1 << 20;
            }

            @Override
            public void send(String node, long number, byte[] frame) {
                End to = ends.get(node);
                if (to == null) {
                    listener.unreachable(node, number, "there is no node " + node);
                } else {
                    carry(name, () -> to.listener.frame(frame));
                }
            }

            @Override
            public void reply(String node, long incarnation, long number, byte[] frame) {
                send(node, number, frame);
            }

            @Override
            public void publish(String topic, byte[] frame) {
                for (End to : List.copyOf(ends.values())) {
                    if (to != this && to.topics.contains(topic)) {
                        carry(name, () -> to.listener.frame(frame));
                    }
                }
            }

            @Override
            public void subscribe(String topic) {
                topics.add(topic);
            }

            @Override
            public void unsubscribe(String topic) {
                topics.remove(topic);
            }

            @Override
            public void close() {
                ends.remove(name, this);
            }
        }
    }

    private Bus open(String name) {
        return Bus.open(name, wire.new End(), BusSettings.on(test.space()).withObserver(losses::add));
    }

    private static ApplicationPlan plan(String text) {
        return ApplicationReader.parse(text, Path.of("test.app"), ComponentKinds.standard(), Map.of());
    }

    private void serve(String text) {
        test.run(() -> {
            ApplicationPlan plan = plan(text);
            node = ApplicationNode.open(plan, laptop, settings);
        });
    }

    private void run(String text) {
        test.run(() -> {
            var settings = ApplicationSettings.defaults()
                    .withBroker(BrokerSettings.defaults().withObserver(event -> {}))
                    .withComponentObserver(ComponentObserver.logging())
                    .withObserver(this::note);
            application = Application.start(plan(text), base, settings);
            application.started().handle((runs, error) -> error); // the test reads the result later
        });
    }

    private void note(BrokerEvent event) {
        switch (event) {
            case BrokerEvent.Started(var provider) -> note(provider, "STARTED");
            case BrokerEvent.Stopped(var provider) -> note(provider, "STOPPED");
            default -> {}
        }
    }

    private void note(ServiceRecord provider, String what) {
        if (provider.provider().node().equals("laptop")) {
            observer.info(provider.provider(), what);
        }
    }

    private void note(ApplicationEvent event) {
        if (event instanceof ApplicationEvent.Connected it) {
            events.add(it.need().by() + " uses " + it.provider().provider());
        } else if (event instanceof ApplicationEvent.Lost it) {
            events.add(it.need().by() + " has lost its provider");
        }
    }

    private void seconds(double count) {
        for (int i = 0; i < count * 10; i++) {
            test.advance(Duration.ofMillis(100));
        }
    }

    @AfterEach
    void nothingIsLeft() {
        robots.close();
        if (application != null) {
            test.get(application.closeAsync().handle((ended, error) -> true));
        }
        if (node != null) {
            test.get(node.closeAsync().handle((ended, error) -> true));
        }
        base.close();
        laptop.close();
        test.runQueued();
        assertThat(robots.connections()).as("connections left open").isZero();
        test.close();
    }

    @Test
    void robot_isDrivenByAComponentOfTheOtherNode_whichEndsWithTheApplication() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        assertThat(events).containsExactly("pair uses base/robots", "robot1 uses laptop/follower");
        assertThat(observer.take()).contains("follower STARTED");
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(ahead(0.2));
        assertThatThrownBy(() -> application.componentInterface("follower"))
                .hasMessage("follower runs on node laptop, expected one of [robots, reserve]");
        test.get(application.closeAsync());
        assertThat(observer.take()).contains("follower STOPPED");
    }

    @Test
    void nodeThatIsMissing_isNamedAfterFiveSeconds_andNothingIsStarted() {
        laptop.close();
        run(TEXT);
        seconds(4.9);
        assertThat(application.started().isDone()).isFalse();
        seconds(1);
        assertThat(test.error(application.started()))
                .isInstanceOf(MissingServiceException.class)
                .hasMessage("\"pair\" needs node \"laptop\" for follower, and has not found it within 5 s: it does"
                        + " not offer follower; start the same application there");
        assertThat(events).isEmpty();
    }

    @Test
    void nodeThatComesLater_isFound() {
        run(TEXT);
        seconds(3);
        serve(TEXT);
        seconds(1);
        test.get(application.started());
        assertThat(events).contains("robot1 uses laptop/follower");
    }

    @Test
    void nodeThatIsLost_isFollowedByAnotherProvider() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        laptop.close();
        seconds(2);
        assertThat(events).last().isEqualTo("robot1 uses base/reserve");
        robots.tick(100);
        assertThat(robots.commands(0)).contains(ahead(0.5));
    }

    @Test
    void nodeThatIsLostWithoutAReserve_endsTheApplication() {
        serve(WITHOUT_RESERVE);
        run(WITHOUT_RESERVE);
        test.get(application.started());
        laptop.close();
        seconds(5);
        assertThat(events).last().isEqualTo("robot1 has lost its provider");
        assertThat(test.error(application.ended()))
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("\"robot1\"", "\"wallFollower\"");
    }

    @Test
    void applicationThatIsLost_leavesNoComponentRunning_andANewOneStartsItAgain() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        wire.ends.remove("base"); // nothing reaches it
        wire.hold("base"); // and nothing comes from it
        observer.take();
        seconds(3);
        assertThat(observer.take()).doesNotContain("follower STOPPED");
        seconds(1.5);
        assertThat(observer.take()).contains("follower STOPPED");
        wire.held.clear();
        wire.hold();
        test.run(application::closeAsync);
        seconds(20);
        assertThat(application.ended().isDone()).isTrue();

        try (var second = open("base")) {
            test.run(() -> {
                application = Application.start(plan(TEXT), second, QUIET);
            });
            test.get(application.started());
            assertThat(observer.take()).contains("follower STARTED");
            test.get(application.closeAsync());
        }
    }

    @Test
    void componentOfTheOtherNode_takesAPlace_andGivesItBack() {
        String text = TEXT + """
                component relief is spaceWanderer on laptop
                at 150ms replace follower by relief
                at 1s replace relief by follower
                """;
        serve(text);
        run(text);
        test.get(application.started());
        seconds(0.5);
        assertThat(events).last().isEqualTo("robot1 uses laptop/relief");
        assertThat(observer.take()).contains("follower STARTED", "relief STARTED", "follower STOPPED");
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(ahead(0.5));
        seconds(1);
        assertThat(events).last().isEqualTo("robot1 uses laptop/follower");
        assertThat(observer.take()).contains("follower STARTED", "relief STOPPED");
    }

    @Test
    void componentThatHasTakenAPlace_keepsIt_andTheReplacedOneStaysAway_whenTheirNodeRestarts() {
        String text = WITHOUT_RESERVE + """
                component relief is spaceWanderer on laptop
                at 150ms replace follower by relief
                """;
        serve(text);
        run(text);
        test.get(application.started());
        seconds(0.5);
        assertThat(events).last().isEqualTo("robot1 uses laptop/relief");
        events.clear();
        laptop.close();
        laptop = open("laptop");
        serve(text);
        seconds(2);
        assertThat(events).last().isEqualTo("robot1 uses laptop/relief");
        assertThat(events).doesNotContain("robot1 uses laptop/follower");
        robots.tick(100);
        assertThat(robots.commands(0)).contains(ahead(0.5));
    }

    @Test
    void closeOfAnApplication_afterItsSpace_returns_andTheApplicationHasEnded() {
        run(TEXT); // waits for its other node
        test.space().close();
        application.close();
        assertThat(application.ended().isRejected()).isTrue();
    }

    @Test
    void componentThatTakesAPlaceLater_isNotUsedBefore() {
        String text = (TEXT + """
                component relief is spaceWanderer on laptop
                at 150ms replace follower by relief
                """).replace("robot1 needs service wallFollower", "robot1 needs capability wanders");
        serve(text);
        run(text);
        test.get(application.started());
        assertThat(events).last().isEqualTo("robot1 uses base/reserve");
    }

    @Test
    void pauseOfTheNode_endsNothing() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        observer.take();
        test.advance(Duration.ofSeconds(60)); // all at once, as after a suspended process
        seconds(5);
        assertThat(observer.take()).doesNotContain("follower STOPPED");
    }

    @Test
    void speedThatTheBusDeliversLate_isDropped_andReported() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(1);
        wire.hold("laptop");
        robots.tick(100);
        seconds(0.4);
        wire.release();
        test.runQueued();
        assertThat(robots.commands(0)).as("commands that were obeyed").hasSize(1);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(2);
        assertThat(losses).hasSize(1).hasOnlyElementsOfType(Loss.Stale.class);
    }

    @Test
    void readingThatTheBusDeliversLate_drivesNothing() {
        serve(TEXT);
        run(TEXT);
        test.get(application.started());
        robots.tick(100);
        wire.hold("base");
        robots.tick(100);
        seconds(0.7);
        wire.release();
        test.runQueued();
        assertThat(robots.commands(0)).as("commands that were obeyed").hasSize(1);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(2);
    }

    @Test
    void wrongNode_isRefused() {
        test.run(() -> {
            assertThatThrownBy(() -> ApplicationNode.open(plan(TEXT), base, settings))
                    .hasMessage("node base has no components of pair to serve, expected one of [laptop]");
            assertThatThrownBy(() -> Application.start(plan(TEXT), laptop, ApplicationSettings.defaults()))
                    .hasMessage("node base runs pair, and this is node laptop, which serves components:"
                            + " use ApplicationNode");
        });
        assertThatThrownBy(() -> ApplicationNode.open(plan(TEXT), laptop, settings))
                .hasMessageStartingWith("the components of node laptop were opened on no actor space");
    }
}
