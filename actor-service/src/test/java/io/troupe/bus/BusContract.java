package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import org.junit.jupiter.api.AfterEach;

/**
 * Base class of the tests that every kind of bus must pass. Each test runs twice: with both sides on one node, and with
 * two nodes that exchange only bytes.
 */
abstract class BusContract {
    /** The placement of the two sides of a test. */
    enum Wiring {
        /** Both sides on one {@link Bus}. */
        ONE_NODE,
        /** Each side on a node; the nodes exchange only bytes. */
        TWO_NODES
    }

    record Ranges(int number, List<Double> metres, Map<String, Integer> names, Optional<String> note) {}

    record Count(int value) {}

    record Text(String value) {}

    record Chain(int value, Optional<Chain> next) {
        static Chain of(int links) {
            var chain = new Chain(0, Optional.empty());
            for (int i = 1; i < links; i++) {
                chain = new Chain(i, Optional.of(chain));
            }
            return chain;
        }
    }

    static final BusTopic<Chain> CHAINS = new BusTopic<>("chains", Chain.class);
    static final Operation<Count, Chain> FORGE =
            new Operation<>("forge", Count.class, Chain.class, Operation.Kind.DATA);
    static final BusTopic<Count> COUNTS = new BusTopic<>("counts", Count.class);
    static final BusTopic<Ranges> RANGES = new BusTopic<>("ranges", Ranges.class);
    static final Operation<Count, Text> SPELL = new Operation<>("spell", Count.class, Text.class, Operation.Kind.DATA);
    static final Operation<Count, Text> START =
            new Operation<>("start", Count.class, Text.class, Operation.Kind.CONTROL);
    static final Duration SECOND = Duration.ofSeconds(1);
    static final int CAPACITY = 4;

    final TestSpace test = new TestSpace();
    final List<Loss> losses = new ArrayList<>();
    final List<BusMessage> passed = new ArrayList<>();
    final List<Throwable> failures = new ArrayList<>();

    private final BytePipe pipe = new BytePipe(test.space());
    private final Bus near;
    private final Bus far;

    BusContract(Wiring wiring) {
        if (wiring == Wiring.ONE_NODE) {
            var bus = Bus.inProcess("robots", settings());
            near = bus;
            far = bus;
        } else {
            near = pipe.open("near", settings());
            far = pipe.open("far", settings());
        }
    }

    final Bus near() {
        return near;
    }

    final Bus far() {
        return far;
    }

    final BusMetrics nearMetrics() {
        return near.metrics();
    }

    final BusMetrics farMetrics() {
        return far.metrics();
    }

    final long bytesCarried() {
        return pipe.bytesCarried();
    }

    /** Delivers pending messages to the far side without running the space in between. */
    final void arrive() {
        pipe.carryAll();
    }

    final BusSettings settings() {
        return BusSettings.on(test.space()).withCapacity(CAPACITY).withObserver(new BusObserver() {
            @Override
            public void lost(Loss loss) {
                losses.add(loss);
            }

            @Override
            public void passed(BusMessage message) {
                passed.add(message);
            }

            @Override
            public void failed(BusMessage request, Throwable error) {
                failures.add(error);
            }
        });
    }

    @AfterEach
    void nothingIsLeft() {
        far().close();
        near().close();
        test.close();
        assertThat(losses).as("losses no test took").isEmpty();
        assertThat(failures).as("failures no test took").isEmpty();
    }

    final <T> List<T> take(List<T> from) {
        var taken = List.copyOf(from);
        from.clear();
        return taken;
    }

    final Loss theOnlyLoss() {
        assertThat(losses).hasSize(1);
        return losses.removeFirst();
    }

    final String refusalOf(Promise<?> promise) {
        Throwable error = test.error(promise);
        assertThat(error).isInstanceOf(BusException.class);
        return String.valueOf(error.getMessage());
    }

    /** Registers a listener, so that a rejection is not reported as unhandled. */
    static <T> Promise<T> heard(Promise<T> promise) {
        promise.handle((value, error) -> value);
        return promise;
    }

    static Promise<Text> spelt(Count count) {
        return Promise.of(new Text("number " + count.value()));
    }
}
