package io.troupe.actor;

import io.troupe.actor.internal.BoundedQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.Objects;
import java.util.concurrent.Flow;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** See {@link ActorSpace#publisher}. */
record CallbackPublisher<T>(SpaceHome space, int capacity, Consumer<? super Callback<T>> source)
        implements Flow.Publisher<T> {
    @Override
    public void subscribe(Flow.Subscriber<? super T> subscriber) {
        Objects.requireNonNull(subscriber, "subscriber");
        TurnOwner owner = Home.current() == space && space.owner() instanceof Incarnation life ? life : space.itself();
        new Subscription<>(this, subscriber, owner).begin();
    }

    @Override
    public String toString() {
        return "publisher on space " + space;
    }

    /**
     * One subscriber, from the start to its end or cancellation. All signals are entries of the space's callback queue.
     *
     * <p><b>Threads.</b> {@link #request} and {@link #cancel} from any thread, the rest on the space's thread.
     */
    private static final class Subscription<T> implements Flow.Subscription {
        private static final int BATCH = 64; // so that a long backlog leaves time for others

        private final CallbackPublisher<T> publisher;
        private final TurnOwner owner;
        private final Callback.Stream<T> stream;
        private final BoundedQueue<T> waiting; // received, and not yet requested
        private Flow.@Nullable Subscriber<? super T> subscriber; // null after the end
        private volatile boolean cancelled;
        private long requested;
        private boolean ended;
        private @Nullable Throwable failure;

        Subscription(CallbackPublisher<T> publisher, Flow.Subscriber<? super T> subscriber, TurnOwner owner) {
            this.publisher = publisher;
            this.subscriber = subscriber;
            this.owner = owner;
            this.waiting = BoundedQueue.droppingOldest(publisher.capacity);
            this.stream = new Callback.Stream<>(publisher.capacity, this::arrived, this::ended);
        }

        void begin() {
            SpaceHome space = publisher.space;
            space.enqueue(Entry.urgent(() -> guard(this::start), () -> space.runGuarded(this::refuse)));
        }

        private void start() {
            var reader = Objects.requireNonNull(subscriber);
            signal(() -> reader.onSubscribe(this));
            if (!cancelled) {
                try {
                    publisher.source.accept(ReturningCallback.to(stream, publisher.space));
                } catch (Throwable thrown) {
                    ended(thrown);
                }
            }
        }

        /** The space is closed. */
        private void refuse() {
            var reader = Objects.requireNonNull(subscriber);
            cancelled = true;
            reader.onSubscribe(this);
            reader.onError(
                    new ActorStoppedException("subscribe(..) came too late: space " + publisher.space + " is closed"));
        }

        @Override
        public void request(long count) {
            queue(() -> more(count));
        }

        @Override
        public void cancel() {
            cancelled = true;
            stream.cancel();
            queue(this::forget);
        }

        private void queue(Runnable task) {
            publisher.space.enqueue(Entry.urgent(() -> guard(task), () -> {}));
        }

        /** Runs a task on behalf of the subscribing actor; if that has stopped, there is nothing more to do. */
        private void guard(Runnable task) {
            if (!owner.run("a subscriber", task)) {
                cancelled = true;
                stream.cancel();
                forget();
            }
        }

        private void more(long count) {
            if (count > 0) {
                requested = requested + count < 0 ? Long.MAX_VALUE : requested + count;
                deliver();
            } else if (!cancelled) {
                waiting.drain();
                ended = true;
                failure = new IllegalArgumentException("request(" + count
                        + "), expected 1 or more: rule 3.9 forbids a non-positive subscription request");
                deliver();
                stream.cancel();
            }
        }

        private void arrived(T value) {
            if (value == null) {
                stream.fail(new NullPointerException("a result is null, which a publisher cannot pass on"));
                return;
            }
            if (!ended && !cancelled) {
                if (waiting.offer(value) != null) {
                    stream.noteDropped();
                }
                deliver();
            }
        }

        private void ended(@Nullable Throwable error) {
            if (!ended && !cancelled) {
                ended = true;
                failure = error;
                deliver();
            }
        }

        private void deliver() {
            for (int count = 0; requested > 0 && !cancelled && !waiting.isEmpty(); count++) {
                if (count == BATCH) {
                    queue(this::deliver);
                    return;
                }
                T value = Objects.requireNonNull(waiting.poll());
                requested -= requested == Long.MAX_VALUE ? 0 : 1;
                var reader = Objects.requireNonNull(subscriber);
                signal(() -> reader.onNext(value));
            }
            if (ended && !cancelled && waiting.isEmpty()) {
                var reader = Objects.requireNonNull(subscriber);
                Throwable error = failure;
                cancelled = true; // nothing may follow
                forget();
                if (error == null) {
                    reader.onComplete();
                } else {
                    reader.onError(error);
                }
            }
        }

        /** A subscriber must not throw; one that does is cancelled, and that is a failure of its actor. */
        private void signal(Runnable signal) {
            try {
                signal.run();
            } catch (Throwable thrown) {
                cancel();
                throw thrown;
            }
        }

        private void forget() {
            subscriber = null;
            waiting.drain();
        }

        @Override
        public String toString() {
            return "subscription to " + publisher + ": " + stream;
        }
    }
}
