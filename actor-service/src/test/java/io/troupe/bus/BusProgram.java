package io.troupe.bus;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.BusContract.Count;
import io.troupe.bus.BusContract.Text;
import io.troupe.bus.BusModel.Manner;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

/** A random program that runs on a bus and on its model, step by step. */
final class BusProgram implements AutoCloseable {
    private static final int CAPACITY = 3;
    private static final int STEPS = 60;
    private static final int LIMIT_SECONDS = 3;
    private static final Duration LIMIT = Duration.ofMillis(3_500); // never equal to a multiple of the clock's steps
    private static final int PORTS = 4;

    private final TestSpace test = new TestSpace();
    private final Random random;
    private final BytePipe pipe = new BytePipe(test.space());
    private final List<Bus> nodes = new ArrayList<>();
    private final BusModel model;
    private final Map<String, BusPort> ports = new LinkedHashMap<>();
    private final Map<Integer, BusPort.Subscription> subscriptions = new LinkedHashMap<>();
    private final Map<Integer, List<String>> heard = new LinkedHashMap<>();
    private final Map<Integer, Promise<Text>> answers = new LinkedHashMap<>();
    private final List<Runnable> kept = new ArrayList<>();
    private final List<Loss> losses = new ArrayList<>();
    private final List<String> steps = new ArrayList<>();
    private int next;

    BusProgram(long seed, boolean twoNodes) {
        random = new Random(seed);
        var settings = BusSettings.on(test.space()).withCapacity(CAPACITY).withObserver(losses::add);
        nodes.add(pipe.open("one", settings));
        if (twoNodes) {
            nodes.add(pipe.open("two", settings));
        }
        model = new BusModel(CAPACITY, nodes.size());
    }

    void run() {
        for (int i = 0; i < STEPS; i++) {
            step();
            pipe.carryAll(); // the model has no messages in transit
        }
        crank();
    }

    private void step() {
        switch (random.nextInt(12)) {
            case 0 -> subscribe(somePort());
            case 1 -> unsubscribe();
            case 2, 3, 4 -> publish(somePort());
            case 5 -> answer(somePort());
            case 6, 7 -> ask(somePort(), nameOf(random.nextInt(PORTS)));
            case 8 -> crank();
            case 9 -> answerKept();
            case 10 -> advance();
            default -> {
                if (random.nextInt(4) == 0) {
                    close(somePort());
                }
            }
        }
    }

    /** The port of that number, attached if necessary. */
    private String somePort() {
        int number = random.nextInt(PORTS);
        ports.computeIfAbsent(
                nameOf(number), name -> nodes.get(number % nodes.size()).attach(name));
        return nameOf(number);
    }

    private static String nameOf(int number) {
        return "port" + number;
    }

    private BusPort port(String name) {
        return java.util.Objects.requireNonNull(ports.get(name));
    }

    private void subscribe(String name) {
        int reader = next++;
        steps.add(reader + " subscribes at " + name);
        var mine = new ArrayList<String>();
        heard.put(reader, mine);
        subscriptions.put(
                reader,
                port(name).subscribe(BusContract.COUNTS, (count, from) -> mine.add(from.name() + " " + count.value())));
        model.subscribe(reader, name);
    }

    private void unsubscribe() {
        if (!subscriptions.isEmpty()) {
            var numbers = List.copyOf(subscriptions.keySet());
            int reader = numbers.get(random.nextInt(numbers.size()));
            steps.add(reader + " unsubscribes");
            java.util.Objects.requireNonNull(subscriptions.remove(reader)).close();
            model.unsubscribe(reader);
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
                var later = new Deferred<Text>(test.space());
                kept.add(() -> later.resolve(text));
                yield later;
            }
        };
    }

    private void ask(String requester, String to) {
        int id = next++;
        steps.add(requester + " asks " + to + ": " + id);
        var node = nodes.get((to.charAt(to.length() - 1) - '0') % nodes.size()).node();
        var answer = port(requester).ask(new Address(node, to), BusContract.SPELL, new Count(id), LIMIT);
        answer.handle((value, error) -> value); // a listener, so that a rejection is not reported
        answers.put(id, answer);
        model.ask(id, requester, to, LIMIT_SECONDS);
    }

    private void crank() {
        steps.add("crank");
        test.crank();
        model.crank();
    }

    private void answerKept() {
        steps.add("what is kept is answered");
        kept.forEach(Runnable::run);
        kept.clear();
        model.answerKept();
    }

    private void advance() {
        crank();
        steps.add("a second passes");
        test.advance(Duration.ofSeconds(1));
        model.advance(1);
    }

    private void close(String name) {
        steps.add(name + " leaves");
        java.util.Objects.requireNonNull(ports.remove(name)).close();
        model.close(name);
    }

    Map<Integer, List<String>> heardOnTheBus() {
        return heard;
    }

    Map<Integer, List<String>> heardInTheModel() {
        return model.heard();
    }

    Map<Integer, String> answersOfTheBus() {
        var said = new LinkedHashMap<Integer, String>();
        answers.forEach((id, answer) -> said.put(id, describe(answer)));
        return said;
    }

    private static String describe(Promise<Text> answer) {
        Text text = answer.getNow();
        Throwable error = answer.error();
        if (text != null) {
            return text.value();
        }
        return switch (error) {
            case null -> "null";
            case RemoteFailure failure -> "failed";
            case BusTimeoutException timeOut -> "timed out";
            default -> "refused";
        };
    }

    Map<Integer, String> answersOfTheModel() {
        return model.answers();
    }

    /** Compares the metrics of the bus and the losses reported to its observer with the model. */
    Map<String, Long> countedByTheBus() {
        var counts = new LinkedHashMap<String, Long>();
        long delivered = 0;
        long pending = answers.values().stream().filter(each -> !each.isDone()).count();
        for (Bus node : nodes) {
            var now = node.metrics();
            delivered += now.delivered();
            pending -= now.asked() - now.answered() - now.refused() - now.timedOut();
            counts.merge("queued", now.queued(), Long::sum);
            counts.merge("dropped", now.dropped(), Long::sum);
            counts.merge("discarded", now.discarded(), Long::sum);
            counts.merge("late", now.late(), Long::sum);
        }
        counts.put("delivered", delivered);
        counts.put("told as dropped", count(Loss.Dropped.class));
        counts.put(
                "told as discarded",
                losses.stream()
                        .mapToLong(loss -> loss instanceof Loss.Discarded discarded ? discarded.count() : 0)
                        .sum());
        counts.put("told as late", count(Loss.Late.class));
        counts.put("questions unaccounted for", pending);
        return counts;
    }

    private long count(Class<? extends Loss> type) {
        return losses.stream().filter(type::isInstance).count();
    }

    Map<String, Long> countedByTheModel() {
        long delivered = model.heard().values().stream().mapToLong(List::size).sum();
        return Map.of(
                "queued", model.queued,
                "dropped", model.dropped,
                "discarded", model.discarded,
                "late", model.late,
                "delivered", delivered,
                "told as dropped", model.dropped,
                "told as discarded", model.discarded,
                "told as late", model.late,
                "questions unaccounted for", 0L);
    }

    @Override
    public void close() {
        nodes.forEach(Bus::close);
        test.crank();
        test.close();
    }

    @Override
    public String toString() {
        return String.join("\n", steps);
    }
}
