package io.troupe.bus;

import static java.util.Objects.requireNonNull;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.BusContract.Count;
import io.troupe.bus.BusContract.Text;
import io.troupe.tools.Thorough;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.function.Predicate;
import java.util.function.ToLongFunction;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Runs random programs on a bus and on a simple model of it, and compares everything that is received and counted. */
class BusModelTest {
    private static final int PROGRAMS = Integer.getInteger("model.programs", Thorough.times(60, 300));
    private static final long SEED = Long.getLong("model.seed", -1L);
    private static final int CAPACITY = 3;
    private static final int STEPS = 60;
    private static final int PORTS = 4;

    /** The nodes exchange bytes. */
    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void randomPrograms_onSoManyNodes_showWhatTheModelSays(int nodes) {
        if (SEED >= 0) {
            check(SEED, nodes);
            return;
        }
        for (long seed = 0; seed < PROGRAMS; seed++) {
            check(seed, nodes);
        }
    }

    private static void check(long seed, int nodes) {
        try (var program = new Program(seed, nodes)) {
            program.run();
            var model = program.model;
            String which = "-Dmodel.seed=%d, nodes: %d, program:%n%s".formatted(seed, nodes, program);
            assertThat(program.received).as("received; %s", which).isEqualTo(model.received);
            assertThat(program.outcomes()).as("answers; %s", which).isEqualTo(model.outcomes());
            assertThat(program.counts()).as("counts; %s", which).isEqualTo(model.counts());
        }
    }

    /** The behaviour of a request handler. */
    private enum Manner {
        ANSWERS,
        THROWS,
        KEEPS
    }

    private static int numberOf(String port) {
        return port.charAt(port.length() - 1) - '0';
    }

    /** A simple model of a bus: lists, without threads or promises. */
    private static final class Model {
        /** A subscription. */
        private record Reader(String port, List<String> received, ArrayDeque<String> waiting) {}

        /** A request; the outcome is null while it is pending. */
        private static final class Request {
            final int id;
            final String requester;
            final long deadlineSeconds;

            @Nullable
            String outcome;

            Request(int id, String requester, long deadlineSeconds) {
                this.id = id;
                this.requester = requester;
                this.deadlineSeconds = deadlineSeconds;
            }
        }

        /** A port with a request handler. */
        private record Handler(String port, Manner manner, ArrayDeque<Request> waiting, List<Request> kept) {}

        private final Map<Integer, Reader> readers = new LinkedHashMap<>();
        private final Map<String, Handler> handlers = new LinkedHashMap<>();
        private final List<Request> requests = new ArrayList<>();
        private final List<Request> keptByNobody = new ArrayList<>();
        private final Map<Integer, List<String>> received = new LinkedHashMap<>();
        private long dropped;
        private long discarded;
        private long queued;
        private long late;
        private long seconds;

        void subscribe(int reader, String port) {
            received.put(reader, new ArrayList<>());
            readers.put(reader, new Reader(port, received.get(reader), new ArrayDeque<>()));
        }

        void publish(String value) {
            for (var reader : readers.values()) {
                if (reader.waiting.size() == CAPACITY) {
                    reader.waiting.remove();
                    dropped++;
                }
                reader.waiting.add(value);
                queued++;
            }
        }

        void unsubscribe(int reader) {
            discarded += requireNonNull(readers.remove(reader)).waiting.size();
        }

        void answer(String port, Manner manner) {
            handlers.put(port, new Handler(port, manner, new ArrayDeque<>(), new ArrayList<>()));
        }

        void ask(int id, String requester, String to, long limitSeconds) {
            var request = new Request(id, requester, seconds + limitSeconds);
            requests.add(request);
            var handler = handlers.get(to);
            if (handler == null || handler.waiting.size() == CAPACITY) {
                request.outcome = "refused";
            } else {
                handler.waiting.add(request);
            }
        }

        void runQueued() {
            for (var reader : readers.values()) {
                reader.received.addAll(reader.waiting);
                reader.waiting.clear();
            }
            for (var handler : handlers.values()) {
                for (var request = handler.waiting.poll(); request != null; request = handler.waiting.poll()) {
                    handle(handler, request);
                }
            }
        }

        private void handle(Handler handler, Request request) {
            if (begun(handler).size() >= CAPACITY) {
                settle(request, "refused");
                return;
            }
            switch (handler.manner) {
                case ANSWERS -> settle(request, "answered " + request.id);
                case THROWS -> settle(request, "failed");
                case KEEPS -> handler.kept.add(request);
            }
        }

        /** The begun requests of a request handler that have not been cancelled. */
        private List<Request> begun(Handler handler) {
            return handler.kept.stream()
                    .filter(request -> request.outcome == null)
                    .toList();
        }

        private void settle(Request request, String outcome) {
            if (request.outcome == null) {
                request.outcome = outcome;
            } else {
                late++;
            }
        }

        /** Replies to all requests that were kept open. */
        void answerKept() {
            for (var handler : handlers.values()) {
                handler.kept.forEach(request -> settle(request, "answered " + request.id));
                handler.kept.clear();
            }
            late += keptByNobody.size();
            keptByNobody.clear();
        }

        void advance() {
            seconds++;
            settlePending(request -> request.deadlineSeconds < seconds, "timed out");
        }

        private void settlePending(Predicate<Request> which, String outcome) {
            for (var request : requests) {
                if (request.outcome == null && which.test(request)) {
                    request.outcome = outcome;
                    handlers.values().forEach(handler -> handler.waiting.remove(request)); // it is not handled
                }
            }
        }

        void close(String port) {
            List.copyOf(readers.keySet()).stream()
                    .filter(reader -> requireNonNull(readers.get(reader)).port.equals(port))
                    .forEach(this::unsubscribe);
            var handler = handlers.remove(port);
            if (handler != null) {
                handler.waiting.forEach(request -> settle(request, "refused"));
                begun(handler).forEach(request -> settle(request, "refused"));
                keptByNobody.addAll(handler.kept);
            }
            settlePending(request -> request.requester.equals(port), "refused");
        }

        Map<Integer, String> outcomes() {
            var outcomes = new LinkedHashMap<Integer, String>();
            requests.forEach(request -> outcomes.put(request.id, String.valueOf(request.outcome)));
            return outcomes;
        }

        Map<String, Long> counts() {
            return Map.of(
                    "queued", queued,
                    "dropped", dropped,
                    "discarded", discarded,
                    "late", late,
                    "delivered",
                            received.values().stream().mapToLong(List::size).sum(),
                    "told as dropped", dropped,
                    "told as discarded", discarded,
                    "told as late", late,
                    "questions unaccounted for", 0L);
        }
    }

    /** A random program that runs on a bus and on its model, step by step. */
    private static final class Program implements AutoCloseable {
        private static final int LIMIT_SECONDS = 3;
        private static final Duration LIMIT =
                Duration.ofMillis(3_500); // never equal to a multiple of the clock's steps

        private final TestSpace test = new TestSpace();
        private final Random random;
        private final BytePipe pipe = new BytePipe(test.space());
        private final List<Bus> nodes = new ArrayList<>();
        private final Model model;
        private final Map<String, BusPort> ports = new LinkedHashMap<>();
        private final Map<Integer, BusPort.Subscription> subscriptions = new LinkedHashMap<>();
        private final Map<Integer, List<String>> received = new LinkedHashMap<>();
        private final Map<Integer, Promise<Text>> answers = new LinkedHashMap<>();
        private final List<Runnable> kept = new ArrayList<>();
        private final List<Loss> losses = new ArrayList<>();
        private final List<String> steps = new ArrayList<>();
        private int next;

        Program(long seed, int nodeCount) {
            random = new Random(seed);
            var settings = BusSettings.on(test.space()).withCapacity(CAPACITY).withObserver(losses::add);
            for (String name : List.of("one", "two").subList(0, nodeCount)) {
                nodes.add(pipe.open(name, settings));
            }
            model = new Model();
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                step();
                pipe.carryAll(); // the model has no messages in transit
            }
            runQueued();
        }

        private void step() {
            switch (random.nextInt(12)) {
                case 0 -> subscribe(somePort());
                case 1 -> unsubscribe();
                case 2, 3, 4 -> publish(somePort());
                case 5 -> answer(somePort());
                case 6, 7 -> ask(somePort(), "port" + random.nextInt(PORTS));
                case 8 -> runQueued();
                case 9 -> {
                    steps.add("what is kept is answered");
                    kept.forEach(Runnable::run);
                    kept.clear();
                    model.answerKept();
                }
                case 10 -> {
                    runQueued();
                    steps.add("a second passes");
                    test.advance(Duration.ofSeconds(1));
                    model.advance();
                }
                default -> {
                    if (random.nextInt(4) == 0) {
                        String name = somePort();
                        steps.add(name + " leaves");
                        requireNonNull(ports.remove(name)).close();
                        model.close(name);
                    }
                }
            }
        }

        private Bus nodeOf(String port) {
            return nodes.get(numberOf(port) % nodes.size());
        }

        /** The name of a port, which is attached if necessary. */
        private String somePort() {
            String name = "port" + random.nextInt(PORTS);
            ports.computeIfAbsent(name, each -> nodeOf(each).attach(each));
            return name;
        }

        private BusPort port(String name) {
            return requireNonNull(ports.get(name));
        }

        private void subscribe(String name) {
            int reader = next++;
            steps.add(reader + " subscribes at " + name);
            var mine = new ArrayList<String>();
            received.put(reader, mine);
            BusPort.Subscriber<Count> subscriber = (count, from) -> mine.add(from.name() + " " + count.value());
            subscriptions.put(reader, port(name).subscribe(BusContract.COUNTS, subscriber));
            model.subscribe(reader, name);
        }

        private void unsubscribe() {
            if (!subscriptions.isEmpty()) {
                var numbers = List.copyOf(subscriptions.keySet());
                int reader = numbers.get(random.nextInt(numbers.size()));
                steps.add(reader + " unsubscribes");
                requireNonNull(subscriptions.remove(reader)).close();
                if (model.readers.containsKey(reader)) { // otherwise its port has left
                    model.unsubscribe(reader);
                }
            }
        }

        private void publish(String name) {
            int value = next++;
            steps.add(name + " publishes " + value);
            port(name).publish(BusContract.COUNTS, new Count(value));
            model.publish(name + " " + value);
        }

        private void answer(String name) {
            var manner = Manner.values()[random.nextInt(Manner.values().length)];
            try {
                port(name).answer(BusContract.SPELL, count -> reply(manner, count));
            } catch (IllegalArgumentException already) {
                return;
            }
            steps.add(name + " " + manner);
            model.answer(name, manner);
        }

        private Promise<Text> reply(Manner manner, Count count) {
            var text = new Text("answered " + count.value());
            return switch (manner) {
                case ANSWERS -> Promise.of(text);
                case THROWS -> throw new IllegalStateException("will not");
                case KEEPS -> {
                    Deferred<Text> later = test.space().deferred();
                    kept.add(() -> later.resolve(text));
                    yield later;
                }
            };
        }

        private void ask(String requester, String to) {
            int id = next++;
            steps.add(requester + " asks " + to + ": " + id);
            var address = new Address(nodeOf(to).node(), to);
            var answer = port(requester).ask(address, BusContract.SPELL, new Count(id), LIMIT);
            answer.handle((value, error) -> value); // a listener, so that a rejection is not reported
            answers.put(id, answer);
            model.ask(id, requester, to, LIMIT_SECONDS);
        }

        private void runQueued() {
            steps.add("run");
            test.runQueued();
            model.runQueued();
        }

        Map<Integer, String> outcomes() {
            var outcomes = new LinkedHashMap<Integer, String>();
            answers.forEach((id, answer) -> outcomes.put(id, outcome(answer)));
            return outcomes;
        }

        private static String outcome(Promise<Text> answer) {
            Text text = answer.getNow();
            return text != null
                    ? text.value()
                    : switch (answer.error()) {
                        case null -> "null";
                        case RemoteFailure failure -> "failed";
                        case BusTimeoutException timeOut -> "timed out";
                        default -> "refused";
                    };
        }

        /** The metrics of the bus, and the losses reported to its observer. */
        Map<String, Long> counts() {
            long pending =
                    answers.values().stream().filter(each -> !each.isDone()).count();
            long settled = sum(BusMetrics::answered) + sum(BusMetrics::rejected) + sum(BusMetrics::timedOut);
            long discarded = 0;
            for (var loss : losses) {
                discarded += loss instanceof Loss.DroppedAtEnd it ? it.count() : 0;
            }
            return Map.of(
                    "queued", sum(BusMetrics::queued),
                    "dropped", sum(BusMetrics::dropped),
                    "discarded", sum(BusMetrics::droppedAtEnd),
                    "late", sum(BusMetrics::late),
                    "delivered", sum(BusMetrics::delivered),
                    "told as dropped", count(Loss.Dropped.class),
                    "told as discarded", discarded,
                    "told as late", count(Loss.Late.class),
                    "questions unaccounted for", pending - (sum(BusMetrics::asked) - settled));
        }

        private long sum(ToLongFunction<BusMetrics> figure) {
            return nodes.stream().map(Bus::metrics).mapToLong(figure).sum();
        }

        private long count(Class<? extends Loss> type) {
            return losses.stream().filter(type::isInstance).count();
        }

        @Override
        public void close() {
            nodes.forEach(Bus::close);
            test.runQueued();
            test.close();
        }

        @Override
        public String toString() {
            return String.join("\n", steps);
        }
    }
}
