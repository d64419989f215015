package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A promise of the model: an outcome, as text, and a list of those who wait for it. */
final class ModelPromise {
    private final ModelSpace space;
    final boolean atHome;
    final boolean madeOutside;
    final boolean byHand;
    private final List<Runnable> listeners = new ArrayList<>();
    private @Nullable String outcome;
    private boolean heard;

    /** @param atHome whether it belongs to the space at all */
    ModelPromise(ModelSpace space, boolean atHome, boolean byHand) {
        this.space = space;
        this.atHome = atHome;
        this.madeOutside = atHome && !space.inside;
        this.byHand = byHand;
    }

    static ModelPromise settled(ModelSpace space, String outcome) {
        var promise = new ModelPromise(space, space.inside, false);
        promise.settle(outcome);
        return promise;
    }

    @Nullable
    String outcome() {
        return outcome;
    }

    boolean isDone() {
        return outcome != null;
    }

    boolean isHeard() {
        return heard;
    }

    static boolean isError(String outcome) {
        return outcome.startsWith("!");
    }

    boolean settle(String end) {
        if (outcome != null) {
            return false;
        }
        outcome = end;
        if (listeners.isEmpty() && atHome && isError(end) && !end.equals("!CancellationException")) {
            space.rejections.rejected(this);
        }
        var told = List.copyOf(listeners);
        listeners.clear();
        told.forEach(Runnable::run);
        return true;
    }

    void whenDone(Runnable listener) {
        heard = true;
        if (isDone()) {
            listener.run();
        } else {
            listeners.add(listener);
        }
    }

    void follow(ModelPromise other) {
        other.whenDone(() -> settle(String.valueOf(other.outcome)));
    }
}
