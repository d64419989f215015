package io.troupe.faults.history;

import io.troupe.faults.history.Event.Moved;
import io.troupe.faults.history.Event.Sent;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/**
 * Robots. A driver never sends a speed twice: so a robot that keeps a speed has got no command since, and its driver is
 * gone or cut off; and the time when a speed was sent is known when a robot has it.
 */
final class RobotRules {
    private static final long MOST_KEPT_MICROS = 500_000;
    private static final long TICK_MICROS = 100_000;
    /** The limit of the server, a tick, and a busy machine. */
    private static final long MOST_AGE_NANOS = 300_000_000 + 100_000_000 + 150_000_000;

    private static final double SCALE = 1e9; // speeds differ by more than this

    private record Speed(int robot, long value) {}

    /** The first tick in which a robot had its speed. */
    private record Since(Moved moved, Entry entry) {}

    private final Map<Speed, Entry> sent = new HashMap<>();
    private final Map<Integer, Since> since = new HashMap<>();
    private final History history;
    private final Pauses pauses;
    private final Consumer<Violation> violations;
    private long worstKeptMicros;
    private long matched;

    RobotRules(History history, Pauses pauses, Consumer<Violation> violations) {
        this.history = history;
        this.pauses = pauses;
        this.violations = violations;
    }

    RobotRules check() {
        for (Entry entry : history.entries()) {
            if (entry.event() instanceof Sent(int robot, double turnRadps)) {
                sent.put(speed(robot, turnRadps), entry);
            } else if (entry.event() instanceof Moved moved) {
                moved(moved, entry);
            }
        }
        return this;
    }

    private static Speed speed(int robot, double turnRadps) {
        return new Speed(robot, Math.round(turnRadps * SCALE));
    }

    private void moved(Moved moved, Entry entry) {
        Since earlier = since.get(moved.robot());
        boolean isNew = earlier == null || earlier.moved.turnRadps() != moved.turnRadps();
        if (isNew) {
            since.put(moved.robot(), new Since(moved, entry));
        }
        if (moved.turnRadps() == 0) {
            return;
        }
        if (isNew) {
            checkAge(moved, entry);
            return;
        }
        // with the tick before the first one, in which the command has arrived
        long keptMicros = moved.worldMicros() - earlier.moved.worldMicros() + TICK_MICROS;
        worstKeptMicros = Math.max(worstKeptMicros, keptMicros);
        if (keptMicros > MOST_KEPT_MICROS) {
            violations.accept(new Violation(
                    Rule.STOPPED,
                    "robot " + moved.robot() + " moves " + keptMicros / 1_000 + " ms after its last command",
                    List.of(earlier.entry, entry)));
        }
    }

    private void checkAge(Moved moved, Entry entry) {
        Entry command = sent.get(speed(moved.robot(), moved.turnRadps()));
        if (command == null) {
            return; // a speed between two commands: a robot does not change its speed at once
        }
        matched++;
        long ageNanos = pauses.runningNanos(entry.process(), command.nanos(), entry.nanos());
        if (ageNanos > MOST_AGE_NANOS) {
            violations.accept(new Violation(
                    Rule.FRESH,
                    "robot " + moved.robot() + " gets a speed that is " + ageNanos / 1_000_000 + " ms old",
                    List.of(command, entry)));
        }
    }

    /** The longest time on the world's clock for which a robot kept the speed of one command. */
    long worstKeptMillis() {
        return worstKeptMicros / 1_000;
    }

    /** How many commands have reached a robot. */
    long matched() {
        return matched;
    }
}
