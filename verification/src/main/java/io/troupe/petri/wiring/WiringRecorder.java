package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Callback;
import io.troupe.petri.wiring.RecordedProtocols.Fact;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;

/**
 * Writes a wiring from runs of a program: the protocols of its actors, as they were seen to call each other.
 *
 * {@snippet :
 * var recorder = new WiringRecorder("test");
 * try (var test = new TestSpace(recorder)) {
 *     run(test);
 * }
 * assertThat(recorder.problems()).isEmpty();
 * assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(Proved.class);
 * }
 *
 * <p>A state of an actor is what it has under way: the calls that it has accepted, with the last thing that each of
 * them did, and the questions that are open. So the wiring allows the calls of the runs in each order in which the
 * states were seen to follow each other. In every state in which an actor was not seen to hold its calls, it takes
 * those that it answered at once wherever it was asked, because actors do so. What no run has shown is not allowed: it
 * is a draft, to be read and corrected.
 *
 * <p>A call that its caller cancels, or a time limit of its {@code ask}, is recorded as {@code cancels}, also if the
 * other actor has begun it, which then answers it. {@code Promise.orTimeout} settles no request that has begun: what
 * its caller does after it is recorded as done while the question is open.
 *
 * <p>Actors that call no other actor, and that no other calls, are left out. A call from outside is a private step. A
 * mailbox is as large as was needed.
 *
 * <p><b>Role.</b> An observer of spaces, like {@link WiringObserver}, with the same names and the same translation;
 * needs {@code troupe-actor-core}. A component is of the type of its actor if all calls of it are methods of that type.
 *
 * <p><b>Threads.</b> Any thread; spaces may share one.
 *
 * <p><b>Cost.</b> Memory for each call.
 *
 * <p><b>Errors.</b> What a protocol cannot express, or what looks like a mistake of the program, is in
 * {@link #problems}.
 */
public final class WiringRecorder implements CallObserver {
    private final String name;
    private final WiringObserver.@Nullable Translation translation;
    private final List<List<Fact>> runs =
            new ArrayList<>(List.of(new ArrayList<>())); // guarded by this, as is the rest
    private final Map<String, Optional<Class<?>>> types =
            new HashMap<>(); // empty for one that is not that of all calls
    private final Set<String> streams = new LinkedHashSet<>();
    private final Map<Call, Asked> open = new HashMap<>();
    private final Set<String> ended = new HashSet<>(); // with calls that were not answered
    private ActorNames names = new ActorNames(name -> false);
    private int calls;

    /** A call that was made, or one that a connection has yet to pass on. */
    private record Asked(int number, boolean isAnsweredAtOnce, String callee, int servedBy, boolean isBegun) {
        Asked begun() {
            return new Asked(number, isAnsweredAtOnce, callee, servedBy, true);
        }
    }

    /** @param name of the wiring */
    public WiringRecorder(String name) {
        this.name = requireNonNull(name, "name");
        this.translation = null;
    }

    /** @param translation finds the components and the calls, in place of the names of actors and methods */
    public WiringRecorder(String name, WiringObserver.Translation translation) {
        this.name = requireNonNull(name, "name");
        this.translation = requireNonNull(translation, "translation");
    }

    /** What follows is another run: all components begin again. */
    public synchronized void newRun() {
        if (!runs.getLast().isEmpty()) {
            runs.add(new ArrayList<>());
        }
        open.clear();
        ended.clear();
        names = new ActorNames(each -> false);
    }

    // ---- called by the spaces

    @Override
    public void called(Party from, Party to, Call call) {
        var followed = translation == null ? Optional.<WiringObserver.Followed>empty() : translation.of(from, to, call);
        synchronized (this) {
            var served = Optional.ofNullable(CallObserver.servedCall()).map(open::get);
            if (translation == null) {
                if (call.isPassedOn()) {
                    names.passing(from, call);
                    open.put(
                            call,
                            new Asked(-1, false, "", served.map(this::served).orElse(-1), false));
                    return;
                }
                if (!ActorNames.isOfTheBroker(call)) {
                    Party caller = names.caller(from);
                    followed = Optional.of(WiringObserver.Followed.of(
                            ActorNames.isActor(caller) ? names.of(caller) : "", names.of(to) + "." + call.method()));
                }
            }
            followed.ifPresent(
                    each -> asked(each, call, served.map(this::served).orElse(-1)));
        }
        if (call.isRequest()) {
            call.whenSettled(error -> settled(call, error));
        }
    }

    /** The number of the call that is served: of a connection, that of its caller. */
    private int served(Asked served) {
        return served.number() < 0 ? served.servedBy() : served.number();
    }

    private void asked(WiringObserver.Followed followed, Call call, int served) {
        String callee = followed.target().substring(0, followed.target().indexOf('.'));
        String method = followed.target().substring(followed.target().indexOf('.') + 1);
        types.merge(
                callee,
                method.equals(call.method()) ? Optional.of(call.type()) : Optional.empty(),
                (all, each) -> all.equals(each) ? all : Optional.empty());
        if (call.arguments().stream().anyMatch(Callback.class::isInstance)) {
            streams.add(followed.target());
        }
        int number = calls++;
        open.put(call, new Asked(number, followed.isAnsweredAtOnce(), callee, served, false));
        add(new Fact.Called(number, followed.caller(), callee, method, call.isRequest(), served));
    }

    private void add(Fact fact) {
        runs.getLast().add(fact);
    }

    @Override
    public synchronized void begun(Party actor, Call call) {
        names.begun(call);
        Asked asked = open.get(call);
        if (asked != null && asked.number() >= 0) {
            open.put(call, asked.begun());
            add(new Fact.Begun(asked.number()));
            if (asked.isAnsweredAtOnce()) {
                add(new Fact.Settled(asked.number(), false));
            }
        }
    }

    @Override
    public synchronized void dropped(Party actor, Call call) {
        names.dropped(call);
    }

    private synchronized void settled(Call call, @Nullable Throwable error) {
        Asked asked = open.get(call);
        if (asked == null || asked.number() < 0 || asked.isAnsweredAtOnce() && asked.isBegun()) {
            return;
        }
        if (error instanceof ActorStoppedException) { // the end of a run is not part of the wiring
            ended.add(asked.callee());
        } else {
            add(new Fact.Settled(
                    asked.number(), error instanceof CancellationException || error instanceof TimeoutException));
        }
    }

    @Override
    public synchronized void held(Party actor) {
        add(new Fact.Held(names.of(actor), true));
    }

    @Override
    public synchronized void released(Party actor) {
        if (!ended.remove(names.of(actor))) {
            add(new Fact.Held(names.of(actor), false));
        }
    }

    // ---- the result

    private synchronized RecordedProtocols recording() {
        var known = new HashMap<String, Class<?>>();
        types.forEach((component, all) -> all.ifPresent(type -> known.put(component, type)));
        return new RecordedProtocols(name, runs.stream().map(List::copyOf).toList(), known, Set.copyOf(streams));
    }

    /** The recorded wiring. */
    public Wiring wiring() {
        return recording().wiring();
    }

    /** What the wiring does not express, or what looks wrong: a call that was never answered. */
    public List<String> problems() {
        return recording().problems();
    }

    /** A Java source file with the method {@code static Wiring wiring()}. */
    public String java(String packageName, String className) {
        return RecordedSource.java(recording(), packageName, className);
    }

    /** A Kotlin source file with the function {@code fun wiring(): Wiring} of an object. */
    public String kotlin(String packageName, String objectName) {
        return RecordedSource.kotlin(recording(), packageName, objectName);
    }
}
