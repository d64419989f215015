package io.troupe.petri.wiring;

import io.troupe.actor.CallGraph;
import io.troupe.actor.CallObserver;
import io.troupe.actor.CallObserver.Call;
import io.troupe.actor.CallObserver.Party;
import java.util.HashMap;
import java.util.Map;
import java.util.WeakHashMap;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/**
 * The names of actors as components: that of their settings (of an actor that was published: the service), or that of
 * their type with a small letter. A second actor of a name gets a 2 after it, and so on in the order in which they are
 * seen; where {@code name1} is a component and {@code name} is none, the first one gets a 1.
 *
 * <p>A connection to a service is no component: what it passes on is a call of the actor that has called it.
 *
 * <p><b>Threads.</b> Not thread-safe.
 */
final class ActorNames {
    private final Predicate<String> isComponent;
    private final Map<Party, String> names = new HashMap<>();
    private final Map<String, Integer> counts = new HashMap<>();
    private final Map<Call, Party> queued = new HashMap<>(); // the callers of calls to connections
    private final Map<Call, Party> passing =
            new WeakHashMap<>(); // of begun ones: as long as the connection may pass them on

    ActorNames(Predicate<String> isComponent) {
        this.isComponent = isComponent;
    }

    static boolean isActor(Party party) {
        return !party.name().equals(CallGraph.OUTSIDE) && !party.name().equals(CallGraph.TASKS);
    }

    /** Whether a call is one of the broker's, which are no part of a program. */
    static boolean isOfTheBroker(Call call) {
        return call.type().getPackageName().equals("io.troupe.broker");
    }

    /** The name of an actor. */
    String of(Party actor) {
        return names.computeIfAbsent(actor, this::newName);
    }

    private String newName(Party actor) {
        String name = actor.number() == 0
                ? actor.name().substring(actor.name().lastIndexOf('/') + 1).replaceAll("[^\\p{L}\\p{N}_-]+", "-")
                : Character.toLowerCase(actor.name().charAt(0)) + actor.name().substring(1);
        int count = counts.merge(name, 1, Integer::sum);
        return count == 1 && (isComponent.test(name) || !isComponent.test(name + "1")) ? name : name + count;
    }

    /** Notes a call to a connection. */
    void passing(Party from, Call call) {
        queued.put(call, caller(from));
    }

    /** A connection may have begun a call; this object of it is the {@linkplain CallObserver#servedCall served} one. */
    void begun(Call call) {
        Party caller = queued.remove(call);
        if (caller != null) {
            passing.put(call, caller);
        }
    }

    /** A call does not begin. */
    void dropped(Call call) {
        queued.remove(call);
    }

    /** Who makes the call that is made now, in truth: if a connection does, it is the actor whose call this is. */
    Party caller(Party from) {
        @Nullable Call served = CallObserver.servedCall();
        return served == null || !served.isPassedOn() ? from : passing.getOrDefault(served, from);
    }

    /** How many calls to connections are noted. */
    int notes() {
        return queued.size() + passing.size();
    }
}
