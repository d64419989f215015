package io.troupe.services.bus;

import io.troupe.actor.promise.Promise;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** The request handler that a port registered for one operation, with the queue of its requests. */
final class Answering<Q extends Record, A extends Record> extends Inlet {
    /** Identifies a request: its sender and its sequence number. */
    private record Asked(Address by, long number) {
        static Asked of(Message question) {
            return new Asked(question.from(), question.sequence());
        }
    }

    final Operation<Q, A> operation;
    private final Function<? super Q, ? extends Promise<A>> answerer;
    // guarded by itself: requests without a reply yet, at most capacity
    private final Map<Asked, Message> begun = new LinkedHashMap<>();

    Answering(Port port, Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        super(port, port.address() + " answers " + operation.name());
        this.operation = operation;
        this.answerer = answerer;
    }

    @Override
    void handle(Message question) {
        if (!begin(question)) {
            refuseBusy(question, "are being answered");
            return;
        }
        String over = whyEnded();
        if (over != null) {
            refuseBegun(over);
            return;
        }
        Promise<A> answer;
        try {
            answer = answerer.apply(operation.question().cast(question.payload()));
            if (answer == null) {
                throw new NullPointerException("the answerer returned null, expected a promise");
            }
        } catch (Throwable thrown) {
            settle(question, null, thrown);
            return;
        }
        answer.toCompletableFuture() // notifies at once, on any thread, even if the actor has stopped
                .whenComplete((value, error) -> settle(question, value, error));
    }

    /**
     * Records a request as begun. Returns false if the limit is reached. A request whose requester has cancelled is
     * handled, but not recorded.
     */
    private boolean begin(Message question) {
        Message evicted = null;
        synchronized (begun) {
            if (begun.size() >= node.settings.capacity() && node.isAwaited(question)) {
                evicted = oldestOfAnotherNode();
                if (evicted == null) {
                    return false;
                }
                begun.remove(Asked.of(evicted));
            }
            begun.put(Asked.of(question), question);
        }
        if (evicted != null) {
            refuseBusy(evicted, "are being answered");
        }
        // checked after recording: either this thread or the cancelling one sees the other's change
        if (!node.isAwaited(question)) {
            forget(question);
        }
        return true;
    }

    /**
     * The oldest begun request from another node. Its requester may have cancelled, which is not known on this node.
     */
    private @Nullable Message oldestOfAnotherNode() {
        return begun.values().stream().filter(node::isFromAnother).findFirst().orElse(null);
    }

    private void settle(Message question, @Nullable A value, @Nullable Throwable error) {
        boolean first;
        synchronized (begun) {
            first = begun.remove(Asked.of(question)) != null;
        }
        Message reply = replyTo(question, value, error);
        if (first) {
            node.route(reply);
        } else {
            String ended = whyEnded();
            node.telling.late(
                    reply,
                    ended == null ? "nobody waits for it any more" : port.address() + " had left before: " + ended);
        }
    }

    /** The requester has cancelled: its reply is no longer awaited. */
    void forget(Message question) {
        synchronized (begun) {
            begun.remove(Asked.of(question));
        }
    }

    private Message replyTo(Message question, @Nullable A value, @Nullable Throwable error) {
        if (error == null && value == null) {
            return failed(
                    question,
                    new NullPointerException("the answer is null, expected a "
                            + operation.answer().getName()));
        }
        if (error == null) {
            try {
                return node.answer(port.address(), question, operation.answer().cast(node.detached(value)));
            } catch (RuntimeException | Error unfit) {
                return failed(question, unfit);
            }
        }
        return failed(question, error);
    }

    private Message failed(Message question, Throwable error) {
        node.telling.answererFailed(question, error);
        return node.refusal(
                port.address(),
                question,
                new Message.Failure.Failed(error.getClass().getName(), messageOf(error)));
    }

    private static String messageOf(Throwable error) {
        try {
            String message = error.getMessage();
            return message == null ? "(no message)" : message;
        } catch (RuntimeException | Error broken) { // an exception class of the request handler
            return "(its message could not be read: " + broken.getClass().getName() + ")";
        }
    }

    @Override
    boolean dropsOldest() {
        return false;
    }

    @Override
    void overflow(Message question) {
        refuseBusy(question, "wait there");
    }

    private void refuseBusy(Message question, String how) {
        node.refuse(
                port.address(),
                question,
                "is too busy: " + node.settings.capacity() + " questions for " + operation.name() + " " + how);
    }

    @Override
    void leftOver(List<Message> rest, String why) {
        rest.forEach(question -> node.refuse(port.address(), question, "left before it answered: " + why));
        refuseBegun(why);
    }

    private void refuseBegun(String why) {
        List<Message> open;
        synchronized (begun) {
            open = List.copyOf(begun.values());
            begun.clear();
        }
        open.forEach(question -> node.refuse(port.address(), question, "left before it answered: " + why));
    }
}
