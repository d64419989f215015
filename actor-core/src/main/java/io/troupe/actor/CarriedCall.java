package io.troupe.actor;

import io.troupe.actor.internal.loop.Node;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A call with the context of its caller: the entry of the queues, in spaces that carry contexts. */
final class CarriedCall extends Node {
    private final ActorCell cell;
    private final Node call;
    private final Supplier<Runnable> context;

    CarriedCall(ActorCell cell, Node call, Supplier<Runnable> context) {
        this.cell = cell;
        this.call = call;
        this.context = context;
    }

    /** The call behind an entry. */
    static Node callIn(Node entry) {
        return entry instanceof CarriedCall carried ? carried.call : entry;
    }

    ActorCell cell() {
        return cell;
    }

    /** Runs a turn in the context; throws nothing itself. */
    void run(Runnable turn) {
        Runnable end = context.get();
        try {
            turn.run();
        } finally {
            end.run();
        }
    }

    @Override
    protected @Nullable Node serve() {
        cell.deliverNext(this);
        return null;
    }

    @Override
    protected boolean isMessage() {
        return true;
    }

    @Override
    protected boolean carries(Node wanted) {
        return this == wanted || call == wanted;
    }
}
