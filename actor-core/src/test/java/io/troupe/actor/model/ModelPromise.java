package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** A promise of the model: an outcome, as text, and a list of listeners. */
final class ModelPromise {
    /**
     * A listener, which needs the outcome until its own result is settled.
     *
     * @param hasTurn true if it runs in a separate turn, false if it runs on the thread that settles its source
     * @param tell notifies it; if the argument is true, behind the listeners that were notified from outside
     */
    record Listener(ModelPromise result, boolean hasTurn, Consumer<Boolean> tell) {
        boolean isAtHome() {
            return hasTurn && result.atHome;
        }
    }

    private final ModelSpace space;
    private final boolean local;
    final boolean atHome;
    final boolean madeOutside;
    boolean tellsOnlyListener; // of a request that has just been answered
    final boolean isRequest;
    private final List<Listener> listeners = new ArrayList<>();

    @Nullable
    String outcome;

    boolean heard;
    private boolean telling;
    private boolean fromAfar;
    private int onTheirWay;
    private boolean expired; // settled because its time limit was over
    private boolean givenUp; // a time limit of it has passed

    private ModelPromise(ModelSpace space, boolean atHome, boolean local, boolean isRequest) {
        this.space = space;
        this.isRequest = isRequest;
        this.atHome = atHome;
        this.local = local;
        this.madeOutside = atHome && !space.inside;
    }

    /** A promise that may be settled on any thread; {@code atHome} is true if it belongs to the space. */
    static ModelPromise shared(ModelSpace space, boolean atHome) {
        return new ModelPromise(space, atHome, false, false);
    }

    /** A promise that changes only in the space, if it is created there. */
    static ModelPromise local(ModelSpace space, boolean atHome) {
        return new ModelPromise(space, atHome, space.inside, false);
    }

    static ModelPromise request(ModelSpace space) {
        return new ModelPromise(space, true, space.inside, true);
    }

    boolean isDone() {
        return outcome != null;
    }

    static boolean isError(String outcome) {
        return outcome.startsWith("!");
    }

    /**
     * Settles it. From outside, a local promise is settled when the space processes that, and the result is true if it
     * was pending.
     */
    boolean settle(String end) {
        if (outcome != null) {
            return false;
        }
        if (local && !space.inside) {
            space.enqueue(ModelSpace.Task.callback(() -> settle(end)));
            return true;
        }
        outcome = end;
        heard = listeners.stream().anyMatch(each -> !each.result.expired);
        boolean reports = listeners.isEmpty() || !end.equals("!ActorStoppedException");
        if (!heard && atHome && isError(end) && !end.equals("!CancellationException") && reports) {
            space.rejected(this);
        }
        tellAll();
        return true;
    }

    /** Settles it because its time limit is over, unless the source was settled before. */
    void expire(String end, ModelPromise source) {
        expired = outcome == null;
        if (expired) {
            settle(end);
            source.givenUp = true;
        }
    }

    /** A request, which has not begun: rejects it if the time limits of all its listeners have passed. */
    boolean isShed() {
        boolean shed = givenUp && !listeners.isEmpty() && listeners.stream().allMatch(each -> each.result.isDone());
        return shed && settle("!CancellationException");
    }

    /** Listeners registered while others are being notified from outside are notified after them. */
    private void tellAll() {
        fromAfar = !space.inside && listeners.stream().anyMatch(Listener::isAtHome);
        telling = fromAfar;
        do {
            var told = List.copyOf(listeners);
            listeners.clear();
            onTheirWay += (int) told.stream().filter(Listener::hasTurn).count();
            tellsOnlyListener = isRequest && told.size() == 1;
            told.forEach(each -> each.tell.accept(false));
            tellsOnlyListener = false;
        } while (!listeners.isEmpty());
        telling = false;
    }

    void register(Listener listener) {
        if (local && !space.inside) {
            space.enqueue(ModelSpace.Task.callback(() -> registerHere(listener)));
        } else {
            registerHere(listener);
        }
    }

    private void registerHere(Listener listener) {
        heard = true;
        if (isDone() && !telling) {
            tellLate(listener);
            return;
        }
        while (!isDone() && !listeners.isEmpty() && listeners.getLast().result.isDone()) {
            listeners.removeLast();
        }
        listeners.add(listener);
    }

    /** Listeners notified from outside may still be in the inbox: a late listener must not overtake them. */
    private void tellLate(Listener listener) {
        boolean behind = fromAfar && onTheirWay > 0;
        if (listener.hasTurn) {
            onTheirWay++;
        }
        listener.tell.accept(behind);
    }

    /** A listener begins its turn. */
    void arrived() {
        onTheirWay--;
    }

    void follow(ModelPromise other) {
        if (other == this) {
            settle("!IllegalStateException");
        } else if (other.isDone()) {
            other.heard = true;
            settle(String.valueOf(other.outcome));
        } else {
            other.register(new Listener(this, false, behind -> settle(String.valueOf(other.outcome))));
        }
    }
}
