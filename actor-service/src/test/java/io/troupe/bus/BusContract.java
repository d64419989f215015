package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Operation.Kind;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Function;
import org.junit.jupiter.api.AfterEach;

/** Base class of the tests of a bus, with both sides on one node, or on two nodes that exchange only bytes. */
abstract class BusContract {
    /** Connects the nodes of a test. What a node sends is under way until it is carried. */
    interface Pipe {
        Bus open(String node, BusSettings settings);

        /** Delivers everything that is under way, on the thread of the test. */
        void carryAll();
    }

    /** The placement of the two sides of a test. */
    enum Wiring {
        ONE_NODE,
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
    static final BusTopic<Count> COUNTS = new BusTopic<>("counts", Count.class);
    static final BusTopic<Ranges> RANGES = new BusTopic<>("ranges", Ranges.class);
    static final Operation<Count, Chain> FORGE = new Operation<>("forge", Count.class, Chain.class, Kind.DATA);
    static final Operation<Count, Text> SPELL = new Operation<>("spell", Count.class, Text.class, Kind.DATA);
    static final Operation<Count, Text> START = new Operation<>("start", Count.class, Text.class, Kind.CONTROL);
    static final Duration SECOND = Duration.ofSeconds(1);
    static final int CAPACITY = 4;

    final TestSpace test = new TestSpace();
    final List<Loss> losses = new ArrayList<>();
    final List<BusMessage> passed = new ArrayList<>();
    final List<Throwable> failures = new ArrayList<>();
    final Pipe pipe = pipe(test.space());
    final Bus near;
    final Bus far;

    BusContract(Wiring wiring) {
        if (wiring == Wiring.ONE_NODE) {
            near = Bus.inProcess("robots", settings());
            far = near;
        } else {
            near = pipe.open("near", settings());
            far = pipe.open("far", settings());
        }
    }

    /**
     * The pipe between two nodes; other engines have others. Called by the constructor.
     *
     * @param carrier carries what is under way when it is run
     */
    Pipe pipe(ActorSpace carrier) {
        return new BytePipe(carrier);
    }

    /** Why a request to a node that does not exist is rejected. */
    String noWayTo(String node) {
        return "there is no way from node " + near.node() + " to node " + node;
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
        far.close();
        near.close();
        test.close();
        assertThat(losses).as("losses no test took").isEmpty();
        assertThat(failures).as("failures no test took").isEmpty();
    }

    static <T> List<T> take(List<T> from) {
        var taken = List.copyOf(from);
        from.clear();
        return taken;
    }

    final Loss theOnlyLoss() {
        assertThat(losses).hasSize(1);
        return losses.removeFirst();
    }

    final void assertTakenLosses(int count, Class<? extends Loss> type) {
        assertThat(take(losses)).hasSize(count).allMatch(type::isInstance);
    }

    final String refusalOf(Promise<?> promise) {
        Throwable error = test.error(promise);
        assertThat(error).isInstanceOf(BusException.class);
        return String.valueOf(error.getMessage());
    }

    /** A handler of {@link #SPELL} on the far side. */
    final BusPort speller(Function<Count, Promise<Text>> handler) {
        var port = far.attach("speller");
        port.answer(SPELL, handler::apply);
        return port;
    }

    /** Asks with a listener, so that a rejection is not reported as unhandled. */
    static Promise<Text> ask(BusPort requester, BusPort handler, int number) {
        var answer = requester.ask(handler.address(), SPELL, new Count(number), SECOND);
        answer.handle((value, error) -> value);
        return answer;
    }

    static Promise<Text> spelt(Count count) {
        return Promise.of(new Text("number " + count.value()));
    }
}
