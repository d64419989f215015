package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Marking;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import io.troupe.petri.wiring.PossibleMarkings.World;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayDeque;
import java.util.EnumMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;

/**
 * The markings that a monitor holds for possible are exactly those of the full graph that random events lead to: none
 * that cannot be reached, and none is missing.
 */
class PossibleMarkingsTest {
    private static final int WIRINGS = 300;
    private static final int STEPS = 60;
    private static final int MAX_MARKINGS = 3_000;

    private final Map<Kind, Integer> kinds = new EnumMap<>(Kind.class);
    private int refused;
    private int deadlocks;

    /** The events of one net, and the markings that they can lead to by the graph. */
    private static final class Followed {
        private final WiringNet net;
        private final Set<String> observed;
        private final PossibleMarkings markings;
        private Set<State> expected;
        private List<World> now;

        Followed(WiringNet net, Set<String> observed, State first) {
            this.net = net;
            this.observed = observed;
            this.markings = new PossibleMarkings(net, observed, null);
            this.expected = closed(Set.of(first));
            this.now = markings.first();
        }

        Optional<ProtocolEvent> seen(Transition transition) {
            return net.event(transition)
                    .seen()
                    .filter(event -> event.kind() != Kind.DID || observed.contains(event.what()));
        }

        /** Adds the markings that transitions lead to which need not be seen. */
        private Set<State> closed(Set<State> states) {
            var all = new LinkedHashSet<>(states);
            var ahead = new ArrayDeque<>(states);
            while (!ahead.isEmpty()) {
                for (var edge : ahead.remove().successors()) {
                    var isUnseen = seen(edge.transition()).isEmpty()
                            || net.event(edge.transition()).mayBeUnseen();
                    if (isUnseen && all.add(edge.target())) {
                        ahead.add(edge.target());
                    }
                }
            }
            return all;
        }

        /** Whether the event is possible. */
        boolean follow(ProtocolEvent event, String seed) {
            var after = new LinkedHashSet<State>();
            for (var state : expected) {
                for (var edge : state.successors()) {
                    if (seen(edge.transition()).equals(Optional.of(event))) {
                        after.add(edge.target());
                    }
                }
                if (state.marking().marked().stream()
                        .anyMatch(place -> net.onlyWay(place)
                                .filter(way -> way.waits().equals(event))
                                .isPresent())) {
                    after.add(state); // its only step is one that waits
                }
            }
            var found = markings.after(now, event);
            assertThat(found.isEmpty()).as("%s: %s is impossible", seed, event).isEqualTo(after.isEmpty());
            if (after.isEmpty()) {
                assertThat(markings.whyNot(now, event).getValue()).as(seed).isNotBlank();
                return false;
            }
            expected = closed(after);
            now = found;
            compare(seed + " after " + event);
            return true;
        }

        void compare(String where) {
            assertThat(markings.markings(now))
                    .as(where)
                    .isEqualTo(expected.stream()
                            .map(state -> words(state.marking()))
                            .collect(Collectors.toSet()));
            assertThat(markings.canGoOn(now))
                    .as("%s is no deadlock", where)
                    .isEqualTo(expected.stream()
                            .anyMatch(state -> !state.successors().isEmpty()));
        }

        private static Set<String> words(Marking marking) {
            return marking.marked().stream()
                    .map(place -> marking.tokens(place) + "*" + place)
                    .collect(Collectors.toCollection(TreeSet::new));
        }
    }

    private void follow(Wiring wiring, Random random, String seed) {
        var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        var graph = ReachabilityGraph.explore(net.net(), MAX_MARKINGS);
        if (!graph.isComplete()) {
            return;
        }
        var state = graph.states().get(0);
        var followed = new Followed(net, random.nextBoolean() ? Set.of("x") : Set.of(), state);
        followed.compare(seed);
        var events = net.net().transitions().stream()
                .flatMap(transition -> followed.seen(transition).stream())
                .distinct()
                .toList();
        for (var i = 0; i < STEPS && !state.successors().isEmpty(); i++) {
            var edge = state.successors().get(random.nextInt(state.successors().size()));
            state = edge.target();
            var event = followed.seen(edge.transition());
            if (event.isPresent()) {
                kinds.merge(event.get().kind(), 1, Integer::sum);
                assertThat(followed.follow(event.get(), seed))
                        .as("%s: %s", seed, event)
                        .isTrue();
                assertThat(followed.expected).contains(state);
            }
        }
        deadlocks += followed.markings.canGoOn(followed.now) ? 0 : 1;
        for (var i = 0; i < 10 && !events.isEmpty(); i++) { // also those that are impossible
            refused += followed.follow(events.get(random.nextInt(events.size())), seed) ? 0 : 1;
        }
    }

    @Test
    void possibleMarkings_areThoseOfTheGraph() {
        for (var seed = 0L; seed < WIRINGS; seed++) {
            var random = new Random(seed);
            follow(new RandomWiring(random).wiring("seed " + seed), random, "seed " + seed);
        }
        follow(DeclarationsTest.frames(2).build(), new Random(0), "a stream to its end");
        assertThat(kinds.keySet()).as("kinds of events").contains(Kind.values());
        assertThat(refused).as("events that are impossible").isGreaterThan(200);
        assertThat(deadlocks).as("runs into a deadlock").isPositive();
    }

    @Test
    void possibleMarkings_withSynchronisedStops_areThoseOfTheGraph() {
        var wiring = PaperWiring.wiring();
        for (var seed = 0L; seed < 10; seed++) {
            follow(wiring, new Random(seed), "each stops alone, seed " + seed);
            follow(wiring.withSynchronisedStop(), new Random(seed), "all stop, seed " + seed);
        }
        assertThat(kinds).containsOnlyKeys(Kind.ASKED, Kind.TAKEN, Kind.ANSWERED);
    }
}
