package io.troupe.bus;

import io.troupe.common.text.Suggestions;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** The registry of one node: ports by name, subscriptions by topic, and the value type of each topic. */
final class LocalPorts {
    private final String node;
    private final Map<String, BusPort> ports = new ConcurrentHashMap<>();
    private final Map<String, List<TopicSubscription<?>>> subscriptions = new ConcurrentHashMap<>();
    private final Map<String, TypeInUse> topics = new ConcurrentHashMap<>();

    /** The value type of a topic, and the number of ports that have published or subscribed to it. */
    private record TypeInUse(Class<?> type, int ports) {}

    LocalPorts(String node) {
        this.node = node;
    }

    void add(BusPort port) {
        if (ports.putIfAbsent(port.address().name(), port) != null) {
            throw new IllegalArgumentException("the name " + port.address() + " is taken; " + attachedPorts());
        }
    }

    void remove(BusPort port) {
        ports.remove(port.address().name(), port);
    }

    @Nullable
    BusPort port(String name) {
        return ports.get(name);
    }

    List<BusPort> ports() {
        return new ArrayList<>(ports.values());
    }

    /** A suggestion for the error message about an unknown port name. */
    String hint(String name) {
        return Suggestions.hint(name, ports.keySet());
    }

    private String attachedPorts() {
        return "there are " + String.join(", ", ports.keySet().stream().sorted().toList()) + " on node " + node;
    }

    /**
     * A port starts to use a topic. The value type of the topic is fixed until all ports that use it are closed.
     *
     * @throws IllegalArgumentException if the topic has another type on this node
     */
    void use(BusTopic<?> topic) {
        topics.compute(topic.name(), (name, before) -> {
            if (before != null && before.type() != topic.type()) {
                throw new IllegalArgumentException(
                        "topic " + name + " is of " + before.type().getName() + " and of "
                                + topic.type().getName() + " on node " + node + ", expected one type for one name");
            }
            return new TypeInUse(topic.type(), before == null ? 1 : before.ports() + 1);
        });
    }

    /** A port that used the topic was closed. */
    void release(BusTopic<?> topic) {
        topics.computeIfPresent(
                topic.name(), (name, used) -> used.ports() == 1 ? null : new TypeInUse(used.type(), used.ports() - 1));
    }

    /** @param onFirst is called with the topic, under its lock, if this is its first subscription */
    void add(TopicSubscription<?> subscription, Consumer<String> onFirst) {
        subscriptions.compute(subscription.topic.name(), (topic, before) -> {
            List<TopicSubscription<?>> all = before == null ? new CopyOnWriteArrayList<>() : before;
            all.add(subscription); // inside compute, because an empty list is removed concurrently
            if (before == null) {
                onFirst.accept(topic);
            }
            return all;
        });
    }

    /** @param onLast is called with the topic, under its lock, if this was its last subscription */
    void remove(TopicSubscription<?> subscription, Consumer<String> onLast) {
        subscriptions.computeIfPresent(subscription.topic.name(), (topic, all) -> {
            all.remove(subscription);
            if (!all.isEmpty()) {
                return all;
            }
            onLast.accept(topic);
            return null; // topics are created and removed as components come and go
        });
    }

    List<TopicSubscription<?>> subscriptions(String topic) {
        return subscriptions.getOrDefault(topic, List.of());
    }
}
