package io.troupe.actor;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A subject on which anybody publishes and to which anybody subscribes, inside one process.
 *
 * <p><b>Role.</b> For senders and receivers that need not know each other: one sensor, many readers. Made by
 * {@link #of}, or by {@link #latest} when whoever subscribes late shall hear the last value. Ends with {@link #finish}
 * or {@link #fail}; whoever subscribes then hears of the end only.
 *
 * {@snippet :
 * Topic<Integer> colours = Topic.latest(space, "colours");
 * colours.publish(0xFF0000);
 * Callback.Stream<Integer> subscription = colours.subscribe(colour -> log.add("saw " + colour));
 * colours.publish(0x00FF00); // returns 1: the number of subscribers
 * }
 *
 * <p><b>Threads.</b> Every method from any thread. What a subscriber hears runs on the space that subscribed, as
 * entries of its callback queue, on behalf of the actor that subscribed; if that was no actor space, on the space of
 * the topic. A callback that an actor was handed keeps its first reader. Publishing runs none of a subscriber's code
 * but {@link Callback#isCancelled}, so a slow or broken one holds up nobody else.
 *
 * <p><b>Order.</b> Values reach each subscriber in the order in which they were published; values of several publishers
 * reach all subscribers in the same order. After the end, after a cancellation, and after the subscribing actor has
 * stopped or restarted, nothing arrives any more.
 *
 * <p><b>Cost.</b> Publishing takes a lock for as long as it takes to queue one entry for each subscriber. Nothing
 * bounds these entries: a subscriber that is slower than its publishers for long gathers them. A subscriber that is
 * gone is forgotten with the next call of any method.
 *
 * <p><b>Errors.</b> A value that nobody has subscribed to, or that comes after the end, reaches nobody:
 * {@link #publish} answers 0. What a subscriber throws is its own failure.
 */
public final class Topic<T> {
    private final ActorSpace space;
    private final String name;
    private final boolean remembers;
    private final Object lock = new Object(); // guards all below
    private final List<Subscription<? super T>> readers = new ArrayList<>();
    private @Nullable T last;
    private boolean ended;
    private @Nullable Throwable failure;

    private Topic(ActorSpace space, String name, boolean remembers) {
        this.space = Objects.requireNonNull(space, "space");
        this.name = Objects.requireNonNull(name, "name");
        this.remembers = remembers;
    }

    /**
     * A topic whose subscribers hear what is published after they have subscribed.
     *
     * @param space where those hear it who subscribe from outside every space
     * @param name for messages about it
     */
    public static <T> Topic<T> of(ActorSpace space, String name) {
        return new Topic<>(space, name, false);
    }

    /** A topic that remembers the last value: whoever subscribes hears that first, if there is one. See {@link #of}. */
    public static <T> Topic<T> latest(ActorSpace space, String name) {
        return new Topic<>(space, name, true);
    }

    /**
     * Sends a value to all subscribers.
     *
     * @return to how many it was sent; some may be gone before it arrives
     */
    public int publish(T value) {
        Objects.requireNonNull(value, "value");
        synchronized (lock) {
            if (ended) {
                return 0;
            }
            if (remembers) {
                last = value;
            }
            readers.removeIf(reader -> !reader.send(value));
            return readers.size();
        }
    }

    /**
     * Subscribes to the values. The failure of the topic is then a failure of the subscriber, so that it does not get
     * lost.
     *
     * @return the subscription, to be cancelled from any thread
     */
    public Callback.Stream<T> subscribe(Consumer<? super T> onValue) {
        var stream = new Callback.Stream<T>(Objects.requireNonNull(onValue, "onValue"), this::refuseFailure);
        addReader(ReturningCallback.to(stream, space));
        return stream;
    }

    /**
     * Subscribes to the values and to the end. To cancel, pass a {@link Callback.Stream}; one that is subscribed twice
     * gets every value twice.
     *
     * @param more of them; there is a variable number so that {@code subscribe(list::add)}, which would fit both
     *     methods, means the one for values
     */
    @SafeVarargs
    public final void subscribe(Callback<? super T> callback, Callback<? super T>... more) {
        Objects.requireNonNull(callback, "callback");
        Objects.requireNonNull(more, "more");
        addReader(ReturningCallback.to(callback, space));
        for (Callback<? super T> another : more) {
            addReader(ReturningCallback.to(Objects.requireNonNull(another, "more"), space));
        }
    }

    private void addReader(ReturningCallback<? super T> callback) {
        var reader = new Subscription<>(this, callback);
        synchronized (lock) {
            if (ended) {
                reader.end(failure);
                return;
            }
            readers.removeIf(Subscription::isGone);
            if (last == null ? !reader.isGone() : reader.send(last)) {
                readers.add(reader);
            }
        }
    }

    /** How many subscribers there are, so that a publisher may save itself the work for nobody. */
    public int subscribers() {
        synchronized (lock) {
            readers.removeIf(Subscription::isGone);
            return readers.size();
        }
    }

    /** How many subscriptions are held, those that are gone and not yet forgotten too. */
    int remembered() {
        synchronized (lock) {
            return readers.size();
        }
    }

    /** Ends all subscriptions with success; false if the topic has ended before. */
    public boolean finish() {
        return end(null);
    }

    /** Ends all subscriptions with an error; false, and nobody hears of this one, if the topic has ended before. */
    public boolean fail(Throwable error) {
        return end(Objects.requireNonNull(error, "error"));
    }

    @Override
    public String toString() {
        return "topic " + name;
    }

    private boolean end(@Nullable Throwable error) {
        synchronized (lock) {
            if (ended) {
                return false;
            }
            ended = true;
            failure = error;
            last = null;
            readers.removeIf(Subscription::isGone);
            readers.forEach(reader -> reader.end(error));
            readers.clear();
            return true;
        }
    }

    private void refuseFailure(@Nullable Throwable end) {
        if (end != null && !(end instanceof CancellationException)) {
            throw new ActorException(
                    this + " has failed, and this subscriber takes values only:"
                            + " subscribe with a Callback.Stream to hear of the end",
                    end);
        }
    }
}
