package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.FairRuns.Fails;
import io.troupe.petri.ReachabilityGraph.Edge;
import io.troupe.petri.ReachabilityGraph.State;
import java.util.ArrayDeque;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.function.Predicate;
import org.junit.jupiter.api.Test;

/** Questions about fair runs, compared with their definition on random nets. */
class FairRunsTest {
    private static final int NETS = 400;
    private static final int MAX_MARKINGS = 60;

    /** The sample of the Javadoc. */
    @Test
    void customer_isServedInTheEnd() {
        var net = Nets.net("shop", "waiting=1 served", "serve: waiting > served", "leave: served > waiting");
        var waiting = net.place("waiting");
        var served = net.place("served");
        var runs = FairRuns.of(ReachabilityGraph.explore(net));
        var answer = runs.leadsTo(marking -> marking.tokens(waiting) > 0, marking -> marking.tokens(served) > 0);
        assertThat(answer).isInstanceOf(Answer.Yes.class);
    }

    private static Set<State> reached(State from, Predicate<State> passes) {
        var reached = new LinkedHashSet<>(List.of(from));
        var ahead = new ArrayDeque<>(reached);
        while (!ahead.isEmpty()) {
            ahead.remove().successors().stream()
                    .map(Edge::target)
                    .filter(passes)
                    .filter(reached::add)
                    .forEach(ahead::add);
        }
        return reached;
    }

    /** A fair run may stay for ever with {@code state}, without a goal: all that it leads to leads back. */
    private static boolean staysWithout(State state, Predicate<Marking> goal) {
        return reached(state, next -> true).stream()
                .allMatch(next -> !goal.test(next.marking())
                        && reached(next, each -> true).contains(state));
    }

    @Test
    void answers_onRandomNets_areThoseOfTheDefinition() {
        var holding = 0;
        var failing = 0;
        for (var seed = 0L; seed < NETS; seed++) {
            var random = new Random(seed);
            var net = Nets.any(random);
            var graph = ReachabilityGraph.explore(net, MAX_MARKINGS);
            if (!graph.isComplete() || net.places().isEmpty()) {
                continue;
            }
            var asked = net.places().get(random.nextInt(net.places().size()));
            var wanted = net.places().get(random.nextInt(net.places().size()));
            Predicate<Marking> when = marking -> marking.tokens(asked) > 0;
            Predicate<Marking> goal = marking -> marking.tokens(wanted) > 0;
            var fails = graph.states().stream()
                    .filter(state -> when.test(state.marking()) && !goal.test(state.marking()))
                    .anyMatch(state -> reached(state, next -> !goal.test(next.marking())).stream()
                            .anyMatch(next -> staysWithout(next, goal)));
            var answer = FairRuns.of(graph).leadsTo(when, goal);
            assertThat(answer).as("seed %d", seed).isInstanceOf(fails ? Answer.No.class : Answer.Yes.class);
            if (answer instanceof Answer.No<Fails>(var found)) {
                failing++;
                assertThat(net.fire(net.initialMarking(), found.trace())).isEqualTo(found.marking());
                assertThat(when.test(found.marking())).isTrue();
                var marking = found.marking();
                for (var step : found.way()) {
                    assertThat(goal.test(marking)).isFalse();
                    marking = net.fire(marking, step);
                }
                assertThat(found.forever().contains(graph.find(marking).orElseThrow()))
                        .isTrue();
                assertThat(found.forever().states()).noneMatch(state -> goal.test(state.marking()));
            } else {
                holding++;
            }
        }
        assertThat(holding).isGreaterThan(30);
        assertThat(failing).isGreaterThan(30);
    }
}
