package io.troupe.actor.testkit;

import io.troupe.actor.ActorContext;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.CallObserver;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * Finds actors that call each other in a ring while they wait: an actor is called while it serves a call that waits for
 * it. Nothing has to be declared.
 *
 * {@snippet :
 * var rings = new RingFinder();
 * try (var test = new TestSpace(rings)) {
 *     Account one = test.spawn(Account.class, CarefulAccount::new, ActorSettings.named("one"));
 *     Account two = test.spawn(Account.class, CarefulAccount::new, ActorSettings.named("two"));
 *     test.get(one.pay(two, 5));
 *     test.get(two.pay(one, 5));
 * }
 * rings.idle();
 * assertThatThrownBy(rings::check).hasMessageContaining("may come to wait for each other");
 * }
 *
 * <p>Which rings block: an actor takes other calls while the promise that it returned is pending, so most rings pass.
 * One blocks if an actor of it does not take the call, because it {@linkplain ActorContext#hold holds} its calls, or
 * does not answer it, because it waits for a private lock such as a {@code Mutex}. See {@link Kind}.
 *
 * <p>Requests are followed from their caller to the call that this one serves, also through listeners, sequential
 * bodies, suspend functions, connections to services and other observed spaces of this process; a one-way message, a
 * timer and a call on a bus end a chain.
 *
 * <p><b>Role.</b> For tests; also the observer of a running program. Spaces may share one.
 *
 * <p><b>Threads.</b> Any thread; one lock guards it.
 *
 * <p><b>Cost.</b> Memory for each open request and each ring.
 */
public final class RingFinder implements CallObserver {
    /** What was seen of a ring. */
    public enum Kind {
        /**
         * Its calls wait for each other, and nothing happens any more; or an actor of it held its calls back until
         * another one gave up, by a time limit or a cancellation.
         */
        BLOCKED,
        /**
         * Each actor of it was seen to hold its calls until the next one had answered. That was at different times, so
         * nothing has blocked yet. What an actor waits for is judged by the call that it serves: each call is counted
         * that it makes on behalf of that one while it holds its calls; if there is none, those that it has made
         * before.
         */
        POSSIBLE,
        /** The actor took the call, and answered it, while it served the one that waited for it. */
        PASSED
    }

    /**
     * An actor that waits.
     *
     * @param serves the method that it serves, or empty
     * @param asks what it waits for: {@code actor.method}
     * @param note in words, what is known besides; or empty
     */
    public record Wait(String actor, String serves, String asks, String note) {
        @Override
        public String toString() {
            return actor + (serves.isEmpty() ? "" : " serves " + serves + ", which") + " waits for " + asks + note;
        }
    }

    /**
     * A ring of calls.
     *
     * @param waits each for a call that the next one has got; the last one for a call that the first one has got
     */
    public record Ring(Kind kind, List<Wait> waits) {
        public Ring {
            waits = List.copyOf(waits);
        }

        /** The story: who waits for what. */
        @Override
        public String toString() {
            String actors = waits.stream().map(Wait::actor).distinct().collect(Collectors.joining(", "));
            String first = waits.getFirst().actor();
            String head = switch (kind) {
                case BLOCKED -> first + " is called while it waits for that call: a ring that blocks " + actors;
                case POSSIBLE -> actors + " may come to wait for each other: each holds its calls meanwhile";
                case PASSED -> first + " is called while it serves a call that waits for " + first + ", and answers";
            };
            return waits.stream().map(wait -> "\n  - " + wait).collect(Collectors.joining("", head, ""));
        }
    }

    /** A request that is not settled. */
    private static final class Open {
        final Party from;
        final Party to;
        final String method;
        final boolean isPassedOn;
        final long number;

        @Nullable
        Open cause; // the call that the caller serves; null as soon as this one is settled

        boolean begun;
        boolean over;

        Open(Party from, Party to, Call call, long number, @Nullable Open cause) {
            this.from = from;
            this.to = to;
            this.method = call.method();
            this.isPassedOn = call.isPassedOn();
            this.number = number;
            this.cause = cause;
        }

        String target() {
            return to + "." + method;
        }

        /** The call that an actor has made; this one, or that which a connection has passed on as this one. */
        Open made() {
            Open made = this;
            while (made.cause != null && made.cause.isPassedOn && made.cause.to.equals(made.from)) {
                made = made.cause;
            }
            return made;
        }

        Party caller() {
            return made().from;
        }
    }

    /** An actor holds its calls. */
    private static final class Hold {
        final @Nullable Open served; // by the actor, when it began to hold its calls
        final long number; // of the first call after that
        final Map<Held, Wait> before = new LinkedHashMap<>(); // calls from before, which were answered meanwhile
        boolean hasCalls; // made since, on behalf of the same call

        Hold(@Nullable Open served, long number) {
            this.served = served;
            this.number = number;
        }

        boolean isFor(Open call) {
            return call.cause == served;
        }
    }

    /** A call to an actor that serves another one, which waits for it. */
    private record Nested(List<Open> path) {
        Open outer() {
            return path.getFirst();
        }

        Open inner() {
            return path.getLast();
        }
    }

    /** One actor held its calls until the other one had answered. */
    private record Held(Party waiting, Party asked) {}

    private final Map<Call, Open> open = new LinkedHashMap<>(); // guarded by this, as is all that follows
    private final List<Nested> nested = new ArrayList<>();
    private final Map<Party, Hold> holding = new HashMap<>();
    private final Map<Held, Wait> held = new LinkedHashMap<>();
    private final Set<Ring> found = new LinkedHashSet<>();
    private long calls;

    /** Creates one that has seen nothing. */
    public RingFinder() {}

    // ---- called by the spaces

    @Override
    public void called(Party from, Party to, Call call) {
        if (!call.isRequest()) {
            return;
        }
        synchronized (this) {
            var made = new Open(from, to, call, calls++, served());
            open.put(call, made);
            Hold hold = holding.get(from);
            if (hold != null && hold.isFor(made)) {
                hold.hasCalls = true;
            }
            if (!made.isPassedOn) {
                noteNested(made);
            }
        }
        call.whenSettled(error -> settled(call, error));
    }

    private @Nullable Open served() {
        Call served = CallObserver.servedCall();
        return served == null ? null : open.get(served);
    }

    private void noteNested(Open inner) {
        var path = new ArrayList<>(List.of(inner));
        for (Open outer = inner.cause; outer != null && !outer.over; outer = outer.cause) {
            if (!outer.isPassedOn) {
                path.addFirst(outer);
                if (outer.to.equals(inner.to)) {
                    nested.add(new Nested(List.copyOf(path)));
                    return;
                }
            }
        }
    }

    @Override
    public synchronized void begun(Party actor, Call call) {
        Open begun = open.get(call);
        if (begun != null) {
            begun.begun = true;
        }
    }

    @Override
    public synchronized void held(Party actor) {
        holding.put(actor, new Hold(served(), calls));
    }

    @Override
    public synchronized void released(Party actor) {
        Hold hold = holding.remove(actor);
        if (hold != null && !hold.hasCalls) {
            hold.before.forEach(held::putIfAbsent);
        }
    }

    private synchronized void settled(Call call, @Nullable Throwable error) {
        Open over = open.get(call);
        if (over == null) {
            return;
        }
        if (error instanceof ActorStoppedException) { // its space is closed, perhaps because nothing happens any more
            search(over, new ArrayList<>(), new HashSet<>(), true);
        }
        open.remove(call);
        over.over = true;
        if (!over.isPassedOn && over.begun) {
            noteHeld(over);
        }
        boolean isGivenUp = error instanceof TimeoutException || error instanceof CancellationException;
        nested.removeIf(each -> {
            if (each.path().contains(over)) {
                noteEnd(each, over, isGivenUp);
                return true;
            }
            return false;
        });
        over.cause = null;
    }

    /** Notes that a caller has got its answer while it holds its calls. */
    private void noteHeld(Open over) {
        Open made = over.made();
        Hold hold = holding.get(made.from);
        if (hold != null && hold.isFor(made)) {
            (made.number < hold.number ? hold.before : held)
                    .putIfAbsent(
                            new Held(made.from, over.to), wait(made.from, over, ", and holds its calls meanwhile"));
        }
    }

    private void noteEnd(Nested ring, Open over, boolean isGivenUp) {
        Open inner = ring.inner();
        if (isGivenUp && !inner.begun && holding.containsKey(inner.to)) {
            note(Kind.BLOCKED, ring.path());
        } else if (!isGivenUp && over == inner && over.begun) {
            note(Kind.PASSED, ring.path());
        } // else the outer call did not wait for the inner one, or a caller has not waited to the end
    }

    private void note(Kind kind, List<Open> path) {
        var waits = new ArrayList<Wait>();
        for (int index = 1; index < path.size(); index++) {
            waits.add(wait(path.get(index - 1).to, path.get(index), ""));
        }
        found.add(new Ring(kind, waits));
    }

    private static Wait wait(Party actor, Open asked, String note) {
        Open served = asked.cause;
        while (served != null && served.isPassedOn) {
            served = served.cause;
        }
        return new Wait(actor.toString(), served == null ? "" : served.method, asked.target(), note);
    }

    // ---- asked by the test

    /** Nothing happens any more until something comes from outside: rings of open calls block from now on. */
    public synchronized void idle() {
        var done = new HashSet<Open>();
        for (Open start : List.copyOf(open.values())) {
            search(start, new ArrayList<>(), done, false);
        }
    }

    /** @param isSure leaves out what is true of calls only if nothing happens any more */
    private void search(Open call, List<Open> path, Set<Open> done, boolean isSure) {
        int at = path.indexOf(call);
        if (at >= 0) {
            noteBlocked(List.copyOf(path.subList(at, path.size())));
        } else if (done.add(call)) {
            path.add(call);
            waitsOf(call, isSure).forEach(next -> search(next, path, done, isSure));
            path.removeLast();
        }
    }

    /** The open calls that are settled before this one is. */
    private List<Open> waitsOf(Open call, boolean isSure) {
        if (!call.begun) {
            return holding.containsKey(call.to) ? callsOf(open.values(), call.to) : List.of();
        }
        var own = open.values().stream().filter(made -> made.cause == call).toList();
        return own.isEmpty() && !isSure ? callsOf(earlier(call), call.to) : own;
    }

    /** What was called on behalf of calls that the same actor has got before; they may have a lock. */
    private List<Open> earlier(Open call) {
        return open.values().stream()
                .filter(made -> made.cause != null
                        && made.cause != call
                        && made.cause.to.equals(call.to)
                        && made.cause.number < call.number)
                .toList();
    }

    private static List<Open> callsOf(Collection<Open> calls, Party actor) {
        return calls.stream().filter(made -> made.from.equals(actor)).toList();
    }

    private void noteBlocked(List<Open> ring) {
        int first = 0; // begins with the oldest call that waits: the ring is found once, wherever the search began
        for (int index = 1; index < ring.size(); index++) {
            first = ring.get(index).number < ring.get(first).number ? index : first;
        }
        var waits = new ArrayList<Wait>();
        for (int index = 0; index < ring.size(); index++) {
            Open asked = ring.get((first + index) % ring.size());
            Open next = ring.get((first + index + 1) % ring.size());
            if (!asked.isPassedOn) {
                waits.add(wait(asked.caller(), asked, whyNot(asked, next)));
            }
        }
        found.add(new Ring(Kind.BLOCKED, waits));
    }

    private static String whyNot(Open asked, Open next) {
        if (!asked.begun) {
            return ", which that has not begun: it holds its calls";
        }
        return next.cause == asked ? "" : ", which that has begun and does not answer";
    }

    /** The rings that were seen so far, each once. */
    public synchronized List<Ring> rings() {
        var all = new LinkedHashSet<>(found);
        var blocked = found.stream()
                .filter(ring -> ring.kind() == Kind.BLOCKED)
                .map(RingFinder::actors)
                .collect(Collectors.toSet());
        for (Held start : held.keySet()) {
            possible(start, new ArrayList<>(), all, blocked);
        }
        return List.copyOf(all);
    }

    private void possible(Held next, List<Held> path, Set<Ring> all, Set<Set<String>> blocked) {
        path.add(next);
        if (next.asked().equals(path.getFirst().waiting())) {
            var ring = new Ring(
                    Kind.POSSIBLE,
                    path.stream()
                            .map(each -> Objects.requireNonNull(held.get(each)))
                            .toList());
            boolean isKnown = blocked.contains(actors(ring))
                    || all.stream()
                            .anyMatch(each ->
                                    each.kind() == Kind.POSSIBLE && actors(each).equals(actors(ring)));
            if (!isKnown) {
                all.add(ring);
            }
        } else if (path.stream()
                .limit(path.size() - 1L)
                .noneMatch(each -> each.waiting().equals(next.asked()))) {
            held.keySet().stream()
                    .filter(each -> each.waiting().equals(next.asked()))
                    .forEach(each -> possible(each, path, all, blocked));
        }
        path.removeLast();
    }

    private static Set<String> actors(Ring ring) {
        return ring.waits().stream().map(Wait::actor).collect(Collectors.toSet());
    }

    /** @throws AssertionError if a ring blocks, or is possible; the message has its story */
    public void check() {
        var wrong = rings().stream().filter(ring -> ring.kind() != Kind.PASSED).toList();
        if (!wrong.isEmpty()) {
            throw new AssertionError(wrong.stream().map(Ring::toString).collect(Collectors.joining("\n")));
        }
    }
}
