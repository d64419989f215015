package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedClass;
import org.junit.jupiter.params.provider.EnumSource;

/** Publish and subscribe, on every kind of bus. */
@ParameterizedClass
@EnumSource(BusContract.Wiring.class)
class PublishContractTest extends BusContract {
    PublishContractTest(Wiring wiring) {
        super(wiring);
    }

    @Test
    void values_reachEverySubscriber_inTheOrderOfTheirPublisher_withItsAddress() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<String>();
        far().attach("a").subscribe(COUNTS, (count, from) -> heard.add("a" + count.value() + " " + from));
        far().attach("b").subscribe(COUNTS, (count, from) -> heard.add("b" + count.value() + " " + from));
        for (int i = 1; i <= 3; i++) {
            publisher.publish(COUNTS, new Count(i));
        }
        assertThat(heard).as("nothing runs on the publisher's stack").isEmpty();
        test.crank();
        String from = " " + publisher.address();
        assertThat(heard.stream().filter(each -> each.startsWith("a")))
                .containsExactly("a1" + from, "a2" + from, "a3" + from);
        assertThat(heard.stream().filter(each -> each.startsWith("b")))
                .containsExactly("b1" + from, "b2" + from, "b3" + from);
    }

    @Test
    void subscriber_receivesWhatIsPublishedFromThenOn_andNothingAfterItHasClosed() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        var subscription = far().attach("a").subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        publisher.publish(COUNTS, new Count(2));
        test.crank();
        subscription.close();
        publisher.publish(COUNTS, new Count(3));
        test.crank();
        assertThat(heard).containsExactly(2);
    }

    @Test
    void subscriptionThatIsClosed_reportsHowManyValuesItDidNotReceive() {
        var publisher = near().attach("publisher");
        var subscription = far().attach("a").subscribe(COUNTS, (count, from) -> {
            throw new AssertionError("it has closed");
        });
        test.run(() -> {
            publisher.publish(COUNTS, new Count(1));
            publisher.publish(COUNTS, new Count(2));
            arrive();
            subscription.close();
        });
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Discarded.class, lost -> {
            assertThat(lost.subscriber()).isEqualTo(new Address(far().node(), "a"));
            assertThat(lost.count()).isEqualTo(2);
            assertThat(lost)
                    .hasToString(far().node()
                            + "/a does not hear 2 values of counts that waited: it does not subscribe any more");
        });
    }

    @Test
    void value_thatItsPublisherChangesLater_isReceivedAsItWas() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Ranges>();
        far().attach("a").subscribe(RANGES, (ranges, from) -> heard.add(ranges));
        var metres = new ArrayList<>(List.of(1.0, 2.0));
        var value = new Ranges(1, metres, new java.util.HashMap<>(Map.of("left", 1)), Optional.of("first"));
        var asItWas = new Ranges(1, List.copyOf(metres), Map.copyOf(value.names()), Optional.of("first"));
        publisher.publish(RANGES, value);
        metres.clear();
        value.names().clear();
        test.crank();
        assertThat(heard).containsExactly(asItWas);
    }

    @Test
    void subscriberThatIsTooSlow_losesTheOldest_andTheObserverIsNotifiedOfEach() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        var slow = far().attach("slow");
        slow.subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        test.run(() -> {
            for (int i = 1; i <= CAPACITY + 2; i++) {
                publisher.publish(COUNTS, new Count(i));
            }
            arrive();
        });
        assertThat(heard).containsExactly(3, 4, 5, 6);
        assertThat(take(losses))
                .hasSize(2)
                .allSatisfy(loss -> assertThat(loss)
                        .isInstanceOfSatisfying(
                                Loss.Dropped.class,
                                dropped -> assertThat(dropped.subscriber()).isEqualTo(slow.address())));
        var metrics = farMetrics();
        assertThat(metrics.queued())
                .isEqualTo(metrics.delivered() + metrics.dropped())
                .isEqualTo(6);
        assertThat(metrics.dropped()).isEqualTo(2);
    }

    @Test
    void subscriberThatThrows_isReportedToTheObserver_andTheOthersReceiveTheValue() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        var broken = far().attach("broken");
        broken.subscribe(COUNTS, (count, from) -> {
            throw new IllegalStateException("cannot hear " + count.value());
        });
        far().attach("b").subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        assertThat(heard).containsExactly(1);
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.SubscriberFailed.class, lost -> {
            assertThat(lost.subscriber()).isEqualTo(broken.address());
            assertThat(lost.error()).hasMessage("cannot hear 1");
        });
    }

    @Test
    void valueThatIsNestedTooDeep_isRefused_byName() {
        var port = near().attach("a");
        assertThatThrownBy(() -> port.publish(CHAINS, Chain.of(200_000)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("a value of " + Chain.class.getName()
                        + " cannot leave the process: it is nested deeper than 500 levels");
    }

    @Test
    void topic_withTwoTypes_isRefused_andNamesBoth() {
        var port = near().attach("a");
        port.subscribe(COUNTS, (count, from) -> {});
        assertThatThrownBy(() -> port.publish(new BusTopic<>("counts", Text.class), new Text("1")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(
                        "topic counts is of " + Count.class.getName() + " and of " + Text.class.getName());
    }

    @Test
    void messages_ofOneNode_areNumberedUpward() {
        var publisher = near().attach("publisher");
        IntStream.range(0, 3).forEach(i -> publisher.publish(COUNTS, new Count(i)));
        assertThat(take(passed).stream()
                        .filter(each -> each.from().equals(publisher.address()))
                        .distinct())
                .extracting(BusMessage::sequence)
                .containsExactly(1L, 2L, 3L);
        test.crank();
    }
}
