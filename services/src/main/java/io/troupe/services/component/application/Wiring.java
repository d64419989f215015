package io.troupe.services.component.application;

import io.troupe.services.broker.Need;
import io.troupe.services.bus.BusPort;
import io.troupe.services.bus.Topic;
import io.troupe.services.component.Component;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.function.Function;

/**
 * Connects topics: of a user and its provider those that have the same last name and type.
 *
 * <p><b>Role.</b> What the user's side publishes goes to the provider if that hears it, and what the provider publishes to the user's side if that hears it.
 * <p><b>Threads.</b> The application's space.
 */
final class Wiring {
    private final BusPort port;
    private final Map<String, Component<?, ?>> components;
    private final Consumer<ApplicationEvent> observer;

    Wiring(BusPort port, Map<String, Component<?, ?>> components, Consumer<ApplicationEvent> observer) {
        this.port = port;
        this.components = new LinkedHashMap<>(components);
        this.observer = observer;
    }

    void know(String name, Component<?, ?> component) {
        components.put(name, component);
    }

    /** By which need a topic is fed. */
    private final Map<Topic<?>, Need> feeders = new HashMap<>();

    /**
     * Lets a need feed topics.
     *
     * @throws ApplicationException if another does already: a robot that two drive obeys none, and a control law that hears two robots drives neither
     */
    void claim(Need need, List<Wire<?>> wires) {
        for (var wire : wires) {
            Need other = feeders.get(wire.to());
            if (other != null && other != need) {
                throw new ApplicationException(wire.to().name() + " would be fed twice, because " + words(other)
                        + " and because " + words(need) + ", expected once");
            }
        }
        wires.forEach(wire -> feeders.put(wire.to(), need));
    }

    private static String words(Need need) {
        return need.by() + " needs "
                + (need.service() != null ? need.service() : "the capability " + need.capability());
    }

    void release(Need need) {
        feeders.values().removeIf(each -> each == need);
    }

    /** What is to be connected between a user and a provider; a provider that is no component of this application has no topics that are known here. */
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

    private List<Topic<?>> all(Function<Component<?, ?>, List<Topic<?>>> topics) {
        return components.values().stream()
                .flatMap(component -> topics.apply(component).stream())
                .<Topic<?>>map(topic -> topic)
                .toList();
    }

    private static List<Topic<?>> topicsOf(String owner, Collection<Topic<?>> topics) {
        return topics.stream()
                .filter(topic -> topic.name().startsWith(owner + "/"))
                .<Topic<?>>map(topic -> topic)
                .toList();
    }

    private static void connect(List<Wire<?>> wires, List<Topic<?>> from, List<Topic<?>> to) {
        for (var source : from) {
            for (var target : to) {
                if (lastName(source).equals(lastName(target))) {
                    wire(source, target).ifPresent(wires::add);
                }
            }
        }
    }

    private static String lastName(Topic<?> topic) {
        return topic.name().substring(topic.name().indexOf('/') + 1);
    }

    /** A wire between two topics, if they have one type. */
    static <T extends Record> Optional<Wire<?>> wire(Topic<T> from, Topic<?> to) {
        return from.type().equals(to.type())
                ? Optional.of(new Wire<>(from, new Topic<>(to.name(), from.type())))
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
