package io.troupe.faults.node;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.broker.ActorConnection;
import io.troupe.broker.ActorServices;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.faults.history.Event.CallKind;
import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Settled;
import io.troupe.faults.history.Event.StreamEnded;
import io.troupe.faults.history.Event.StreamItem;
import io.troupe.faults.history.Event.StreamOpened;
import io.troupe.faults.history.History;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jspecify.annotations.Nullable;

/** Calls the tools of all nodes in random ways. On one space. */
final class Callers {
    private static final Duration PAUSE = Duration.ofMillis(30);
    private static final Duration LIMIT = Duration.ofSeconds(2);
    private static final ConnectionSettings SETTINGS =
            ConnectionSettings.defaults().withWaitLimit(LIMIT).withAnswerLimit(LIMIT);
    /** Of a call without another limit: it waits for a provider, and then for the answer. */
    private static final long BOTH_LIMITS_MILLIS = 2 * LIMIT.toMillis();

    private static final long SHORT_LIMIT_MILLIS = 700;
    private static final int MOST_MILLIS = 1_500;
    private static final int MOST_ITEMS = 400;
    private static final int STREAM_OF = 40; // one call of so many

    private record Target(String name, Tool tool) {}

    private final ActorSpace space;
    private final History.Writer history;
    private final String process;
    private final Random random;
    private final List<Target> targets = new ArrayList<>();
    private long made;
    private int open;
    private boolean isQuiet;

    Callers(ActorSpace space, History.Writer history, String process, long seed) {
        this.space = space;
        this.history = history;
        this.process = process;
        this.random = new Random(seed);
    }

    /** Connects to the tool of each node, and to that of any. */
    void start(ActorServices services, List<String> nodes) {
        for (String node : nodes) {
            connect(services, "tool-" + node, Need.ofCapability(process, "at-" + node));
        }
        connect(services, "tool", Need.ofService(process, "tool"));
        next();
    }

    private void connect(ActorServices services, String name, Need need) {
        ActorConnection<Tool> connection = services.connect(Tool.class, need, SETTINGS);
        connection.first().onRejected(missing -> {}); // a later one is used, too
        targets.add(new Target(name, connection.actor()));
    }

    /** Makes no further calls. */
    void quiet() {
        isQuiet = true;
    }

    /** Returns how many calls and streams have not ended. */
    int open() {
        return open;
    }

    private void next() {
        if (!isQuiet) {
            call(targets.get(random.nextInt(targets.size())));
            space.delay(PAUSE).thenRun(this::next);
        }
    }

    private void call(Target target) {
        String call = process + "." + ++made;
        if (made % STREAM_OF == 0) {
            stream(call, target);
            return;
        }
        switch (random.nextInt(10)) {
            case 0, 1, 2, 3 -> {
                called(call, target, CallKind.SHORT, BOTH_LIMITS_MILLIS);
                watch(call, target.tool.count(call));
            }
            case 4, 5 -> {
                called(call, target, CallKind.SHORT, SHORT_LIMIT_MILLIS);
                watch(call, target.tool.count(call).orTimeout(Duration.ofMillis(SHORT_LIMIT_MILLIS)));
            }
            case 6 -> {
                called(call, target, CallKind.LONG, BOTH_LIMITS_MILLIS);
                watch(call, target.tool.countLater(call, random.nextInt(MOST_MILLIS)));
            }
            case 7 -> {
                called(call, target, CallKind.LONG, SHORT_LIMIT_MILLIS);
                Promise<Long> answer = target.tool.countLater(call, random.nextInt(MOST_MILLIS));
                watch(call, answer.orTimeout(Duration.ofMillis(SHORT_LIMIT_MILLIS)));
            }
            case 8 -> {
                called(call, target, CallKind.CANCELLED, BOTH_LIMITS_MILLIS);
                Promise<Long> answer = target.tool.countLater(call, MOST_MILLIS);
                watch(call, answer);
                space.delay(Duration.ofMillis(random.nextInt(200))).thenRun(answer::cancel);
            }
            default -> {
                called(call, target, CallKind.ONE_WAY, BOTH_LIMITS_MILLIS);
                target.tool.note(call);
            }
        }
    }

    private void called(String call, Target target, CallKind kind, long limitMillis) {
        history.add(new Called(call, target.name, kind, limitMillis, BOTH_LIMITS_MILLIS));
    }

    private void watch(String call, Promise<Long> answer) {
        open++;
        answer.onSettled((value, error) -> {
            open--;
            boolean mayBeSent = !(error instanceof ServiceCallException failure) || failure.mayHaveRun();
            history.add(new Settled(call, error == null, mayBeSent, outcome(error)));
        });
    }

    private void stream(String call, Target target) {
        long items = 1 + random.nextInt(MOST_ITEMS);
        open++;
        history.add(new StreamOpened(call, target.name, items));
        var reader = new Callback.Stream<Long>(number -> history.add(new StreamItem(call, number)), error -> {
            open--;
            history.add(new StreamEnded(call, error == null, outcome(error)));
        });
        target.tool.list(call, items, reader);
        if (random.nextInt(5) == 0) {
            space.delay(Duration.ofMillis(random.nextInt(200))).thenRun(reader::cancel);
        }
    }

    private static String outcome(@Nullable Throwable error) {
        return error == null ? "answered" : error.getClass().getSimpleName() + ": " + error.getMessage();
    }
}
