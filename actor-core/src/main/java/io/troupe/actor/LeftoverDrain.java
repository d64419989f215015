package io.troupe.actor;

import io.troupe.actor.promise.Node;
import io.troupe.actor.time.TimerWheel;
import java.util.ArrayList;
import java.util.List;

/** Rejects and counts what is left in the queues of a closed space. On the thread that acts for the space. */
final class LeftoverDrain {
    private final SpaceHome space;
    private final Dispatcher dispatcher;
    private final List<String> examples = new ArrayList<>();
    private int messages;
    private int requests;
    private int tasks;
    private int timers;

    LeftoverDrain(SpaceHome space, Dispatcher dispatcher) {
        this.space = space;
        this.dispatcher = dispatcher;
    }

    void dropTimers(TimerWheel wheel) {
        timers += space.timers().closeOutside();
        for (Runnable task : wheel.clear()) {
            timers++;
            if (task instanceof Expiry expiry) {
                space.runGuarded(expiry.ifClosed());
            }
        }
    }

    void dropIdleActions() {
        for (int count = dispatcher.takeIdleActions().size(); count > 0; count--) {
            tasks++;
            rejectTask();
        }
    }

    private void rejectTask() {
        space.reports().deadLetter(new DeadLetter(space.toString(), "a task", "space " + space + " is closed"));
    }

    /** Rejects entries until the queues are empty; rejecting one may queue others. */
    void rejectAll() {
        for (Node node = dispatcher.pollLeftover(); node != null; node = dispatcher.pollLeftover()) {
            try {
                reject(node);
            } catch (Throwable broken) { // for example no memory: the entries behind it are still rejected
                space.reports().error("turning away what waited in space", space, broken, null);
            }
        }
    }

    private void reject(Node node) {
        switch (node) {
            case Message ticket -> count(ticket.receiver().callOf(ticket));
            case Request<?> ticket -> count(ticket.receiver().callOf(ticket));
            case Entry entry -> {
                reject(entry);
                return;
            }
            default -> {}
        }
        dispatcher.serve(node); // its actor has stopped and rejects the call
    }

    private void count(Node call) {
        if (call instanceof Message message) {
            messages++;
            note(message + " to " + message.receiver());
        } else if (call instanceof Request<?> request && !request.isDone()) {
            requests++;
            note(request.toString());
        }
    }

    private void reject(Entry entry) {
        Runnable ifClosed = entry.ifClosed();
        if (SpaceHome.goesToMailbox(entry)) {
            tasks++;
        }
        if (ifClosed != null) {
            space.runGuarded(ifClosed);
        } else {
            rejectTask();
        }
    }

    private void note(String call) {
        if (examples.size() < Leftovers.EXAMPLES) {
            examples.add(call);
        }
    }

    Leftovers leftovers(int sequences) {
        space.closing.openExamples().forEach(this::note);
        return new Leftovers(messages, requests, space.closing.openRequests(), tasks, timers, sequences, examples);
    }
}
