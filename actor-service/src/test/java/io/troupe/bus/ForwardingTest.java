package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Values that are forwarded from topic to topic keep their age. */
class ForwardingTest {
    record Value(int number) {}

    private static final Duration LIMIT = Duration.ofMillis(300);
    private static final BusTopic<Value> UNLIMITED = new BusTopic<>("pilot/velocity", Value.class);
    private static final BusTopic<Value> PILOT = UNLIMITED.withMaxAge(LIMIT);
    private static final BusTopic<Value> ROBOT = new BusTopic<>("robot/velocity", Value.class).withMaxAge(LIMIT);

    private final TestSpace test = new TestSpace();
    private final BytePipe pipe = new BytePipe(test.space());
    private final List<Loss> losses = new ArrayList<>();
    private final Bus here = open("here");
    private final Bus there = open("there");
    private final BusPort pilot = here.attach("pilot");
    private final BusPort hub = here.attach("hub");
    private final List<Integer> received = new ArrayList<>();

    private Bus open(String name) {
        return pipe.open(name, BusSettings.on(test.space()).withObserver(losses::add));
    }

    @AfterEach
    void close() {
        here.close();
        there.close();
        test.runQueued();
        test.close();
    }

    private void subscribe(String node) {
        Bus bus = node.equals("here") ? here : there;
        bus.attach("robot").subscribe(ROBOT, (value, from) -> received.add(value.number()));
        test.runQueued();
    }

    /** Publishes a value that waits for 250 ms; its listener at the hub takes some time. */
    private void publish(BusTopic<Value> topic, int number, long listenerMillis) {
        var forwarding =
                hub.forward(PILOT, ROBOT, (value, from) -> test.clock().advance(Duration.ofMillis(listenerMillis)));
        pilot.publish(topic, new Value(number));
        test.clock().advance(Duration.ofMillis(250));
        test.runQueued();
        forwarding.close();
    }

    @ParameterizedTest
    @ValueSource(strings = {"here", "there"})
    void valueThatIsHeldUpOnItsWay_isDroppedAtTheLastTopic_byTheAgeOfTheWholeWay(String node) {
        subscribe(node);
        publish(PILOT, 1, 40);
        assertThat(received).containsExactly(1);
        publish(PILOT, 2, 200);
        assertThat(received).containsExactly(1);
        assertThat(losses)
                .singleElement()
                .isInstanceOfSatisfying(
                        Loss.Stale.class, stale -> assertThat(stale.age()).isEqualTo(Duration.ofMillis(450)));
    }

    @Test
    void valueThatIsForwardedTwice_overATopicWithoutLimit_keepsItsAge() {
        subscribe("here");
        var between = new BusTopic<>("between/velocity", Value.class);
        hub.forward(UNLIMITED, between, (value, from) -> test.clock().advance(LIMIT));
        hub.forward(between, ROBOT, (value, from) -> test.clock().advance(Duration.ofMillis(value.number())));
        pilot.publish(UNLIMITED, new Value(0));
        test.runQueued();
        assertThat(received).containsExactly(0); // as old as it may be
        pilot.publish(UNLIMITED, new Value(1));
        test.runQueued();
        assertThat(received).containsExactly(0);
        assertThat(losses).singleElement().isInstanceOf(Loss.Stale.class);
    }

    @Test
    void subscriberThatDropsOldValues_countsTheAgeFromThePublication_whateverTheTopicOfThePublisher() {
        here.attach("robot").subscribe(PILOT, (value, from) -> received.add(value.number()));
        test.clock().advance(Duration.ofMinutes(1));
        pilot.publish(UNLIMITED, new Value(1));
        test.runQueued();
        assertThat(received).containsExactly(1);
        pilot.publish(UNLIMITED, new Value(2));
        test.clock().advance(LIMIT.plusMillis(1));
        test.runQueued();
        assertThat(received).containsExactly(1);
        assertThat(losses).singleElement().isInstanceOf(Loss.Stale.class);
    }
}
