package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import io.troupe.tools.Thorough;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/**
 * Runs random programs that call through one connection while providers are published, fail, are withdrawn and
 * replaced, partly within one turn. A model determines where each call has to end: every request is answered exactly
 * once, by the provider that executed it, or rejected with a reason; every one-way call was executed once, or reported
 * to the observer, or is a dead letter.
 */
class AccountingTest {
    /** The actor under test: answers at once, or later. */
    interface Worker {
        Promise<String> work(int id, boolean later);

        void note(int id);
    }

    private static final Duration LIMIT = Duration.ofSeconds(5);
    private static final int STEPS = 60;

    static Stream<Long> seeds() {
        return IntStream.range(0, Thorough.times(60, 400)).mapToObj(i -> 20_191_121L + i);
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void everyCall_isAnsweredOnce_orRejectedWithAReason(long seed) {
        new Program(seed).run();
    }

    @Test
    void programs_reachEveryKindOfEnd() {
        Map<String, Integer> ends = new TreeMap<>();
        seeds().limit(100)
                .flatMap(seed -> new Program(seed).run().ends())
                .forEach(end -> ends.merge(end, 1, Integer::sum));
        assertThat(ends.keySet())
                .contains("answered", "died with it", "too late", "nobody there", "note done", "note undelivered");
        assertThat(ends.get("answered")).isGreaterThan(Thorough.times(300, 1_000));
    }

    /** An answer that is still pending. */
    private record Late(Deferred<String> answer, String by) {
        void give() {
            answer.resolve(by);
        }
    }

    /** One program, and its model: the providers in the order of the registry. */
    private static final class Program {
        private final Random random;
        private final TestSpace test = new TestSpace();
        private final List<BrokerEvent> events = new ArrayList<>();
        private final Broker broker = Broker.open(
                "node", test.space(), BrokerSettings.defaults().withoutRestart().withObserver(events::add));
        private final ActorServices services = broker.services();
        private final Map<Integer, List<String>> done = new HashMap<>();
        private final List<Late> later = new ArrayList<>();
        private final Map<Integer, Promise<String>> asked = new TreeMap<>();
        private final List<Integer> notes = new ArrayList<>();
        private final Map<Integer, String> expected = new HashMap<>(); // provider that must execute it, if certain
        private final List<Address> alive = new ArrayList<>(); // the model: the first is in use
        private final Worker worker;
        private final long seed;
        private final Set<Address> running = new HashSet<>();
        private @Nullable Address inUse;
        private int batch; // steps in this turn
        private int calls;
        private int providers;

        Program(long seed) {
            this.seed = seed;
            this.random = new Random(seed);
            var connection = services.connect(Worker.class, Need.ofService("user", "work"));
            connection.first().handle((record, error) -> null);
            worker = connection.actor();
            test.runQueued();
        }

        Program run() {
            for (int i = 0; i < STEPS; i++) {
                boolean settle = random.nextInt(3) > 0; // otherwise the next step runs in the same turn
                step(settle);
                batch++;
                if (settle) {
                    test.runQueued();
                    settled();
                    batch = 0;
                }
            }
            test.runQueued();
            test.advance(LIMIT);
            later.forEach(Late::give);
            test.runQueued();
            test.get(broker.closeAsync());
            test.runQueued();
            check();
            return this;
        }

        /**
         * Updates the provider that the model expects to get the next calls. After several steps in one turn, the model
         * takes over the broker's state.
         */
        private void settled() {
            var records = test.get(broker.registered());
            Address really = null;
            for (var event : events) {
                really = switch (event) {
                    case BrokerEvent.Connected e -> e.to().provider();
                    case BrokerEvent.FailedOver e -> e.to().provider();
                    case BrokerEvent.Lost e -> null;
                    default -> really;
                };
            }
            if (batch > 1) {
                inUse = really;
                alive.clear();
                running.clear();
                records.stream()
                        .filter(each -> each.health() != Health.FAILED)
                        .forEach(each -> alive.add(each.provider()));
                records.stream()
                        .filter(each -> each.health() == Health.WELL)
                        .forEach(each -> running.add(each.provider()));
                return;
            }
            running.retainAll(alive);
            if (inUse == null || !alive.contains(inUse)) {
                inUse = alive.stream()
                        .filter(running::contains)
                        .findFirst()
                        .orElse(alive.isEmpty() ? null : alive.getFirst());
            }
            if (inUse != null) {
                running.add(inUse);
            }
            assertThat(really).as("seed %d: in use, by the model", seed).isEqualTo(inUse);
        }

        private void step(boolean settle) {
            switch (random.nextInt(12)) {
                case 0, 1 -> publish();
                case 2 -> kill();
                case 3 -> withdraw();
                case 4 -> replace();
                case 5 ->
                    later.stream()
                            .filter(each -> !each.answer().isDone())
                            .findFirst()
                            .ifPresent(Late::give);
                case 6 -> {
                    test.runQueued();
                    test.advance(Duration.ofSeconds(random.nextInt(3)));
                }
                case 7 -> note(settle);
                default -> ask(settle);
            }
        }

        private void publish() {
            Address address = nextAddress();
            broker.register("work", List.of(), address, provider(address));
            alive.add(address);
        }

        private Address nextAddress() {
            return new Address("node", "work-" + ++providers);
        }

        private Provider provider(Address address) {
            var worker = new Worker() {
                @Override
                public Promise<String> work(int id, boolean isLater) {
                    note(id);
                    var answer = new Late(Deferred.unbound(), address.name());
                    if (isLater) {
                        later.add(answer);
                    } else {
                        answer.give();
                    }
                    return answer.answer();
                }

                @Override
                public void note(int id) {
                    done.computeIfAbsent(id, each -> new ArrayList<>()).add(address.name());
                }
            };
            return services.provider(address, test.space(), Worker.class, () -> worker, ActorSettings.defaults());
        }

        private void kill() {
            if (inUse != null && alive.contains(inUse)) {
                var life = services.running(inUse);
                if (life != null) {
                    test.space().stop(life.proxy());
                    alive.remove(inUse);
                }
            }
        }

        private void withdraw() {
            if (!alive.isEmpty()) {
                Address one = alive.remove(random.nextInt(alive.size()));
                broker.withdraw(one).handle((gone, error) -> null);
            }
        }

        private void replace() {
            if (!alive.isEmpty()) {
                int place = random.nextInt(alive.size());
                Address next = nextAddress();
                broker.replace(alive.get(place), "work", List.of(), next, provider(next))
                        .handle((by, error) -> null);
                if (alive.set(place, next).equals(inUse)) {
                    inUse = next;
                }
                running.add(next);
            }
        }

        private void ask(boolean settle) {
            boolean isLater = random.nextInt(3) == 0;
            int id = expect(settle);
            asked.put(id, worker.work(id, isLater));
            asked.get(id).handle((value, error) -> null);
        }

        private void note(boolean settle) {
            int id = expect(settle);
            notes.add(id);
            worker.note(id);
        }

        /** If nothing else is pending, the model knows who must execute the next call: the provider in use. */
        private int expect(boolean settle) {
            calls++;
            if (inUse != null && test.space().isQuiet() && settle && batch == 0) {
                expected.put(calls, inUse.name());
            }
            return calls;
        }

        private void check() {
            String what = "seed " + seed;
            asked.forEach((id, promise) -> {
                String call = what + ": call " + id;
                assertThat(promise.isDone()).as("%s has ended", call).isTrue();
                var by = doneBy(id);
                Throwable error = promise.error();
                if (error == null) {
                    assertThat(by)
                            .as("%s was done once, and answered by that", call)
                            .isEqualTo(List.of(promise.getNow()));
                } else {
                    assertThat(by).as("%s was done once at most", call).hasSizeLessThanOrEqualTo(1);
                    assertThat(error).as(call).isInstanceOf(ServiceCallException.class);
                    assertThat(((ServiceCallException) error).mayHaveRun() || by.isEmpty())
                            .as("%s says that nobody got it, and %s did it", call, by)
                            .isTrue();
                }
            });
            expected.forEach((id, name) -> assertThat(doneBy(id))
                    .as("%s: call %d was for %s", what, id, name)
                    .containsExactly(name));
            int deadLetters = (int) test.takeDeadLetters().stream()
                    .filter(letter -> letter.message().contains("note("))
                    .count();
            assertThat(notesDone() + undelivered() + deadLetters)
                    .as("%s: one-way calls done, undelivered and dead", what)
                    .isEqualTo(notes.size());
            assertThat(notes).as(what).allSatisfy(id -> assertThat(doneBy(id)).hasSizeLessThanOrEqualTo(1));
            assertThat(test.takeProblems()).as(what).isEmpty();
            test.close();
        }

        private List<String> doneBy(int id) {
            return done.getOrDefault(id, List.of());
        }

        private long notesDone() {
            return notes.stream().filter(done::containsKey).count();
        }

        private long undelivered() {
            return events.stream()
                    .filter(BrokerEvent.CallRejected.class::isInstance)
                    .count();
        }

        Stream<String> ends() {
            var ends = asked.values().stream().map(promise -> end(promise.error()));
            var ofNotes = Stream.concat(
                    Stream.generate(() -> "note done").limit(notesDone()),
                    Stream.generate(() -> "note undelivered").limit(undelivered()));
            return Stream.concat(ends, ofNotes);
        }

        private static String end(@Nullable Throwable error) {
            String message = error == null ? "" : String.valueOf(error.getMessage());
            return error == null
                    ? "answered"
                    : message.contains("ended while")
                            ? "died with it"
                            : message.contains("did not answer") ? "too late" : "nobody there";
        }
    }
}
