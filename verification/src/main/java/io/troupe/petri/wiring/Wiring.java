package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import io.troupe.petri.PetriNet;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

/**
 * An application: named components, each with its {@link Protocol}, and the calls between them.
 *
 * <p>A request {@code player.setValues} goes to the component named {@code player}, unless {@link WiringBuilder#bind}
 * binds it to another. Several components may call the same one; it serves them one at a time.
 *
 * {@snippet :
 * var wiring = Wiring.of("two clients")
 *         .components("client", 2, client)
 *         .component("planner", planner)
 *         .build();
 * }
 *
 * <p><b>Role.</b> Checked for deadlocks by {@link WiringCheck}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> {@link WiringBuilder#build} throws {@link IllegalArgumentException} for a request to an unknown
 * component, for a call that the other side never offers, and for an offer that no component calls and that is not
 * declared open; the message suggests the nearest known name.
 */
public final class Wiring {
    private final String name;
    private final Parts parts;
    /** The groups that stop in one step; empty if each component stops alone. */
    private final Optional<List<Set<String>>> stopGroups;

    /**
     * What a wiring is made of.
     *
     * @param components by name
     * @param bindings from {@code component.role} to a component or a resource
     * @param open calls and messages that come from outside
     * @param mailboxes by component
     * @param resources units by name
     * @param windows by {@code component.call}: the items that a stream holds
     */
    record Parts(
            Map<String, Protocol> components,
            Map<String, String> bindings,
            Set<String> open,
            Map<String, Mailbox> mailboxes,
            Map<String, Integer> resources,
            Map<String, Integer> windows) {
        static Parts empty() {
            return new Parts(
                    new LinkedHashMap<>(),
                    new LinkedHashMap<>(),
                    new LinkedHashSet<>(),
                    new LinkedHashMap<>(),
                    new LinkedHashMap<>(),
                    new LinkedHashMap<>());
        }

        Parts copy() {
            return new Parts(
                    new LinkedHashMap<>(components),
                    Map.copyOf(bindings),
                    new LinkedHashSet<>(open),
                    Map.copyOf(mailboxes),
                    new LinkedHashMap<>(resources),
                    Map.copyOf(windows));
        }
    }

    record Mailbox(int capacity, Overflow overflow) {}

    Wiring(String name, Parts parts, Optional<List<Set<String>>> stopGroups) {
        this.name = name;
        this.parts = parts;
        this.stopGroups = stopGroups;
    }

    /** Starts a wiring without components. */
    public static WiringBuilder of(String name) {
        return new WiringBuilder(name);
    }

    public String name() {
        return name;
    }

    /** The names of the components in the order in which they were added. */
    public List<String> components() {
        return List.copyOf(parts.components().keySet());
    }

    /** The protocol of a component. */
    public Protocol protocol(String component) {
        var found = parts.components().get(requireNonNull(component, "component"));
        if (found == null) {
            throw new IllegalArgumentException("wiring " + name + ": there is no component " + component + "; "
                    + Suggestions.hintWithAll(component, parts.components().keySet()));
        }
        return found;
    }

    /** Whether components stop in synchronised steps; otherwise each stops alone. */
    public boolean stopsTogether() {
        return stopGroups.isPresent();
    }

    /**
     * The same components with their stops fused into one that they take together, each where it waits for its next
     * call: the paper's correction. A component that waits for a call in several states after it could stop takes part
     * in any of them.
     */
    public Wiring withSynchronisedStop() {
        return new Wiring(
                name + " with a synchronised stop",
                parts,
                Optional.of(List.of(Set.copyOf(parts.components().keySet()))));
    }

    /**
     * The same components, where each of {@code groups} stops in a separate step, as all do in
     * {@link #withSynchronisedStop}. A component that is in no group never stops: for example robots leave one by one,
     * each with its session, while the shared components stay up.
     *
     * @throws IllegalArgumentException for an unknown component, one in two groups, a group in which no component
     *     stops, and a component in no group that has a state in which it can only stop
     */
    public Wiring withSynchronisedStops(List<? extends Set<String>> groups) {
        var seen = new HashSet<String>();
        for (var group : groups) {
            for (var component : group) {
                protocol(component);
                require(seen.add(component), component + " stops in two groups of " + groups + ", expected one");
            }
            require(
                    group.stream()
                            .anyMatch(component ->
                                    !protocol(component).stopStates().isEmpty()),
                    "no component stops in group " + group + "; expected a component that declares a stop");
        }
        parts.components().forEach((component, protocol) -> {
            for (var state : seen.contains(component) ? List.<String>of() : protocol.stopStates()) {
                require(
                        protocol.out(state).size() > 1,
                        component + " is in no group that stops, but can do nothing else in state " + state);
            }
        });
        List<Set<String>> copies = groups.stream().<Set<String>>map(Set::copyOf).toList();
        return new Wiring(name + " with stops by groups", parts, Optional.of(copies));
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw new IllegalArgumentException("wiring " + name + ": " + message);
        }
    }

    /**
     * The net of the whole: the components' nets and a meld for each request. Names are in the words of the
     * declaration.
     */
    public PetriNet net() {
        return new WiringNet(this, parts.components().keySet()).net();
    }

    /** The component on the other side of a step. */
    String provider(String component, Step.Outgoing step) {
        return bound(component, step.role());
    }

    /** The component or resource that a component means by {@code role}. */
    String bound(String component, String role) {
        return parts.bindings().getOrDefault(component + "." + role, role);
    }

    /** The components of {@code among} that call an offer, in order. */
    List<String> callers(String provider, String call, Set<String> among) {
        return partners(provider, call, among, step -> step instanceof Step.Requests || step instanceof Step.Asks);
    }

    /** The components of {@code among} that send a message, in order. */
    List<String> senders(String receiver, String message, Set<String> among) {
        return partners(receiver, message, among, Step.Sends.class::isInstance);
    }

    private List<String> partners(String other, String call, Set<String> among, Predicate<Step.Outgoing> isOfKind) {
        return parts.components().keySet().stream()
                .filter(among::contains)
                .filter(component -> protocol(component)
                        .outgoing()
                        .filter(isOfKind)
                        .anyMatch(step -> step.call().equals(call)
                                && provider(component, step).equals(other)))
                .toList();
    }

    /** Checks the argument of a question about states: components with some of their states. */
    void requireStates(Map<String, Set<String>> states) {
        require(!states.isEmpty(), "a question is about no component; expected one or more with their states");
        states.forEach((component, some) -> {
            var known = protocol(component).states();
            require(!some.isEmpty(), "a question is about no state of " + component + "; known: " + known);
            for (var state : some) {
                require(
                        known.contains(state),
                        component + " has no state " + state + "; " + Suggestions.hintWithAll(state, known));
            }
        });
    }

    /** By state of a component: its questions, written {@code component.call}, that may be open when it is there. */
    Map<String, Set<String>> openQuestions(String component) {
        var protocol = protocol(component);
        var open = new HashMap<String, Set<String>>();
        protocol.states().forEach(state -> open.put(state, new LinkedHashSet<>()));
        var isGrowing = true;
        while (isGrowing) {
            isGrowing = false;
            for (var step : protocol.steps()) {
                var after = new LinkedHashSet<>(requireNonNull(open.get(step.from())));
                switch (step) {
                    case Step.Asks asks -> after.add(target(component, asks));
                    case Step.Cancels cancels -> after.remove(target(component, cancels));
                    case Step.Takes takes -> {
                        if (takes.outcome() != Step.Takes.Outcome.ANSWER
                                || !protocol(provider(component, takes)).isStream(takes.call())) {
                            after.remove(target(component, takes));
                        }
                    }
                    default -> {}
                }
                isGrowing |= step.targets()
                        .map(to -> requireNonNull(open.get(to)).addAll(after))
                        .reduce(false, Boolean::logicalOr);
            }
        }
        return open;
    }

    /** The call or message of a step, written {@code component.call}. */
    String target(String component, Step.Outgoing step) {
        return provider(component, step) + "." + step.call();
    }

    /** Whether a call or message, written {@code component.call}, comes from outside. */
    boolean isOpen(String target) {
        return parts.open().contains(target);
    }

    Optional<Mailbox> mailbox(String component) {
        return Optional.ofNullable(parts.mailboxes().get(component));
    }

    /** The units of each resource, by its name. */
    Map<String, Integer> resources() {
        return parts.resources();
    }

    /** The items that a stream holds. */
    int window(String component, String call) {
        return parts.windows().getOrDefault(component + "." + call, 1);
    }

    /** The groups that stop in one step, in order; empty if each component stops alone. */
    List<Set<String>> stopGroups() {
        return stopGroups.orElse(List.of());
    }

    /** The states in which a component may stop, alone or with its group. */
    List<String> stops(String component) {
        var protocol = protocol(component);
        if (stopGroups.isEmpty()) {
            return protocol.stopStates();
        }
        var isGrouped = stopGroups().stream().anyMatch(group -> group.contains(component));
        return isGrouped ? protocol.synchronisedStops() : List.of();
    }

    /** The components and the name. */
    @Override
    public String toString() {
        return name + " " + parts.components().keySet();
    }
}
