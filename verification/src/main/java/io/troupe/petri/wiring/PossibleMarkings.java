package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Arc;
import io.troupe.petri.Place;
import io.troupe.petri.wiring.WiringNet.ComponentState;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicReferenceArray;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * The markings of a wiring's net in which a program can be after what was seen of it. They are found by firing the
 * transitions of the net, those that are not seen at any time, so each of them can be reached; and none is left out.
 *
 * <p>A set of markings is a list of {@link World}s: for each component the places on which its token can be, in any
 * combination, and one marking of the places between components. Mostly there is one world, so that the cost of an
 * event does not grow with the number of combinations.
 *
 * <p>Long, because it also words what is possible and why an event is not.
 *
 * <p><b>Threads.</b> Thread-safe.
 */
final class PossibleMarkings {
    /** Some markings: all combinations of the components' places, with these tokens between components. */
    record World(List<BitSet> local, List<Integer> between) {
        boolean covers(World other) {
            for (var i = 0; i < local.size(); i++) {
                if (!covers(local.get(i), other.local.get(i))) {
                    return false;
                }
            }
            return between.equals(other.between);
        }

        private static boolean covers(BitSet all, BitSet part) {
            if (all == part) {
                return true;
            }
            var rest = (BitSet) part.clone();
            rest.andNot(all);
            return rest.isEmpty();
        }
    }

    /** A transition: one place before and after for each component, and what it takes and puts between them. */
    private record Firing(
            WiringNet.Event event,
            int[] components,
            int[] from,
            int[] to,
            int[] takes,
            int[] takesTokens,
            int[] puts,
            int[] putsTokens) {
        boolean isLocal() {
            return components.length == 1 && takes.length == 0 && puts.length == 0;
        }

        int find(int component) {
            for (var i = 0; i < components.length; i++) {
                if (components[i] == component) {
                    return i;
                }
            }
            return -1;
        }

        boolean finds(World world) {
            for (var i = 0; i < components.length; i++) {
                if (!world.local.get(components[i]).get(from[i])) {
                    return false;
                }
            }
            return true;
        }

        boolean hasTokens(World world) {
            for (var i = 0; i < takes.length; i++) {
                if (world.between.get(takes[i]) < takesTokens[i]) {
                    return false;
                }
            }
            return true;
        }

        boolean mayFire(World world) {
            return finds(world) && hasTokens(world);
        }

        List<Integer> between(World world) {
            if (takes.length == 0 && puts.length == 0) {
                return world.between;
            }
            var after = new ArrayList<>(world.between);
            for (var i = 0; i < takes.length; i++) {
                after.set(takes[i], after.get(takes[i]) - takesTokens[i]);
            }
            for (var i = 0; i < puts.length; i++) {
                after.set(puts[i], after.get(puts[i]) + putsTokens[i]);
            }
            return after;
        }
    }

    /** Firings with the same effect on the places between components, and of the same components. */
    private record Effect(List<Integer> components, List<Integer> between) {}

    private final Wiring wiring;
    private final WiringNet net;
    private final List<String> components;
    private final List<List<Place>> local = new ArrayList<>(); // by component
    private final List<Place> between = new ArrayList<>();
    private final WiringNet.@Nullable Entry without;
    private final List<Firing> leftOut = new ArrayList<>(); // those of that step
    private final List<Firing> firings = new ArrayList<>();
    private final Map<ProtocolEvent, List<Firing>> seen = new HashMap<>();
    private final List<List<Firing>> unseen = new ArrayList<>(); // by component: those that are local
    private final List<Firing> unseenBetween = new ArrayList<>();
    private final List<Map<BitSet, BitSet>> closures = new ArrayList<>(); // by component
    /** By component: what {@link #closed} gives for each of its places, once it was needed. */
    private final List<AtomicReferenceArray<@Nullable BitSet>> closedPlaces = new ArrayList<>();

    private final List<World> first;
    private volatile int lastEnabled;

    /**
     * Starts in the first marking.
     *
     * @param observed the labels of the private steps that are seen
     * @param without a step that no component takes; null = none
     */
    PossibleMarkings(WiringNet net, Set<String> observed, WiringNet.@Nullable Entry without) {
        this.wiring = net.wiring();
        this.net = net;
        this.without = without;
        this.components = wiring.components();
        var index = new HashMap<Place, Integer>();
        var owner = new HashMap<Place, Integer>();
        for (var component : components) {
            local.add(new ArrayList<>());
            unseen.add(new ArrayList<>());
            closures.add(new ConcurrentHashMap<>());
        }
        for (var place : net.net().places()) {
            int own = net.owner(place).map(components::indexOf).orElse(-1);
            var among = own < 0 ? between : local.get(own);
            owner.put(place, own);
            index.put(place, among.size());
            among.add(place);
        }
        local.forEach(places -> closedPlaces.add(new AtomicReferenceArray<>(places.size())));
        for (var transition : net.net().transitions()) {
            var event = net.event(transition);
            var firing = firing(event, transition.inputs(), transition.outputs(), owner, index);
            if (without != null && event.entry().equals(Optional.of(without))) {
                leftOut.add(firing);
            } else {
                add(
                        firing,
                        event.seen()
                                .filter(each ->
                                        each.kind() != ProtocolEvent.Kind.DID || observed.contains(each.what())));
            }
        }
        local.forEach(places -> places.forEach(place -> net.onlyWay(place).ifPresent(way -> add(place, way.waits()))));
        var start = local.stream().map(PossibleMarkings::marked).toList();
        first = close(List.of(new World(
                IntStream.range(0, start.size())
                        .mapToObj(i -> closed(i, start.get(i)))
                        .toList(),
                between.stream().map(place -> Math.toIntExact(place.tokens())).toList())));
    }

    private static BitSet marked(List<Place> places) {
        var marked = new BitSet();
        for (var i = 0; i < places.size(); i++) {
            marked.set(i, places.get(i).tokens() > 0);
        }
        return marked;
    }

    private static Firing firing(
            WiringNet.Event event,
            List<Arc> inputs,
            List<Arc> outputs,
            Map<Place, Integer> owner,
            Map<Place, Integer> index) {
        var after = new HashMap<Integer, Integer>();
        for (var arc : outputs) {
            if (requireNonNull(owner.get(arc.place())) >= 0) {
                after.put(requireNonNull(owner.get(arc.place())), requireNonNull(index.get(arc.place())));
            }
        }
        var own = inputs.stream()
                .filter(arc -> requireNonNull(owner.get(arc.place())) >= 0)
                .toList();
        if (own.size() != after.size()) {
            throw new IllegalStateException("a component does not keep its token in " + event);
        }
        return new Firing(
                event,
                own.stream()
                        .mapToInt(arc -> requireNonNull(owner.get(arc.place())))
                        .toArray(),
                own.stream()
                        .mapToInt(arc -> requireNonNull(index.get(arc.place())))
                        .toArray(),
                own.stream()
                        .mapToInt(arc -> requireNonNull(after.get(owner.get(arc.place()))))
                        .toArray(),
                between(inputs, owner)
                        .mapToInt(arc -> requireNonNull(index.get(arc.place())))
                        .toArray(),
                between(inputs, owner).mapToInt(Arc::weight).toArray(),
                between(outputs, owner)
                        .mapToInt(arc -> requireNonNull(index.get(arc.place())))
                        .toArray(),
                between(outputs, owner).mapToInt(Arc::weight).toArray());
    }

    private static Stream<Arc> between(List<Arc> arcs, Map<Place, Integer> owner) {
        return arcs.stream().filter(arc -> requireNonNull(owner.get(arc.place())) < 0);
    }

    private void add(Firing firing, Optional<ProtocolEvent> event) {
        firings.add(firing);
        event.ifPresent(
                each -> seen.computeIfAbsent(each, key -> new ArrayList<>()).add(firing));
        if (event.isEmpty() || firing.event().mayBeUnseen()) {
            (firing.isLocal() ? unseen.get(firing.components()[0]) : unseenBetween).add(firing);
        }
    }

    /** An event in which a component stays on its place. */
    private void add(Place place, ProtocolEvent event) {
        int component = components.indexOf(event.component());
        int[] where = {local.get(component).indexOf(place)};
        int[] none = {};
        seen.computeIfAbsent(event, key -> new ArrayList<>())
                .add(new Firing(
                        WiringNet.Event.of(event.component()),
                        new int[] {component},
                        where,
                        where,
                        none,
                        none,
                        none,
                        none));
    }

    List<World> first() {
        return first;
    }

    // ---- events

    /** The markings after an event; empty if it is not possible in any. */
    List<World> after(List<World> now, ProtocolEvent event) {
        var candidates = seen.getOrDefault(event, List.of());
        var found = new ArrayList<World>();
        for (var world : now) {
            fire(world, candidates, found);
        }
        return close(found);
    }

    private void fire(World world, List<Firing> candidates, List<World> found) {
        @Nullable Firing only = null; // loops, since this is done for each event
        for (var i = 0; i < candidates.size(); i++) {
            if (candidates.get(i).mayFire(world)) {
                if (only != null) {
                    fireAny(world, enabled(candidates, world), found);
                    return;
                }
                only = candidates.get(i);
            }
        }
        if (only != null) {
            found.add(moved(world, only));
        }
    }

    private static List<Firing> enabled(List<Firing> candidates, World world) {
        return candidates.stream().filter(firing -> firing.mayFire(world)).toList();
    }

    /** One of several transitions fires; the worlds are as few as describe exactly the markings after it. */
    private void fireAny(World world, List<Firing> enabled, List<World> found) {
        var effects = new LinkedHashMap<Effect, List<Firing>>();
        for (var firing : enabled) {
            var who = Arrays.stream(firing.components()).boxed().toList();
            effects.computeIfAbsent(new Effect(who, firing.between(world)), key -> new ArrayList<>())
                    .add(firing);
        }
        effects.forEach((effect, fired) -> {
            var who = effect.components();
            var places = who.stream().map(each -> new BitSet()).toList();
            var combinations = new LinkedHashSet<List<Integer>>();
            for (var firing : fired) {
                for (var i = 0; i < who.size(); i++) {
                    places.get(i).set(firing.to()[i]);
                }
                combinations.add(Arrays.stream(firing.to()).boxed().toList());
            }
            var product = places.stream().mapToLong(BitSet::cardinality).reduce(1, (a, b) -> a * b);
            if (product == combinations.size()) {
                found.add(moved(world, who, places, effect.between()));
                return;
            }
            for (var combination : combinations) {
                var only = combination.stream().map(PossibleMarkings::only).toList();
                found.add(moved(world, who, only, effect.between()));
            }
        });
    }

    private static BitSet only(int place) {
        var only = new BitSet();
        only.set(place);
        return only;
    }

    private World moved(World world, Firing firing) {
        var local = new ArrayList<>(world.local());
        for (var i = 0; i < firing.components().length; i++) {
            var component = firing.components()[i];
            local.set(component, closedPlace(component, firing.to()[i]));
        }
        return new World(local, firing.between(world));
    }

    private World moved(World world, List<Integer> who, List<BitSet> places, List<Integer> after) {
        var local = new ArrayList<>(world.local());
        for (var i = 0; i < who.size(); i++) {
            local.set(who.get(i), closed(who.get(i), places.get(i)));
        }
        return new World(local, after);
    }

    private BitSet closedPlace(int component, int place) {
        var places = closedPlaces.get(component);
        var known = places.get(place);
        if (known == null) {
            known = closed(component, only(place));
            places.set(place, known);
        }
        return known;
    }

    /** Adds where steps that are not seen lead a component by itself. */
    private BitSet closed(int component, BitSet places) {
        return closures.get(component).computeIfAbsent(places, start -> {
            var all = (BitSet) start.clone();
            var isGrowing = true;
            while (isGrowing) {
                isGrowing = false;
                for (var firing : unseen.get(component)) {
                    if (all.get(firing.from()[0]) && !all.get(firing.to()[0])) {
                        all.set(firing.to()[0]);
                        isGrowing = true;
                    }
                }
            }
            return all;
        });
    }

    /** Adds what transitions lead to that are not seen, and in which others take part. */
    private List<World> close(List<World> worlds) {
        if (unseenBetween.isEmpty() && worlds.size() < 2) {
            return List.copyOf(worlds);
        }
        var all = new ArrayList<World>();
        worlds.forEach(world -> addNew(all, world));
        for (var i = 0; i < all.size(); i++) {
            for (var firing : unseenBetween) {
                if (firing.mayFire(all.get(i))) {
                    addNew(all, moved(all.get(i), firing));
                }
            }
        }
        return List.copyOf(all);
    }

    private static void addNew(List<World> all, World world) {
        for (var known : all) {
            if (known.covers(world)) {
                return;
            }
        }
        all.add(world);
    }

    // ---- questions

    /** Whether any transition can fire in any of the markings; otherwise the program is in a deadlock. */
    boolean canGoOn(List<World> now) {
        var start = lastEnabled;
        for (var i = 0; i < firings.size(); i++) {
            var at = (start + i) % firings.size();
            for (var world : now) {
                if (firings.get(at).mayFire(world)) {
                    lastEnabled = at;
                    return true;
                }
            }
        }
        return false;
    }

    /** The places on which the token of a component may be. */
    private Set<Place> places(List<World> now, int component) {
        var found = new LinkedHashSet<Place>();
        now.forEach(world -> world.local().get(component).stream()
                .mapToObj(local.get(component)::get)
                .forEach(found::add));
        return found;
    }

    /** Whether a component is surely in one of these states. */
    boolean isWithin(List<World> now, String component, Set<String> states) {
        return places(now, components.indexOf(component)).stream()
                .allMatch(place ->
                        net.componentState(place).in().filter(states::contains).isPresent());
    }

    /** Whether a component may have no call and no wait under way. */
    boolean mayRest(List<World> now, String component) {
        var index = components.indexOf(component);
        return now.stream()
                .anyMatch(world -> world.local().get(index).stream().anyMatch(place -> isRest(world, index, place)));
    }

    private boolean isRest(World world, int component, int place) {
        var where = local.get(component).get(place);
        var state = net.componentState(where);
        return state instanceof ComponentState.Ended
                || state instanceof ComponentState.At
                        && (net.onlyWay(where).isEmpty() || canLeave(world, component, place));
    }

    /** Whether a component can take a step from this place; to fail is none. */
    private boolean canLeave(World world, int component, int place) {
        return firings.stream()
                .filter(firing -> firing.find(component) >= 0 && firing.from()[firing.find(component)] == place)
                .filter(firing -> firing.event()
                        .seen()
                        .filter(event -> event.kind() == ProtocolEvent.Kind.FAILED)
                        .isEmpty())
                .anyMatch(firing -> firing.mayFire(world));
    }

    /** What is surely under way: a component with its situation, or words for a message or question; else empty. */
    Optional<Map.Entry<String, String>> underWay(List<World> now) {
        for (var component : components) {
            if (!mayRest(now, component)) {
                return Optional.of(Map.entry(component, component + " " + wait(now, component)));
            }
        }
        Optional<Map.Entry<String, String>> found = Optional.empty();
        for (var world : now) {
            found = underWay(world);
            if (found.isEmpty()) {
                return found;
            }
        }
        return found;
    }

    private Optional<Map.Entry<String, String>> underWay(World world) {
        for (var component : components) {
            if (!mayRest(List.of(world), component)) {
                return Optional.of(Map.entry(component, component + " " + wait(List.of(world), component)));
            }
        }
        for (var i = 0; i < between.size(); i++) {
            var place = between.get(i);
            if (world.between().get(i) > 0) {
                switch (net.componentState(place)) {
                    case ComponentState.Unanswered(var component, var target) -> {
                        return Optional.of(Map.entry(component, place.name()));
                    }
                    case ComponentState.Holding(var component, var messages)
                    when !messages.isEmpty() -> {
                        return Optional.of(Map.entry(component, place.name()));
                    }
                    default -> {
                        // nothing waits for it
                    }
                }
            }
        }
        return Optional.empty();
    }

    /** What a component that does not rest waits for. */
    private String wait(List<World> now, String component) {
        return describe(
                now,
                component,
                place -> net.onlyWay(place)
                        .map(way -> waiting(now, component, way.step()))
                        .orElseGet(() -> describe(now, place)));
    }

    private String waiting(List<World> now, String component, Step.Waiting step) {
        return switch (step) {
            case Step.Acquires acquires -> {
                var resource = wiring.bound(component, acquires.resource());
                yield "waits for " + resource + held(now, resource);
            }
            case Step.Sends sends -> {
                var receiver = wiring.provider(component, sends);
                yield "waits for room to send " + sends.call() + " to " + receiver + contents(now, receiver);
            }
            case Step.Emits emits -> "waits for room to emit " + emits.call();
            case Step.Asks asks ->
                "waits to ask " + wiring.target(component, asks) + " again, since its question is still open";
        };
    }

    /** Who may hold a resource. */
    private String held(List<World> now, String resource) {
        var found = IntStream.range(0, components.size())
                .filter(i -> places(now, i).stream()
                        .flatMap(place -> net.componentState(place).in().stream())
                        .flatMap(state -> wiring.protocol(components.get(i)).held(state).stream())
                        .anyMatch(role -> wiring.bound(components.get(i), role).equals(resource)))
                .mapToObj(components::get)
                .toList();
        return found.isEmpty()
                ? ""
                : ", which " + String.join(" and ", found) + (found.size() == 1 ? " holds" : " hold");
    }

    private String contents(List<World> now, String receiver) {
        return IntStream.range(0, between.size())
                .filter(i -> net.componentState(between.get(i)) instanceof ComponentState.Holding holding
                        && holding.component().equals(receiver)
                        && now.stream().anyMatch(world -> world.between().get(i) > 0))
                .mapToObj(i -> ", whose mailbox holds "
                        + ((ComponentState.Holding) net.componentState(between.get(i))).messages())
                .collect(Collectors.joining(" or"));
    }

    /**
     * The component that makes an event impossible, and why; only after an event that {@link #after} found to be so.
     */
    Map.Entry<String, String> whyNot(List<World> now, ProtocolEvent event) {
        var candidates = new ArrayList<>(seen.getOrDefault(event, List.of()));
        var left = without;
        var isLeftOut = left != null
                && candidates.addAll(leftOut.stream()
                        .filter(firing -> firing.event().seen().equals(Optional.of(event)))
                        .toList());
        for (var component : new LinkedHashSet<>(List.of(event.component(), event.provider()))) {
            var index = components.indexOf(component);
            var takesPart = candidates.stream()
                    .filter(firing -> firing.find(index) >= 0)
                    .toList();
            if (candidates.isEmpty()
                    || !takesPart.isEmpty()
                            && takesPart.stream()
                                    .noneMatch(firing -> now.stream()
                                            .anyMatch(world ->
                                                    world.local().get(index).get(firing.from()[firing.find(index)])))) {
                return Map.entry(component, component + " " + describe(now, component) + options(now, component));
            }
        }
        if (isLeftOut && left != null) {
            var component = left.component();
            return Map.entry(component, component + " " + describe(now, component) + options(now, component));
        }
        var needed = new TreeSet<String>();
        var free = new TreeSet<String>();
        for (var world : now) {
            candidates.stream()
                    .filter(firing -> firing.finds(world))
                    .flatMapToInt(firing -> IntStream.range(0, firing.takes().length)
                            .filter(i -> world.between().get(firing.takes()[i]) < firing.takesTokens()[i])
                            .map(i -> firing.takes()[i]))
                    .forEach(place -> {
                        free.add("not: " + between.get(place));
                        needed.addAll(instead(world, group(between.get(place))));
                    });
        }
        return Map.entry(event.component(), String.join(", ", needed.isEmpty() ? free : needed));
    }

    private String options(List<World> now, String component) {
        var allowed = allowed(now, component);
        return ", where it may " + (allowed.isEmpty() ? "do nothing" : String.join(", or ", allowed));
    }

    /** What is so instead of a token on a place: the content of the mailbox, the phase of the question. */
    private List<String> instead(World world, String group) {
        return IntStream.range(0, between.size())
                .filter(i -> world.between().get(i) > 0 && group(between.get(i)).equals(group))
                .mapToObj(i -> between.get(i).name())
                .toList();
    }

    private static String group(Place place) {
        var name = place.name();
        var end = Math.max(name.indexOf("'s mailbox "), name.indexOf(" ", name.indexOf("'s question ") + 12));
        return name.contains("'s mailbox ") || name.contains("'s question ") ? name.substring(0, end) : name;
    }

    /** What can be seen of a component next, in the words of the declaration. */
    Set<String> allowed(List<World> now, String component) {
        var index = components.indexOf(component);
        var found = new TreeSet<String>();
        seen.forEach((event, fired) -> {
            var option = event.asOptionOf(component);
            if (!option.isEmpty()
                    && fired.stream()
                            .anyMatch(firing -> firing.find(index) >= 0
                                    && now.stream()
                                            .anyMatch(world ->
                                                    world.local().get(index).get(firing.from()[firing.find(index)])))) {
                found.add(option);
            }
        });
        return found;
    }

    /** For example {@code is in "ready" or is in "loaded"}. */
    String describe(List<World> now, String component) {
        return describe(now, component, place -> describe(now, place));
    }

    private String describe(List<World> now, String component, Function<Place, String> words) {
        return places(now, components.indexOf(component)).stream()
                .map(words)
                .distinct()
                .sorted()
                .collect(Collectors.joining(" or "));
    }

    private String describe(List<World> now, Place place) {
        return switch (net.componentState(place)) {
            case ComponentState.At(var it, var state) -> "is in \"" + state + "\"";
            case ComponentState.Asking(var it, var request) ->
                "waits for " + wiring.target(it, request) + ", which is not accepted yet";
            case ComponentState.Served(var it, var request) -> "waits for the answer of " + wiring.target(it, request);
            case ComponentState.Ended(var it, var state) -> "has ended in \"" + state + "\"";
            case ComponentState.Serving(var it, var call, var state) ->
                "answers " + call + callers(now, it + "." + call);
            case ComponentState.Decided(var it, var step) -> waiting(now, it, step);
            default -> "has failed";
        };
    }

    private String callers(List<World> now, String target) {
        var found = IntStream.range(0, components.size())
                .filter(i -> places(now, i).stream()
                        .anyMatch(place -> net.componentState(place) instanceof ComponentState.Served call
                                && wiring.target(call.component(), call.request())
                                        .equals(target)))
                .mapToObj(components::get)
                .collect(Collectors.joining(" or "));
        return found.isEmpty() ? "" : " to " + found;
    }

    /** All of the markings, each as its marked places; for small nets. */
    Set<Set<String>> markings(List<World> now) {
        var all = new LinkedHashSet<Set<String>>();
        for (var world : now) {
            Set<String> shared = new TreeSet<>();
            for (var i = 0; i < between.size(); i++) {
                if (world.between().get(i) > 0) {
                    shared.add(world.between().get(i) + "*" + between.get(i));
                }
            }
            var some = List.of(shared);
            for (var i = 0; i < components.size(); i++) {
                var places = places(List.of(world), i);
                some = some.stream()
                        .flatMap(set -> places.stream().map(place -> {
                            Set<String> more = new TreeSet<>(set);
                            more.add("1*" + place);
                            return more;
                        }))
                        .toList();
            }
            all.addAll(some);
        }
        return all;
    }
}
