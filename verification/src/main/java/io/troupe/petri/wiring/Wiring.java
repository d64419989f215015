package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * An application: named components, each with its {@link Protocol}, and who calls whom.
 *
 * <p>A request {@code player.setValues} goes to the component called {@code player}, unless {@link Builder#bind} says
 * otherwise. Several components may call the same one; it serves them one at a time.
 *
 * {@snippet :
 * var wiring = Wiring.of("two robots")
 *         .components("robot", 2, robot)
 *         .component("player", player)
 *         .build();
 * }
 *
 * <p><b>Role.</b> Asked whether it can deadlock by {@link WiringCheck}.
 * <p><b>Threads.</b> Immutable.
 * <p><b>Errors.</b> {@link Builder#build} throws {@link IllegalArgumentException} for a request to an unknown
 * component, for a call that the other side never offers, and for an offer that nobody calls and that is not declared
 * open; the message has the nearest known name.
 */
public final class Wiring {
    private final String name;
    private final Map<String, Protocol> components;
    private final Map<String, String> bindings;
    private final Set<String> open;
    private final boolean stopsTogether;

    private Wiring(
            String name,
            Map<String, Protocol> components,
            Map<String, String> bindings,
            Set<String> open,
            boolean stopsTogether) {
        this.name = name;
        this.components = components;
        this.bindings = bindings;
        this.open = open;
        this.stopsTogether = stopsTogether;
    }

    /** Starts a wiring without components. */
    public static Builder of(String name) {
        return new Builder(name);
    }

    public String name() {
        return name;
    }

    /** The names of the components in the order they were added. */
    public List<String> components() {
        return List.copyOf(components.keySet());
    }

    /** The protocol of a component. */
    public Protocol protocol(String component) {
        var found = components.get(requireNonNull(component, "component"));
        if (found == null) {
            throw new IllegalArgumentException("wiring " + name + ": there is no component " + component + "; "
                    + Names.hint(component, components.keySet()));
        }
        return found;
    }

    /** Whether all components that stop do so in one synchronised step. */
    public boolean stopsTogether() {
        return stopsTogether;
    }

    /**
     * The same components, whose stops are fused into one that they take together, each where it waits for its next
     * call: the paper's correction. A component that waits for a call in several states after its stop was declared
     * takes part in any of them.
     */
    public Wiring withSynchronisedStop() {
        return new Wiring(name + " with a synchronised stop", components, bindings, open, true);
    }

    /** The net of the whole: the components' nets and a meld for each request; names are words of the declaration. */
    public PetriNet net() {
        return new WiringNet(this, components.keySet()).net();
    }

    /** The component that answers a request. */
    String provider(String component, Step.Requests request) {
        return bindings.getOrDefault(component + "." + request.role(), request.role());
    }

    /** Those of {@code among} that call an offer, in order. */
    List<String> callers(String provider, String call, Set<String> among) {
        return components.keySet().stream()
                .filter(among::contains)
                .filter(caller -> protocol(caller).requests().stream()
                        .anyMatch(request -> request.call().equals(call)
                                && provider(caller, request).equals(provider)))
                .toList();
    }

    /** The states in which a component may stop. */
    List<String> stops(String component) {
        var protocol = protocol(component);
        return stopsTogether ? protocol.synchronisedStops() : protocol.stopStates();
    }

    /** The components and the name. */
    @Override
    public String toString() {
        return name + " " + components.keySet();
    }

    /** Collects components and bindings; for one thread. */
    public static final class Builder {
        private final String name;
        private final Map<String, Protocol> components = new LinkedHashMap<>();
        private final Map<String, String> bindings = new LinkedHashMap<>();
        private final Set<String> open = new LinkedHashSet<>();

        private Builder(String name) {
            this.name = requireNonNull(name, "name");
        }

        /** Adds a component that is called as its protocol. */
        public Builder component(Protocol protocol) {
            return component(protocol.name(), protocol);
        }

        /** Adds a component. */
        public Builder component(String component, Protocol protocol) {
            Names.requireWord("wiring " + name + ": the name of a component", requireNonNull(component, "component"));
            requireNonNull(protocol, "protocol");
            require(!components.containsKey(component), "there are two components called " + component);
            components.put(component, protocol);
            return this;
        }

        /** Adds {@code count} (1 or more) components called {@code prefix} with 1, 2, .. behind it. */
        public Builder components(String prefix, int count, Protocol protocol) {
            require(count > 0, "there are " + count + " components " + prefix + ", expected 1 or more");
            for (var i = 1; i <= count; i++) {
                component(prefix + i, protocol);
            }
            return this;
        }

        /** Sends what {@code component} requests of {@code role} to {@code provider}. */
        public Builder bind(String component, String role, String provider) {
            var key = requireNonNull(component, "component") + "." + requireNonNull(role, "role");
            requireNonNull(provider, "provider");
            var old = bindings.put(key, provider);
            require(old == null, key + " is bound twice, to " + old + " and to " + provider);
            return this;
        }

        /**
         * Declares that a call, written {@code component.call}, is made from outside at any time, and so need not be
         * requested by a component.
         */
        public Builder open(String target) {
            open.add(requireNonNull(target, "target"));
            return this;
        }

        /** The wiring, checked. */
        public Wiring build() {
            require(!components.isEmpty(), "there are no components; expected 1 or more");
            bindings.forEach(this::requireBinding);
            var wiring = new Wiring(
                    name, new LinkedHashMap<>(components), Map.copyOf(bindings), new LinkedHashSet<>(open), false);
            components.forEach((component, protocol) ->
                    protocol.requests().forEach(request -> requireAnswered(wiring, component, request)));
            var offers = new ArrayList<String>();
            components.forEach(
                    (component, protocol) -> protocol.provided().forEach(call -> offers.add(component + "." + call)));
            for (var target : open) {
                require(
                        offers.contains(target),
                        "open call " + target + " is not offered; " + Names.hint(target, offers));
            }
            components.forEach((component, protocol) ->
                    protocol.provided().forEach(call -> requireCalled(wiring, component, call)));
            return wiring;
        }

        private void requireBinding(String key, String provider) {
            var component = key.substring(0, key.indexOf('.'));
            var role = key.substring(key.indexOf('.') + 1);
            var protocol = components.get(component);
            if (protocol == null) {
                throw error(key + " is bound, but there is no component " + component + "; "
                        + Names.hint(component, components.keySet()));
            }
            var roles = protocol.requests().stream()
                    .map(Step.Requests::role)
                    .distinct()
                    .toList();
            require(
                    roles.contains(role),
                    key + " is bound, but " + component + " requests nothing of " + role + "; "
                            + Names.hint(role, roles));
            require(
                    components.containsKey(provider),
                    key + " is bound to the unknown component " + provider + "; "
                            + Names.hint(provider, components.keySet()));
        }

        private void requireAnswered(Wiring wiring, String component, Step.Requests request) {
            var provider = wiring.provider(component, request);
            var target =
                    component + " requests " + request.role() + "." + request.call() + " in state " + request.from();
            var protocol = components.get(provider);
            if (protocol == null) {
                throw error(target + ", but there is no component " + provider + "; "
                        + Names.hint(provider, components.keySet()));
            }
            require(!provider.equals(component), target + " of itself; expected another component");
            require(
                    protocol.offers(request.call()),
                    target + ", but " + provider + " never offers " + request.call() + "; "
                            + Names.hint(request.call(), protocol.provided()));
        }

        private void requireCalled(Wiring wiring, String component, String call) {
            var called = !wiring.callers(component, call, components.keySet()).isEmpty();
            var declaredOpen = open.contains(component + "." + call);
            require(
                    called || declaredOpen,
                    component + " offers " + call + ", but nobody requests it; request it, or declare " + component
                            + "." + call + " open");
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
}
