package io.troupe.services.component.application;

import io.troupe.services.broker.Need;
import io.troupe.services.bus.BusPort;
import io.troupe.services.bus.BusTopic;
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
 * Connects topics: of a user and its provider those that have the same last name and type.
 *
 * <p><b>Role.</b> What the user's side publishes goes to the provider if that hears it, and what the provider publishes
 * to the user's side if that hears it.
 *
 * <p><b>Threads.</b> The application's space.
 */
final class Wiring {
    /** Why a topic is fed. */
    private record Feed(Wire<?> wire, @Nullable Need need) {
        String why() {
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

    Wiring(BusPort port, Map<String, Component<?, ?>> components, Consumer<ApplicationEvent> observer) {
        this.port = port;
        this.components = new LinkedHashMap<>(components);
        this.observer = observer;
    }

    void know(String name, Component<?, ?> component) {
        components.put(name, component);
    }

    /**
     * Lets a need, or the declaration itself, feed topics.
     *
     * @param need null for wires of the declaration, which may join several into one
     * @throws ApplicationException if another feeds one already: a robot that two drive obeys none, and a control law
     *     that hears two robots drives neither; or if values would go round in a circle
     */
    void claim(@Nullable Need need, List<Wire<?>> wires) {
        for (var wire : wires) {
            for (var other : feeds) {
                if (other.wire().to().equals(wire.to()) && (need != null || other.need() != null)) {
                    throw new ApplicationException(wire.to().name() + " would be fed twice, because " + other.why()
                            + " and because " + new Feed(wire, need).why() + ", expected once");
                }
            }
        }
        List<Wire<?>> all = new ArrayList<>(wires);
        feeds.forEach(feed -> all.add(feed.wire()));
        for (var wire : wires) {
            try {
                ApplicationPlan.checkEnds(wire, all);
            } catch (IllegalArgumentException circle) {
                throw new ApplicationException(circle.getMessage());
            }
        }
        wires.forEach(wire -> feeds.add(new Feed(wire, need)));
    }

    void release(Need need) {
        feeds.removeIf(each -> each.need() == need);
    }

    /**
     * What is to be connected between a user and a provider; a provider that is no component of this application has no
     * topics that are known here.
     */
    List<Wire<?>> between(String user, String provider) {
        Component<?, ?> serving = components.get(provider);
        if (serving == null || user.equals(provider)) {
            return List.of();
        }
        List<Wire<?>> wires = new ArrayList<>();
        connect(wires, topicsOf(user, all(Component::publishes)), topicsOf(provider, serving.hears()));
        connect(wires, topicsOf(provider, serving.publishes()), topicsOf(user, all(Component::hears)));
        return wires;
    }

    private List<BusTopic<?>> all(Function<Component<?, ?>, List<BusTopic<?>>> topics) {
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

    /** A wire between two topics, if they have one type. */
    static <T extends Record> Optional<Wire<?>> wire(BusTopic<T> from, BusTopic<?> to) {
        return from.type().equals(to.type())
                ? Optional.of(new Wire<>(from, new BusTopic<>(to.name(), from.type())))
                : Optional.empty();
    }

    /** Lets values go over a wire until that is closed. */
    <T extends Record> BusPort.Subscription open(Wire<T> wire) {
        return port.subscribe(wire.from(), (value, publisher) -> {
            observer.accept(new ApplicationEvent.Carried(wire, value));
            port.publish(wire.to(), value);
        });
    }

    /** All of them. */
    List<BusPort.Subscription> open(List<Wire<?>> wires) {
        return wires.stream().<BusPort.Subscription>map(wire -> open(wire)).toList();
    }
}
