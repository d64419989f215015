package io.troupe.bus;

import io.troupe.actor.promise.Promise;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** The request handler that a port registered for one operation, with the queue of its requests. */
final class OperationHandler<Q extends Record, A extends Record> extends InboundQueue {
    /** Identifies a request: its sender and its sequence number. */
    private record RequestId(Address by, long number) {
        static RequestId of(BusMessage request) {
            return new RequestId(request.from(), request.sequence());
        }
    }

    final Operation<Q, A> operation;
    private final Function<? super Q, ? extends Promise<A>> handler;
    // guarded by itself: requests without a reply yet, at most capacity
    private final Map<RequestId, BusMessage> begun = new LinkedHashMap<>();

    OperationHandler(BusPort port, Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> handler) {
        super(port, port.address() + " answers " + operation.name());
        this.operation = operation;
        this.handler = handler;
    }

    @Override
    void handle(BusMessage request) {
        if (!begin(request)) {
            rejectBusy(request, "are being answered");
            return;
        }
        String over = whyEnded();
        if (over != null) {
            rejectBegun(over);
            return;
        }
        Promise<A> answer;
        try {
            answer = handler.apply(operation.request().cast(request.payload()));
            if (answer == null) {
                throw new NullPointerException("the answerer returned null, expected a promise");
            }
        } catch (Throwable thrown) {
            settle(request, null, thrown);
            return;
        }
        answer.toCompletableFuture() // notifies at once, on any thread, even if the actor has stopped
                .whenComplete((value, error) -> settle(request, value, error));
    }

    /**
     * Records a request as begun. Returns false if the limit is reached. A request whose requester has cancelled is
     * handled, but not recorded.
     */
    private boolean begin(BusMessage request) {
        BusMessage evicted = null;
        synchronized (begun) {
            if (begun.size() >= node.settings.capacity() && node.isAwaited(request)) {
                evicted = oldestFromAnotherNode();
                if (evicted == null) {
                    return false;
                }
                begun.remove(RequestId.of(evicted));
            }
            begun.put(RequestId.of(request), request);
        }
        if (evicted != null) {
            rejectBusy(evicted, "are being answered");
        }
        // checked after recording: either this thread or the cancelling one sees the other's change
        if (!node.isAwaited(request)) {
            forget(request);
        }
        return true;
    }

    /**
     * The oldest begun request from another node. Its requester may have cancelled, which is not known on this node.
     */
    private @Nullable BusMessage oldestFromAnotherNode() {
        return begun.values().stream().filter(node::isFromAnother).findFirst().orElse(null);
    }

    private void settle(BusMessage request, @Nullable A value, @Nullable Throwable error) {
        boolean first;
        synchronized (begun) {
            first = begun.remove(RequestId.of(request)) != null;
        }
        BusMessage reply = replyTo(request, value, error);
        if (first) {
            node.route(reply);
        } else {
            String ended = whyEnded();
            node.notifier.late(
                    reply,
                    ended == null ? "nobody waits for it any more" : port.address() + " had left before: " + ended);
        }
    }

    /** The requester has cancelled: its reply is no longer awaited. */
    void forget(BusMessage request) {
        synchronized (begun) {
            begun.remove(RequestId.of(request));
        }
    }

    private BusMessage replyTo(BusMessage request, @Nullable A value, @Nullable Throwable error) {
        if (error == null && value == null) {
            return failed(
                    request,
                    new NullPointerException("the answer is null, expected a "
                            + operation.reply().getName()));
        }
        if (error == null) {
            try {
                return node.reply(port.address(), request, operation.reply().cast(node.copy(value)));
            } catch (RuntimeException | Error unfit) {
                return failed(request, unfit);
            }
        }
        return failed(request, error);
    }

    private BusMessage failed(BusMessage request, Throwable error) {
        node.notifier.handlerFailed(request, error);
        return node.rejection(
                port.address(),
                request,
                new BusMessage.Failure.Failed(error.getClass().getName(), messageOf(error)));
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
    void overflow(BusMessage request) {
        rejectBusy(request, "wait there");
    }

    private void rejectBusy(BusMessage request, String how) {
        node.reject(
                port.address(),
                request,
                "is too busy: " + node.settings.capacity() + " questions for " + operation.name() + " " + how);
    }

    @Override
    void discard(List<BusMessage> rest, String why) {
        rest.forEach(request -> node.reject(port.address(), request, "left before it answered: " + why));
        rejectBegun(why);
    }

    private void rejectBegun(String why) {
        List<BusMessage> open;
        synchronized (begun) {
            open = List.copyOf(begun.values());
            begun.clear();
        }
        open.forEach(request -> node.reject(port.address(), request, "left before it answered: " + why));
    }
}
