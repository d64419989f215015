package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.LibraryAccess;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.BoundedQueue;
import io.troupe.bus.internal.BoundedText;
import io.troupe.bus.internal.NotBegunException;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CancellationException;
import java.util.function.Function;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** The request handler that a port registered for one operation, with the queue of its requests. */
final class OperationHandler<Q extends Record, A extends Record> extends InboundQueue {
    final Operation<Q, A> operation;
    private final Function<? super Q, ? extends Promise<A>> handler;
    // guarded by itself: requests that were taken from the queue and have no reply yet
    private final Map<MessageDelivery.RequestId, Begun> begun = new LinkedHashMap<>();

    /** A request that was taken from the queue, and the answer that is cancelled with it, if there is one. */
    private static final class Begun {
        final MessageDelivery request;

        @Nullable
        Promise<?> answer;

        Begun(MessageDelivery request) {
            this.request = request;
        }

        void cancel() {
            if (answer != null) {
                answer.cancel();
            }
        }
    }

    OperationHandler(BusPort port, Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> handler) {
        super(port, BoundedQueue.rejecting(port.node.settings.capacity()));
        this.operation = operation;
        this.handler = handler;
    }

    /** Recorded under the lock of the queue, so that a cancellation finds each request either waiting or begun. */
    @Override
    void taken(MessageDelivery delivery) {
        if (!isNotice(delivery)) {
            synchronized (begun) {
                begun.put(delivery.id(), new Begun(delivery));
            }
        }
    }

    private static boolean isNotice(MessageDelivery delivery) {
        return delivery.message().purpose() instanceof BusMessage.Purpose.Notice;
    }

    @Override
    void handle(MessageDelivery request) {
        if (request.isOverdue(node.nanos())) {
            forget(request.id());
            node.reject(
                    port.address(),
                    request,
                    "got to it after the limit of " + request.limitNanos() / 1_000_000 + " ms");
            return;
        }
        if (isNotice(request)) {
            handleNotice(request);
            return;
        }
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
            answer = call(request);
            if (answer == null) {
                throw new NullPointerException("the answerer returned null, expected a promise");
            }
        } catch (Throwable thrown) {
            settle(request, null, thrown);
            return;
        }
        if (LibraryAccess.isForOneCaller(answer)) {
            cancelWith(request, answer);
        }
        answer.toCompletableFuture() // notifies at once, on any thread, even if the actor has stopped
                .whenComplete((value, error) -> settle(request, value, error));
    }

    /** Calls the handler. If the requester has asked for that, the requests that the handler sends share the limit. */
    private @Nullable Promise<A> call(MessageDelivery request) throws Throwable {
        Q question = operation.request().cast(request.message().payload());
        ActorSpace here = ActorSpace.current();
        if (!request.isLimitShared() || here == null) {
            return handler.apply(question);
        }
        var called = new Called<Q, A>();
        here.within(request.left(node.nanos()), () -> called.call(handler, question))
                .onRejected(late -> {});
        if (called.thrown != null) {
            throw called.thrown;
        }
        return called.answer;
    }

    /** What a handler returned or threw. */
    private static final class Called<Q, A> {
        @Nullable
        Promise<A> answer;

        @Nullable
        Throwable thrown;

        Promise<?> call(Function<? super Q, ? extends Promise<A>> handler, Q question) {
            try {
                answer = handler.apply(question);
            } catch (Throwable failure) {
                thrown = failure;
            }
            return answer == null ? Promise.done() : answer;
        }
    }

    /** Notes the answer that is cancelled with a request; cancels it if that has happened meanwhile. */
    private void cancelWith(MessageDelivery request, Promise<?> answer) {
        Begun open;
        synchronized (begun) {
            open = begun.get(request.id());
            if (open != null) {
                open.answer = answer;
            }
        }
        if (open == null) {
            answer.cancel();
        }
    }

    /** No requester waits for the result of a one-way message; its failure is reported on this node. */
    private void handleNotice(MessageDelivery notice) {
        Promise<A> result;
        try {
            result = handler.apply(operation.request().cast(notice.message().payload()));
        } catch (Throwable thrown) {
            node.notifier.handlerFailed(notice.message(), thrown);
            return;
        }
        if (result != null) {
            result.toCompletableFuture().whenComplete((value, error) -> {
                if (error != null) {
                    node.notifier.handlerFailed(notice.message(), error);
                }
            });
        }
    }

    /**
     * Returns false if too many requests are being answered. A request whose requester has cancelled is handled, but
     * its reply not awaited.
     */
    private boolean begin(MessageDelivery request) {
        if (!node.isAwaited(request)) {
            forget(request.id());
        } else if (isBusy()) {
            long nowNanos = node.nanos();
            forgetAll(each -> each != request && each.isOverdue(nowNanos)); // no requester waits for their replies
            if (isBusy()) {
                forget(request.id());
                return false;
            }
        }
        return true;
    }

    private boolean isBusy() {
        synchronized (begun) {
            return begun.size() > node.settings.capacity();
        }
    }

    private void settle(MessageDelivery request, @Nullable A value, @Nullable Throwable error) {
        boolean first;
        synchronized (begun) {
            first = begun.remove(request.id()) != null;
        }
        if (!first && error instanceof CancellationException) {
            return; // cancelled with its request: there is no reply
        }
        BusMessage reply = replyTo(request, value, error);
        if (first) {
            node.route(reply, request.incarnation());
        } else {
            String ended = whyEnded();
            node.notifier.late(
                    reply,
                    ended == null ? "no caller waits for it any more" : port.address() + " had left before: " + ended);
        }
    }

    /** The requester has cancelled: a queued request is not handled, and the reply to a begun one not awaited. */
    void cancel(MessageDelivery.RequestId request) {
        if (!remove(request)) {
            forget(request);
        }
    }

    private void forget(MessageDelivery.RequestId request) {
        Begun gone;
        synchronized (begun) {
            gone = begun.remove(request);
        }
        if (gone != null) {
            gone.cancel();
        }
    }

    /** That life of a node has ended. */
    void forgetAllOf(String requesterNode, long incarnation) {
        forgetAll(each -> each.incarnation() == incarnation
                && each.message().from().node().equals(requesterNode));
    }

    private void forgetAll(Predicate<? super MessageDelivery> unawaited) {
        List<Begun> gone = new ArrayList<>();
        synchronized (begun) {
            begun.values().removeIf(each -> unawaited.test(each.request) && gone.add(each));
        }
        gone.forEach(Begun::cancel);
    }

    private BusMessage replyTo(MessageDelivery request, @Nullable A value, @Nullable Throwable error) {
        if (error instanceof NotBegunException notBegun) {
            var why = new BusMessage.Failure.NotDelivered(String.valueOf(notBegun.getMessage()));
            return node.rejection(port.address(), request, why);
        }
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

    private BusMessage failed(MessageDelivery request, Throwable error) {
        node.notifier.handlerFailed(request.message(), error);
        return node.rejection(
                port.address(),
                request,
                new BusMessage.Failure.Failed(error.getClass().getName(), BoundedText.ofMessage(error)));
    }

    @Override
    void overflow(MessageDelivery request) {
        rejectBusy(request, "wait there");
    }

    private void rejectBusy(MessageDelivery request, String how) {
        node.reject(
                port.address(),
                request,
                "is too busy: " + node.settings.capacity() + " questions for " + operation.name() + " " + how);
    }

    @Override
    void dropAtEnd(List<MessageDelivery> rest, String why) {
        rest.forEach(request -> node.reject(port.address(), request, "left before it answered: " + why));
        rejectBegun(why);
    }

    private void rejectBegun(String why) {
        List<Begun> open;
        synchronized (begun) {
            open = List.copyOf(begun.values());
            begun.clear();
        }
        open.forEach(each -> node.leaveUnanswered(port.address(), each.request, "left before it answered: " + why));
    }
}
