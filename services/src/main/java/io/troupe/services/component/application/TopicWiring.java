package io.troupe.services.component.application;

import io.troupe.broker.Need;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.services.component.Component;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * Forwards values between topics. A user and its provider are connected by those topics that have the same last name
 * and type.
 *
 * <p><b>Role.</b> A topic that the user's side publishes is connected with that of the provider if the provider
 * subscribes to it, and a topic that the provider publishes with that of the user if the user's side subscribes to it.
 *
 * <p><b>Threads.</b> The application's space.
 */
final class TopicWiring {
    /** A wire that feeds its target topic, with the need that has claimed it, or null if the wire is declared. */
    private record Feed(Wire<?> wire, @Nullable Need need) {
        String reason() {
            return need == null
                    ? wire + " is declared"
                    : need.by() + " needs "
                            + (need.service() != null ? need.service() : "the capability " + need.capability());
        }
    }

    private final BusPort port;
    private final Map<String, Component<?, ?>> components;
    private final Consumer<ApplicationEvent> observer;
    private final List<Feed> feeds = new ArrayList<>();

    TopicWiring(BusPort port, Map<String, Component<?, ?>> components, Consumer<ApplicationEvent> observer) {
        this.port = port;
        this.components = new LinkedHashMap<>(components);
        this.observer = observer;
    }

    void addComponent(String name, Component<?, ?> component) {
        components.put(name, component);
    }

    /**
     * Claims the target topics of wires for a need, or for the wires of the declaration.
     *
     * @param need null for declared wires, several of which may feed one topic
     * @throws ApplicationException if another claim feeds one of the topics, or if the wires would close a cycle. A
     *     robot that two providers drive follows neither, and a control law that receives the readings of two robots
     *     drives neither
     */
    void claim(@Nullable Need need, List<Wire<?>> wires) {
        for (var wire : wires) {
            for (var other : feeds) {
                if (other.wire().to().equals(wire.to()) && (need != null || other.need() != null)) {
                    throw new ApplicationException(wire.to().name() + " would be fed twice, because " + other.reason()
                            + " and because " + new Feed(wire, need).reason() + ", expected once");
                }
            }
        }
        List<Wire<?>> all = new ArrayList<>(wires);
        feeds.forEach(feed -> all.add(feed.wire()));
        for (var wire : wires) {
            try {
                ApplicationPlan.checkAcyclic(wire, all);
            } catch (IllegalArgumentException circle) {
                throw new ApplicationException(circle.getMessage());
            }
        }
        wires.forEach(wire -> feeds.add(new Feed(wire, need)));
    }

    void release(Need need) {
        feeds.removeIf(each -> each.need() == need);
    }

    List<Wire<?>> wiresBetween(String user, String provider) {
        return wiresBetween(components, user, provider);
    }

    /**
     * The wires between a user and a provider. A provider that is not a component of this application has no known
     * topics, and so no wires.
     */
    static List<Wire<?>> wiresBetween(Map<String, Component<?, ?>> components, String user, String provider) {
        Component<?, ?> serving = components.get(provider);
        if (serving == null || user.equals(provider)) {
            return List.of();
        }
        List<Wire<?>> wires = new ArrayList<>();
        connect(wires, topicsOf(user, all(components, Component::publishes)), topicsOf(provider, serving.subscribes()));
        connect(wires, topicsOf(provider, serving.publishes()), topicsOf(user, all(components, Component::subscribes)));
        return wires;
    }

    private static List<BusTopic<?>> all(
            Map<String, Component<?, ?>> components, Function<Component<?, ?>, List<BusTopic<?>>> topics) {
        return components.values().stream()
                .flatMap(component -> topics.apply(component).stream())
                .<BusTopic<?>>map(topic -> topic)
                .toList();
    }

    private static List<BusTopic<?>> topicsOf(String owner, Collection<BusTopic<?>> topics) {
        return topics.stream()
                .filter(topic -> topic.name().startsWith(owner + "/"))
                .<BusTopic<?>>map(topic -> topic)
                .toList();
    }

    private static void connect(List<Wire<?>> wires, List<BusTopic<?>> from, List<BusTopic<?>> to) {
        for (var source : from) {
            for (var target : to) {
                if (lastName(source).equals(lastName(target))) {
                    wire(source, target).ifPresent(wires::add);
                }
            }
        }
    }

    private static String lastName(BusTopic<?> topic) {
        return topic.name().substring(topic.name().indexOf('/') + 1);
    }

    /** A wire between two topics; empty if their types differ. */
    static <T extends Record> Optional<Wire<?>> wire(BusTopic<T> from, BusTopic<?> to) {
        return from.type().equals(to.type()) ? Optional.of(new Wire<>(from, to.ofType(from.type()))) : Optional.empty();
    }

    /** Forwards values over a wire until the subscription is closed. */
    <T extends Record> BusPort.Subscription open(Wire<T> wire) {
        return port.forward(
                wire.from(),
                wire.to(),
                (value, publisher) -> observer.accept(new ApplicationEvent.Forwarded(wire, value)));
    }

    /** Forwards values over several wires. */
    List<BusPort.Subscription> open(List<Wire<?>> wires) {
        return wires.stream().<BusPort.Subscription>map(wire -> open(wire)).toList();
    }
}
