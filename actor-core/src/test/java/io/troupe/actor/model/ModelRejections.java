package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.List;

/** Rejections without a listener. One whose caller is outside is kept for a second before it is reported. */
final class ModelRejections {
    private static final int GRACE_TICKS = 2_000;

    private final ModelSpace space;
    private final List<ModelPromise> lost = new ArrayList<>();
    private final List<ModelPromise> held = new ArrayList<>();

    ModelRejections(ModelSpace space) {
        this.space = space;
    }

    void rejected(ModelPromise promise) {
        if (space.closed
                && (promise.madeOutside || String.valueOf(promise.outcome()).contains("ActorStopped"))) {
            return;
        }
        if (space.inside && space.stopping && String.valueOf(promise.outcome()).contains("ActorStopped")) {
            return;
        }
        if (!space.inside) {
            space.enqueue(ModelTask.entry(() -> rejected(promise), () -> rejected(promise)));
        } else if (promise.madeOutside) {
            held.add(promise);
            space.timers.set(
                    GRACE_TICKS,
                    0,
                    () -> {
                        held.remove(promise);
                        lost.add(promise);
                    },
                    () -> {});
        } else {
            lost.add(promise);
        }
    }

    void report() {
        var now = List.copyOf(lost);
        lost.clear();
        for (var promise : now) {
            if (!promise.isHandled()) {
                space.history.add("unheard " + String.valueOf(promise.outcome()).substring(1));
            }
        }
    }

    void reportAll() {
        lost.addAll(held);
        held.clear();
        report();
    }
}
