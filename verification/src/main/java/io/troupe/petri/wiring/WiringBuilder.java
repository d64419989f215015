package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

/**
 * Collects the components and bindings of a {@link Wiring}.
 *
 * <p><b>Role.</b> From {@link Wiring#of}; continue with {@link #component} and {@link #bind}.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> An illegal or repeated name throws {@link IllegalArgumentException} at once; {@link #build} throws
 * it for errors that need the whole wiring.
 */
public final class WiringBuilder {
    private final String name;
    private final Map<String, Protocol> components = new LinkedHashMap<>();
    private final Map<String, String> bindings = new LinkedHashMap<>();
    private final Set<String> open = new LinkedHashSet<>();

    WiringBuilder(String name) {
        this.name = requireNonNull(name, "name");
    }

    /** Adds a component with the name of its protocol. */
    public WiringBuilder component(Protocol protocol) {
        return component(protocol.name(), protocol);
    }

    /** Adds a component. */
    public WiringBuilder component(String component, Protocol protocol) {
        ProtocolBuilder.requireName(
                "wiring " + name + ": the name of a component", requireNonNull(component, "component"));
        requireNonNull(protocol, "protocol");
        require(!components.containsKey(component), "there are two components called " + component);
        components.put(component, protocol);
        return this;
    }

    /** Adds {@code count} (1 or more) components named {@code prefix} followed by 1, 2, .. */
    public WiringBuilder components(String prefix, int count, Protocol protocol) {
        require(count > 0, "there are " + count + " components " + prefix + ", expected 1 or more");
        for (var i = 1; i <= count; i++) {
            component(prefix + i, protocol);
        }
        return this;
    }

    /** Binds the requests of {@code component} to {@code role} to the component {@code provider}. */
    public WiringBuilder bind(String component, String role, String provider) {
        var key = requireNonNull(component, "component") + "." + requireNonNull(role, "role");
        requireNonNull(provider, "provider");
        var old = bindings.put(key, provider);
        require(old == null, key + " is bound twice, to " + old + " and to " + provider);
        return this;
    }

    /**
     * Declares that a call, written {@code component.call}, is made from outside at any time, so that no component
     * needs to request it.
     */
    public WiringBuilder open(String target) {
        open.add(requireNonNull(target, "target"));
        return this;
    }

    /** Checks the declaration and builds the wiring. */
    public Wiring build() {
        require(!components.isEmpty(), "there are no components; expected 1 or more");
        bindings.forEach(this::requireBinding);
        var wiring = new Wiring(
                name,
                new LinkedHashMap<>(components),
                Map.copyOf(bindings),
                new LinkedHashSet<>(open),
                Optional.empty());
        components.forEach((component, protocol) ->
                protocol.requests().forEach(request -> requireAnswered(wiring, component, request)));
        var offers = new ArrayList<String>();
        components.forEach(
                (component, protocol) -> protocol.provided().forEach(call -> offers.add(component + "." + call)));
        for (var target : open) {
            require(
                    offers.contains(target),
                    "open call " + target + " is not offered; " + Suggestions.hintWithAll(target, offers));
        }
        components.forEach(
                (component, protocol) -> protocol.provided().forEach(call -> requireCalled(wiring, component, call)));
        return wiring;
    }

    private void requireBinding(String key, String provider) {
        var component = key.substring(0, key.indexOf('.'));
        var role = key.substring(key.indexOf('.') + 1);
        var protocol = components.get(component);
        if (protocol == null) {
            throw error(key + " is bound, but there is no component " + component + "; "
                    + Suggestions.hintWithAll(component, components.keySet()));
        }
        var roles =
                protocol.requests().stream().map(Step.Requests::role).distinct().toList();
        require(
                roles.contains(role),
                key + " is bound, but " + component + " requests nothing of " + role + "; "
                        + Suggestions.hintWithAll(role, roles));
        require(
                components.containsKey(provider),
                key + " is bound to the unknown component " + provider + "; "
                        + Suggestions.hintWithAll(provider, components.keySet()));
    }

    private void requireAnswered(Wiring wiring, String component, Step.Requests request) {
        var provider = wiring.provider(component, request);
        var target = component + " requests " + request.role() + "." + request.call() + " in state " + request.from();
        var protocol = components.get(provider);
        if (protocol == null) {
            throw error(target + ", but there is no component " + provider + "; "
                    + Suggestions.hintWithAll(provider, components.keySet()));
        }
        require(!provider.equals(component), target + " of itself; expected another component");
        require(
                protocol.offers(request.call()),
                target + ", but " + provider + " never offers " + request.call() + "; "
                        + Suggestions.hintWithAll(request.call(), protocol.provided()));
    }

    private void requireCalled(Wiring wiring, String component, String call) {
        var called = !wiring.callers(component, call, components.keySet()).isEmpty();
        var declaredOpen = open.contains(component + "." + call);
        require(
                called || declaredOpen,
                component + " offers " + call + ", but nobody requests it; request it, or declare " + component + "."
                        + call + " open");
        require(
                !(called && declaredOpen),
                component + "." + call + " is declared open and requested by "
                        + wiring.callers(component, call, components.keySet()) + "; expected one of the two");
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw error(message);
        }
    }

    private IllegalArgumentException error(String message) {
        return new IllegalArgumentException("wiring " + name + ": " + message);
    }
}
