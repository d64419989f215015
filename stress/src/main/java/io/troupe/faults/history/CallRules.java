package io.troupe.faults.history;

import io.troupe.faults.history.Event.CallKind;
import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Executed;
import io.troupe.faults.history.Event.Settled;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** The rules of calls, for each call. */
final class CallRules {
    /** The machine may be busy: a timer of a process that runs may be late by this. */
    private static final long TOLERANCE_NANOS = 500_000_000;

    /** The lines about one call. */
    private static final class Call {
        @Nullable
        Entry called;

        final List<Entry> settled = new ArrayList<>();
        final List<Entry> executed = new ArrayList<>();

        List<Entry> all() {
            var all = new ArrayList<>(settled);
            all.addAll(executed);
            if (called != null) {
                all.add(called);
            }
            return all;
        }
    }

    private final Map<String, Call> calls = new LinkedHashMap<>();
    private final Pauses pauses;
    private final Consumer<Violation> violations;

    CallRules(History history, Pauses pauses, Consumer<Violation> violations) {
        this.pauses = pauses;
        this.violations = violations;
        Function<String, Call> of = name -> calls.computeIfAbsent(name, unused -> new Call());
        for (Entry entry : history.entries()) {
            switch (entry.event()) {
                case Called called -> of.apply(called.call()).called = entry;
                case Settled settled -> of.apply(settled.call()).settled.add(entry);
                case Executed executed -> of.apply(executed.call()).executed.add(entry);
                default -> {}
            }
        }
    }

    void check() {
        calls.forEach(this::check);
    }

    /** The time until a call is executed, without the pauses after it was accepted. */
    private long sinceAcceptedNanos(Entry called, Entry executed) {
        String process = executed.process();
        return process.equals(called.process())
                ? pauses.runningNanos(process, called.nanos(), executed.nanos())
                : pauses.sinceAcceptedNanos(process, called.nanos(), executed.nanos());
    }

    private void check(String name, Call call) {
        Consumer<Rule> broken = rule -> violations.accept(new Violation(rule, "call " + name, call.all()));
        if (call.executed.size() > 1) {
            broken.accept(Rule.EXECUTED_ONCE);
        }
        if (call.called == null || !(call.called.event() instanceof Called called)) {
            broken.accept(Rule.SETTLED_ONCE); // the line is written before the call
            return;
        }
        long limitNanos = called.limitMillis() * 1_000_000 + TOLERANCE_NANOS;
        if (called.kind() == CallKind.ONE_WAY) {
            return;
        }
        String caller = call.called.process();
        boolean isOverdue = pauses.runningNanos(caller, call.called.nanos(), pauses.lastNanos(caller)) > limitNanos;
        if (call.settled.size() > 1 || call.settled.isEmpty() && isOverdue) {
            broken.accept(Rule.SETTLED_ONCE);
        }
        long executionNanos = called.executionMillis() * 1_000_000 + TOLERANCE_NANOS;
        call.executed.stream()
                .filter(executed -> sinceAcceptedNanos(call.called, executed) > executionNanos)
                .findAny()
                .ifPresent(late -> broken.accept(Rule.NOT_LATE));
        for (Entry entry : call.settled) {
            var settled = (Settled) entry.event();
            if (pauses.runningNanos(caller, call.called.nanos(), entry.nanos()) > limitNanos) {
                broken.accept(Rule.SETTLED_IN_TIME);
            }
            if (!settled.mayBeSent() && !call.executed.isEmpty()) {
                broken.accept(Rule.NOT_SENT);
            }
            if (settled.answered() && call.executed.stream().noneMatch(each -> each.nanos() <= entry.nanos())) {
                broken.accept(Rule.ANSWERED);
            }
        }
    }

    /** How much longer than its limit the slowest call took, without the pauses of its caller; negative if none did. */
    static long worstMillisBeyondLimit(History history) {
        var rules = new CallRules(history, new Pauses(history), violation -> {});
        return rules.calls.values().stream()
                        .filter(call -> call.called != null && !call.settled.isEmpty())
                        .mapToLong(rules::nanosBeyondLimit)
                        .max()
                        .orElse(Long.MIN_VALUE)
                / 1_000_000;
    }

    private long nanosBeyondLimit(Call call) {
        Entry begin = Objects.requireNonNull(call.called);
        long nanos = pauses.runningNanos(
                begin.process(), begin.nanos(), call.settled.getFirst().nanos());
        return nanos - ((Called) begin.event()).limitMillis() * 1_000_000;
    }
}
