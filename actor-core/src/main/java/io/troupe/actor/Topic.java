package io.troupe.actor;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A publish/subscribe topic inside one process.
 *
 * <p><b>Role.</b> For publishers and subscribers that need not know each other, such as one sensor and many readers.
 * Created by {@link #of}, or by {@link #latest} if late subscribers shall receive the last value. Ended by
 * {@link #finish} or {@link #fail}; a later subscriber is only notified of the end.
 *
 * {@snippet :
 * Topic<Integer> colours = Topic.latest(space, "colours");
 * colours.publish(0xFF0000);
 * Callback.Stream<Integer> subscription = colours.subscribe(colour -> log.add("saw " + colour));
 * colours.publish(0x00FF00); // returns 1: the number of subscribers
 * }
 *
 * <p><b>Threads.</b> Every method from any thread. A subscriber's callback runs on the space that subscribed, as
 * entries of its callback queue, on behalf of the actor that subscribed. For a thread outside every space it runs on
 * the space of the topic. A callback that an actor received as an argument still runs for its first caller. Publishing
 * calls no code of a subscriber, so a slow or broken subscriber does not delay others.
 *
 * <p><b>Order.</b> Values reach each subscriber in the order in which they were published; values of several publishers
 * reach all subscribers in the same order. No values arrive after the end, after a cancellation, or after the
 * subscribing actor has stopped or restarted.
 *
 * <p><b>Cost.</b> Publishing holds a lock while it queues one entry for each subscriber. These entries accumulate if a
 * subscriber is slower than its publishers for long, unless it subscribes with a capacity. A subscriber that is gone is
 * removed by the next call of any method.
 *
 * <p><b>Errors.</b> A value without subscribers, or after the end, is not delivered: {@link #publish} returns 0. An
 * exception of a subscriber is a failure of that subscriber.
 */
public final class Topic<T> {
    private final ActorSpace space;
    private final String name;
    private final boolean remembers;
    private final Object lock = new Object(); // guards all fields below
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
     * Creates a topic whose subscribers receive the values published after they have subscribed.
     *
     * @param space the space where subscribers from outside every space run
     * @param name used in log and error messages
     */
    public static <T> Topic<T> of(ActorSpace space, String name) {
        return new Topic<>(space, name, false);
    }

    /**
     * Creates a topic that stores the last value: a new subscriber receives it first, if there is one. See {@link #of}.
     */
    public static <T> Topic<T> latest(ActorSpace space, String name) {
        return new Topic<>(space, name, true);
    }

    /**
     * Sends a value to all subscribers.
     *
     * @return the number of subscribers it was sent to; some may be gone before it arrives
     */
    public int publish(T value) {
        Objects.requireNonNull(value, "value");
        var after = new AfterLock();
        int sent;
        synchronized (lock) {
            if (ended) {
                return 0;
            }
            if (remembers) {
                last = value;
            }
            readers.removeIf(reader -> !reader.send(value, after));
            sent = readers.size();
        }
        after.run();
        return sent;
    }

    /**
     * Subscribes to the values. A failure of the topic then counts as a failure of the subscriber, so that it is not
     * lost.
     *
     * @return the subscription, to be cancelled from any thread
     */
    public Callback.Stream<T> subscribe(Consumer<? super T> onValue) {
        return subscribe(Integer.MAX_VALUE, onValue);
    }

    /**
     * Like {@link #subscribe(Consumer)}, for a subscriber that needs only the newest values, as of a sensor. The
     * capacity for a subscriber that is notified of the end is an argument of its {@link Callback.Stream}.
     *
     * {@snippet :
     * Callback.Stream<Integer> newest = colours.subscribe(1, colour -> log.add("saw " + colour));
     * colours.publish(0xFF0000);
     * colours.publish(0x00FF00); // drops the first, unless that was received meanwhile
     * long lost = newest.dropped();
     * }
     *
     * @param capacity the number of values that may be queued; one more drops the oldest
     */
    public Callback.Stream<T> subscribe(int capacity, Consumer<? super T> onValue) {
        Objects.requireNonNull(onValue, "onValue");
        var stream = new Callback.Stream<T>(capacity, onValue, this::refuseFailure, false);
        addReader(ReturningCallback.to(stream, space.home));
        return stream;
    }

    /**
     * Subscribes to the values and to the end. To cancel, pass a {@link Callback.Stream}; one that is subscribed twice
     * receives every value twice.
     *
     * @param more further callbacks; the parameter is variable so that {@code subscribe(list::add)}, which would fit
     *     both methods, means the one for values
     */
    @SafeVarargs
    public final void subscribe(Callback<? super T> callback, Callback<? super T>... more) {
        Objects.requireNonNull(callback, "callback");
        Objects.requireNonNull(more, "more");
        addReader(ReturningCallback.to(callback, space.home));
        for (Callback<? super T> another : more) {
            addReader(ReturningCallback.to(Objects.requireNonNull(another, "more"), space.home));
        }
    }

    private void addReader(ReturningCallback<? super T> callback) {
        var reader = new Subscription<>(callback);
        var after = new AfterLock();
        synchronized (lock) {
            if (ended) {
                reader.end(failure, after);
            } else {
                readers.removeIf(Subscription::isGone);
                if (last == null ? !reader.isGone() : reader.send(last, after)) {
                    readers.add(reader);
                }
            }
        }
        after.run();
    }

    /** The number of subscribers; a publisher may skip work if it is zero. */
    public int subscribers() {
        synchronized (lock) {
            readers.removeIf(Subscription::isGone);
            return readers.size();
        }
    }

    /** The number of stored subscriptions, including those that are gone and not yet removed. */
    int remembered() {
        synchronized (lock) {
            return readers.size();
        }
    }

    /** Ends all subscriptions without an error; false if the topic has already ended. */
    public boolean finish() {
        return end(null);
    }

    /** Ends all subscriptions with an error; false, without effect, if the topic has already ended. */
    public boolean fail(Throwable error) {
        return end(Objects.requireNonNull(error, "error"));
    }

    @Override
    public String toString() {
        return "topic " + name;
    }

    private boolean end(@Nullable Throwable error) {
        var after = new AfterLock();
        synchronized (lock) {
            if (ended) {
                return false;
            }
            readers.removeIf(Subscription::isGone);
            readers.forEach(reader -> reader.end(error, after));
            readers.clear();
            last = null;
            failure = error;
            ended = true; // now that all are notified
        }
        after.run();
        return true;
    }

    private void refuseFailure(@Nullable Throwable end) {
        if (end != null) {
            throw new ActorException(
                    this + " has failed, and this subscriber takes values only:"
                            + " subscribe with a Callback.Stream to be notified of the end",
                    end);
        }
    }

    /** What is done for subscribers when the lock has been released, because it runs code of users. */
    private static final class AfterLock {
        private @Nullable List<Runnable> actions; // most calls have none

        void add(Runnable action) {
            if (actions == null) {
                actions = new ArrayList<>();
            }
            actions.add(action);
        }

        void run() {
            if (actions != null) {
                actions.forEach(Runnable::run);
            }
        }
    }

    /**
     * One subscriber of a topic.
     *
     * <p><b>Threads.</b> The topic's lock guards all methods; entries run on the subscriber's space.
     *
     * <p><b>Order.</b> As sent, from whichever threads.
     */
    private static final class Subscription<T> {
        private final ReturningCallback<T> reader;

        Subscription(ReturningCallback<T> reader) {
            this.reader = reader;
        }

        /** Sends a value; false, without effect, if the subscriber is gone. */
        boolean send(T value, AfterLock after) {
            if (isGone()) {
                return false;
            }
            if (!reader.sendUnderLock(value)) {
                after.add(reader::rejectLeftovers);
            }
            if (reader.isObserved()) {
                after.add(reader::noteReturned);
            }
            return true;
        }

        void end(@Nullable Throwable error, AfterLock after) {
            if (!reader.endUnderLock(error)) {
                after.add(reader::rejectLeftovers);
            }
        }

        boolean isGone() {
            return reader.isOver();
        }
    }
}
