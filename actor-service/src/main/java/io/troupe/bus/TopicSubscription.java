package io.troupe.bus;

import io.troupe.actor.internal.BoundedQueue;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A port's subscription to one topic, with the queue of its values. */
final class TopicSubscription<T extends Record> extends InboundQueue implements BusPort.Subscription {
    final BusTopic<T> topic;
    private final BusPort.Subscriber<? super T> subscriber;
    private final @Nullable BusTopic<T> forwardedTo;
    private long dropped; // guarded by this

    /** @param forwardedTo a topic on which the values are published with their ages; null for none */
    TopicSubscription(
            BusPort port,
            BusTopic<T> topic,
            BusPort.Subscriber<? super T> subscriber,
            @Nullable BusTopic<T> forwardedTo) {
        super(
                port,
                BoundedQueue.droppingOldest(
                        topic.capacity() != null ? topic.capacity() : port.node.settings.capacity()));
        this.topic = topic;
        this.subscriber = subscriber;
        this.forwardedTo = forwardedTo;
    }

    /** Returns whether values are dropped by their age, or forwarded with it. */
    boolean agesMatter() {
        return topic.maxAge() != null || forwardedTo != null;
    }

    @Override
    void handle(MessageDelivery delivery) {
        BusMessage message = delivery.message();
        Duration limit = topic.maxAge();
        if (limit != null) {
            long ageNanos = delivery.ageNanos(node.nanos());
            if (ageNanos > limit.toNanos()) {
                node.counters.stale.increment();
                node.notifier.lost(new Loss.Stale(port.address(), message, Duration.ofNanos(ageNanos)));
                return;
            }
        }
        try {
            T value = topic.type().cast(message.payload());
            subscriber.receive(value, message.from());
            if (forwardedTo != null) {
                port.publish(forwardedTo, value, delivery.ageNanos(node.nanos()));
            }
            node.counters.delivered.increment();
        } catch (Throwable thrown) {
            node.counters.failed.increment();
            node.notifier.lost(new Loss.SubscriberFailed(port.address(), message, thrown));
        }
    }

    @Override
    void accepted() {
        node.counters.queued.increment();
    }

    @Override
    void overflow(MessageDelivery delivery) {
        if (topic.capacity() != null) { // as its publishers and subscribers want it
            node.counters.replaced.increment();
            return;
        }
        long soFar;
        synchronized (this) {
            soFar = ++dropped;
        }
        node.counters.dropped.increment();
        node.notifier.lost(new Loss.Dropped(port.address(), delivery.message(), soFar));
    }

    @Override
    void dropAtEnd(List<MessageDelivery> rest, String why) {
        if (!rest.isEmpty()) {
            node.counters.droppedAtEnd.add(rest.size());
            node.notifier.lost(new Loss.DroppedAtEnd(port.address(), topic.name(), rest.size(), why));
        }
    }

    @Override
    public void close() {
        end("it does not subscribe any more");
    }
}
