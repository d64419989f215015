package io.troupe.actor.model;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.Supervision;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Collectors;

/**
 * One step of a random program, done by the test thread or, as part of a script, inside a handler, a listener or a
 * timer.
 *
 * @param id a unique number: of the letter, promise, stream, timer or error that it creates
 * @param target the actor, promise, stream or timer that it applies to
 * @param number a quantity or a variant, depending on the kind
 * @param script the acts that run where the step arrives
 */
record Act(Kind kind, int id, int target, int number, List<Act> script) {
    enum Kind {
        RUN,
        /** Moves the clock by {@code number} half milliseconds. */
        ADVANCE,
        /** Spawns actor {@code target} with the {@link Cast} {@code number}; the script runs when it starts. */
        SPAWN,
        STOP,
        STOP_SELF,
        /** Holds the calls of the actor back. */
        HOLD,
        RELEASE,
        WATCH,
        TELL,
        /** {@code number}: see {@link Answer}. */
        ASK,
        /** Creates a promise that is settled by hand. */
        DEFER,
        RESOLVE,
        REJECT,
        CANCEL,
        THEN,
        HANDLE,
        WHEN,
        RESCUE,
        /** Continues with promise {@code number} if there is one. */
        COMPOSE,
        /** Limits a promise to {@code number} half milliseconds. */
        LIMIT,
        /** Likewise, with a value in place of the error. */
        INSTEAD,
        /**
         * A call with a callback; {@code number} modulo 4 is 1 or 3 = one that can be cancelled, 2 or 3 = a request.
         * One that can be cancelled keeps {@code number} / 4 results, 0 = all. The script runs in the actor, except for
         * its {@link #READER}.
         */
        OPEN,
        /** In the script of an {@link #OPEN}: what the reader does with each result. */
        READER,
        /** Passes the callback on to another actor. */
        FORWARD,
        /** Sends {@code number} results. */
        NEXT,
        FINISH,
        FAIL,
        CANCEL_STREAM,
        LOOK_AT_STREAM,
        AFTER,
        EVERY,
        CANCEL_TIMER,
        DELAY,
        EXECUTE,
        CLOSE,
        ON_IDLE,
        THROW
    }

    /** How a request is answered. */
    enum Answer {
        VALUE,
        /** With a promise under the next id, settled by hand. */
        LATER,
        FAILED,
        NULL,
        /** With promise {@code number} minus the number of answers, if there is one. */
        OTHER;

        static Answer of(int number) {
            return values()[Math.min(number, OTHER.ordinal())];
        }
    }

    /** What happens to an actor after a failure. */
    enum Directive {
        RESUME,
        RESTART,
        STOP
    }

    /**
     * The settings of an actor of a program, as plain numbers.
     *
     * @param limit failures within the window; -1 = any number
     * @param windowTicks in half milliseconds
     * @param capacity of the mailbox; 0 = any
     * @param failingInstance the instance whose factory throws; 0 = none
     * @param firstPauseTicks before a restart, doubled for each failure in a row; 0 = none
     */
    record Cast(
            Directive directive,
            int limit,
            int windowTicks,
            int capacity,
            Overflow overflow,
            boolean ownHandler,
            int failingInstance,
            int firstPauseTicks) {
        static final int SUPERVISIONS = 6;
        static final int VARIANTS = SUPERVISIONS * 6 * 2 * 4;
        static final int LONGEST_PAUSE_TICKS = 30;

        static Cast of(int variant) {
            int supervision = variant % SUPERVISIONS;
            int mailbox = variant / SUPERVISIONS % 6;
            int factory = variant / (SUPERVISIONS * 12) % 4;
            return new Cast(
                    switch (supervision) {
                        case 1 -> Directive.STOP;
                        case 2, 3, 5 -> Directive.RESTART;
                        default -> Directive.RESUME;
                    },
                    supervision < 2 ? -1 : supervision == 5 ? 3 : Math.min(1, supervision - 2),
                    10,
                    mailbox < 3 ? 0 : 2,
                    Overflow.values()[mailbox % 3],
                    variant / (SUPERVISIONS * 6) % 2 == 1,
                    factory < 2 ? 0 : factory - 1,
                    supervision == 5 ? 4 : 0);
        }

        ActorSettings settings(String name) {
            var supervision = switch (directive) {
                case RESUME -> limit < 0 ? Supervision.RESUME : Supervision.resume(limit, ticks(windowTicks));
                case STOP -> Supervision.STOP;
                case RESTART ->
                    limit < 0
                            ? Supervision.restart(ticks(windowTicks))
                            : Supervision.restart(limit, ticks(windowTicks));
            };
            if (firstPauseTicks > 0) {
                supervision = supervision.withPauses(ticks(firstPauseTicks), ticks(LONGEST_PAUSE_TICKS));
            }
            var plain = ActorSettings.named(name).withSupervision(supervision);
            return capacity == 0 ? plain : plain.withMailbox(capacity, overflow);
        }

        static Duration ticks(int number) {
            return Duration.ofNanos(500_000L * number);
        }
    }

    static Act of(Kind kind, int id, int target, int number) {
        return new Act(kind, id, target, number, List.of());
    }

    /** Of an {@link Kind#OPEN}: true if its reader can cancel it. */
    boolean isCancellable() {
        return number % 2 == 1;
    }

    /** Of an {@link Kind#OPEN}: true if it is a request. */
    boolean isRequest() {
        return number % 4 > 1;
    }

    /** Of an {@link Kind#OPEN}: the number of results that may be queued. */
    int most() {
        return isCancellable() && number >= 4 ? number / 4 : Integer.MAX_VALUE;
    }

    int promised() {
        return number - Answer.values().length;
    }

    Act reader() {
        return script.stream()
                .filter(each -> each.kind == Kind.READER)
                .findFirst()
                .orElse(of(Kind.READER, 0, 0, 0));
    }

    /** The number of acts, including their scripts. */
    static int count(List<Act> acts) {
        return acts.stream().mapToInt(each -> 1 + count(each.script)).sum();
    }

    /** The acts without a range of them, counted in the order in which they are written. */
    static List<Act> without(List<Act> acts, int from, int to) {
        var kept = new ArrayList<Act>();
        int at = 0;
        for (Act act : acts) {
            int size = 1 + count(act.script);
            if (at < from || at >= to) {
                var script = without(act.script, from - at - 1, to - at - 1);
                kept.add(new Act(act.kind, act.id, act.target, act.number, script));
            }
            at += size;
        }
        return List.copyOf(kept);
    }

    @Override
    public String toString() {
        return String.valueOf(id);
    }

    static String print(List<Act> acts, String indent) {
        return acts.stream().map(each -> each.print(indent)).collect(Collectors.joining());
    }

    private String print(String indent) {
        String line = "%s%s id=%d target=%d number=%d%n".formatted(indent, kind, id, target, number);
        return line + print(script, indent + "    ");
    }
}
